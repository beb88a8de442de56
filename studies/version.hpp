#pragma once

namespace stylobate {

/// "0.3.0+12.945a212c6e": commits since the one that set the number, and the commit; with ".dirty" where the tree had
/// changes that were not committed (cmake/version.cmake). It goes into every result.
const char* code_version();

/// What compiled it, for results too: "GNU 12.2.0, x86_64, Release, -O3 -DNDEBUG -ffp-contract=off".
const char* code_build();

} // namespace stylobate

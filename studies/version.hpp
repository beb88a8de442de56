#pragma once

namespace stylobate {

/// "0.2.0+1a2b3c4", with "-dirty" where the tree had changes that were not committed: it goes into every result.
const char* code_version();

/// What compiled it, for results too: "GNU 12.2.0, x86_64, Release, -O3 -DNDEBUG -ffp-contract=off".
const char* code_build();

} // namespace stylobate

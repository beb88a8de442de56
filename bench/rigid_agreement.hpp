#pragma once
/// What the first table of docs/rigid_limit.md shows of the agreement with rigid blocks, in sentences and a table that
/// are computed from its numbers, so that the page cannot contradict them.

#include <string>

namespace stylobate {

/// The sentences and the table of a page with a table "contacts | step ... | cells", whose rows are of two corners (by
/// damping ratio and K_N) and of rigid blocks, one of them "rigid, e = 0".
/// @throws std::runtime_error if there is no such table
std::string agreement_text(const std::string& page);

} // namespace stylobate

#include "ensemble/model/collapse_criterion.hpp"

#include <fmt/format.h>

namespace stylobate {

std::string collapse_criterion(const OutcomeSpec& outcome)
{
    return fmt::format(
        "a block has fallen when its centre is below {:.3g} of its height at rest above the base, or when "
        "it has rotated beyond its own slenderness angle atan(width / height) and has not come back "
        "after 1/p, p = sqrt(3 g / (4 R)) with R half the diagonal of a whole column, or by the end of "
        "the realization",
        outcome.collapse_height_fraction);
}

std::string followed_until(const OutcomeSpec& outcome)
{
    return outcome.follow == Follow::rest ? "until all fallen blocks are at rest" : "until the first block has fallen";
}

} // namespace stylobate

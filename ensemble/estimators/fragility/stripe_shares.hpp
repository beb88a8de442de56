#pragma once
/// Shares by stripe without any form of a curve, the monotone curve through them, and whether they are monotone at all.

#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/estimators/fragility/limits.hpp"

#include <string>
#include <vector>

namespace stylobate {

struct StripeShare {
    double intensity = 0;
    std::size_t records = 0;
    double trials = 0, reached = 0;
    double share = 0;
    Limits limits;       ///< of this stripe alone, by its records (`record_share_limits`)
    double monotone = 0; ///< share of the best curve that does not fall (pooled adjacent violators)
    Limits band;         ///< holds all stripes of a truth that does not fall at once, with the level
};

struct StripeShares {
    double level = 0.95;
    std::vector<StripeShare> stripes;
    double p_monotone = 1; ///< of the largest fall between two stripes, were the truth monotone
    std::string says;      ///< the finding in a sentence
};

/// The band is that of all stripes at level 1 - (1 - level) / stripes, each limit carried on to where it must hold too:
/// right for any number of stripes, and not narrower than it may be where neighbours are pooled, as a bootstrap of the
/// monotone curve would be. A fall is the largest of (share_i - share_j) / standard error over i < j, its chance from
/// 1999 flips of the records' signs (stream `bootstrap`).
///
/// @throws InputError with more than one measure
StripeShares stripe_shares(const FragilityData& data, double level = 0.95, std::uint64_t seed = 1);

} // namespace stylobate

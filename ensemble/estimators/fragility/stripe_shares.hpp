#pragma once
/// Shares by stripe without any form of a curve, the monotone curve through them, and a test of monotonicity.

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
    /// By its records (`record_share_limits`). Below the first stripe with damage the upper limit is no greater than
    /// that of any stronger stripe, and above the last stripe without survival likewise the lower one.
    Limits limits;
    double monotone = 0; ///< share of the best non-decreasing curve (pooled adjacent violators)
    Limits band;         ///< contains all stripes of a non-decreasing truth at once, with the level
};

struct StripeShares {
    double level = 0.95;
    std::vector<StripeShare> stripes;
    double p_monotone = 1; ///< of the largest decrease between two stripes, for a monotone truth
    std::string says;      ///< the finding in a sentence
};

/// The band is that of all stripes at level 1 - (1 - level) / stripes (Bonferroni), each limit extended to the stripes
/// where monotonicity implies it too: valid for any number of stripes, and not too narrow where neighbours are pooled,
/// as a bootstrap of the monotone curve would be (own derivation).
///
/// The statistic of a decrease is the largest of (share_i - share_j) / standard error over i < j; its p-value is from
/// 1999 random signs of the records' contributions (stream `bootstrap`), a wild bootstrap with the weights of Liu,
/// "Bootstrap procedures under some non-i.i.d. models", Annals of Statistics 16 (1988) 1696.
///
/// @throws InputError with more than one measure
StripeShares stripe_shares(const FragilityData& data, double level = 0.95, std::uint64_t seed = 1);

} // namespace stylobate

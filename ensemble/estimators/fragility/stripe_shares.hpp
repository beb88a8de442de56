#pragma once
/// Shares by stripe without any form of a curve, the monotone curve through them, and a test of monotonicity.

#include "ensemble/estimators/fragility/fragility_data.hpp"

#include <span>
#include <string>
#include <vector>

namespace stylobate {

// The interval of a share whose trials come in groups, such as runs under the same motion.
//
// Trials of one record are not independent, so a record is one observation: its own share y_g in [0, 1]. Nothing is
// assumed about the distribution of the shares. The upper limit is the quantile (1 + level) / 2 of
//
//   (W_1 y_1 + ... + W_m y_m + W_0) / (W_1 + ... + W_m + W_0),   W independent and exponential
//
// that is, of the mean under random weights of the records (Rubin, "The Bayesian bootstrap", Annals of Statistics 9
// (1981) 130) with one additional record in which everything is reached. The lower limit is that of the trials that
// were not reached. Source: Gaffke, "Three test statistics for a nonparametric one-sided hypothesis on the mean of a
// nonnegative variable", Mathematical Methods of Statistics 14 (2005) 451; Learned-Miller & Thomas, "A new confidence
// interval for the mean of a bounded random variable", arXiv:1905.06208. Where every record is reached by all of its
// trials or by none, it is the interval of Clopper and Pearson of the records.
//
// The interval needs no variance, which cannot be estimated where one record or none is damaged. Its limits never
// decrease when one more trial is reached. Its coverage is at least the nominal one, and higher where records are
// alike (docs/fragility_statistics.md has the measured coverage).

/// Trials of one record.
struct RecordCount {
    double trials = 0;  ///< the record's weight in the share
    double reached = 0; ///< of them, in [0, trials]
};

/// @param records without one, the limits are 0 and 1; records without trials are left out
Limits record_share_limits(std::span<const RecordCount> records, double level);

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

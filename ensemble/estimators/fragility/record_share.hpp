#pragma once
/// The interval of a share whose trials come in groups, such as runs under the same motion.
///
/// Trials of one record are not independent, so a record is one observation: its own share y_g in [0, 1]. Nothing is
/// assumed about the distribution of the shares. The upper limit is the quantile (1 + level) / 2 of
///
///   (W_1 y_1 + ... + W_m y_m + W_0) / (W_1 + ... + W_m + W_0),   W independent and exponential
///
/// that is, of the mean under random weights of the records (Rubin, "The Bayesian bootstrap", Annals of Statistics 9
/// (1981) 130) with one additional record in which everything is reached. The lower limit is that of the trials that
/// were not reached. Source: Gaffke, "Three test statistics for a nonparametric one-sided hypothesis on the mean of a
/// nonnegative variable", Mathematical Methods of Statistics 14 (2005) 451; Learned-Miller & Thomas, "A new confidence
/// interval for the mean of a bounded random variable", arXiv:1905.06208. Where every record is reached by all of its
/// trials or by none, it is the interval of Clopper and Pearson of the records.
///
/// The interval needs no variance, which cannot be estimated where one record or none is damaged. Its limits never
/// decrease when one more trial is reached. Its coverage is at least the nominal one, and higher where records are
/// alike (docs/fragility_statistics.md has the measured coverage).

#include "ensemble/estimators/fragility/limits.hpp"

#include <span>

namespace stylobate {

/// Trials of one record.
struct RecordCount {
    double trials = 0;  ///< the record's weight in the share
    double reached = 0; ///< of them, in [0, trials]
};

/// @param records without one, the limits are 0 and 1; records without trials are left out
Limits record_share_limits(std::span<const RecordCount> records, double level);

} // namespace stylobate

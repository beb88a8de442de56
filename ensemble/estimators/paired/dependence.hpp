#pragma once
/// Whether what an intervention gains depends on a drawn quantity: friction, stiffness, a phase.
///
/// y = (reached in the variant) - (reached in the base) of a pair is -1, 0 or 1. If y does not depend on the quantity,
/// the values of y within a stratum may be exchanged among its pairs. With r the ranks of the quantity within the
/// stratum (ties have their mean rank) the statistic
///
///   T = sum over strata and pairs (r - mean r) y
///
/// then has the mean 0 and the variance sum over strata S_rr S_yy / (n - 1), S the sums of squares about the mean: the
/// extended test of Mantel, "Chi-square tests with one degree of freedom; extensions of the Mantel-Haenszel procedure",
/// Journal of the American Statistical Association 58 (1963) 690. Its p-value is that of the normal distribution. The
/// pairs of a stratum must be independent: motions that several pairs share make it too small.
///
/// How much it depends is shown by the differences in the lower, middle and upper third of the quantity.

#include "ensemble/estimators/paired/paired_difference.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace stylobate {

/// The same realization of two studies.
struct PairedTrial {
    std::size_t stratum = 0; ///< its cell, from 0
    bool base = false;       ///< whether it reached the limit state there
    bool variant = false;
};

struct Dependence {
    double z = 0; ///< positive: the difference variant - base grows with the quantity; 0 where nothing varies
    double p = 1; ///< two-sided
    std::array<double, 2> between{};             ///< values of the quantity between the thirds
    std::array<PairedDifference, 3> thirds = {}; ///< means over the strata
};

/// @param values (trials) finite   @param level of the intervals   @pre there are at least three trials
Dependence dependence_on(std::span<const PairedTrial> trials, std::span<const double> values, double level);

} // namespace stylobate

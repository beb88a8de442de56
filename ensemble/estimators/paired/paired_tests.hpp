#pragma once
/// Exact tests of whether two studies differ, and what many tests at once allow to be named.
///
/// Without an effect the two outcomes of a pair may be exchanged, and with them the sign of every group's difference
/// x = (reached in the variant alone) - (reached in the base alone): all signs are equally likely, and the p-value is
/// the share of sign patterns whose sum is at least as large. Where every group is one pair this is the exact test of
/// McNemar, "Note on the sampling error of the difference between correlated proportions or percentages", Psychometrika
/// 12 (1947) 153: Binomial(b + c, 1/2). The sum over sign patterns is exact too, by their distribution over whole
/// numbers.
///
/// Many cells: the p-values are adjusted. The cells of a surface have draws of their own, so that their tests are
/// independent; then the procedure of Benjamini and Hochberg ("Controlling the false discovery rate", Journal of the
/// Royal Statistical Society B 57 (1995) 289) bounds the expected share of false names among all names. The stripes of
/// a fragility study share structures and motions; there Holm's procedure ("A simple sequentially rejective multiple
/// test procedure", Scandinavian Journal of Statistics 6 (1979) 65), valid under any dependence, bounds the probability
/// of any false name.

#include "ensemble/estimators/paired/paired_difference.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stylobate {

/// Two-sided, twice the smaller of the two one-sided values, at most 1. Exact; with more than 1e8 steps of the
/// distribution by the normal approximation with the correction for continuity.
/// @param groups each exchangeable as a whole
double sign_flip_p(std::span<const PairedCounts> groups);
/// Of independent pairs: McNemar's exact test.
double mcnemar_p(const PairedCounts& counts);

/// Adjusted values: those at most alpha are named at the rate alpha.
std::vector<double> benjamini_hochberg(const std::vector<double>& p);
std::vector<double> holm(const std::vector<double>& p);

// Whether what an intervention gains depends on a drawn quantity: friction, stiffness, a phase.
//
// y = (reached in the variant) - (reached in the base) of a pair is -1, 0 or 1. If y does not depend on the quantity,
// the values of y within a stratum may be exchanged among its pairs. With r the ranks of the quantity within the
// stratum (ties have their mean rank) the statistic
//
//   T = sum over strata and pairs (r - mean r) y
//
// then has the mean 0 and the variance sum over strata S_rr S_yy / (n - 1), S the sums of squares about the mean: the
// extended test of Mantel, "Chi-square tests with one degree of freedom; extensions of the Mantel-Haenszel procedure",
// Journal of the American Statistical Association 58 (1963) 690. Its p-value is that of the normal distribution. The
// pairs of a stratum must be independent: motions that several pairs share make it too small.
//
// How much it depends is shown by the differences in the lower, middle and upper third of the quantity.

/// One realization as two studies have it.
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

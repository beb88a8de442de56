#pragma once
/// The difference of two probabilities that are estimated from the same realizations.
///
/// Of n pairs b reached the limit state in the variant alone and c in the base alone. The difference variant - base is
/// d = (b - c) / n, and its variance (q - d2) / n, q = (b + c) / n: pairs that end alike add nothing to it. The
/// interval is the score interval of Tango, "Equivalence test and confidence interval for the difference in proportions
/// for the paired-sample design", Statistics in Medicine 17 (1998) 891: all d with
///
///   |b - c - n d| <= z sqrt(n (2 q10 + d (1 - d)))
///
/// where q10 is the most likely probability of the pairs of c, given d: the larger root of
/// 2 n x2 - (b + c - (2 n - b + c) d) x - c d (1 - d) = 0. Without a discordant pair its limits are -+ z2 / (n + z2).
///
/// Chosen among Tango's, Agresti and Min's ("Simple improved confidence intervals for comparing matched proportions",
/// Statistics in Medicine 24 (2005) 729) and Bonett and Price's, by exact summation: the coverage of Tango's at level
/// 0.95 is 0.93 to 0.98 with eight expected discordant pairs or more, and it is conservative with few. Agresti and
/// Min's falls to 0.83 where an intervention acts in one direction alone, which is the usual case (docs/compare.md).
///
/// Groups (runs under one motion) are not independent trials. Their counts are divided by the design effect
///
///   D = G / (G - 1) sum over groups (b_g - c_g - n_g d)2 / (n (q - d2)),   within [1/2, mean pairs of a group]
///
/// and z becomes Student's quantile of G - 1 degrees of freedom; without a discordant pair D is its upper bound, as if
/// each group were one pair. The design effect is that of Rao and Scott, "A simple method for the analysis of clustered
/// binary data", Biometrics 48 (1992) 577; its use with Tango's interval is an own choice. Measured coverage:
/// docs/compare.md.
///
/// Strata (cells of a surface) have equal weights, however many pairs each has: d is the mean of the cells'
/// differences, its variance V the sum of theirs over the square of their number, and Tango's interval is taken at the
/// number of pairs (Q - d2) / V that has this variance, at most twice what equal cells would have (Q the mean share of
/// discordant pairs; own choice).

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stylobate {

// Pairs of trials: the same realization of two studies, and whether each reached a limit state.

struct PairedCounts {
    std::uint64_t both = 0;         ///< reached in both
    std::uint64_t base_only = 0;    ///< discordant: reached in the base alone
    std::uint64_t variant_only = 0; ///< discordant: reached in the variant alone
    std::uint64_t neither = 0;

    void add(bool base, bool variant) { ++(base ? (variant ? both : base_only) : (variant ? variant_only : neither)); }
    PairedCounts& operator+=(const PairedCounts& more)
    {
        both += more.both;
        base_only += more.base_only;
        variant_only += more.variant_only;
        neither += more.neither;
        return *this;
    }
    std::uint64_t pairs() const { return both + base_only + variant_only + neither; }
    std::uint64_t base() const { return both + base_only; }
    std::uint64_t variant() const { return both + variant_only; }
    std::uint64_t discordant() const { return base_only + variant_only; }
    bool operator==(const PairedCounts&) const = default;
};

/// Numbers of pairs as real numbers: a design effect divides them.
struct PairedDifference {
    double value = 0; ///< variant - base; NaN without pairs
    double lower = -1;
    double upper = 1;
    double design_effect = 1;
    double quantile = 0; ///< z, or Student's

    double half_width() const { return (upper - lower) / 2; }
};

/// Limits at a quantile: z of the level, or another one. @param pairs > 0, of them `variant_only` and `base_only`
PairedDifference score_interval(double pairs, double base_only, double variant_only, double quantile);

/// Of independent pairs.
PairedDifference paired_difference(const PairedCounts& counts, double level);
/// Of groups of pairs that depend on each other; those without pairs are left out. One group alone: [-1, 1].
PairedDifference grouped_difference(std::span<const PairedCounts> groups, double level);
/// The mean over strata with pairs.
PairedDifference stratified_difference(std::span<const PairedCounts> strata, double level);
/// The mean over strata with pairs at a quantile, with a weight of each stratum; no weights: equal ones.
PairedDifference weighted_difference(std::span<const PairedCounts> strata, std::span<const double> weights,
                                     double quantile);

/// Quantile of the standard normal distribution for a two-sided level.
double two_sided_normal(double level);
/// Quantile of Student's distribution for a two-sided level.
double two_sided_student(double level, double freedom);

/// The share of the variant over that of the base, of independent pairs: the normal interval of the logarithm, with its
/// variance (b + c) / (n_base n_variant), n_base and n_variant the pairs that reached it (delta method), in which one
/// pair is added to those that differ (own choice: without any that differ the width would be 0). From 0 to infinity
/// where either share is 0.
struct PairedRatio {
    double value = 0, lower = 0, upper = 0;
};
PairedRatio paired_ratio(const PairedCounts& counts, double level);

/// How many times as many realizations of each of two studies that are drawn independently give the mean difference
/// over strata the variance that pairs give it: with the shares a and b of the two, the share q of discordant pairs, d
/// = b - a and sums over the strata,
///
///   sum (a (1 - a) + b (1 - b)) / (n - 1)  /  sum (q - d2) / (n - 1).
///
/// Below 1 where more pairs differ than if the two were independent. A stratum with fewer than two pairs is left out.
/// NaN where the paired variance is 0, as without a discordant pair: nothing is known of it then.
double pairing_gain(std::span<const PairedCounts> strata);
/// `pairing_gain` over groups of pairs that depend on each other, where studies drawn independently have groups of
/// their own (other motions): sum (A_g2 + B_g2) / sum (B_g - A_g)2, with the excess A_g and B_g of the counts of a
/// group over its part of the total. With one pair in each group this is `pairing_gain` of one stratum.
double pairing_gain_of_groups(std::span<const PairedCounts> groups);

// How much stronger the shaking must be before a limit state is reached, from pairs at several intensities.
//
// The capacity of a structure is the intensity from which on it reaches the limit state. Where its probability p rises
// from 0 to 1 between the intensities a_1 and a_n, the mean logarithm of the capacities is
//
//   ln a_n - integral of p over ln a
//
// (Spearman and Karber; Finney, *Statistical method in biological assay*, Griffin, 1978, chapter 20), so that the
// ratio of the geometric means of variant and base is
//
//   exp(-sum w_i d_i),     w_i = (ln a_(i + 1) - ln a_(i - 1)) / 2, at the ends of half a width
//
// with d_i the difference of the probabilities at a_i. No form of a curve enters, and no common scale: the ratio of
// one frequency can be compared with that of another structure. Beyond the range d is unknown and counts as 0:
// capacities there count as at its end. Where d is not 0 at an end, the ratio is a bound; where a part of both stands
// at a_n or falls at a_1, it is drawn towards 1.
//
// Between two intensities the shares are not known. Of curves that rise each integral may be off by half of the sum of
// the steps of p times those of ln a, so that the ratio is known within a factor of `grid` only, however many pairs
// there are.
//
// The interval is that of the weighted mean of the differences: by pairs (`weighted_difference`), or by the motions
// (Student's, of the mean over motions of sum w_i d_ig).

struct CapacityRatio {
    /// Of the capacity of the variant over that of the base; NaN where neither has both a realization that reached the
    /// limit state and one that did not: no intensity of the range separates them.
    double value = 0;
    double lower = 0, upper = 0; ///< by the pairs
    double grid = 1;             ///< the ratio may be so many times as large or small, by the steps of the intensities
    /// The differences at the ends of the range say that the ratio is at least, or at most, the value. Both: unknown.
    bool at_least = false, at_most = false;
};

/// @param intensities that grow, > 0
/// @param counts of pairs: of each intensity, or (intensities x groups) of groups that depend on each other
CapacityRatio capacity_ratio(std::span<const double> intensities, std::span<const PairedCounts> counts,
                             std::size_t groups, double level);

} // namespace stylobate

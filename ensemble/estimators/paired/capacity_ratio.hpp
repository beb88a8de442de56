#pragma once
/// How much stronger the shaking must be before a limit state is reached, from pairs at several intensities.
///
/// The capacity of a structure is the intensity from which on it reaches the limit state. Where its probability p rises
/// from 0 to 1 between the intensities a_1 and a_n, the mean logarithm of the capacities is
///
///   ln a_n - integral of p over ln a
///
/// (Spearman and Karber; Finney, *Statistical method in biological assay*, Griffin, 1978, chapter 20), so that the
/// ratio of the geometric means of variant and base is
///
///   exp(-sum w_i d_i),     w_i = (ln a_(i + 1) - ln a_(i - 1)) / 2, at the ends of half a width
///
/// with d_i the difference of the probabilities at a_i. No form of a curve enters, and no common scale: the ratio of
/// one frequency can be compared with that of another structure. Beyond the range d is unknown and counts as 0:
/// capacities there count as at its end. Where d is not 0 at an end, the ratio is a bound; where a part of both stands
/// at a_n or falls at a_1, it is drawn towards 1.
///
/// Between two intensities the shares are not known. Of curves that rise each integral may be off by half of the sum of
/// the steps of p times those of ln a, so that the ratio is known within a factor of `grid` only, however many pairs
/// there are.
///
/// The interval is that of the weighted mean of the differences: by pairs (`weighted_difference`), or by the motions
/// (Student's, of the mean over motions of sum w_i d_ig).

#include "ensemble/estimators/paired/paired_difference.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace stylobate {

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

#pragma once
/// Twins: realizations that differ from another one, their original, in one thing alone. Whether both have the same
/// verdict says how sure it is; how fast they part says how long it can be foretold.
///
/// Of a pair that differs in the place of one drum, the separation is
///
///   s = sqrt( sum over the free blocks of (dx / B)^2 + (dy / B)^2 + dtheta^2 ),   B the mean width of the drums,
///
/// taken after each chunk of steps, which both have in common. It is followed until it reaches the tolerance, or until
/// one of the two ends. The exponent is the slope of ln s over time, by least squares, from the first look at which the
/// original has left its place (by `left_place` widths or radians; before, nothing grows) to the last one below the
/// tolerance, as long as the ground shakes: the largest Lyapunov exponent over a finite time. What is small grows alike
/// whatever its size, until it meets an edge (a contact that opens, a joint that slips) which only one of the two
/// passes; so the exponent belongs to a size.

#include "ensemble/engine/executor.hpp"
#include "ensemble/experiment.hpp"
#include "ensemble/model/followed_twin.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// Realizations that one `LaneSet` can step together, and the study that says how.
struct TwinRange {
    std::uint64_t begin = 0, end = 0; ///< indices
    Study study;
};
/// All realizations of a study with twins, in the order of their indices.
std::vector<TwinRange> twin_ranges(const Study& study);

/// How a realization is stepped: the study itself, but for twins in single precision.
Study stepped_as(const Study& study, std::uint64_t index);

/// How far a block of the original has moved when the growth begins to count, in widths or radians.
inline constexpr double left_place = 1e-3;
/// Fewest looks of a slope.
inline constexpr int least_looks = 8;

/// Follows the moved twins of the first `TwinsSpec::followed` realizations of each cell, in the order of the originals
/// and the kinds; pairs whose original is invalid are left out. The same bits for every instruction set and number of
/// threads.
///
/// @param observer is told of originals that are done
/// @return fewer originals' if the observer asked to stop
std::vector<FollowedTwin> follow_twins(const Experiment& experiment, const RunOptions& options, Observer& observer);

/// Originals that are followed.
std::uint64_t followed_originals(const Study& study);

} // namespace stylobate

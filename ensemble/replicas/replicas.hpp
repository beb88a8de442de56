#pragma once
/// Perturbed replicas (`[twins]`; twins in the names below): realizations that differ from another one, their original,
/// in one property only. The agreement of both verdicts measures how reliable the verdict is; the growth of their
/// separation measures how long the motion is predictable.
///
/// For a pair that differs in the place of one drum, the separation is
///
///   s = sqrt( sum over the free blocks of (dx / B)^2 + (dy / B)^2 + turn^2 ),   B the mean width of the drums,
///
/// (own choice of the norm) taken after each chunk of steps, which both have in common. The pair is followed until s
/// reaches the tolerance, or until one of the two ends. The exponent is the slope of ln s over time, by least squares,
/// from the first sample at which the original has left its place (by `left_place` widths or radians; before, nothing
/// grows) to the last one below the tolerance, during the shaking: the largest Lyapunov exponent over a finite time
/// (Benettin, Galgani & Strelcyn, "Kolmogorov entropy and numerical experiments", Physical Review A 14 (1976) 2338,
/// without renormalization). Small separations grow at the same rate whatever their size, until an event (a contact
/// that opens, a joint that slips) occurs in only one of the two; the exponent therefore belongs to a size.

#include "ensemble/experiment.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/replica_separation.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// Realizations that one `LaneSet` can step together, and the study that they follow.
struct ReplicaRange {
    std::uint64_t begin = 0, end = 0; ///< indices
    Study study;
};
/// All realizations of a study with replicas, in the order of their indices.
std::vector<ReplicaRange> replica_ranges(const Study& study);

/// How a realization is stepped: the study itself, but for replicas in single precision.
Study stepped_as(const Study& study, std::uint64_t index);

/// How far a block of the original has moved when the growth begins to count, in widths or radians.
inline constexpr double left_place = 1e-3;
/// Fewest samples of a slope.
inline constexpr int least_checks = 8;

/// Follows the displaced replicas of the first `ReplicasSpec::followed` realizations of each cell, in the order of the
/// originals and the kinds; pairs whose original is invalid are left out. The same bits for every instruction set and
/// number of threads.
///
/// @param observer is notified of originals that are done
/// @return fewer originals' if the observer asked to stop
std::vector<ReplicaSeparation> replica_separations(const Experiment& experiment, const RunOptions& options,
                                                   Observer& observer);

/// Kinds of displaced replicas; 0 of a study without replicas.
std::uint64_t moves_of(const Study& study);
/// Originals whose displaced replicas are followed; 0 of a study without any.
std::uint64_t separated_originals(const Study& study);

} // namespace stylobate

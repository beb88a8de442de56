#pragma once
/// One realization, followed through time.

#include "ensemble/experiment.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/model/realization.hpp"
#include "io/store/result_store.hpp"
#include "kernels/isa.hpp"

#include <cstdint>
#include <functional>

namespace stylobate {

struct FollowedRealization {
    Realization realization;
    Outcome outcome; ///< the same bits as in the ensemble
    Trajectory trajectory;
};

/// Thrown by `follow` where it was asked to stop.
struct FollowStopped {};

/// Runs one realization to its end. Its trajectory is sampled at `output.trajectory_rate_hz`, from 0 on, linear between
/// the two steps about each sample.
/// @param go_on asked every 1024 steps; false: stop. May be empty
/// @throws FollowStopped then
FollowedRealization follow(const Experiment& experiment, std::uint64_t index, Isa isa,
                           const std::function<bool()>& go_on = {});

/// The row of a results file.
ResultRow result_row(const Study& study, const Realization& realization, const Outcome& outcome);

} // namespace stylobate

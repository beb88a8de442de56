#pragma once
/// One realization, followed through time.

#include "ensemble/experiment.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/model/realization.hpp"
#include "io/store/result_store.hpp"
#include "kernels/isa.hpp"

#include <cstdint>

namespace stylobate {

struct FollowedRealization {
    Realization realization;
    Outcome outcome; ///< the same bits as in the ensemble
    Trajectory trajectory;
};

/// Runs one realization to its end. Its trajectory is sampled at `output.trajectory_rate_hz`, from 0 on, linear between
/// the two steps about each sample.
FollowedRealization follow(const Experiment& experiment, std::uint64_t index, Isa isa);

/// The row of a results file.
ResultRow result_row(const Study& study, const Realization& realization, const Outcome& outcome);

} // namespace stylobate

#pragma once
/// Realizations through time, with their trajectories.

#include "ensemble/experiment.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/run/executor.hpp"
#include "io/store/result_store.hpp"
#include "kernels/isa.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace stylobate {

struct TracedRealization {
    Realization realization;
    Outcome outcome; ///< the same bits as in the ensemble
    Trajectory trajectory;
};

/// Thrown by `trace` where it was asked to stop.
struct TraceStopped {};

/// Runs one realization to its end. Its trajectory is sampled at `output.trajectory_rate_hz`, from 0 on, linear between
/// the two steps about each sample.
/// @param go_on asked every 1024 steps; false: stop. May be empty
/// @throws TraceStopped then
TracedRealization trace(const Experiment& experiment, std::uint64_t index, Isa isa,
                        const std::function<bool()>& go_on = {});

/// Which realizations to trace, and where they go.
struct TracePlan {
    std::vector<std::uint64_t> indices;
    std::uint64_t recorded = 0; ///< those with a lower index have their trajectory recorded
    /// Takes one after the other, in the order of `indices`.
    std::function<void(TracedRealization)> sink;
    /// Asked now and then whether to stop; told the share of the lanes that are busy, and how far the realization is
    /// that is furthest. May be empty.
    std::function<bool(double occupancy, const SimulatedTime& furthest)> stop;
};

/// Runs realizations of a study without replicas to their ends, several in a register and on several threads: the same
/// bits as `trace` gives one by one. The plan's functions are called from one thread at a time.
/// @return false if it was stopped; the sink has then been given all that had ended
/// @throws what `Sampler::realization` or the plan's functions throw, after all threads have stopped
bool trace_all(const Experiment& experiment, const RunOptions& options, const TracePlan& plan);

/// The row of a results file.
ResultRow result_row(const Study& study, const RealizationHeader& realization, const Outcome& outcome);

} // namespace stylobate

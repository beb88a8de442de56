#pragma once
/// Measured motion, tracked by the model in lockstep: an observer and the free windows that start from it.
///
/// Rocking is chaotic: a free run carries no information on the measurement after a few impacts, and one that is
/// restarted from measured states has lost its contacts' overlaps and springs, which no camera sees. So the model
/// itself runs along the measured motion, weakly nudged towards it in x and rotation,
///
///   added acceleration = w^2 (q_target - q) + 1.4 w (v_target - v)
///
/// which keeps its contacts in states that it can have. From this observer free windows start: from its whole state,
/// without nudging, over a short time. What the model predicts there is compared with what was measured.
///
/// The observers and windows of many parameter sets and runs are stepped in lockstep: a lane that is free takes the
/// next one. A result is a function of its job alone, bit by bit, whatever the lane, the neighbours, the instruction
/// set and the number of threads.

#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/run/executor.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace stylobate {

/// Where the blocks of a realization are to be, at evenly spaced times, as displacements from the reference stack in
/// the frame of the base. NaN: not known; no nudging there, nor between it and its neighbours in time.
struct Targets {
    double start_s = 0;   ///< of the first sample, in the time of the base motion
    double spacing_s = 0; ///< > 0
    std::size_t blocks = 0;
    // (nt x blocks) in the order of `Realization::blocks`
    std::vector<double> x_m;
    std::vector<double> theta_rad;
    std::vector<double> velocity_m_s;
    std::vector<double> rotation_rad_s;

    std::size_t samples() const { return blocks == 0 ? 0 : x_m.size() / blocks; }
};

/// A stretch of time in which the model runs free.
struct FreeWindow {
    double start_s = 0;          ///< where it leaves the observer (up to `tracking_beat` of its steps before)
    std::vector<double> times_s; ///< when its blocks are read: ascending, after the start
};

/// Steps between two times at which a window may leave its observer, and the most between two settings of the nudging.
inline constexpr int tracking_beat = 8;

/// One parameter set and one run.
struct TrackingJob {
    Realization realization; ///< with its own base motion; run by the step with mechanisms, even where none acts
    std::shared_ptr<const Targets> targets;                 ///< null: no nudging
    double nudge_rad_s = 0;                                 ///< w
    std::shared_ptr<const std::vector<FreeWindow>> windows; ///< ascending; null: none
    std::shared_ptr<const std::vector<double>> watched_s; ///< when the observer itself is read, ascending; null: never
    int nudge_steps =
        tracking_beat; ///< steps between two settings of the nudging: 1, 2, 4 or 8; fewer where w dt asks for it
};

/// Displacements from the reference stack in the frame of the base, (times x blocks) in the order of
/// `Realization::blocks`; between two steps on the straight line. NaN from where the model was no longer finite.
struct Readings {
    std::vector<double> x_m;
    std::vector<double> y_m;
    std::vector<double> theta_rad;
};

/// What simulations along measured motion have cost.
struct SimulationCount {
    std::uint64_t simulations = 0;        ///< of whole runs
    std::uint64_t window_simulations = 0; ///< of windows that start from measured states
    std::uint64_t block_steps = 0;

    SimulationCount& operator+=(const SimulationCount& other)
    {
        simulations += other.simulations;
        window_simulations += other.window_simulations;
        block_steps += other.block_steps;
        return *this;
    }
    SimulationCount operator-(const SimulationCount& other) const
    {
        return {simulations - other.simulations, window_simulations - other.window_simulations,
                block_steps - other.block_steps};
    }
};

struct TrackingResult {
    std::vector<Readings> windows; ///< in the order of the job's
    Readings watched;              ///< of the observer
};

struct TrackingReport {
    std::vector<TrackingResult> results; ///< in the order of the jobs
    std::uint64_t windows = 0;           ///< that were run
    std::uint64_t block_steps = 0;       ///< free blocks x steps, observers and windows
    double seconds = 0;                  ///< wall clock
    double occupancy = 0;                ///< part of the lanes that worked
    bool complete = false;               ///< false: the observer asked to stop, and results are missing
};

/// Runs all jobs. `observer` is given the number of jobs done (`Progress::done` of `total`), and may stop the run.
///
/// @pre every realization has a base motion of its own (`Realization::motion`) and a step
/// @throws what setting up a realization throws, after all threads have stopped
TrackingReport track(const std::vector<TrackingJob>& jobs, const RunOptions& options, Observer& observer);

} // namespace stylobate

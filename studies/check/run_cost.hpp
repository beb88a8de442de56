#pragma once
/// What a run of a study needs: steps, time, memory, and the size of its results file.

#include "studies/check/study_trial.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/kinds/kind.hpp"

#include <cstdint>
#include <string>

namespace stylobate {

/// From what to what.
struct Between {
    double low = 0, high = 0;
};

/// What a run will do, known before anything is simulated.
struct RunSize {
    std::uint64_t realizations = 0; ///< or the most that it can take:
    bool at_most = false;           ///< of an adaptive surface and of rare events
    std::uint64_t cells = 0;
    int blocks = 0, free_blocks = 0; ///< of one structure, without the ground
    Between step_s;                  ///< over a sample of the realizations
    Between longest_steps;           ///< of a realization that runs to the time limit
    double most_block_steps = 0;     ///< of all, if none falls or comes to rest: the mean of the sample
    double file_bytes = 0;           ///< of the complete file; while the run is finished it is there twice
    std::uint64_t trajectories = 0;
    double trajectory_bytes = 0; ///< of the file, in trajectories
    double row_bytes = 0;        ///< of memory for each realization
};

/// @param kind  of the study, prepared
/// @param trial whose realizations tell how long trajectories are; null: as long as they can be
RunSize size_of_run(const LoadedStudy& loaded, const Kind& kind, const Trial* trial);

/// What the trial makes of it.
struct RunTime {
    Between steps;          ///< of the realizations of the trial
    double block_steps = 0; ///< of the whole run
    /// Of all threads together, files included [s]; of a run whose realizations are at most so many, if all are run and
    /// are as long as those of the trial in the mean.
    double processor_s = 0;
    Between processor_range_s; ///< in which the time lies (docs/check.md)
    /// Elapsed [s], on an idle machine.
    double seconds() const { return processor_s / threads; }
    Between range_s() const { return {processor_range_s.low / threads, processor_range_s.high / threads}; }
    int threads = 1;
    bool at_most = false; ///< only the upper end of the range means something
};

/// @param drawing_s processor time in which the realizations are drawn once before the run (`check_realizations`)
/// @pre the trial has run something
RunTime time_of_run(const LoadedStudy& loaded, const Trial& trial, const RunSize& size, double drawing_s);

/// The longest that a run of an unfinished trial can take: all of its steps, at the speed of the trial.
/// @pre trial.lane_s_per_step > 0
RunTime longest_time_of_run(const Trial& trial, const RunSize& size);

/// Resident memory of the run [bytes]: what this process holds now, which has read the same study, and what the run
/// adds for each realization.
/// @param peak_bytes the most that this process has held
double memory_of_run(const Study& study, const RunSize& size, double peak_bytes);

/// Processor time of this process so far, of all threads [s].
double processor_seconds();

/// The most memory that this process has held so far [bytes].
double peak_memory_bytes();

} // namespace stylobate

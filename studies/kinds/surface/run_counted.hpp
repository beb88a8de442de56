#pragma once
/// A surface that keeps counts of its realizations and no rows.

#include "ensemble/engine/executor.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <string>

namespace stylobate {

struct CountedRun {
    Progress progress;
    bool complete = false;
    LimitCounts limits; ///< of what is in the file
};

/// Runs what is left, and completes the file where nothing is.
/// @param found whether the file is there, and is to be continued
/// @throws InputError and what else `TallyWriter` and `run_ensemble` throw
CountedRun run_counted(const LoadedStudy& loaded, const RunOptions& options, const std::string& results, bool found,
                       Observer& observer);

} // namespace stylobate

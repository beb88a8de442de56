#pragma once
/// What `stylobate run` prints at its end.

#include "ensemble/engine/executor.hpp"
#include "studies/app/command.hpp"
#include "studies/kinds/kind.hpp"

#include <string>

namespace stylobate {

/// What a run has come to.
struct RunReport {
    const std::string& results; ///< the file
    const Study& study;
    const Kind& kind; ///< of a complete run: concluded
    const Progress& progress;
    const RunOptions& run;
    bool complete = false;
};

/// Prints it, as lines or as JSON, and a message where too many realizations are invalid.
/// @returns the exit status
int report_run(const CommonOptions& options, const RunReport& report);

} // namespace stylobate

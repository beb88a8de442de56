#pragma once
/// What `stylobate run` prints at its end.

#include "ensemble/run/executor.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/kinds/kind.hpp"
#include "studies/kinds/law_band.hpp"
#include "studies/results/whole_run.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace stylobate {

/// What a run has come to.
struct RunReport {
    const std::string& results; ///< the file
    const Study& study;
    const Kind& kind; ///< of a complete run of all: concluded
    const RunOptions& run;
    Progress progress = {};
    bool complete = false; ///< of a shard: it is
    Shard shard = {};
    bool merged = false;              ///< from shards, and not run here
    std::optional<LawBand> laws = {}; ///< over contact laws; nothing: not measured
    bool laws_interrupted = false;    ///< the study is complete, and its runs under other laws are not
};

/// A message where more realizations are invalid than the study allows; else empty. @param results the file
std::string too_many_invalid(const Study& study, std::uint64_t invalid, std::uint64_t total,
                             const std::string& results);
/// Prints it. @returns the exit status
int report_invalid(const Study& study, std::uint64_t invalid, std::uint64_t total, const std::string& results);
/// The same of the first of several studies that has too many.
int report_invalid(const WholeRuns& studies);

/// Before anything is run. @throws InputError if one of the studies cannot be run so
void check_can_run(const CommonOptions& options, const WholeRuns& studies);
/// Runs what the studies lack, one after the other. @returns false if the user has asked to stop
bool run_all(const CommonOptions& options, const WholeRuns& studies, Console& console);

/// Prints it, as lines or as JSON, and a message where too many realizations are invalid.
/// @returns the exit status
int report_run(const CommonOptions& options, const RunReport& report);

} // namespace stylobate

#pragma once
/// Runs of study files, and results joined from shards.

#include "studies/workflow/run_report.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct RunRequest {
    std::string study; ///< its file
    std::vector<std::string> settings{};
    std::optional<std::string> results{}; ///< none: in the working folder, with the name of the study
    std::optional<std::string> shard{};   ///< "3/8": that part of the study alone
    bool laws = false;                    ///< also under other contact laws
};

/// Runs a study of any kind, or continues an unfinished result of it. Collective, of all ranks of the machine.
/// @throws InputError if the study cannot be run so, before anything is written
RunReport run_study_file(const RunRequest& request, const Machine& machine, WorkObserver& observer);

struct MergeRequest {
    std::vector<std::string> files; ///< of shards, or of earlier merges
    std::string output;
    bool partial = false; ///< accept missing realizations
    bool force = false;   ///< replace a file that is there
    std::vector<std::string> settings{};
};

/// Joins the results of shards to the results of the whole study.
/// @returns nothing if the observer has asked to stop: nothing was written
/// @throws InputError if the files are not parts of one study, or have not all of it
std::optional<RunReport> merge_shards(const MergeRequest& request, const Machine& machine, WorkObserver& observer);

} // namespace stylobate

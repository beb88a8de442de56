#pragma once
/// Runs of study files, and results joined from shards: what they have come to, as data, lines and JSON.

#include "studies/kinds/law_band.hpp"
#include "studies/report/json.hpp"
#include "studies/results/study_run.hpp"
#include "studies/workflow/workflow.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct RunReport {
    std::string results;                 ///< the file
    std::unique_ptr<const StudyRun> run; ///< of a complete run of all its kind is concluded
    RunOptions options{};
    std::string backend{};
    Progress progress{};
    bool complete = false; ///< of a shard: it is
    bool was_complete = false;
    bool merged = false;                      ///< from shards, and not run here
    std::optional<LawBand> laws{};            ///< over contact laws; none: not measured
    bool laws_interrupted = false;            ///< the study is complete, and its runs under other laws are not
    std::optional<std::string> law_invalid{}; ///< `too_many_invalid` of its runs under other laws

    const Shard& shard() const { return run->header().shard; }
    bool whole() const { return complete && shard().whole(); }
    /// Whether the same command has something to continue. A merge with missing realizations was asked for so.
    bool interrupted() const { return !merged && (!complete || laws_interrupted); }
    /// A message where more realizations are invalid than the study allows.
    std::optional<std::string> too_many_invalid() const;
};

std::string run_text(const RunReport& report);
Json run_json(const RunReport& report);

/// A message where more realizations are invalid than the study allows. @param results the file
std::optional<std::string> too_many_invalid(const Study& study, std::uint64_t invalid, std::uint64_t total,
                                            const std::string& results);
/// That of the first of several studies that has too many.
std::optional<std::string> too_many_invalid(const StudyRuns& studies);

/// Before anything is run. @throws InputError if one of the studies cannot be run so
void check_can_run(const StudyRuns& studies, const std::string& backend);
/// Runs what the studies lack, one after the other. @returns false if the observer has asked to stop
bool run_all(const StudyRuns& studies, const RunOptions& options, WorkObserver& observer);

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

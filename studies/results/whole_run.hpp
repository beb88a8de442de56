#pragma once
/// A study that another one needs beside it: checked before anything is written, run into a results file of its own,
/// and continued where one is there.

#include "ensemble/model/observer.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/kinds/kind.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace stylobate {

class WholeRun {
public:
    /// Looks at the study and at its file, and changes nothing.
    /// @param name of the study, for messages   @param results its file; need not be there
    /// @throws InputError if the study cannot be run, or if the file is another study's
    WholeRun(LoadedStudy loaded, std::string name, std::string results);
    ~WholeRun();
    WholeRun(const WholeRun&) = delete;
    WholeRun& operator=(const WholeRun&) = delete;

    const std::string& name() const { return name_; }
    const std::string& results() const { return results_; }
    const Study& study() const { return loaded_.study(); }
    const ResultHeader& header() const { return header_; }
    /// What the user should know before the run, in sentences.
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Whether nothing is left to run.
    bool finished() const { return finished_; }
    /// Draws the realizations once, where the file is not there. @throws InputError if one cannot be run
    void check_drawn() const;

    /// Runs what is left, up to a complete file. @returns false if the observer has asked to stop
    bool run(const RunOptions& options, Observer& observer);
    /// Runs those of the realizations that are not in the file, which stays one to be continued.
    /// @returns false if the observer has asked to stop
    bool run_some(std::span<const std::uint64_t> indices, const RunOptions& options, Observer& observer);
    /// All rows that are there, in any order.
    void for_each_row(const std::function<void(const ResultRow&)>& f) const;
    /// Realizations that are in the file.
    std::uint64_t done() const;
    /// How many of these are invalid.
    std::uint64_t invalid() const;
    /// What keeps the study from being stepped on a device (`Kind::needs_processor`); empty: nothing does.
    std::string needs_processor() const { return kind_->needs_processor(); }

private:
    void open();

    const LoadedStudy loaded_;
    std::string name_, results_;
    ResultHeader header_;
    std::vector<std::string> warnings_;
    bool found_ = false, finished_ = false;
    std::unique_ptr<class RunStore> store_;
    std::unique_ptr<Kind> kind_;
};

using WholeRuns = std::vector<std::unique_ptr<WholeRun>>;

} // namespace stylobate

#pragma once
/// A study on its way to results: looked at, opened, run, concluded, finished. The only place that has this order.

#include "ensemble/model/observer.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "io/store/result_store.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/kinds/kind.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stylobate {

/// Where a run puts its realizations: the rows of a results file, or its counts where the study keeps no rows. By
/// itself it keeps nothing: of a process that gives its rows to another one.
class RunStore {
public:
    virtual ~RunStore() = default;

    /// How a realization ended that is there already.
    virtual std::optional<State> state(std::uint64_t) const { return std::nullopt; }
    /// Where there are no rows: what is counted, by its place in the order of the run; else null.
    virtual const DoneSet* counted() const { return nullptr; }
    /// Gives the kind what is there: all rows, or the counts.
    virtual void give_to(Kind&) const {}
    /// All rows that are there; none of counts.
    virtual void for_each_row(const std::function<void(const ResultRow&)>&) const {}
    virtual void add(const ResultRow&) {}
    /// Whether it keeps trajectories; else no realization is followed for one.
    virtual bool keeps_trajectories() const { return true; }
    virtual void add(const Trajectory&) {}
    /// Takes what another file of the study has. @pre none of it is there already
    virtual void add(const ResultReader& other);
    /// All is there: the file becomes complete, with what the kind makes of it.
    virtual void finish(const Kind&) {}
    /// Keeps what is there for another run.
    virtual void flush() {}
};

/// @param found whether the file is there and is to be continued
/// @throws InputError as `ResultWriter` and `TallyWriter` do
std::unique_ptr<RunStore> open_store(const std::string& file, const ResultHeader& header, bool found);

/// Draws realizations once, so that one that cannot be run (a fixed step above its bound, drums drawn off each other)
/// is refused before anything is written. It costs less than a hundredth of running them.
/// @throws InputError naming the realization
/// @param shard the part that is going to be run
void check_realizations(const Sampler& sampler, const Kind& kind, const Shard& shard = {});
/// Draws realizations once, until the observer asks to stop. @return whether all were drawn
bool check_realizations(const Sampler& sampler, const Kind& kind, Observer& observer, const Shard& shard = {});

struct RunEnd {
    Progress progress;
    bool complete = false; ///< of a shard: it is; else the user has asked to stop
};

/// Asks the kind for rounds, runs what is not in the store, and gives every new row to both. Afterwards a complete run
/// wants `Kind::conclude` and `RunStore::finish`, another one and a shard `RunStore::flush`.
/// @pre the kind has been given what the store has, and if it is a shard, it has no `why_no_shards`
/// @throws what `run_ensemble` and the store throw
RunEnd run_study(const Experiment& experiment, Kind& kind, RunStore& store, const RunOptions& options,
                 Observer& observer, const Shard& shard = {});

class StudyRun {
public:
    /// Looks at the study and at its file, and changes nothing.
    /// @param name of the study, for messages
    /// @param results its file, which need not be there
    /// @param shard the part of it that is run
    /// @param ranks that run it together; null: this process is alone
    /// @throws InputError if the study cannot be run, or if the file is another study's
    StudyRun(LoadedStudy loaded, std::string name, std::string results, const Shard& shard = {},
             Ranks* ranks = nullptr);
    /// A study that has been judged already. @param header of its results   @param warnings what was found
    /// @param results its file; nullopt: its rows go into a store that `open` is given
    StudyRun(LoadedStudy loaded, ResultHeader header, std::string name, std::optional<std::string> results,
             Ranks* ranks = nullptr, std::vector<std::string> warnings = {});
    ~StudyRun();
    StudyRun(const StudyRun&) = delete;
    StudyRun& operator=(const StudyRun&) = delete;

    const std::string& name() const { return name_; }
    /// @pre it has a file
    const std::string& results() const { return *results_; }
    const Study& study() const { return loaded_.study(); }
    const LoadedStudy& loaded() const { return loaded_; }
    const ResultHeader& header() const { return header_; }
    const Kind& kind() const { return *kind_; }
    /// What of the study can hardly be meant, in sentences.
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// What its kind has chosen, in sentences; nullopt: nothing.
    const std::optional<std::string>& notice() const { return notice_; }
    /// Whether a file of the study is there.
    bool found() const { return found_; }
    /// Whether nothing is left to run.
    bool finished() const { return finished_; }

    /// Collective: what rank 0 has found holds for all ranks.
    void agree();
    /// Draws the realizations once, where the file is not there; ranks draw a part each.
    /// @throws InputError if one cannot be run
    void check_drawn() const;
    /// Opens the file, or makes it. @param store instead of a file; null: the file
    void open(std::unique_ptr<RunStore> store = nullptr);
    /// Takes what another file of the study has. @pre it is open, and has none of it
    void take(const ResultReader& other) { store_->add(other); }

    /// Runs what is left, up to a complete file; where the observer stops it, and of a shard, what is there is kept.
    RunEnd run(const RunOptions& options, Observer& observer);
    /// Runs those of the realizations that are not in the file, which stays one to be continued.
    /// @returns false if the observer has asked to stop
    bool run_some(std::span<const std::uint64_t> indices, const RunOptions& options, Observer& observer);
    /// Keeps what is there for another run, and gives it to the kind. @pre it is open
    void keep();
    /// Gives the kind what a finished file has. @returns what its run would have reported, as far as the file has it
    Progress restore();

    /// All rows that are there, in any order.
    void for_each_row(const std::function<void(const ResultRow&)>& f) const;
    /// Realizations that are in the file.
    std::uint64_t done() const;
    /// How many of these are invalid.
    std::uint64_t invalid() const;

private:
    bool leads() const { return !ranks_ || ranks_->leads(); }

    const LoadedStudy loaded_;
    const std::string name_;
    const std::optional<std::string> results_;
    const ResultHeader header_;
    Ranks* const ranks_;
    const std::vector<std::string> warnings_;
    const std::unique_ptr<Kind> kind_;
    const std::optional<std::string> notice_;
    bool found_ = false, finished_ = false;
    std::unique_ptr<RunStore> store_; ///< while it is open
};

using StudyRuns = std::vector<std::unique_ptr<StudyRun>>;

} // namespace stylobate

#include "stylobate/run.hpp"

#include "library/inside.hpp"
#include "library/result.hpp"
#include "studies/results/study_run.hpp"

#include <algorithm>
#include <unordered_map>

namespace stylobate::api {

namespace {

/// Tells the caller of a run, who may stop it.
class RunTeller : public inner::Observer {
public:
    explicit RunTeller(const std::function<bool(const Progress&)>& tell) : tell_(tell) {}

    void progress(const inner::Progress& p) override
    {
        if (!tell_ || stopped_)
            return;
        stopped_ =
            !tell_({p.done, p.total, p.collapsed, p.invalid, p.seconds, p.rate, p.share, p.share_lower, p.share_upper});
    }
    bool stop_requested() override { return stopped_; }

private:
    const std::function<bool(const Progress&)>& tell_;
    bool stopped_ = false;
};

/// The rows of a run in memory.
struct KeptRows {
    std::unordered_map<std::uint64_t, inner::State> states;
    std::vector<inner::ResultRow> rows;
};

/// Keeps the rows in memory, or gives them away where the study keeps none.
class MemoryStore : public inner::RunStore {
public:
    /// @param away receives each row, which is not kept then; a null function keeps all rows
    MemoryStore(KeptRows& kept, std::function<void(const inner::ResultRow&)> away) : kept_(kept), away_(std::move(away))
    {
    }

    std::optional<inner::State> state(std::uint64_t index) const override
    {
        const auto found = kept_.states.find(index);
        return found == kept_.states.end() ? std::nullopt : std::optional(found->second);
    }
    void add(const inner::ResultRow& row) override
    {
        if (away_)
            return away_(row);
        kept_.states.emplace(row.index, row.outcome.state);
        kept_.rows.push_back(row);
    }
    using RunStore::add;
    bool keeps_trajectories() const override { return false; }

private:
    KeptRows& kept_;
    std::function<void(const inner::ResultRow&)> away_;
};

} // namespace

Result Inside::run(const Experiment& experiment, const RunOptions& options)
{
    const inner::LoadedStudy& loaded = of(experiment).loaded;
    inner::StudyRun study(loaded, loaded.result_header(), "study", std::nullopt);
    const inner::ResultHeader& header = study.header();
    Result::Data data(header, study.study(), "the result");
    study.check_drawn();
    KeptRows kept;
    study.open(std::make_unique<MemoryStore>(
        kept, header.has_rows() ? std::function<void(const inner::ResultRow&)>()
                                : [&](const inner::ResultRow& row) { data.add(row); }));
    RunTeller teller(options.progress);
    data.complete = study.run(machine_of(options).run_options(), teller).complete;
    if (!data.complete && header.has_rows())
        data.count_the_first([&](std::uint64_t index) { return kept.states.contains(index); });
    for (const inner::ResultRow& row : kept.rows)
        data.add(row);
    if (data.complete)
        data.finish(study.kind().surface(), study.kind().tables());
    else
        data.finish();
    return make<Result>(std::move(data));
}

Result run(const Experiment& experiment, const RunOptions& options)
{
    return translated([&] { return Inside::run(experiment, options); });
}

Result run_to_file(const Experiment& experiment, const std::filesystem::path& file, const RunOptions& options)
{
    translated([&] {
        const inner::LoadedStudy& loaded = Inside::of(experiment).loaded;
        inner::StudyRun study(loaded, loaded.result_header(), "study", file.string());
        const inner::RunOptions how = machine_of(options).run_options();
        study.check_drawn();
        RunTeller teller(options.progress);
        study.run(how, teller);
    });
    return Result::from_file(file);
}

} // namespace stylobate::api

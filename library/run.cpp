#include "stylobate/run.hpp"

#include "library/inside.hpp"
#include "library/results.hpp"
#include "studies/app/command.hpp"
#include "studies/kinds/single/single_kind.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/run_store.hpp"
#include "studies/results/run_study.hpp"

#include <algorithm>
#include <unordered_map>

namespace stylobate::api {

namespace {

/// Tells the caller of a run, who may stop it.
class Teller : public inner::Observer {
public:
    explicit Teller(const std::function<bool(const Progress&)>& tell) : tell_(tell) {}

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

/// Keeps the rows in memory, or gives them away where the study keeps none.
class MemoryStore : public inner::RunStore {
public:
    /// @param away empty: they are kept
    explicit MemoryStore(std::function<void(const inner::ResultRow&)> away) : away_(std::move(away)) {}

    std::optional<inner::State> state(std::uint64_t index) const override
    {
        const auto found = states_.find(index);
        return found == states_.end() ? std::nullopt : std::optional(found->second);
    }
    void give_to(inner::Kind&) const override {}
    void add(const inner::ResultRow& row) override
    {
        if (away_)
            return away_(row);
        states_.emplace(row.index, row.outcome.state);
        rows_.push_back(row);
    }
    using RunStore::add;
    void add(const inner::Trajectory&) override {}
    void finish(const inner::Kind&) override {}
    void flush() override {}

    const std::vector<inner::ResultRow>& rows() const { return rows_; }

private:
    std::function<void(const inner::ResultRow&)> away_;
    std::unordered_map<std::uint64_t, inner::State> states_;
    std::vector<inner::ResultRow> rows_;
};

/// Realizations of a single study without their trajectories: no reason to step them one by one.
class SingleAtOnce : public inner::SingleKind {
public:
    using SingleKind::SingleKind;
    std::string prepare(const inner::Experiment&, const std::string&) override { return {}; }
    bool plan(inner::Rounds& rounds) override { return rounds.run({.fair = true}); }
};

inner::Table table_of(const std::vector<inner::Table>& tables, const std::string& name)
{
    const auto found = std::ranges::find(tables, name, &inner::Table::name);
    return found == tables.end() ? inner::Table(name) : *found;
}

} // namespace

inner::RunOptions run_options(int threads, const std::string& simd)
{
    inner::CommonOptions options;
    options.threads = threads;
    options.simd = simd;
    return options.run_options();
}

Result Inside::run(const Experiment& experiment, const RunOptions& options)
{
    const inner::LoadedStudy& loaded = of(experiment).loaded;
    const inner::Study& study = loaded.study();
    const inner::ResultHeader header = loaded.result_header();
    Result::Data data(header, study, "the result");
    const std::unique_ptr<inner::Kind> kind = study.kind == inner::StudyKind::single
                                                  ? std::make_unique<SingleAtOnce>(study, header)
                                                  : inner::make_kind(study, header);
    kind->prepare(loaded.experiment(), "study");
    inner::check_realizations(loaded.sampler(), *kind);
    MemoryStore store(header.has_rows() ? std::function<void(const inner::ResultRow&)>()
                                        : [&](const inner::ResultRow& row) { data.add(row); });
    Teller teller(options.progress);
    const inner::StudyRun ran =
        inner::run_study(loaded.experiment(), *kind, store, run_options(options.threads, options.simd), teller);
    data.complete = ran.complete;
    if (!ran.complete && header.has_rows())
        data.count_the_first([&](std::uint64_t index) { return store.state(index).has_value(); });
    for (const inner::ResultRow& row : store.rows())
        data.add(row);
    if (!ran.complete) {
        data.finish();
    } else {
        kind->conclude();
        const std::vector<inner::Table> tables = kind->tables();
        data.finish(kind->surface(), table_of(tables, "rare"), table_of(tables, "fragility"));
    }
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
        const inner::ResultHeader header = loaded.result_header();
        const std::unique_ptr<inner::Kind> kind = inner::make_kind(loaded.study(), header);
        kind->prepare(loaded.experiment(), "study");
        const inner::RunOptions how = run_options(options.threads, options.simd);
        const bool found = std::filesystem::exists(file);
        if (!found) // else it has been done before the file was made
            inner::check_realizations(loaded.sampler(), *kind);
        else if (inner::ResultWriter::is_finished(file, header))
            return;
        const std::unique_ptr<inner::RunStore> store = inner::open_store(file.string(), header, found);
        store->give_to(*kind);
        Teller teller(options.progress);
        if (inner::run_study(loaded.experiment(), *kind, *store, how, teller).complete) {
            kind->conclude();
            store->finish(*kind);
        } else {
            store->flush();
        }
    });
    return Result::from_file(file);
}

} // namespace stylobate::api

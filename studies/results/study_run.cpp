#include "studies/results/study_run.hpp"

#include "ensemble/numerics/in_parallel.hpp"
#include "studies/cluster/shared_round.hpp"
#include "studies/cluster/together.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/results/kinds.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace stylobate {

namespace {

class RowStore : public RunStore {
public:
    explicit RowStore(std::unique_ptr<ResultWriter> writer) : writer_(std::move(writer)) {}

    std::optional<State> state(std::uint64_t index) const override { return writer_->state(index); }
    void give_to(Kind& kind) const override
    {
        writer_->for_each_row([&](const ResultRow& row) { kind.add(row); });
    }
    void for_each_row(const std::function<void(const ResultRow&)>& f) const override { writer_->for_each_row(f); }
    void add(const ResultRow& row) override { writer_->add(row); }
    void add(const Trajectory& trajectory) override { writer_->add(trajectory); }
    using RunStore::add;
    void finish(const Kind& kind) override
    {
        const std::optional<SurfaceTable> surface = kind.surface();
        writer_->finish(surface ? &*surface : nullptr, kind.tables());
    }
    void flush() override { writer_->flush(); }

private:
    std::unique_ptr<ResultWriter> writer_;
};

class CountStore : public RunStore {
public:
    explicit CountStore(std::unique_ptr<TallyWriter> writer) : writer_(std::move(writer)) {}

    const DoneSet* counted() const override { return &writer_->done(); }
    void give_to(Kind& kind) const override { kind.add(writer_->tally()); }
    void add(const ResultRow& row) override { writer_->add(tally_entry(row)); }
    void add(const Trajectory&) override { throw std::logic_error("counts keep no trajectories"); }
    void add(const ResultReader& other) override { writer_->add(*other.tally(), *other.counted()); }
    void finish(const Kind& kind) override { writer_->finish(kind.surface().value()); }
    void flush() override { writer_->flush(); }

private:
    std::unique_ptr<TallyWriter> writer_;
};

} // namespace

void RunStore::add(const ResultReader& other)
{
    for (const std::uint64_t index : other.trajectory_indices())
        add(other.trajectory(index));
    other.for_each_row([&](const ResultRow& row) { add(row); });
}

std::unique_ptr<RunStore> open_store(const std::string& file, const ResultHeader& header, bool found)
{
    if (header.has_rows())
        return std::make_unique<RowStore>(found ? ResultWriter::resume(file, header)
                                                : ResultWriter::create(file, header));
    return std::make_unique<CountStore>(found ? TallyWriter::resume(file, header) : TallyWriter::create(file, header));
}

namespace {

/// What had been done before a round, and the round.
/// @param fair whether the round's share is that of the whole; else it stays as it was before
Progress joined(const Progress& before, const Progress& round, bool fair)
{
    Progress all = before;
    all.done += round.done;
    all.collapsed += round.collapsed;
    all.invalid += round.invalid;
    all.block_steps += round.block_steps;
    all.seconds += round.seconds;
    all.furthest = round.furthest;
    if (fair) {
        all.share = round.share;
        all.share_lower = round.share_lower;
        all.share_upper = round.share_upper;
    }
    if (all.seconds > 0) {
        all.rate = (before.rate * before.seconds + round.rate * round.seconds) / all.seconds;
        all.occupancy = (before.occupancy * before.seconds + round.occupancy * round.seconds) / all.seconds;
    }
    return all;
}

/// Tells the progress of a round as a part of the whole.
class RoundObserver : public Observer {
public:
    RoundObserver(Observer& whole, const Progress& before, bool fair) : whole_(whole), before_(before), fair_(fair) {}
    void progress(const Progress& round) override { whole_.progress(joined(before_, round, fair_)); }
    void warn(const std::string& text) override { whole_.warn(text); }
    bool stop_requested() override { return whole_.stop_requested(); }

private:
    Observer& whole_;
    const Progress before_;
    const bool fair_;
};

class Runner : public Rounds {
public:
    Runner(const Experiment& experiment, Kind& kind, RunStore& store, const RunOptions& options, Observer& observer,
           const Shard& shard)
        : Rounds(experiment, options, observer, shard), kind_(kind), store_(store),
          heard_(kind.why_no_shards().has_value())
    {
        if (options.ranks && heard_) // what an earlier part of the run has left
            share_rows(
                *options.ranks, kind.header(), [&](const auto& take_row) { store.for_each_row(take_row); },
                [&](const ResultRow& row) { kind.add(row); });
    }

    bool run(const Round& round) override
    {
        const Study& study = experiment.study();
        RunPlan plan;
        plan.indices = round.indices;
        plan.total = round.indices.empty() ? study.total() : round.indices.size();
        plan.shard = shard;
        plan.as = round.as;
        plan.realize = round.realize;
        if (store_.counted())
            plan.done = *store_.counted();
        else if (options.leads())
            plan.mark_done([&](std::uint64_t index) { return store_.state(index); });
        plan.sink = [&](const Realization& realization, const Outcome& outcome) {
            take(result_row(study, realization, outcome));
        };
        const std::uint64_t size = RunOrder(plan.total).places(shard).size();
        if (progress.total == 0)
            progress.total = size;

        const DoneSet::Part before = plan.done.all();
        Progress part{.done = before.end, .collapsed = before.collapsed, .invalid = before.invalid};
        RoundObserver observed(observer, progress, round.fair);
        if (options.ranks) { // a round that any rank stops is incomplete for all ranks
            const SharedRun shared = run_on_ranks(
                experiment, options, plan, kind_.header(), heard_, [&](const ResultRow& row) { take(row); }, observed);
            progress = joined(progress, shared.progress, round.fair);
            return shared.complete;
        }
        if (before.end < size)
            part = run_ensemble(experiment, options, plan, observed);
        else if (round.fair)
            estimate_share(part, before.end - before.invalid, before.collapsed);
        progress = joined(progress, part, round.fair);
        return part.done == size;
    }

    bool trace(std::uint64_t kept_trajectories) override
    {
        if (!store_.keeps_trajectories())
            return run({.fair = true});
        const auto begin = std::chrono::steady_clock::now();
        const auto seconds = [begin] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        };
        const std::uint64_t total = experiment.study().total();
        const RunOrder order(total);
        const RunOrder::Places places = order.places(shard);
        progress.total = places.size();
        TracePlan plan;
        plan.recorded = kept_trajectories;
        for (std::uint64_t index = 0; index < total; ++index) {
            if (!places.has(order.place(index)))
                continue;
            if (const std::optional<State> state = store_.state(index))
                count(*state);
            else
                plan.indices.push_back(index);
        }
        std::uint64_t run_now = 0;
        const auto look_at_clock = [&] {
            progress.seconds = seconds();
            progress.rate = static_cast<double>(run_now) / progress.seconds;
        };
        plan.sink = [&](const TracedRealization& f) {
            if (f.realization.index < kept_trajectories)
                store_.add(f.trajectory); // before its row: where the row is, it is
            take(result_row(experiment.study(), f.realization, f.outcome));
            progress.block_steps += f.realization.free_blocks() * f.outcome.steps;
            ++run_now;
            look_at_clock();
            count(f.outcome.state);
        };
        double next_report_s = 0;
        plan.stop = [&](double occupancy, const SimulatedTime& furthest) {
            if (seconds() < next_report_s)
                return false;
            next_report_s = seconds() + 0.1;
            progress.occupancy = occupancy;
            look_at_clock();
            progress.furthest = furthest;
            observer.progress(progress);
            return observer.stop_requested();
        };
        const bool complete = !observer.stop_requested() && trace_all(experiment, options, plan);
        observer.progress(progress);
        return complete;
    }

private:
    /// One more has ended, of a fair sample of the study.
    void count(State state)
    {
        ++progress.done;
        progress.collapsed += state == State::collapsed;
        progress.invalid += state == State::invalid;
        estimate_share(progress, progress.done - progress.invalid, progress.collapsed);
    }

    void take(const ResultRow& row)
    {
        store_.add(row);
        if (!store_.counted())
            kind_.add(row);
    }

    Kind& kind_;
    RunStore& store_;
    const bool heard_; ///< by all ranks: the rounds depend on the outcomes in the rows
};

} // namespace

bool check_realizations(const Sampler& sampler, const Kind& kind, Observer& observer, const Shard& shard)
{
    constexpr std::uint64_t portion = 256;
    const RunOrder order(kind.drawn_first());
    const RunOrder::Places places = order.places(shard);
    std::atomic<bool> stopped = false;
    std::mutex asking;
    const std::uint64_t portions = (places.end - places.begin + portion - 1) / portion;
    in_parallel(std::uint64_t{0}, portions, [&](std::uint64_t k) {
        const std::uint64_t first = places.begin + k * portion, end = std::min(first + portion, places.end);
        if (const std::unique_lock lock(asking, std::try_to_lock); lock.owns_lock() && observer.stop_requested())
            stopped = true;
        for (std::uint64_t place = first; place < end && !stopped; ++place)
            sampler.realization(order.index(place));
    });
    return !stopped;
}

void check_realizations(const Sampler& sampler, const Kind& kind, const Shard& shard)
{
    Observer patient;
    check_realizations(sampler, kind, patient, shard);
}

RunEnd run_study(const Experiment& experiment, Kind& kind, RunStore& store, const RunOptions& options,
                 Observer& observer, const Shard& shard)
{
    Runner runner(experiment, kind, store, options, observer, shard);
    const bool complete = kind.plan(runner);
    if (store.counted())
        store.give_to(kind);
    return {runner.progress, complete};
}

namespace {

/// Runs the realizations that it is given; concludes nothing.
class ChosenKind : public Kind {
public:
    ChosenKind(const Study& study, const ResultHeader& header, std::span<const std::uint64_t> indices)
        : Kind(study, header), indices_(indices)
    {
    }
    bool plan(Rounds& rounds) override { return indices_.empty() || rounds.run({.indices = indices_}); }

private:
    std::span<const std::uint64_t> indices_;
};

ResultHeader header_of(const LoadedStudy& loaded, const Shard& shard)
{
    ResultHeader header = loaded.result_header();
    header.shard = shard;
    return header;
}

} // namespace

StudyRun::StudyRun(LoadedStudy loaded, ResultHeader header, std::string name, std::optional<std::string> results,
                   Ranks* ranks, std::vector<std::string> warnings)
    : loaded_(std::move(loaded)), name_(std::move(name)), results_(std::move(results)), header_(std::move(header)),
      ranks_(ranks), warnings_(std::move(warnings)), kind_(make_kind(loaded_.study(), header_)),
      notice_(results_ || !kind_->prepares_file_alone() ? kind_->prepare(loaded_.experiment(), name_) : std::nullopt),
      found_(results_ && leads() && std::filesystem::exists(*results_)),
      finished_(found_ && ResultWriter::is_finished(*results_, header_))
{
}

StudyRun::StudyRun(LoadedStudy loaded, std::string name, std::string results, const Shard& shard, Ranks* ranks)
    : StudyRun(loaded, header_of(loaded, shard), name, results, ranks, loaded.warnings(name))
{
}

StudyRun::~StudyRun() = default;

void StudyRun::agree()
{
    if (!ranks_)
        return;
    const std::string first = ranks_->of_first(finished_ ? "finished" : found_ ? "found" : "");
    finished_ = first == "finished";
    found_ = !first.empty();
}

void StudyRun::check_drawn() const
{
    if (!found_) // else it has been done before the file was made
        check_realizations(loaded_.sampler(), *kind_, ranks_ ? part_of(*ranks_) : header_.shard);
}

void StudyRun::open(std::unique_ptr<RunStore> store)
{
    if (store_)
        return;
    store_ = store ? std::move(store) : leads() ? open_store(*results_, header_, found_) : std::make_unique<RunStore>();
    found_ = true;
}

RunEnd StudyRun::run(const RunOptions& options, Observer& observer)
{
    if (finished_)
        return {{}, true};
    open();
    store_->give_to(*kind_);
    RunEnd end = run_study(loaded_.experiment(), *kind_, *store_, options, observer, header_.shard);
    if (leads() && end.complete && header_.shard.whole()) {
        kind_->conclude();
        store_->finish(*kind_);
        finished_ = true;
    } else {
        store_->flush();
    }
    store_.reset();
    return end;
}

bool StudyRun::run_some(std::span<const std::uint64_t> indices, const RunOptions& options, Observer& observer)
{
    if (finished_)
        return true;
    open();
    ChosenKind chosen(loaded_.study(), header_, indices);
    const bool complete = run_study(loaded_.experiment(), chosen, *store_, options, observer).complete;
    store_->flush();
    return complete;
}

void StudyRun::keep()
{
    store_->give_to(*kind_);
    store_->flush();
    store_.reset();
}

Progress StudyRun::restore()
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Progress progress{.seconds = unknown, .rate = unknown, .occupancy = unknown};
    const ResultReader reader(*results_);
    progress.done = progress.total = reader.done();
    reader.for_each_row([&](const ResultRow& row) {
        kind_->add(row);
        progress.collapsed += row.outcome.state == State::collapsed;
        progress.invalid += row.outcome.state == State::invalid;
    });
    if (const Tally* tally = reader.tally()) {
        kind_->add(*tally);
        progress.collapsed = tally->all_reached(static_cast<std::size_t>(LimitState::collapse));
        progress.invalid = tally->all_invalid();
    }
    kind_->restore(reader);
    kind_->share(progress);
    return progress;
}

void StudyRun::for_each_row(const std::function<void(const ResultRow&)>& f) const
{
    if (store_)
        store_->for_each_row(f);
    else if (results_ && std::filesystem::exists(*results_))
        ResultReader(*results_).for_each_row(f);
}

std::uint64_t StudyRun::invalid() const
{
    std::uint64_t rows = 0;
    for_each_row([&](const ResultRow& row) { rows += row.outcome.state == State::invalid; });
    return rows;
}

std::uint64_t StudyRun::done() const
{
    if (store_) {
        std::uint64_t rows = 0;
        store_->for_each_row([&](const ResultRow&) { ++rows; });
        return rows;
    }
    return results_ && std::filesystem::exists(*results_) ? ResultReader(*results_).done() : 0;
}

} // namespace stylobate

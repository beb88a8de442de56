#include "studies/results/run_study.hpp"

#include "studies/experiment/trajectory.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>

namespace stylobate {

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
    Runner(const Experiment& experiment, Kind& kind, RunStore& store, const RunOptions& options, Observer& observer)
        : Rounds(experiment, options, observer), kind_(kind), store_(store)
    {
    }

    bool run(const Round& round) override
    {
        const Study& study = experiment.study();
        RunPlan plan;
        plan.indices = round.indices;
        plan.total = round.indices.empty() ? study.total() : round.indices.size();
        plan.as = round.as;
        plan.realize = round.realize;
        if (store_.counted())
            plan.done = *store_.counted();
        else
            plan.mark_done([&](std::uint64_t index) { return store_.state(index); });
        plan.sink = [&](const Realization& realization, const Outcome& outcome) {
            take(result_row(study, realization, outcome));
        };
        if (progress.total == 0)
            progress.total = plan.total;

        const DoneSet::Part before = plan.done.all();
        Progress part{.done = before.end, .collapsed = before.collapsed, .invalid = before.invalid};
        RoundObserver observed(observer, progress, round.fair);
        if (before.end < plan.total)
            part = run_ensemble(experiment, options, plan, observed);
        else if (round.fair)
            estimate_share(part, before.end - before.invalid, before.collapsed);
        progress = joined(progress, part, round.fair);
        return part.done == plan.total;
    }

    bool follow(std::uint64_t kept_trajectories) override
    {
        const auto begin = std::chrono::steady_clock::now();
        std::uint64_t run_now = 0;
        progress.total = experiment.study().total();
        progress.occupancy = 1.0 / kernels(options.isa).lanes;
        const auto elapsed_s = [&] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        };
        // within a realization too, which may take long
        double next_report_s = 0.1;
        const auto go_on = [&] {
            if (elapsed_s() >= next_report_s) {
                progress.seconds = elapsed_s();
                next_report_s = progress.seconds + 0.1;
                observer.progress(progress);
            }
            return !observer.stop_requested();
        };
        for (std::uint64_t index = 0; index < progress.total && !observer.stop_requested(); ++index) {
            std::optional<State> state = store_.state(index);
            if (!state) {
                FollowedRealization f;
                try {
                    f = stylobate::follow(experiment, index, options.isa, go_on);
                } catch (const FollowStopped&) {
                    return false;
                }
                if (index < kept_trajectories)
                    store_.add(f.trajectory); // before its row: where the row is, it is
                take(result_row(experiment.study(), f.realization, f.outcome));
                state = f.outcome.state;
                ++run_now;
                progress.block_steps += free_blocks(f.realization) * f.outcome.steps;
            }
            ++progress.done;
            progress.seconds = elapsed_s();
            progress.rate = static_cast<double>(run_now) / progress.seconds;
            progress.collapsed += state == State::collapsed;
            progress.invalid += state == State::invalid;
            estimate_share(progress, progress.done - progress.invalid, progress.collapsed);
            observer.progress(progress);
        }
        return progress.done == progress.total;
    }

private:
    static std::uint64_t free_blocks(const Realization& realization)
    {
        return static_cast<std::uint64_t>(std::count_if(realization.blocks.begin(), realization.blocks.end(),
                                                        [](const Block& block) { return !block.fixed; }));
    }

    void take(const ResultRow& row)
    {
        store_.add(row);
        if (!store_.counted())
            kind_.add(row);
    }

    Kind& kind_;
    RunStore& store_;
};

} // namespace

void check_realizations(const Sampler& sampler, const Kind& kind)
{
    tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, kind.drawn_first(), 256), [&](const auto& range) {
        for (std::uint64_t index = range.begin(); index != range.end(); ++index)
            sampler.realization(index);
    });
}

StudyRun run_study(const Experiment& experiment, Kind& kind, RunStore& store, const RunOptions& options,
                   Observer& observer)
{
    Runner runner(experiment, kind, store, options, observer);
    const bool complete = kind.plan(runner);
    if (store.counted())
        store.give_to(kind);
    return {runner.progress, complete};
}

} // namespace stylobate

#pragma once
/// One of several rounds of a run: the realizations that have not been run before, told as a part of the whole.

#include "ensemble/engine/executor.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace stylobate {

class RoundObserver : public Observer {
public:
    /// @param before all that had been done when the round began, the share with it
    /// @param fair   whether the round's share is that of the whole; else it stays as it was before
    RoundObserver(Observer& whole, const Progress& before, bool fair = false)
        : whole_(whole), before_(before), fair_(fair)
    {
    }
    void progress(const Progress& round) override { whole_.progress(joined(round)); }
    void warn(const std::string& text) override { whole_.warn(text); }
    bool stop_requested() override { return whole_.stop_requested(); }

    /// What had been done before the round, and the round.
    Progress joined(const Progress& round) const
    {
        Progress all = before_;
        all.done += round.done;
        all.collapsed += round.collapsed;
        all.invalid += round.invalid;
        all.block_steps += round.block_steps;
        all.seconds += round.seconds;
        if (fair_) {
            all.share = round.share;
            all.share_lower = round.share_lower;
            all.share_upper = round.share_upper;
        }
        const double before = before_.rate * before_.seconds;
        all.rate = all.seconds > 0 ? (before + round.rate * round.seconds) / all.seconds : 0;
        all.occupancy =
            all.seconds > 0 ? (before_.occupancy * before_.seconds + round.occupancy * round.seconds) / all.seconds : 0;
        return all;
    }

private:
    Observer& whole_;
    Progress before_;
    bool fair_;
};

/// @param indices  of the round
/// @param outcomes those that are there, `has(index)` and `state(index)`; the new ones go to `add(row)`
/// @param sink     takes the new rows
/// @param whole    of the run so far; the round is added
/// @param realize  makes a realization; empty: the sampler does
/// @return whether all of the round are done
template <class Outcomes>
bool run_round(const LoadedStudy& loaded, const RunOptions& options, std::span<const std::uint64_t> indices,
               Outcomes& outcomes, const std::function<void(const ResultRow&)>& sink, Observer& observer,
               Progress& whole, std::function<Realization(std::uint64_t)> realize = {})
{
    const Study& study = loaded.study();
    RunPlan plan;
    plan.total = indices.size();
    plan.indices = indices;
    plan.mark_done(
        [&](std::uint64_t index) { return outcomes.has(index) ? std::optional(outcomes.state(index)) : std::nullopt; });
    plan.realize = std::move(realize);
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        const ResultRow row = result_row(study, realization, outcome);
        outcomes.add(row);
        sink(row);
    };
    const DoneSet::Part before = plan.done.all();
    Progress progress{.done = before.end, .collapsed = before.collapsed, .invalid = before.invalid};
    RoundObserver observed(observer, whole);
    if (before.end < plan.total)
        progress = run_ensemble(loaded.experiment(), options, plan, observed);
    whole = observed.joined(progress);
    return progress.done == plan.total;
}

} // namespace stylobate

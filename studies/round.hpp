#pragma once
/// One of several rounds of a run: the realizations that have not been run before, told as a part of the whole.

#include "ensemble/executor.hpp"
#include "studies/loaded_study.hpp"
#include "studies/trajectory.hpp"

#include <cstdint>
#include <functional>
#include <span>

namespace stylobate {

class RoundObserver : public Observer {
public:
    /// @param before all that had been done when the round began
    RoundObserver(Observer& whole, const Progress& before) : whole_(whole), before_(before) {}
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
        const double before = before_.rate * before_.seconds;
        all.rate = all.seconds > 0 ? (before + round.rate * round.seconds) / all.seconds : 0;
        all.occupancy =
            all.seconds > 0 ? (before_.occupancy * before_.seconds + round.occupancy * round.seconds) / all.seconds : 0;
        return all;
    }

private:
    Observer& whole_;
    Progress before_;
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
    plan.done = [&](std::uint64_t index) { return outcomes.has(index); };
    plan.realize = std::move(realize);
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        const ResultRow row = result_row(study, realization, outcome);
        outcomes.add(row);
        sink(row);
    };
    for (const std::uint64_t index : indices)
        if (outcomes.has(index)) {
            ++plan.before.done;
            plan.before.collapsed += outcomes.state(index) == State::collapsed;
            plan.before.invalid += outcomes.state(index) == State::invalid;
        }
    RoundObserver observed(observer, whole);
    const Progress progress = plan.before.done == plan.total
                                  ? plan.before
                                  : run_ensemble(study, loaded.sampler(), loaded.record(), options, plan, observed);
    whole = observed.joined(progress);
    return progress.done == plan.total;
}

} // namespace stylobate

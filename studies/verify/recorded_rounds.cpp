#include "studies/verify/recorded_rounds.hpp"

#include "ensemble/numerics/in_parallel.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace stylobate {

RecordedRounds::RecordedRounds(const Experiment& run, const RunOptions& how, Observer& told, Recorded recorded)
    : Rounds(run, how, told, Shard{1, 2}), recorded_(std::move(recorded))
{
}

void RecordedRounds::look_for(std::uint64_t index, std::vector<std::uint64_t>& of_sample)
{
    ++asked_;
    if (!missing_ && !recorded_.there(index))
        missing_ = index;
    if (std::ranges::binary_search(recorded_.sample, index))
        of_sample.push_back(index);
}

bool RecordedRounds::run(const Round& round)
{
    const Study& study = experiment.study();
    std::vector<std::uint64_t> again;
    const std::uint64_t size = round.indices.empty() ? study.total() : round.indices.size();
    for (std::uint64_t number = 0; number < size; ++number)
        look_for(round.indices.empty() ? number : round.indices[number], again);
    if (!again.empty()) {
        RunPlan plan;
        plan.indices = again;
        plan.total = again.size();
        plan.as = round.as;
        plan.realize = round.realize;
        plan.mark_done([](std::uint64_t) { return std::optional<State>(); });
        plan.sink = [&](const Realization& realization, const Outcome& outcome) {
            recorded_.take(result_row(study, realization, outcome));
        };
        const std::uint64_t done = run_ensemble(experiment, options, plan, observer).done;
        again_ += done;
        stopped_ = done < again.size();
    }
    return !stopped_ && !(missing_ && recorded_.ends_at_missing);
}

bool RecordedRounds::follow(std::uint64_t)
{
    std::vector<std::uint64_t> again;
    for (const std::uint64_t index : recorded_.followed)
        look_for(index, again);
    std::mutex mutex; // guards the takers, the observer and the counts
    const auto go_on = [&] {
        if (const std::unique_lock lock(mutex, std::try_to_lock); lock.owns_lock() && observer.stop_requested())
            stopped_ = true;
        return true;
    };
    tbb::task_arena arena(options.threads);
    arena.execute([&] {
        in_parallel(std::size_t{0}, again.size(), [&](std::size_t i) {
            {
                const std::lock_guard lock(mutex);
                if (stopped_ = stopped_ || observer.stop_requested(); stopped_)
                    return;
            }
            const FollowedRealization f = stylobate::follow(experiment, again[i], options.isa, go_on);
            const std::lock_guard lock(mutex);
            recorded_.take(result_row(experiment.study(), f.realization, f.outcome));
            recorded_.take_movement(f.trajectory);
            ++again_;
        });
    });
    return !stopped_;
}

} // namespace stylobate

#include "studies/verify/recorded_rounds.hpp"

#include "ensemble/numerics/in_parallel.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <tuple>
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

bool RecordedRounds::trace(std::uint64_t)
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
            const TracedRealization f = stylobate::trace(experiment, again[i], options.isa, go_on);
            const std::lock_guard lock(mutex);
            recorded_.take(result_row(experiment.study(), f.realization, f.outcome));
            recorded_.take_movement(f.trajectory);
            ++again_;
        });
    });
    return !stopped_;
}

/// SplitMix64 (Steele, Lea and Flood 2014, doi:10.1145/2660193.2660195): its two multiplications, over both numbers.
std::uint64_t sample_key(std::uint64_t seed, std::uint64_t index)
{
    const auto mix = [](std::uint64_t z) {
        z += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    };
    return mix(mix(seed) ^ index);
}

std::vector<std::uint64_t> replay_sample(const ResultReader& reader, std::uint64_t most, std::uint64_t seed)
{
    using Keyed = std::pair<std::uint64_t, std::uint64_t>;   // key, index
    std::map<std::uint64_t, std::set<Keyed>> lowest_of_cell; // of each cell the `most` of the lowest keys
    if (most > 0)
        reader.for_each_row([&](const ResultRow& row) {
            std::set<Keyed>& lowest = lowest_of_cell[row.cell];
            lowest.emplace(sample_key(seed, row.index), row.index);
            if (lowest.size() > most)
                lowest.erase(std::prev(lowest.end()));
        });
    std::vector<std::tuple<std::size_t, std::uint64_t, std::uint64_t>> all; // number in its cell, key, index
    for (const auto& [cell, lowest] : lowest_of_cell) {
        std::size_t number = 0;
        for (const auto& [key, index] : lowest)
            all.emplace_back(number++, key, index);
    }
    std::ranges::sort(all);
    std::vector<std::uint64_t> sample;
    for (std::size_t i = 0; i < all.size() && i < most; ++i)
        sample.push_back(std::get<2>(all[i]));
    std::ranges::sort(sample);
    return sample;
}

} // namespace stylobate

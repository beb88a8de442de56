#pragma once
/// Many realizations: every core steps bundles, and a lane whose realization has ended takes the next one.

#include "ensemble/experiment.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "ensemble/planar/device/device.hpp"
#include "ensemble/run/ranks.hpp"
#include "kernels/isa.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace stylobate {

struct RunOptions {
    Isa isa = Isa::scalar;
    int threads = 1;
    /// Where to step instead of on the processor: each has a thread of its own that serves it, with the help of
    /// `threads` threads where realizations begin and end.
    std::vector<std::shared_ptr<Device>> devices{};
    int slots = 0; ///< of each device; 0: its own choice
    /// So many realizations for each thread are ended sooner by these than by a device, and a quarter of them once
    /// nothing is left to begin (`FewRealizations`). None: as the devices say.
    std::optional<int> few{};
    /// With devices: so many realizations that may take longest are begun first. 0: the run order is left as it is.
    int longest_first = 1000;
    /// With devices: so many of these for each thread that does not serve the devices are stepped by the host from the
    /// beginning, the longest one first: a realization by itself takes less time in a lane than on a device.
    int longest_on_host = 1;
    /// The processes that run the same together; null: this one is alone. `run_ensemble` knows nothing of them: who
    /// calls it shares out what is to be run.
    Ranks* ranks = nullptr;

    bool leads() const { return !ranks || ranks->leads(); }
};

/// What is left to do, and where results go.
struct RunPlan {
    std::uint64_t total = 0;                     ///< realizations 0 .. total - 1, or as many as `indices`
    std::span<const std::uint64_t> indices = {}; ///< those to run; empty: 0 .. total - 1
    Shard shard = {};                            ///< the part of them that is run here
    /// Those that have been done before, by their places: number p of them (or index p) has place
    /// `RunOrder(total).place(p)`. `mark_done` fills it.
    DoneSet done;
    /// The study that the realizations are stepped as, which must be the experiment's but for what a step needs
    /// (`ReplicaRange`); null: the experiment's own.
    const Study* as = nullptr;
    /// The next place to run, of those that this process and others share; called from several threads at once, may
    /// wait. Empty: those of the shard that are not done, in their order.
    std::function<std::optional<std::uint64_t>()> next_place{};
    int processes = 1; ///< that share the places
    /// A realization by its index; called from several threads at once. Empty: the sampler's.
    std::function<Realization(std::uint64_t index)> realize;
    /// Takes the results. Called from one thread at a time, in any order of the indices.
    std::function<void(const Realization&, const Outcome&)> sink;

    std::uint64_t index(std::uint64_t number) const { return indices.empty() ? number : indices[number]; }
    /// The first place from `next` on that is not done; `next` is then behind it. Nothing: there is none before `end`.
    std::optional<std::uint64_t> next_undone(std::uint64_t& next, std::uint64_t end) const
    {
        while (next < end && done.has(next))
            ++next;
        return next < end ? std::optional(next++) : std::nullopt;
    }
    /// Marks what of the shard has been done before. @param state of an index: an optional `State`
    template <class StateOf>
    void mark_done(const StateOf& state)
    {
        const RunOrder order(total);
        done = DoneSet(order);
        const RunOrder::Places places = order.places(shard);
        for (std::uint64_t place = places.begin; place < places.end; ++place)
            if (const std::optional<State> s = state(index(order.index(place))))
                done.add(place, s == State::collapsed, s == State::invalid);
    }
};

/// Sets the share in the whole study from a fair sample of it: Jeffreys' interval. Of no valid realization it says
/// nothing.
void estimate_share(Progress& progress, std::uint64_t valid, std::uint64_t collapsed);

/// Runs the realizations of an experiment.
///
/// They are begun in the order of `RunOrder`, so that what has been done at any time is spread over all of them; the
/// progress' share is that of `DoneSet::sample`. On devices the longest ones are begun first (`StartOrder`), by what
/// `Sampler::most_steps` says. The order is left as it is where the plan makes its realizations or gives the places
/// itself (`RunPlan::realize`, `RunPlan::next_place`): of the places of other processes nothing is known here.
///
/// With devices, `threads` are shared as follows. A thread for each device waits for it, and is not counted. While
/// longest realizations are stepped on the host, a quarter of the threads, at least one, serve the devices, and each of
/// the others steps one of these after the other; later all serve the devices, and in the end step what these leave.
///
/// Where a device fails, the observer is warned once for each kind of device, and what the device had begun is begun
/// anew: by the other devices, or on the processor once none of them goes on.
///
/// The next one comes from one shared counter, so lanes and threads stay busy to the end; a realization's outcome
/// depends on its index alone (see `LaneSet`), so the same results come out, bit by bit, whatever the instruction set
/// and the number of threads, and on devices too (`docs/gpu.md` gives the reasons).
///
/// @return the counts at the end, of a shard its own; `done < total` if the observer asked to stop
/// @throws what `Sampler::realization` or the sink throws, after all threads have stopped
Progress run_ensemble(const Experiment& experiment, const RunOptions& options, const RunPlan& plan, Observer& observer);

} // namespace stylobate

#include "ensemble/run/executor.hpp"

#include "ensemble/engine/drive.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/planar/device/slots.hpp"
#include "ensemble/planar/hand_over.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/spatial/spatial_model.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <unordered_map>

namespace stylobate {

namespace {

constexpr std::uint64_t most_slots = 1 << 24;
/// Realizations that a device leaves to the processor are stepped there one by one, not in registers; slower by about:
constexpr int slower_alone = 4;

/// The sets in which the planar model's realizations are run.
struct PlanarSets {
    using Lanes = LaneSet;
    using Slots = SlotSet;           ///< of a device
    using HandedOver = CompliantSet; ///< what takes over what the lanes or slots cannot step to its end
    static bool hands_over(const Realization& pattern) { return pattern.form == ContactForm::rigid; }
};

/// Those of the spatial model, whose lanes step every realization to its end. It has no device.
struct SpatialSets {
    using Lanes = SpatialLaneSet;
    struct HandedOver {
        HandedOver(const Study&, const Motion*, const KernelTable&, const Realization&) {}
        void take(const SpatialModel::HandOver&) {}
        bool empty() const { return true; }
        bool full() const { return false; }
        int lanes() const { return 0; }
        int active() const { return 0; }
        template <class Deliver>
        void advance(const Deliver&)
        {
        }
    };
    static bool hands_over(const Realization&) { return false; }
};

template <class Sets>
concept HasDevices = requires
{
    typename Sets::Slots;
};

/// What the workers share. @tparam Sets of the model
template <class Sets>
class Run {
public:
    using Lanes = typename Sets::Lanes;
    using HandedOver = typename Sets::HandedOver;

    Run(const Experiment& experiment, const RunOptions& options, const RunPlan& plan, Observer& observer)
        : study_(plan.as ? *plan.as : experiment.study()), sampler_(experiment.sampler()), record_(experiment.record()),
          kernels_(kernels(options.isa)), threads_(options.threads), few_(options.few * options.threads), plan_(plan),
          crew_(observer), order_(plan.total), done_(plan.done.parts().empty() ? DoneSet(order_) : plan.done),
          places_(order_.places(plan.shard)), next_(places_.begin), pattern_(realize(plan.index(0)))
    {
        const DoneSet::Part before = done_.all();
        progress_.done = before_ = before.end;
        progress_.collapsed = before.collapsed;
        progress_.invalid = before.invalid;
        progress_.total = places_.size();
    }

    /// One worker of the processor: a bundle that is refilled until nothing is left.
    void work()
    {
        Lanes lanes(study_, record_, kernels_, pattern_, left() / static_cast<std::uint64_t>(threads_));
        run(lanes, [&](int stepped, bool) {
            count_chunks(lanes.lanes(), stepped);
            report(false, &lanes);
        });
    }

    /// One worker for a device: many slots. Its thread waits for the device; what a realization takes at its beginning
    /// is done on several.
    void work(Device& device, int slots, int share) requires HasDevices<Sets>
    {
        // no more slots than this device's share of what is to do
        const auto most =
            static_cast<int>(std::min<std::uint64_t>(left() / static_cast<std::uint64_t>(share) + 1, most_slots));
        typename Sets::Slots set(study_, record_, pattern_, device, slots, most);
        run(set, [&](int stepped, bool more) {
            count_chunks(set.used(), stepped);
            report(false);
            if (!more && set.active() <= few_ / slower_alone / share)
                set.leave_device();
        });
    }

    Crew& crew() { return crew_; }
    /// Whether the processor ends this sooner than devices would.
    bool few() const { return left() <= static_cast<std::uint64_t>(few_); }

    Progress finish()
    {
        crew_.rethrow();
        report(true);
        return progress_;
    }

private:
    /// Steps what there is to run in these lanes, and in others what is handed over.
    /// @param turn as of `drive`
    template <class Set, class Turn>
    void run(Set& set, const Turn& turn)
    {
        std::optional<HandedOver> handed_over;
        if (Sets::hands_over(pattern_))
            handed_over.emplace(study_, record_, kernels_, pattern_);
        const auto source = [&](int lane) {
            const std::optional<std::uint64_t> index = next();
            if (index)
                set.load(lane, realize(*index));
            return index.has_value();
        };
        const auto sink = [&](int lane) {
            if (set.outcome(lane))
                deliver(set.realization(lane), *set.outcome(lane));
            else
                handed_over->take(*set.handed(lane));
            set.clear(lane);
        };
        drive(set, source, sink, [&](int stepped, bool more) {
            step(handed_over, set.active() == 0);
            turn(stepped, more);
            return !crew_.stopped();
        });
    }

    /// Steps what was handed over while there is a register of it.
    /// @param all to the end of the last one
    void step(std::optional<HandedOver>& set, bool all)
    {
        while (set && !set->empty() && (all || set->full()) && !crew_.stopped()) {
            set->advance(
                [this](const Realization& realization, const Outcome& outcome) { deliver(realization, outcome); });
            count_chunks(set->lanes(), set->active());
            report(false);
        }
    }

    void count_chunks(int lanes, int active)
    {
        lane_chunks_ += static_cast<std::uint64_t>(lanes);
        active_chunks_ += static_cast<std::uint64_t>(active);
    }

    /// Realizations that were to be run here at the beginning, about.
    std::uint64_t left() const
    {
        const std::uint64_t all = places_.size() - std::min(places_.size(), before_);
        return all / static_cast<std::uint64_t>(plan_.processes);
    }

    Realization realize(std::uint64_t index) const
    {
        return plan_.realize ? plan_.realize(index) : sampler_.realization(index);
    }

    std::optional<std::uint64_t> next()
    {
        const std::optional<std::uint64_t> place = next_place_(); // it may wait: without the lock
        if (!place || crew_.stopped())
            return std::nullopt;
        const std::lock_guard lock(crew_.mutex());
        const std::uint64_t index = plan_.index(order_.index(*place));
        running_.emplace(index, *place);
        return index;
    }

    void deliver(const Realization& realization, const Outcome& outcome)
    {
        const std::lock_guard lock(crew_.mutex());
        plan_.sink(realization, outcome);
        const auto place = running_.find(realization.index);
        done_.add(place->second, outcome.state == State::collapsed, outcome.state == State::invalid);
        running_.erase(place);
        ++progress_.done;
        progress_.collapsed += outcome.state == State::collapsed;
        progress_.invalid += outcome.state == State::invalid;
        progress_.block_steps += realization.free_blocks() * outcome.steps;
        ++delivered_;
    }

    /// @param lanes of the thread that reports; null: not known
    void report(bool last, const Lanes* lanes = nullptr)
    {
        crew_.tell(last, [&](double seconds) -> const Progress& {
            progress_.seconds = seconds;
            progress_.rate = seconds > 0 ? static_cast<double>(delivered_) / seconds : 0;
            const std::uint64_t chunks = lane_chunks_;
            progress_.occupancy = chunks > 0 ? static_cast<double>(active_chunks_) / static_cast<double>(chunks) : 0;
            const DoneSet::Part sample = done_.sample(places_.begin);
            if (sample.end > 0)
                estimate_share(progress_, sample.done(places_.begin) - sample.invalid, sample.collapsed);
            if (lanes != nullptr)
                progress_.furthest = lanes->furthest();
            return progress_;
        });
    }

    const Study& study_;
    const Sampler& sampler_;
    const Motion* record_;
    const KernelTable& kernels_;
    const int threads_;
    const int few_; ///< realizations that the processor ends sooner than a device
    const RunPlan& plan_;
    /// The plan's, or the places that are to be done, in their order.
    const std::function<std::optional<std::uint64_t>()> next_place_ = plan_.next_place ? plan_.next_place : [this] {
        const std::lock_guard lock(crew_.mutex());
        return plan_.next_undone(next_, places_.end);
    };
    Crew crew_; ///< its mutex guards the sink and what follows
    Progress progress_;
    const RunOrder order_;
    DoneSet done_;                                             ///< places
    const RunOrder::Places places_;                            ///< of the shard
    std::uint64_t next_;                                       ///< place
    std::uint64_t before_ = 0;                                 ///< how many had been done
    std::unordered_map<std::uint64_t, std::uint64_t> running_; ///< places of what is being stepped, by index
    std::uint64_t delivered_ = 0;
    std::atomic<std::uint64_t> lane_chunks_ = 0, active_chunks_ = 0;
    const Realization pattern_; ///< the topology that all realizations share
};

template <class Sets>
Progress execute(const Experiment& experiment, const RunOptions& options, const RunPlan& plan, Observer& observer)
{
    Run<Sets> run(experiment, options, plan, observer);
    if (options.devices.empty() || run.few()) {
        run.crew().run(options.threads, [&run] { run.work(); });
        return run.finish();
    }
    if constexpr (HasDevices<Sets>) {
        const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(options.threads));
        std::vector<std::thread> workers;
        for (const std::shared_ptr<Device>& device : options.devices)
            workers.emplace_back([&run, &options, &device] {
                run.crew().guarded([&] { run.work(*device, options.slots, static_cast<int>(options.devices.size())); });
            });
        for (std::thread& worker : workers)
            worker.join();
        return run.finish();
    } else {
        throw std::invalid_argument("structures in space are not stepped on a device");
    }
}

} // namespace

void estimate_share(Progress& progress, std::uint64_t valid, std::uint64_t collapsed)
{
    if (valid == 0)
        return;
    const BinomialInterval interval = jeffreys(valid, collapsed, 0.95);
    progress.share = static_cast<double>(collapsed) / static_cast<double>(valid);
    progress.share_lower = interval.lower;
    progress.share_upper = interval.upper;
}

Progress run_ensemble(const Experiment& experiment, const RunOptions& options, const RunPlan& plan, Observer& observer)
{
    return experiment.study().structure.spatial() ? execute<SpatialSets>(experiment, options, plan, observer)
                                                  : execute<PlanarSets>(experiment, options, plan, observer);
}

} // namespace stylobate

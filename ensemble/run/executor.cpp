#include "ensemble/run/executor.hpp"

#include "ensemble/engine/drive.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/planar/device/slots.hpp"
#include "ensemble/planar/hand_over.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/run/start_order.hpp"
#include "ensemble/spatial/spatial_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <unordered_map>

namespace stylobate {

namespace {

constexpr std::uint64_t most_slots = 1 << 24;
/// Realizations that a device leaves to the processor are stepped there one by one, not in registers; slower by about:
constexpr int slower_alone = 4;
/// One of so many threads, at least one, serves the devices while the others step realizations.
constexpr int threads_a_server = 4;

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
          kernels_(kernels(options.isa)), options_(options), plan_(plan), crew_(observer), order_(plan.total),
          done_(plan.done.parts().empty() ? DoneSet(order_) : plan.done), places_(order_.places(plan.shard)),
          next_(places_.begin), pattern_(realize(plan.index(0)))
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
        Lanes lanes(study_, record_, kernels_, pattern_, left() / static_cast<std::uint64_t>(options_.threads));
        step(lanes, [this] { return start_.next(); });
    }

    /// One that steps the longest realizations, one after the other and each by itself.
    void work_apart()
    {
        Lanes lanes(study_, record_, kernels(Isa::scalar), pattern_);
        step(lanes, [this] { return start_.next_apart(); });
    }

    /// One worker for a device: many slots. Its thread waits for the device; what a realization takes at its beginning
    /// is done on several. Where the device fails, others begin anew what it had begun.
    /// @param share number of workers that share what is to do
    /// @param ready once it is known what is to be begun first
    void work(Device& device, int share, const std::shared_future<void>& ready) requires HasDevices<Sets>
    {
        if (device.failed()) { // in a round before
            failed_ = true;
            return;
        }
        try {
            // no more slots than this device's share of what is to do
            const auto most =
                static_cast<int>(std::min<std::uint64_t>(left() / static_cast<std::uint64_t>(share) + 1, most_slots));
            typename Sets::Slots set(study_, record_, pattern_, device, options_.slots, most);
            // (of several queues the first one speaks; studies may run in many rounds)
            const std::string why = &device == options_.devices.front().get() ? set.why_slow() : "";
            if (!why.empty() && device.tell_slow())
                crew_.warn(fmt::format("--backend cuda: the GPU steps this study with a thread for every realization, "
                                       "its slower way: {} (docs/gpu.md)",
                                       why));
            ready.wait();
            step_on_device(set, few_.last * options_.threads / share);
        } catch (const DeviceError& error) {
            failed_ = true;
            device.give_up();
            warn_once(device.name(), error.what());
        }
    }

    /// Finds the longest realizations, which are begun before all others.
    /// @return the number of threads that step some of them
    int begin_with_longest()
    {
        if (plan_.realize || plan_.next_place)
            return 0;
        std::vector<std::uint64_t> longest =
            longest_places(places_, done_, static_cast<std::size_t>(std::max(options_.longest_first, 0)),
                           [this](std::uint64_t place) { return sampler_.most_steps(index_of(place)); });
        const int free = options_.threads - std::max(1, options_.threads / threads_a_server);
        const auto most = static_cast<std::size_t>(std::max(options_.longest_on_host, 0) * std::max(free, 0));
        const std::size_t apart = std::min(most, longest.size());
        start_.start_first(std::move(longest), apart);
        return static_cast<int>(std::min(apart, static_cast<std::size_t>(free)));
    }

    Crew& crew() { return crew_; }
    /// Whether the processor ends this sooner than devices would.
    bool few()
    {
        if constexpr (HasDevices<Sets>)
            few_ = Sets::Slots::few_a_thread(study_, record_, pattern_, *options_.devices.front());
        if (options_.few)
            few_ = {*options_.few, *options_.few / slower_alone};
        return left() <= static_cast<std::uint64_t>(few_.run) * static_cast<std::uint64_t>(options_.threads);
    }
    /// Whether a device has failed.
    bool failed() const { return failed_; }

    Progress finish()
    {
        crew_.rethrow();
        report(true);
        return progress_;
    }

private:
    /// Steps what there is to run in these lanes.
    /// @param next () the next place
    template <class Next>
    void step(Lanes& lanes, const Next& next)
    {
        const auto source = [&](int lane) {
            std::optional<Realization> realization = begin(next());
            if (realization)
                lanes.load(lane, std::move(*realization));
            return realization.has_value();
        };
        run(lanes, source, [&](int stepped, bool) {
            count_chunks(lanes.lanes(), stepped);
            report(false, &lanes);
        });
    }

    /// @param last once nothing is left to begin, so many are left to the host
    /// @throws DeviceError if the device fails; what it had begun is then to be begun anew
    template <class Slots>
    void step_on_device(Slots& set, int last)
    {
        set.prepare_from([this] { return begin(start_.next()); });
        try {
            run(
                set, [&](int slot) { return set.fill(slot); },
                [&](int stepped, bool more) {
                    count_chunks(set.used(), stepped);
                    report(false);
                    if (!more && set.active() <= last)
                        set.leave_device();
                });
        } catch (const DeviceError&) {
            give_back(set.unfinished());
            throw;
        }
    }

    /// Steps what there is to run in these lanes or slots, and in others what is handed over.
    /// @param source, turn as of `drive`
    template <class Set, class Source, class Turn>
    void run(Set& set, const Source& source, const Turn& turn)
    {
        std::optional<HandedOver> handed_over;
        if (Sets::hands_over(pattern_))
            handed_over.emplace(study_, record_, kernels_, pattern_);
        const auto sink = [&](int lane) {
            if (set.outcome(lane))
                deliver(set.realization(lane), *set.outcome(lane));
            else
                handed_over->take(*set.handed(lane));
            set.clear(lane);
        };
        try {
            drive(set, source, sink, [&](int stepped, bool more) {
                step(handed_over, set.active() == 0);
                turn(stepped, more);
                return !crew_.stopped();
            });
        } catch (const DeviceError&) {
            step(handed_over, true); // it is on the host
            throw;
        }
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

    std::uint64_t index_of(std::uint64_t place) const { return plan_.index(order_.index(place)); }

    /// The realization of a place, which is being run from now on; nothing: there is none, or the run stops.
    std::optional<Realization> begin(std::optional<std::uint64_t> place)
    {
        if (!place || crew_.stopped())
            return std::nullopt;
        const std::uint64_t index = index_of(*place);
        {
            const std::lock_guard lock(crew_.mutex());
            running_.emplace(index, *place);
        }
        return realize(index);
    }

    /// What is not being run any more, and has not ended.
    void give_back(const std::vector<std::uint64_t>& indices)
    {
        const std::lock_guard lock(crew_.mutex());
        for (const std::uint64_t index : indices) {
            const auto place = running_.find(index);
            start_.give_back(place->second);
            running_.erase(place);
        }
    }

    /// That a device has failed; of several queues of one it is said once.
    void warn_once(const std::string& device, const std::string& error)
    {
        {
            const std::lock_guard lock(crew_.mutex());
            if (!lost_.insert(device).second)
                return;
        }
        crew_.warn(fmt::format("{} is not used any more: {}. What it had begun is begun anew without it, with the same "
                               "results.",
                               device, error));
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
    const RunOptions& options_;
    FewRealizations few_; ///< that the processor ends sooner than a device
    const RunPlan& plan_;
    Crew crew_; ///< its mutex guards the sink and what follows
    Progress progress_;
    const RunOrder order_;
    DoneSet done_;                  ///< places
    const RunOrder::Places places_; ///< of the shard
    std::uint64_t next_;            ///< place
    /// The plan's, or the places that are to be done.
    StartOrder start_{plan_.next_place ? plan_.next_place : [this] {
        const std::lock_guard lock(crew_.mutex());
        return plan_.next_undone(next_, places_.end);
    }};
    std::uint64_t before_ = 0;                                 ///< how many had been done
    std::unordered_map<std::uint64_t, std::uint64_t> running_; ///< places of what is being stepped, by index
    std::uint64_t delivered_ = 0;
    std::atomic<std::uint64_t> lane_chunks_ = 0, active_chunks_ = 0;
    std::atomic<bool> failed_ = false; ///< a device
    std::set<std::string> lost_;       ///< devices that the observer was warned of
    const Realization pattern_;        ///< the topology that all realizations share
};

/// The threads of a run on devices; `run_ensemble` states how many there are of each kind.
template <class Sets>
void work_on_devices(Run<Sets>& run, const RunOptions& options)
{
    constexpr auto limit = tbb::global_control::max_allowed_parallelism;
    const tbb::global_control threads(limit, static_cast<std::size_t>(options.threads));
    std::promise<void> known; // meanwhile the devices get their memory
    const std::shared_future<void> ready = known.get_future().share();
    std::vector<std::thread> steppers, workers;
    for (const std::shared_ptr<Device>& device : options.devices)
        workers.emplace_back([&run, &options, &device, ready] {
            run.crew().guarded([&] { run.work(*device, static_cast<int>(options.devices.size()), ready); });
        });
    int apart = 0;
    run.crew().guarded([&] { apart = run.begin_with_longest(); });
    std::promise<bool> served; // whether devices have failed
    const std::shared_future<bool> lost = served.get_future().share();
    if (apart > 0) { // until the last of them has ended the longest ones, fewer serve the devices
        auto fewer = std::make_shared<tbb::global_control>(limit, static_cast<std::size_t>(options.threads - apart));
        for (int i = 0; i < apart; ++i)
            steppers.emplace_back([&run, fewer, lost]() mutable {
                run.crew().guarded([&run] { run.work_apart(); });
                fewer.reset();
                if (lost.get())
                    run.crew().guarded([&run] { run.work(); });
            });
    }
    known.set_value();
    for (std::thread& worker : workers)
        worker.join();
    served.set_value(run.failed());
    if (run.failed())
        run.crew().guarded([&] { run.crew().run(options.threads - apart, [&run] { run.work(); }); });
    for (std::thread& stepper : steppers)
        stepper.join();
}

template <class Sets>
Progress execute(const Experiment& experiment, const RunOptions& options, const RunPlan& plan, Observer& observer)
{
    Run<Sets> run(experiment, options, plan, observer);
    if (options.devices.empty() || run.few())
        run.crew().run(options.threads, [&run] { run.work(); });
    else if constexpr (HasDevices<Sets>)
        work_on_devices(run, options);
    else
        throw std::invalid_argument("structures in space are not stepped on a device");
    return run.finish();
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

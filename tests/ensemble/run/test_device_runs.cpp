/// Whole runs on devices that are the processor: which realizations are begun first, which of them the host steps, what
/// is made while a device steps, and what becomes of a run whose device fails.

#include "ensemble/planar/device/slot_warp.hpp"
#include "ensemble/planar/device/slots.hpp"
#include "ensemble/run/executor.hpp"
#include "io/study/study_file.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"
#include "tests/ensemble/engine/forwarding_device.hpp"
#include "tests/ensemble/engine/rigid_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace stylobate {
namespace {

using test::ForwardingDevice;

/// Columns at three frequencies, 6 x `each` realizations.
Study surface(int each)
{
    return read_study(std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/small_scale_column.toml",
                      {"study.realizations=" + std::to_string(each), "excitation.cycles=3", "excitation.ramp_cycles=1",
                       "surface.frequency_hz={ from = 2.0, to = 8.0, count = 3 }",
                       "surface.pga_m_s2={ from = 3.0, to = 9.0, count = 2 }"});
}

RunOptions on(const std::vector<std::shared_ptr<Device>>& devices, int threads, int slots)
{
    RunOptions options{Isa::scalar, threads};
    options.devices = devices;
    options.slots = slots;
    options.few = 0;
    options.longest_first = options.longest_on_host = 0;
    return options;
}

/// What a run gave, in its order.
struct Told {
    std::vector<std::uint64_t> order; ///< indices
    std::map<std::uint64_t, Bits> outcomes;
    std::map<std::uint64_t, std::thread::id> thread; ///< that delivered it, by index
    std::vector<std::string> warnings;
    Progress progress;
};

/// Stops a run once so many realizations have ended; looks at its progress.
class Watcher : public Observer {
public:
    explicit Watcher(Told& told, std::size_t stop_after = std::numeric_limits<std::size_t>::max())
        : told_(told), stop_after_(stop_after)
    {
    }
    std::function<void(const Progress&)> look = [](const Progress&) {};
    void progress(const Progress& progress) override { look(progress); }
    void warn(const std::string& text) override { told_.warnings.push_back(text); }
    bool stop_requested() override { return told_.order.size() >= stop_after_; }

private:
    Told& told_;
    const std::size_t stop_after_;
};

RunPlan plan_of(const Study& study, Told& told)
{
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&told](const Realization& realization, const Outcome& outcome) {
        told.order.push_back(realization.index);
        EXPECT_TRUE(told.outcomes.emplace(realization.index, outcome_bits(outcome)).second)
            << "realization " << realization.index << " came twice";
        told.thread[realization.index] = std::this_thread::get_id();
    };
    return plan;
}

Told run(const Study& study, const RunOptions& options, const std::function<void(RunPlan&)>& change = {})
{
    Told told;
    RunPlan plan = plan_of(study, told);
    if (change)
        change(plan);
    Watcher watcher(told);
    told.progress = run_ensemble(Experiment(study), options, plan, watcher);
    return told;
}

/// Indices by their most steps, the longest first.
std::vector<std::uint64_t> by_length(const Study& study)
{
    const Sampler sampler(study, nullptr);
    std::vector<std::uint64_t> indices(study.total());
    for (std::uint64_t i = 0; i < indices.size(); ++i)
        indices[i] = i;
    std::sort(indices.begin(), indices.end(),
              [&](std::uint64_t a, std::uint64_t b) { return sampler.most_steps(a) > sampler.most_steps(b); });
    return indices;
}

/// The same, but for the first ones, in the run order.
std::vector<std::uint64_t> with_first(const Study& study, std::vector<std::uint64_t> first)
{
    const RunOrder order(study.total());
    const std::set<std::uint64_t> moved(first.begin(), first.end());
    for (std::uint64_t place = 0; place < study.total(); ++place)
        if (!moved.contains(order.index(place)))
            first.push_back(order.index(place));
    return first;
}

/// Steps until a call number `fails_at` of its queue, of the calls that may fail.
class FailingDevice : public ForwardingDevice {
public:
    explicit FailingDevice(int fails_at) : fails_at_(fails_at) {}
    std::string name() const override { return "device X"; }
    void* allocate(std::size_t bytes) override
    {
        call();
        return ForwardingDevice::allocate(bytes);
    }
    void upload(void* to, const void* from, std::size_t bytes) override
    {
        call();
        ForwardingDevice::upload(to, from, bytes);
    }
    void download(void* to, const void* from, std::size_t bytes) override
    {
        call();
        ForwardingDevice::download(to, from, bytes);
    }
    void advance(const SlotMemory& memory, int chunks, int count) override
    {
        call();
        ForwardingDevice::advance(memory, chunks, count);
    }

private:
    void call()
    {
        if (++calls_ >= fails_at_)
            throw DeviceError("the GPU failed: it fell off the bus");
    }
    const int fails_at_;
    int calls_ = 0;
};

} // namespace

TEST(DeviceRuns, TheLongestAreBegunFirst)
{
    const Study study = surface(5);
    RunOptions options = on({std::make_shared<ForwardingDevice>()}, 1, 1); // one after the other
    options.longest_first = 7;
    std::vector<std::uint64_t> longest = by_length(study);
    longest.resize(7);
    EXPECT_EQ(run(study, options).order, with_first(study, longest));
    options.longest_first = 0;
    EXPECT_EQ(run(study, options).order, with_first(study, {}));
    options.longest_first = 1000;
    EXPECT_EQ(run(study, options).order, by_length(study)) << "fewer than are moved";
}

TEST(DeviceRuns, WhereThePlanGivesPlacesOrRealizationsTheOrderIsItsOwn)
{
    const Study study = surface(2);
    RunOptions options = on({std::make_shared<ForwardingDevice>()}, 1, 1);
    options.longest_first = 7;
    const RunOrder order(study.total());
    std::uint64_t left = study.total();
    const Told given = run(study, options, [&](RunPlan& plan) {
        plan.next_place = [&left]() -> std::optional<std::uint64_t> {
            return left > 0 ? std::optional(--left) : std::nullopt;
        };
    });
    std::vector<std::uint64_t> backwards = with_first(study, {});
    std::reverse(backwards.begin(), backwards.end());
    EXPECT_EQ(given.order, backwards);
    const Sampler sampler(study, nullptr);
    const Told made = run(study, options, [&](RunPlan& plan) {
        plan.realize = [&](std::uint64_t index) { return sampler.realization(index); };
    });
    EXPECT_EQ(made.order, with_first(study, {}));
}

TEST(DeviceRuns, TheHostStepsTheLongestFromTheBeginning)
{
    const Study study = surface(5);
    const EnsembleRun want = run_all(study, {best_isa(), 2});
    const auto device = std::make_shared<ForwardingDevice>();
    RunOptions options = on({device}, 4, 4);
    options.longest_first = 20;
    options.longest_on_host = 2; // 6 of them, on 3 threads
    const Told told = run(study, options);
    EXPECT_EQ(told.outcomes, want.outcomes);
    EXPECT_EQ(told.progress.done, study.total());
    EXPECT_EQ(told.progress.block_steps, want.progress.block_steps);
    const std::vector<std::uint64_t> longest = by_length(study);
    std::set<std::thread::id> host, served;
    for (std::size_t i = 0; i < longest.size(); ++i)
        (i < 6 ? host : served).insert(told.thread.at(longest[i]));
    EXPECT_EQ(served.size(), 1U) << "one thread serves the device";
    EXPECT_LE(host.size(), 3U);
    EXPECT_FALSE(host.contains(*served.begin()));
}

/// With one thread there is none to spare.
TEST(DeviceRuns, OneThreadServesTheDevice)
{
    const Study study = surface(2);
    RunOptions options = on({std::make_shared<ForwardingDevice>()}, 1, 4);
    options.longest_first = 20;
    options.longest_on_host = 3;
    const Told told = run(study, options);
    EXPECT_EQ(told.outcomes, run_all(study, {best_isa(), 2}).outcomes);
    std::set<std::thread::id> threads;
    for (const auto& [index, thread] : told.thread)
        threads.insert(thread);
    EXPECT_EQ(threads.size(), 1U);
}

/// Rigid blocks that the host steps are handed over there as elsewhere.
TEST(DeviceRuns, RigidBlocksHaveTheSameBits)
{
    const Study study = rigid_of(surface(3));
    RunOptions options = on({std::make_shared<ForwardingDevice>()}, 2, 4);
    options.longest_first = 12;
    options.longest_on_host = 3;
    EXPECT_EQ(run(study, options).outcomes, run_all(study, {best_isa(), 2}).outcomes);
}

TEST(DeviceRuns, AStoppedRunContinuesWithWhatIsNotDone)
{
    const Study study = surface(10);
    const EnsembleRun want = run_all(study, {best_isa(), 2});
    RunOptions options = on({std::make_shared<ForwardingDevice>(), std::make_shared<ForwardingDevice>()}, 2, 4);
    options.longest_first = 20;
    options.longest_on_host = 3;
    const Experiment experiment(study);
    Told told;
    RunPlan plan = plan_of(study, told);
    Watcher stops(told, 12);
    const Progress first = run_ensemble(experiment, options, plan, stops);
    EXPECT_GE(first.done, 12U);
    EXPECT_LT(first.done, study.total()) << "it was not stopped";
    EXPECT_EQ(first.done, told.outcomes.size());
    const std::set<std::uint64_t> done(told.order.begin(), told.order.end());
    plan.mark_done(
        [&](std::uint64_t index) { return done.contains(index) ? std::optional(State::stood) : std::nullopt; });
    Watcher patient(told);
    EXPECT_EQ(run_ensemble(experiment, options, plan, patient).done, study.total());
    EXPECT_EQ(told.outcomes, want.outcomes);
}

TEST(DeviceRuns, ShardsRunTheirOwnPlaces)
{
    const Study study = surface(5);
    RunOptions options = on({std::make_shared<ForwardingDevice>()}, 2, 4);
    options.longest_first = 6;
    options.longest_on_host = 1;
    std::map<std::uint64_t, Bits> all;
    for (const std::uint64_t number : {1, 2, 3}) {
        const Told told = run(study, options, [&](RunPlan& plan) { plan.shard = {number, 3}; });
        EXPECT_EQ(told.progress.done, RunOrder(study.total()).places({number, 3}).size());
        for (const auto& [index, outcome] : told.outcomes)
            EXPECT_TRUE(all.emplace(index, outcome).second);
    }
    EXPECT_EQ(all, run_all(study, {best_isa(), 2}).outcomes);
}

/// The share that is reported at any time is that of the first blocks of the run order, counted here anew from what has
/// been delivered.
TEST(DeviceRuns, TheReportedShareIsThatOfWholeBlocksLong)
{
    const Study study = surface(42);
    const RunOrder order(study.total());
    ASSERT_LT(order.block_end(0), study.total()) << "one block alone proves nothing";
    RunOptions options = on({std::make_shared<ForwardingDevice>()}, 2, 16);
    options.longest_first = 60;
    options.longest_on_host = 3;
    std::map<std::uint64_t, bool> collapsed; // by place
    Told told;
    RunPlan plan = plan_of(study, told);
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        collapsed[order.place(realization.index)] = outcome.state == State::collapsed;
    };
    int looks = 0, known = 0;
    Watcher watcher(told);
    watcher.look = [&](const Progress& progress) {
        std::uint64_t whole = 0, fallen = 0;
        while (whole < study.total()) {
            const std::uint64_t end = order.block_end(whole);
            std::uint64_t of_block = 0;
            for (std::uint64_t place = whole; place < end; ++place)
                of_block += collapsed.contains(place);
            if (of_block < end - whole)
                break;
            for (; whole < end; ++whole)
                fallen += collapsed.at(whole);
        }
        ++looks;
        known += whole > 0;
        if (whole == 0)
            EXPECT_TRUE(std::isnan(progress.share));
        else
            EXPECT_EQ(progress.share, static_cast<double>(fallen) / static_cast<double>(whole));
    };
    run_ensemble(Experiment(study), options, plan, watcher);
    EXPECT_EQ(collapsed.size(), study.total());
    EXPECT_GT(looks, 2);
    EXPECT_GT(known, 1);
}

/// A device says itself how few realizations are better left to the host.
TEST(DeviceRuns, ADeviceDecidesWhatIsLeftToTheHost)
{
    class Choosy : public ForwardingDevice {
    public:
        explicit Choosy(FewRealizations few) : few_(few) {}
        FewRealizations few_a_thread(const SlotMemory& memory) const override
        {
            EXPECT_EQ(memory.topology.blocks, 7);
            EXPECT_TRUE(memory.topology.stack);
            EXPECT_FALSE(memory.in_single);
            return few_;
        }

    private:
        const FewRealizations few_;
    };
    const Study study = surface(2);
    const auto launches = [&](FewRealizations few, std::optional<int> given) {
        const auto device = std::make_shared<Choosy>(few);
        RunOptions options = on({device}, 2, 4);
        options.few = given;
        EXPECT_EQ(run(study, options).outcomes.size(), study.total());
        return device->launches();
    };
    EXPECT_EQ(launches({6, 0}, {}), 0) << "12 realizations for two threads";
    const int all = launches({5, 0}, {}), some = launches({5, 2}, {});
    EXPECT_GT(some, 0);
    EXPECT_LT(some, all) << "the last four end on the host";
    EXPECT_EQ(launches({6, 0}, 0), all) << "options come first";
    EXPECT_EQ(launches({0, 0}, 6), 0);
    EXPECT_EQ(ForwardingDevice().few_a_thread({}).run, 64);
}

/// Between launches the host makes what is to begin; most of it is to be there before.
TEST(DeviceRuns, RealizationsAreMadeWhileTheDeviceSteps)
{
    class Clocked : public ForwardingDevice {
    public:
        void advance(const SlotMemory& memory, int chunks, int count) override
        {
            ForwardingDevice::advance(memory, chunks, count);
            steps = true; // (a queue returns at once)
        }
        void download(void* to, const void* from, std::size_t bytes) override
        {
            steps = false; // it waits for the launch
            ForwardingDevice::download(to, from, bytes);
        }
        std::atomic<bool> steps = false;
    };
    constexpr int slots = 24;
    const Study study = surface(20);
    const Sampler sampler(study, nullptr);
    const auto device = std::make_shared<Clocked>();
    const RunOptions options = on({device}, 2, slots);
    std::atomic<int> made = 0, ahead = 0, ended = 0, most = 0;
    const Told told = run(study, options, [&](RunPlan& plan) {
        plan.realize = [&](std::uint64_t index) {
            ++made;
            ahead += device->steps;
            most = std::max<int>(most, made - ended);
            return sampler.realization(index);
        };
        plan.sink = [&ended, sink = plan.sink](const Realization& realization, const Outcome& outcome) {
            ++ended;
            sink(realization, outcome);
        };
    });
    EXPECT_EQ(told.outcomes, run_all(study, {best_isa(), 2}).outcomes);
    EXPECT_GT(ahead, (static_cast<int>(study.total()) - slots) / 2) << made << " were made in all";
    EXPECT_LE(most, slots + slots / SlotSet::slots_a_prepared + 1) << "(one is the pattern)";
}

/// Whatever a device fails at: nothing is lost, nothing comes twice, and the user hears of it once.
TEST(DeviceRuns, WhatAFailingDeviceHadBegunIsRunAnew)
{
    const Study study = surface(4);
    const EnsembleRun want = run_all(study, {best_isa(), 2});
    for (const int call : {1, 12, 20, 41, 60, 97})
        for (const bool both : {true, false}) {
            std::vector<std::shared_ptr<Device>> devices{std::make_shared<FailingDevice>(call)};
            if (both) // another queue of the same device
                devices.push_back(std::make_shared<FailingDevice>(call + 5));
            else
                devices.push_back(std::make_shared<ForwardingDevice>());
            RunOptions options = on(devices, 2, 5);
            options.longest_first = 8;
            options.longest_on_host = 1;
            const Told told = run(study, options);
            EXPECT_EQ(told.outcomes, want.outcomes) << "call " << call << " failed";
            EXPECT_EQ(told.progress.done, study.total());
            EXPECT_EQ(told.progress.block_steps, want.progress.block_steps);
            ASSERT_EQ(told.warnings.size(), 1U) << "call " << call;
            EXPECT_NE(told.warnings[0].find("device X"), std::string::npos) << told.warnings[0];
            EXPECT_NE(told.warnings[0].find("fell off the bus"), std::string::npos) << told.warnings[0];
            EXPECT_TRUE(devices[0]->failed());
            if (both)
                continue;
            const Told again = run(study, options); // another round of the same run
            EXPECT_EQ(again.outcomes, want.outcomes);
            EXPECT_TRUE(again.warnings.empty());
        }
}

/// What waits on the host for contacts that yield, too.
TEST(DeviceRuns, AFailureLosesNothingThatIsHandedOver)
{
    const Study study = rigid_of(read_study(
        std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/small_scale_colonnade_drums.toml",
        {"study.realizations=3", "excitation.cycles=4", "surface.frequency_hz={ from = 2.5, to = 3.0, count = 2 }",
         "surface.pga_m_s2={ from = 9.0, to = 15.0, count = 2 }"}));
    const EnsembleRun want = run_all(study, {best_isa(), 2});
    for (const int call : {24, 32, 40}) {
        RunOptions options = on({std::make_shared<FailingDevice>(call)}, 2, 12);
        options.isa = best_isa(); // what is handed over waits until it fills a register
        const Told told = run(study, options);
        EXPECT_EQ(told.outcomes, want.outcomes) << "call " << call << " failed";
        EXPECT_EQ(told.warnings.size(), 1U);
    }
}

/// Of other processes' places, those that the device had begun stay with this one.
TEST(DeviceRuns, AFailureLosesNothingThatOtherProcessesGave)
{
    const Study study = surface(3);
    std::uint64_t next = 0;
    std::mutex mutex;
    const Told told = run(study, on({std::make_shared<FailingDevice>(60)}, 2, 5), [&](RunPlan& plan) {
        plan.next_place = [&]() -> std::optional<std::uint64_t> {
            const std::lock_guard lock(mutex);
            return next < study.total() ? std::optional(next++) : std::nullopt;
        };
    });
    EXPECT_EQ(told.outcomes, run_all(study, {best_isa(), 2}).outcomes);
    EXPECT_EQ(told.warnings.size(), 1U);
}

/// What fails on the host is no failure of a device: it ends the run with its message.
/// Where a device has a slower way and a faster one, the user hears of the slower one once, not from every queue.
TEST(DeviceRuns, ASlowerWayIsSaidOnce)
{
    class Slow : public ForwardingDevice {
        std::string why_slow(const SlotMemory& memory) const override { return why_no_lanes(memory); }
    };
    const Study study = rigid_of(surface(1));
    const RunOptions options = on({std::make_shared<Slow>(), std::make_shared<Slow>()}, 2, 3);
    const Told told = run(study, options);
    EXPECT_TRUE(run(study, options).warnings.empty()) << "said again in the next round";
    ASSERT_EQ(told.warnings.size(), 1U);
    EXPECT_NE(told.warnings.front().find("leave --backend cuda out"), std::string::npos);
    EXPECT_EQ(told.outcomes.size(), study.total());
}

TEST(DeviceRuns, AFailureOfTheSinkEndsTheRun)
{
    const Study study = surface(3);
    RunOptions options = on({std::make_shared<ForwardingDevice>()}, 2, 5);
    options.longest_first = 6;
    options.longest_on_host = 1;
    Told told;
    RunPlan plan = plan_of(study, told);
    plan.sink = [](const Realization&, const Outcome&) { throw std::runtime_error("the disk is full"); };
    Watcher watcher(told);
    try {
        run_ensemble(Experiment(study), options, plan, watcher);
        FAIL() << "the failure was swallowed";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "the disk is full");
    }
    EXPECT_TRUE(told.warnings.empty());
}

} // namespace stylobate

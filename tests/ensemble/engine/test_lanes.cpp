/// Structures with a lane of a warp for every bed: every number of every column has the bits of the step by threads,
/// for all numbers of blocks, and so has every outcome. The warps are emulated in lockstep (`warp_device.hpp`);
/// `test_ptx_columns` runs the device's own code.

#include "tests/ensemble/engine/lanes/both_ways.hpp"
#include "tests/ensemble/engine/rigid_study.hpp"
#include "tests/ensemble/engine/slot_studies.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace stylobate;

class LanesOfBlocks : public testing::TestWithParam<int> {};

TEST_P(LanesOfBlocks, HaveTheBitsOfThreads)
{
    const auto device = same_in_lanes(of_blocks(GetParam(), {"study.realizations=2"}));
    EXPECT_GT(device->asked, 10) << "nothing ended";
}

INSTANTIATE_TEST_SUITE_P(Blocks, LanesOfBlocks, testing::Values(1, 2, 4, 6, most_lane_blocks));
INSTANTIATE_TEST_SUITE_P(Long, LanesOfBlocks, testing::Values(3, 5, 7, 8, 9, 10, 11));

TEST(Lanes, PulsesHaveTheBitsOfThreads)
{
    for (const ExcitationKind kind : {ExcitationKind::half_sine, ExcitationKind::full_sine, ExcitationKind::ricker}) {
        Study study = column({"study.realizations=2"});
        study.excitation.kind = kind;
        same_in_lanes(study);
    }
}

/// Along samples that the device has, and along tables that the host makes.
TEST(Lanes, RecordsHaveTheBitsOfThreads)
{
    same_in_lanes(along_chirp({"study.realizations=2"}), {.record = chirp()});
    same_in_lanes(read_study(inputs + "synthetic_earthquake.toml",
                             {"study.realizations=2", "excitation.rise_s=0.5", "excitation.strong_s=1",
                              "excitation.decay_s=0.3", "surface.frequency_hz={ from = 1.0, to = 3.0, count = 2 }",
                              "surface.pga_m_s2={ from = 4.0, to = 12.0, count = 2 }"}));
}

TEST(Lanes, AFragilityStudyHasTheBitsOfThreads)
{
    const Study study = under_pulses();
    same_in_lanes(study, pulses_of(study));
}

TEST(Lanes, ABrokenRealizationIsSetAside)
{
    broken_are_set_aside();
}

/// All ready studies that lanes serve, columns and colonnades from a small model to a monument: their first thousands
/// of steps. (Whole outcomes: `LanesLong`, and `scripts/gpu.sh` on a device.)
TEST(Lanes, ReadyStudiesHaveTheBitsOfThreads)
{
    int served = 0;
    for (const auto& entry : std::filesystem::directory_iterator(inputs))
        served += entry.path().extension() == ".toml" && begin_in_lanes(entry.path().filename().string(), 6) != nullptr;
    EXPECT_GE(served, 15);
}

/// A few realizations of each, to their end.
TEST(LanesLong, ReadyStudiesHaveTheOutcomesOfTheProcessor)
{
    for (const auto& entry : std::filesystem::directory_iterator(inputs)) {
        const std::string file = entry.path().filename().string();
        if (entry.path().extension() != ".toml" || begin_in_lanes(file, 1) == nullptr)
            continue;
        const LoadedStudy loaded = LoadedStudy::from_file(inputs + file, {});
        const std::uint64_t total = loaded.study().total();
        std::vector<std::uint64_t> indices;
        for (std::uint64_t i = 0; i < 7; ++i)
            indices.push_back(i * (total - 1) / 6);
        const auto outcomes = [&](RunOptions options) {
            std::map<std::uint64_t, Bits> found;
            RunPlan plan;
            plan.total = indices.size();
            plan.indices = indices;
            plan.sink = [&](const Realization& r, const Outcome& o) { found[r.index] = outcome_bits(o); };
            options.few = 0;
            options.longest_on_host = 0;
            Observer observer;
            run_ensemble(loaded.experiment(), options, plan, observer);
            return found;
        };
        RunOptions by_lanes{Isa::scalar, 2};
        by_lanes.devices = {std::make_shared<WarpDevice>()};
        EXPECT_EQ(outcomes(by_lanes), outcomes({best_isa(), 2})) << file;
    }
}

/// Columns under epistyles, whose pieces meet where they have no bed, and whose groups leave lanes empty or do not.
class LanesOfColonnades : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(LanesOfColonnades, HaveTheBitsOfThreads)
{
    const auto [columns, drums] = GetParam();
    const auto device = same_in_lanes(colonnade_of(columns, drums, {"study.realizations=1"}));
    EXPECT_GT(device->asked, 4) << "nothing ended";
}

INSTANTIATE_TEST_SUITE_P(Columns, LanesOfColonnades, testing::Values(std::pair{2, 1}, std::pair{2, 2}));
INSTANTIATE_TEST_SUITE_P(Long, LanesOfColonnades,
                         testing::Values(std::pair{3, 1}, std::pair{2, 3}, std::pair{3, 3}, std::pair{4, 4}));

/// Two columns of one drum under an epistyle, on a fixed block 0: the epistyle, block 3, lies on beds 2 and 3.
TEST(LaneList, OfTwoColumnsUnderAnEpistyle)
{
    const std::vector<TopologyJoint> joints{{0, 1}, {0, 2}, {1, 3}, {2, 3}};
    Topology t{.blocks = 4, .fixed = 1, .top = 3, .joints = 4, .joint = joints.data()};
    std::vector<int> lists(static_cast<std::size_t>(bed_lists_size(t))), owner(4);
    list_beds(t, lists.data());
    std::vector<LaneBed> lane(4);
    ASSERT_TRUE(list_lanes(t, lane.data(), owner.data()));
    EXPECT_EQ(owner, (std::vector{-1, 0, 1, 2}));
    const auto same = [&](int j, int block, int lower, std::uint32_t beds) {
        const LaneBed& l = lane[static_cast<std::size_t>(j)];
        return l.block == block && l.lower == lower && l.beds == beds;
    };
    EXPECT_TRUE(same(0, 1, -1, 0xFFFF0500U)) << "it lies on bed 0 and carries bed 2";
    EXPECT_TRUE(same(1, 2, -1, 0xFFFF0702U));
    EXPECT_TRUE(same(2, 3, 0, 0xFFFF0604U));
    EXPECT_TRUE(same(3, 3, 1, 0xFFFF0604U)) << "a copy of the epistyle";
}

TEST(LaneList, RefusesWhatLanesCannotHold)
{
    const auto fits = [](int blocks, const std::vector<TopologyJoint>& joints) {
        Topology t{.blocks = blocks, .fixed = 1, .joints = static_cast<int>(joints.size()), .joint = joints.data()};
        std::vector<int> lists(static_cast<std::size_t>(bed_lists_size(t))), owner(static_cast<std::size_t>(blocks));
        list_beds(t, lists.data());
        std::vector<LaneBed> lane(joints.size());
        return list_lanes(t, lane.data(), owner.data());
    };
    EXPECT_TRUE(fits(5, {{0, 1}, {1, 2}, {1, 3}, {1, 4}})) << "four beds of block 1";
    EXPECT_FALSE(fits(6, {{0, 1}, {1, 2}, {1, 3}, {1, 4}, {1, 5}})) << "five";
    EXPECT_FALSE(fits(3, {{0, 1}})) << "block 2 has no bed";
    EXPECT_FALSE(fits(3, {{0, 2}, {2, 1}})) << "the beds are not in the order of the blocks";
    std::vector<TopologyJoint> stack;
    for (int j = 0; j < most_lane_beds; ++j)
        stack.push_back({j, j + 1});
    EXPECT_TRUE(fits(most_lane_beds + 1, stack));
    stack.push_back({most_lane_beds, most_lane_beds + 1});
    EXPECT_FALSE(fits(most_lane_beds + 2, stack));
}

TEST(Lanes, MoreBlocksThanAStackHasLanesForHaveTheBitsOfThreads)
{
    same_in_lanes(of_blocks(most_lane_blocks + 1,
                            {"study.realizations=1", "surface.frequency_hz={ from = 3.0, to = 3.0, count = 1 }"}));
}

TEST(Lanes, AColumnFollowedToItsRestHasTheBitsOfThreads)
{
    for (const int free : {1, 6})
        same_in_lanes(of_blocks(free, {"study.realizations=1", "outcome.follow=\"rest\""}));
}

/// What lanes do not serve is stepped by threads.
TEST(Lanes, LeaveTheRestToThreads)
{
    Study single = column({"study.realizations=1"});
    single.run.precision = Precision::single;
    const std::vector<Study> others{single, rigid_of(column({"study.realizations=1"})),
                                    column({"study.realizations=1", "contact.form=\"two_corner\""}),
                                    column({"study.realizations=1", "mechanisms.drag={ coefficient_n_s2_m2 = 0.05 }"}),
                                    of_blocks(most_lane_beds + 1, {"study.realizations=1"})};
    for (const Study& study : others) {
        const auto device = std::make_shared<WarpDevice>();
        RunOptions options{Isa::scalar, 2};
        options.devices = {device};
        options.few = 0;
        options.longest_on_host = 0;
        EXPECT_EQ(run_all(study, options).outcomes, run_all(study, {best_isa(), 2}).outcomes);
        EXPECT_EQ(device->by_lanes(), 0);
        EXPECT_GT(device->by_threads(), 0);
    }
}

/// The device's own lanes and threads, on a run that is small enough to look for hazards of its memory in.
TEST(Cuda, LanesHaveTheBitsOfThreads)
{
    const CudaDevices found = cuda_devices();
    if (found.names.empty())
        GTEST_SKIP() << "not run: " << found.reason;
    for (const int free : {1, 6, most_lane_blocks}) {
        const Study study = of_blocks(free, {"study.realizations=2"});
        RunOptions options{best_isa(), 2};
        options.few = 0;
        options.longest_on_host = 0;
        const auto on = [&](DeviceStep step) {
            options.devices = open_cuda_devices(0, 1, step);
            return run_all(study, options).outcomes;
        };
        const auto by_lanes = on(DeviceStep::by_lanes);
        EXPECT_EQ(by_lanes, on(DeviceStep::by_threads));
        EXPECT_EQ(by_lanes, run_all(study, {best_isa(), 2}).outcomes);
    }
}

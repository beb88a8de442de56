/// The slots of a device, on the device that is the processor and on the devices of CUDA, where there are any: outcomes
/// have the bits of the processor's own lanes, with any number of slots, however they are refilled, and whatever the
/// realizations are. (`test_lanes`: the same with a lane of a warp for every bed.)

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/device/host_device.hpp"
#include "ensemble/planar/device/slot_column.hpp"
#include "ensemble/planar/device/slots.hpp"
#include "io/study/study_file.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"
#include "tests/ensemble/engine/forwarding_device.hpp"
#include "tests/ensemble/engine/rigid_study.hpp"
#include "tests/ensemble/engine/slot_studies.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

using namespace stylobate;

namespace {

RunOptions on_devices(int devices, int slots)
{
    RunOptions options{Isa::scalar, 2};
    for (int i = 0; i < devices; ++i)
        options.devices.push_back(host_device());
    options.slots = slots;
    options.few = 0; // nothing is left to the processor
    options.longest_on_host = 0;
    return options;
}

/// Compares lanes and slots; what the lanes gave.
EnsembleRun same_in_slots(const Study& study, const Motions& motions = {})
{
    const EnsembleRun want = run_all(study, {best_isa(), 2}, motions);
    EXPECT_EQ(want.outcomes.size(), study.total());
    std::vector<RunOptions> all{on_devices(1, 5), on_devices(2, 0)};
    if (!cuda_devices().names.empty())
        for (const int slots : {5, 0}) {
            all.push_back(on_devices(0, slots));
            all.back().devices = open_cuda_devices();
        }
    for (const RunOptions& options : all) {
        const EnsembleRun got = run_all(study, options, motions);
        EXPECT_EQ(got.outcomes, want.outcomes) << options.devices.size() << " queues, the first of "
                                               << options.devices.front()->name() << ", " << options.slots << " slots";
        EXPECT_EQ(got.progress.done, study.total());
        EXPECT_EQ(got.progress.collapsed, want.progress.collapsed);
        EXPECT_EQ(got.progress.block_steps, want.progress.block_steps);
    }
    return want;
}

} // namespace

TEST(Slots, ASurfaceOfAColumnHasTheBitsOfTheLanes)
{
    const EnsembleRun result = same_in_slots(column({}));
    EXPECT_GE(result.states.size(), 3U) << "the mix is not what it should be";
    EXPECT_GT(result.states.at(State::collapsed), 0);
}

/// With watched pairs; collapses are followed until everything lies still, and epistyles lose their seats.
TEST(Slots, AColonnadeThatFallsHasTheBitsOfTheLanes)
{
    const EnsembleRun result = same_in_slots(colonnade({}));
    EXPECT_GT(result.states.at(State::collapsed), 3) << "the mix is not what it should be";
    EXPECT_GT(static_cast<int>(result.outcomes.size()), result.states.at(State::collapsed));
}

TEST(Slots, PulsesHaveTheBitsOfTheLanes)
{
    for (const ExcitationKind kind : {ExcitationKind::half_sine, ExcitationKind::full_sine, ExcitationKind::ricker}) {
        Study study = column({"study.realizations=2"});
        study.excitation.kind = kind;
        same_in_slots(study);
    }
}

/// Every realization has a motion of its own, which the host samples.
TEST(Slots, NoiseHasTheBitsOfTheLanes)
{
    same_in_slots(read_study(inputs + "synthetic_earthquake.toml",
                             {"study.realizations=3", "excitation.rise_s=0.5", "excitation.strong_s=1",
                              "excitation.decay_s=0.3", "surface.frequency_hz={ from = 1.0, to = 3.0, count = 2 }",
                              "surface.pga_m_s2={ from = 4.0, to = 12.0, count = 2 }"}));
}

/// A shared record, stretched and scaled from cell to cell: the device goes along its samples.
TEST(Slots, ARecordHasTheBitsOfTheLanes)
{
    EXPECT_GT(same_in_slots(along_chirp({}), {.record = chirp()}).states.at(State::collapsed), 0);
    same_in_slots(rigid_of(along_chirp({"study.realizations=1"})), {.record = chirp()});
}

/// Where realizations go along a record otherwise, or where it moves the base vertically too, the host makes the
/// tables.
TEST(Slots, AChangedRecordHasTheBitsOfTheLanes)
{
    for (const char* mechanism :
         {"mechanisms.time_offset={ offset_s = 0.013 }", "mechanisms.sensor_gain={ gain = 1.1 }",
          "mechanisms.harmonic_distortion={ second = 0.05 }", "mechanisms.vertical_motion={ ratio = 0.3 }"})
        same_in_slots(along_chirp({"study.realizations=1", mechanism}), {.record = chirp()});
}

/// Many motions, each at several strengths.
TEST(Slots, AFragilityStudyHasTheBitsOfTheLanes)
{
    const Study study = under_pulses();
    EXPECT_GE(same_in_slots(study, pulses_of(study)).states.size(), 2U);
}

/// Samples go up once for each device, however long the realizations are and however many there are.
TEST(Slots, SamplesStayOnTheDevice)
{
    const auto uploaded = [](const Study& study, const Motions& motions) {
        const auto device = std::make_shared<test::ForwardingDevice>();
        RunOptions options = on_devices(0, 0);
        options.devices.push_back(device);
        run_all(study, options, motions);
        return std::pair{device->uploaded(), device->launches()};
    };
    const Motions motions{.record = chirp()};
    const auto [plain, launches] = uploaded(column({}), {});
    const auto [record, more_launches] = uploaded(along_chirp({}), motions);
    EXPECT_GT(launches, 100);
    EXPECT_GT(more_launches, 100);
    const auto tables = static_cast<std::size_t>(more_launches) * SlotSet::chunks_per_launch * chunk_steps * 8;
    EXPECT_LT(record, plain + 200 * 8 + tables / 4) << "a table for each launch is more";
    EXPECT_GT(uploaded(along_chirp({"mechanisms.time_offset={ offset_s = 0.013 }"}), motions).first,
              plain + tables / 2);
}

/// Every form, and mechanisms that act in the joints, on the blocks and through the base.
const std::vector<std::string> mechanisms{"mechanisms.stribeck={ dynamic_friction = 0.5, velocity_m_s = 0.05 }",
                                          "mechanisms.eccentricity={ offset_m = 0.001 }",
                                          "mechanisms.drag={ coefficient_n_s2_m2 = 0.05 }",
                                          "mechanisms.tie={ stiffness_n_m = 20, dashpot_n_s_m = 0.2, force_n = 0.01 }",
                                          "mechanisms.corner_wear={ loss_m_rad = 0.001 }",
                                          "mechanisms.dowel={ stiffness_n_m = 1e5, yield_n = 2, gap_m = 0.0002 }",
                                          "mechanisms.adhesion={ force_n_m = 5 }",
                                          "mechanisms.rod={ block = 4, to_right_n_m = 500, to_left_n_m = 200, height_m "
                                          "= 0.01, speed_m_s = 0.01, start_s = 0.1, travel_m = 0.005 }",
                                          "mechanisms.table_tilt={ angle_rad = 0.01, rate_rad_s = 0.02 }",
                                          "mechanisms.table_pitch={ rotation_rad_s2_m = 0.002 }",
                                          "mechanisms.vertical_motion={ ratio = 0.3 }"};

/// By contact form, so that no test is long.
class SlotsOfForm : public testing::TestWithParam<const char*> {
protected:
    std::vector<std::string> settings{"study.realizations=2", std::string("contact.form=\"") + GetParam() + "\"",
                                      "surface.frequency_hz={ from = 1.5, to = 3.0, count = 2 }",
                                      "surface.pga_m_s2={ from = 2.0, to = 9.0, count = 2 }"};
};

TEST_P(SlotsOfForm, HaveTheBitsOfTheLanes)
{
    same_in_slots(read_study(inputs + "small_scale_column.toml", settings));
}

TEST_P(SlotsOfForm, TheExtendedModelHasTheBitsOfTheLanes)
{
    settings.insert(settings.end(), mechanisms.begin(), mechanisms.end());
    same_in_slots(read_study(inputs + "small_scale_column.toml", settings));
}

INSTANTIATE_TEST_SUITE_P(Forms, SlotsOfForm, testing::Values("area", "two_corner", "points"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(Slots, RigidBlocksHaveTheBitsOfTheLanes)
{
    EXPECT_GT(same_in_slots(rigid_of(column({}))).states.at(State::collapsed), 0);
    EXPECT_GT(same_in_slots(rigid_of(colonnade({}))).states.at(State::collapsed), 0);
}

/// What is stepped in single precision is refilled, moved and checked like the rest.
TEST(Slots, SinglePrecisionHasTheBitsOfTheLanesLong)
{
    const auto in_single = [](Study study) {
        study.run.precision = Precision::single;
        return study;
    };
    EXPECT_GT(same_in_slots(in_single(column({}))).states.at(State::collapsed), 0);
    EXPECT_GT(same_in_slots(in_single(rigid_of(column({})))).states.at(State::collapsed), 0);
    EXPECT_GT(same_in_slots(in_single(colonnade({}))).states.at(State::collapsed), 0);
    same_in_slots(in_single(rigid_of(colonnade({"study.realizations=1"}))));
    same_in_slots(in_single(along_chirp({"study.realizations=1"})), {.record = chirp()});
}

TEST(Slots, TheExtendedModelOfAColonnadeHasTheBitsOfTheLanes)
{
    std::vector<std::string> settings = mechanisms;
    settings.push_back("study.realizations=1");
    same_in_slots(colonnade(settings));
}

/// What strengthens a structure has rows and a list of blocks of its own.
TEST(Slots, StrengtheningHasTheBitsOfTheLanes)
{
    const std::string dowels = "mechanisms.pull_out={ joint = 4, hold_n = 0.5, stiffness_n_m = 1e5, length_m = 0.001, "
                               "spread_m = 0.01 }";
    same_in_slots(
        column({"study.realizations=1", "mechanisms.tendon={ stiffness_n_m = 1e4, prestress_n = 3 }",
                "mechanisms.bearing={ stiffness_n_m = 200, dashpot_n_s_m = 2, curvature_per_m = 1 }",
                "mechanisms.mortar={ joints = [2, 3], tensile_strength_pa = 2e3, cohesion_pa = 1e3 }", dowels}));
    same_in_slots(colonnade({"study.realizations=1",
                             "mechanisms.clamp={ block = 1, stiffness_n_m = 1e4, strength_n = 5, height_m = 0.01 }",
                             "mechanisms.tendon={ stiffness_n_m = 1e4, prestress_n = 3 }"}));
}

/// A slot that breaks is set aside for the reason that a lane is, and its neighbours keep their bits.
TEST(Slots, ABrokenRealizationIsSetAside)
{
    const Study study = column({});
    const Sampler sampler(study, nullptr);
    const EnsembleRun want = run_all(study, {Isa::scalar, 1});
    const auto device = host_device();
    SlotSet set(study, nullptr, sampler.realization(0), *device, 5, 5);
    Realization broken = sampler.realization(3), nothing = sampler.realization(4);
    broken.step_s *= 4;
    nothing.pga_m_s2 = std::numeric_limits<double>::quiet_NaN();
    set.load(0, broken);
    set.load(1, nothing);
    for (int slot = 2; slot < 5; ++slot)
        set.load(slot, sampler.realization(static_cast<std::uint64_t>(8 + slot)));
    LaneSet lane(study, nullptr, kernels(Isa::scalar), broken);
    lane.load(0, broken);
    while (!lane.outcome(0))
        lane.advance();
    std::map<std::uint64_t, Outcome> ends;
    while (set.active() > 0) {
        set.advance();
        for (int slot = 0; slot < set.lanes(); ++slot) {
            if (set.free(slot) || !set.done(slot))
                continue;
            ends[set.realization(slot).index] = *set.outcome(slot);
            set.clear(slot);
        }
    }
    ASSERT_EQ(ends.size(), 5U);
    EXPECT_EQ(outcome_bits(ends.at(3)), outcome_bits(*lane.outcome(0)));
    EXPECT_EQ(ends.at(3).state, State::invalid);
    EXPECT_EQ(ends.at(4).state, State::invalid);
    EXPECT_EQ(ends.at(4).invalid_reason, InvalidReason::not_finite);
    for (std::uint64_t index = 10; index < 13; ++index)
        EXPECT_EQ(outcome_bits(ends.at(index)), want.outcomes.at(index));
}

/// Once slots stay empty the others move together, again and again, and go on with the same bits.
TEST(Slots, GapsAreClosed)
{
    const Study study = column({"study.realizations=6"});
    const Sampler sampler(study, nullptr);
    const EnsembleRun want = run_all(study, {best_isa(), 2});
    const auto device = host_device();
    const int slots = static_cast<int>(study.total());
    SlotSet set(study, nullptr, sampler.realization(0), *device, slots, slots);
    for (int slot = 0; slot < slots; ++slot)
        set.load(slot, sampler.realization(static_cast<std::uint64_t>(slot)));
    int moved = 0, least = slots;
    std::map<std::uint64_t, Bits> got;
    while (set.active() > 0) {
        const int busy = set.active();
        set.advance();
        EXPECT_LE(set.used(), slots);
        EXPECT_GE(set.used(), busy);
        EXPECT_LT(set.used(), std::max(2 * busy, 2)) << "fewer than half of the slots that are gone through work";
        moved += set.used() < least;
        least = std::min(least, set.used());
        for (int slot = 0; slot < set.lanes(); ++slot) {
            if (set.free(slot) || !set.done(slot))
                continue;
            got[set.realization(slot).index] = outcome_bits(*set.outcome(slot));
            set.clear(slot);
        }
    }
    EXPECT_GT(moved, 2);
    EXPECT_EQ(got, want.outcomes);
}

/// A device does little, the processor ends what it has begun.
TEST(Slots, TheProcessorEndsTheLastOnes)
{
    const auto launches = [](const Study& study, int few, const Motions& motions) {
        const auto device = std::make_shared<test::ForwardingDevice>();
        RunOptions options = on_devices(0, 5);
        options.devices.push_back(device);
        options.few = few;
        const EnsembleRun want = run_all(study, {best_isa(), 2}, motions);
        EXPECT_EQ(run_all(study, options, motions).outcomes, want.outcomes) << few << " for each thread";
        return device->launches();
    };
    const auto same = [&](const Study& study, const Motions& motions = {}) {
        EXPECT_GT(launches(study, 5, motions), 10); // the last two of ten
    };
    same(column({}));
    same(colonnade({}));
    same(rigid_of(column({})));
    same(rigid_of(colonnade({})));
    same(along_chirp({}), {.record = chirp()});
    same(along_chirp({"mechanisms.vertical_motion={ ratio = 0.3 }"}), {.record = chirp()});

    const int all = launches(column({}), 0, {}), some = launches(column({}), 10, {});
    EXPECT_LT(some, all) << "nothing was left to the processor";
    EXPECT_EQ(launches(column({}), 1000, {}), 0) << "so few are not for a device";
}

/// What goes up comes back, bit by bit, and another lane goes on with it.
TEST(Slots, AColumnHoldsALane)
{
    const Study study = column({});
    const Sampler sampler(study, nullptr);
    LaneSet a(study, nullptr, kernels(Isa::scalar), sampler.realization(0)),
        b(study, nullptr, kernels(Isa::scalar), sampler.realization(0));
    a.load(0, sampler.realization(7));
    for (int chunk = 0; chunk < 20; ++chunk)
        a.advance();
    std::vector<double> column(column_rows(a.model().topology())), again(column.size());
    write_column(a, column.data());
    b.load(0, sampler.realization(7));
    read_column(b, column.data());
    write_column(b, again.data());
    for (std::size_t i = 0; i < column.size(); ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(column[i]), std::bit_cast<std::uint64_t>(again[i])) << "row " << i;
    EXPECT_EQ(b.steps(0), 20U * chunk_steps);
}

/// As many realizations as fill a device's blocks of threads, some of which end, move together and go on; all tests
/// above compare the same devices with few.
TEST(Cuda, OutcomesHaveTheBitsOfTheProcessor)
{
    const CudaDevices found = cuda_devices();
    if (found.names.empty())
        GTEST_SKIP() << "not run: " << found.reason;
    RunOptions options{best_isa(), 2};
    options.devices = open_cuda_devices();
    options.few = 20;
    const std::string many = "study.realizations=100";
    for (const Study& study : {column({many}), rigid_of(column({many})), rigid_of(colonnade({many}))})
        EXPECT_EQ(run_all(study, options).outcomes, run_all(study, {best_isa(), 2}).outcomes);
}

TEST(Cuda, WhereThereIsNoDeviceItIsSaid)
{
    const CudaDevices found = cuda_devices();
    if (!found.names.empty())
        GTEST_SKIP() << "not run: there is a device";
    EXPECT_FALSE(found.reason.empty());
    try {
        open_cuda_devices();
        FAIL() << "a device was opened that is not there";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(found.reason), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("--backend cuda"), std::string::npos);
    }
}

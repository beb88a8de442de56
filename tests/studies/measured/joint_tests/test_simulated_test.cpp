/// Tests of single joints, simulated: each gives what its closed form says of the specimen that it was done on.

#include "ensemble/model/input_error.hpp"
#include "studies/measured/joint_tests/estimates.hpp"
#include "studies/measured/joint_tests/joint_bench.hpp"
#include "studies/measured/joint_tests/procedures.hpp"
#include "studies/measured/joint_tests/simulated_test.hpp"
#include "tests/studies/measured/small_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace stylobate;

namespace {

constexpr double g = 9.81, b = 0.024, h = 0.0145, mass = 0.1355, mu = 0.65;

Specimen four_blocks()
{
    return small_blocks(4, mu, mass, 0.1);
}

Study contacts()
{
    Study study;
    study.contact.normal_stiffness_n_m2 = 1e8;
    study.contact.tangential_stiffness_n_m = 5e6;
    study.contact.friction = mu;
    return study;
}

constexpr int joint = 2, upper = 2;

MeasuredRun planned(RunKind kind, const char* name, double time_s)
{
    MeasuredRun run;
    run.name = name;
    run.test = kind;
    run.joint = joint;
    run.present = {0, 1, 2};
    run.clamped = {0, 1};
    run.rate_hz = 500;
    for (int i = 0; i <= time_s * 500; ++i)
        run.time_s.push_back(i / 500.0);
    return run;
}

void tape_dummies(MeasuredRun& run)
{
    for (const int k : {1, 2})
        run.dummies.push_back({upper, mass, b, h, 0, 2 * k * h});
}

/// The table goes to and fro at 16 mm/s below a block that a rod holds.
MeasuredRun pull()
{
    MeasuredRun run = planned(RunKind::pull, "pull", 6);
    for (const double t : run.time_s)
        run.base_displacement_m.values.push_back(t < 0.5 ? 0 : 0.008 * (1 - std::cos(2 * (t - 0.5))));
    ForceGauge gauge;
    gauge.name = "rod";
    gauge.block = upper;
    gauge.height_m = 0.5 * h;
    gauge.stiffness_n_m = 2e4;
    run.forces.push_back(gauge);
    return run;
}

MeasuredRun push(double sign)
{
    MeasuredRun run = planned(RunKind::push, sign > 0 ? "push to the right" : "push to the left", 0.7);
    tape_dummies(run);
    ForceGauge gauge;
    gauge.name = "rod";
    gauge.block = upper;
    gauge.height_m = 0.9 * 6 * h;
    gauge.stiffness_n_m = 2e4;
    gauge.to_laboratory = false;
    gauge.speed_m_s = sign * 0.02;
    run.forces.push_back(gauge);
    return run;
}

/// @param sign counter-clockwise > 0
MeasuredRun board(RunKind kind, double sign)
{
    MeasuredRun run = planned(kind, sign > 0 ? "to the left" : "to the right", 8);
    for (const double t : run.time_s)
        run.base_tilt_rad.values.push_back(sign * 0.1 * std::max(0.0, t - 0.2 + std::min(0.0, t - 0.2)));
    if (kind == RunKind::tilt)
        tape_dummies(run);
    return run;
}

MeasuredRun drop()
{
    MeasuredRun run = planned(RunKind::drop, "drop", 1.2);
    tape_dummies(run);
    run.released_s = 0.2;
    const double held[] = {0.1001, 5 * h + 0.003, 2e-3};
    Series* const series[] = {&run.blocks.x_m, &run.blocks.y_m, &run.blocks.theta_rad};
    for (int k = 0; k < 3; ++k)
        for (const double t : run.time_s)
            for (int block = 0; block < 4; ++block)
                series[k]->values.push_back(block == upper && t <= 0.2 ? held[k]
                                                                       : std::numeric_limits<double>::quiet_NaN());
    return run;
}

/// @param laws so many healthy ones
std::vector<TestSubject> subjects(std::size_t laws, const std::vector<SizedCause>& causes = {})
{
    std::vector<TestSubject> all;
    for (std::uint64_t i = 0; i < laws; ++i)
        all.push_back({i, draw_law(LawFamily{}, 5, i), causes});
    return all;
}

std::vector<std::vector<MeasuredRun>> simulate(const std::vector<MeasuredRun>& runs, const std::vector<TestSubject>& on)
{
    Observer silent;
    const SimulatedTests tests = simulated_tests(four_blocks(), contacts(), runs, on, 7, RunOptions{}, silent);
    EXPECT_TRUE(tests.complete);
    return tests.runs;
}

/// The joint under test in the specimen of a subject.
Realization specimen_of(const TestSubject& subject)
{
    const Specimen s = four_blocks();
    return draw_specimen(s, contacts(), build_specimen(s), 7, subject.number, subject.law ? &*subject.law : nullptr,
                         subject.causes);
}

double x_of(const MeasuredRun& run, std::size_t i, std::size_t block)
{
    return run.blocks.x_m.values[i * 4 + block];
}
double theta_of(const MeasuredRun& run, std::size_t i)
{
    return run.blocks.theta_rad.values[i * 4 + upper];
}

double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Forces between two times.
std::vector<double> forces(const MeasuredRun& run, double from_s, double to_s)
{
    std::vector<double> all;
    for (std::size_t i = 0; i < run.time_s.size(); ++i)
        if (run.time_s[i] >= from_s && run.time_s[i] < to_s)
            all.push_back(run.forces[0].value_n.values[i]);
    return all;
}

std::size_t last_seen(const MeasuredRun& run)
{
    std::size_t i = run.time_s.size();
    while (i-- > 1 && std::isnan(x_of(run, i, upper)))
        ;
    return i;
}

/// Tilt at which the body has left its place: the last time before which it was seen there.
double tilt_when(const MeasuredRun& run, double most_m, double most_rad)
{
    for (std::size_t i = run.time_s.size(); i-- > 0;)
        if (std::fabs(x_of(run, i, upper) - 0.1) < most_m && std::fabs(theta_of(run, i)) < most_rad)
            return run.base_tilt_rad.values[i];
    return 0;
}

SizedCause at_block(const char* mechanism, int block, double size)
{
    Cause cause;
    cause.mechanism = mechanism;
    cause.block = block;
    return {cause, size};
}

SizedCause at_joint(const char* mechanism, int place, double size, double fixed)
{
    Cause cause;
    cause.mechanism = mechanism;
    cause.joint = place;
    cause.fixed = fixed;
    return {cause, size};
}

} // namespace

TEST(SimulatedTest, APullGivesTheFrictionOfItsJointUnderEveryHealthyLaw)
{
    const std::vector<TestSubject> on = subjects(12);
    const auto runs = simulate({pull()}, on);
    for (std::size_t s = 0; s < on.size(); ++s) {
        const Realization r = specimen_of(on[s]);
        const double friction = r.joints[joint].friction * r.blocks[upper].mass_kg * g;
        const MeasuredRun& run = runs[s][0];
        double sum = 0, count = 0; // while it slides it swings about the friction
        for (std::size_t i = 1; i + 1 < run.time_s.size(); ++i) {
            const std::vector<double>& base = run.base_displacement_m.values;
            if (std::fabs(base[i + 1] - base[i - 1]) > 0.004 * 0.01) {
                sum += run.forces[0].value_n.values[i] / (base[i + 1] > base[i - 1] ? -friction : friction);
                ++count;
            }
        }
        EXPECT_GT(count, 1000);
        // where next to nothing damps it the block sticks and slips on its rod, which takes 5 % off the mean
        EXPECT_NEAR(sum / count, on[s].law->kind == DampingKind::light ? 0.97 : 1, 0.03) << s;
        EXPECT_NEAR(median(forces(run, 0, 0.4)), 0, 0.01) << "it just touches";
        // those below move with the table, those above are away
        EXPECT_NEAR(x_of(run, 700, 1), 0.1 + run.base_displacement_m.values[700], 3e-4);
        EXPECT_TRUE(std::isnan(x_of(run, 700, 3)));
    }
}

TEST(SimulatedTest, APushGivesTheWeightTimesItsLeversOnBothSides)
{
    // F H = W (b - h theta) while it turns; what an elastic bed takes from b depends on the law and not on the side
    for (const double e : {0.0, 0.003}) {
        const std::vector<TestSubject> on = subjects(12, {at_block("eccentricity", upper, e)});
        const auto runs = simulate({push(1), push(-1)}, on);
        for (std::size_t s = 0; s < on.size(); ++s) {
            const Realization r = specimen_of(on[s]);
            const Block& block = r.blocks[upper];
            const double weight = (block.mass_kg + 2 * mass) * g;
            const double shift = e * block.mass_kg / (block.mass_kg + 2 * mass);
            const double bearing = block.half_width_m - r.joints[joint].mechanisms.chip_right_m;
            double levers[2] = {};
            for (const std::size_t side : {0u, 1u}) {
                const MeasuredRun& run = runs[s][side];
                double sum = 0, count = 0;
                for (std::size_t i = 150; i < 300; ++i) { // the end moves since 0.1 s, and to 0.7 s
                    sum += std::fabs(run.forces[0].value_n.values[i]) * 0.9 * 6 * h / weight +
                           3 * h * std::fabs(theta_of(run, i));
                    ++count;
                }
                levers[side] = sum / count;
            }
            EXPECT_NEAR((levers[0] + levers[1]) / 2 / bearing, 0.95, 0.06) << s;
            EXPECT_NEAR((levers[1] - levers[0]) / 2, shift, 5e-4) << s; // gains of 0.5 % of 24 mm
        }
    }
}

TEST(SimulatedTest, ABoardGivesTheAngleOfFrictionAndATiltTheAngleOfTurning)
{
    const std::vector<TestSubject> on = subjects(8);
    for (const double sign : {1.0, -1.0}) {
        const auto slides = simulate({board(RunKind::board, sign)}, on);
        const auto turns = simulate({board(RunKind::tilt, sign)}, on);
        for (std::size_t s = 0; s < on.size(); ++s) {
            const Realization r = specimen_of(on[s]);
            // it has gone 0.5 mm 0.15 s after it began to slide
            EXPECT_NEAR(std::tan(sign * tilt_when(slides[s][0], 5e-4, 1)), r.joints[joint].friction + 0.02, 0.015) << s;
            EXPECT_LT(sign * (x_of(slides[s][0], last_seen(slides[s][0]), upper) - 0.1), -0.01) << "to the left";
            const double bearing = r.blocks[upper].half_width_m - r.joints[joint].mechanisms.chip_left_m;
            EXPECT_NEAR(std::tan(sign * tilt_when(turns[s][0], 1, 0.01)), bearing / (3 * h), 0.05) << s;
        }
    }
}

TEST(SimulatedTest, ADropBeginsWhereItIsHeldAndEndsAtRest)
{
    const std::vector<TestSubject> on = subjects(12);
    const auto runs = simulate({drop()}, on);
    for (std::size_t s = 0; s < on.size(); ++s) {
        const MeasuredRun& run = runs[s][0];
        const auto y = [&](std::size_t i) { return run.blocks.y_m.values[i * 4 + upper]; };
        for (const std::size_t i : {std::size_t{0}, std::size_t{50}, std::size_t{100}}) {
            EXPECT_NEAR(x_of(run, i, upper), 0.1001, 3e-4);
            EXPECT_NEAR(y(i), 5 * h + 0.003, 3e-4);
            EXPECT_NEAR(theta_of(run, i), 2e-3, 7e-3) << "level to 1 mrad, seen to 1";
        }
        const double t = run.time_s[107] - 0.2; // 14 ms: it falls freely
        EXPECT_NEAR(y(107), 5 * h + 0.003 - 0.5 * g * t * t, 3e-4);
        EXPECT_NEAR(y(500), 5 * h, on[s].law->kind == DampingKind::light ? 2e-3 : 5e-4) << s; // 0.8 s later
        EXPECT_FALSE(*run.collapsed);
    }
}

TEST(SimulatedTest, NoHealthyLawGivesAFallEnergy)
{
    const std::vector<TestSubject> on = subjects(48);
    const auto runs = simulate(planned_runs(four_blocks(), {}, RunKind::drop, joint), on);
    int estimated = 0;
    for (std::size_t s = 0; s < on.size(); ++s)
        for (const Estimate& e : estimates(four_blocks(), runs[s]))
            if (e.name == "drop.bounce") {
                EXPECT_LT(e.value, std::log(2 / 3.0 + 0.01) + 0.1) << s << " " << to_string(on[s].law->kind);
                ++estimated;
            }
    EXPECT_GE(estimated, 46);
}

TEST(SimulatedTest, ABondHoldsUntilItTears)
{
    // (f + W / B) B2 / 6 is above the W b of a dry joint where f B is above 2 W
    const double weight = 3 * mass * g, held = weight * mu / (2 * b), tension = 5 * weight / (2 * b);
    const auto bonded = simulate({push(1)}, subjects(12, {at_joint("adhesion", joint, held, tension / held)}));
    const auto other = simulate({push(1)}, subjects(12, {at_joint("adhesion", joint - 1, held, tension / held)}));
    const auto dry = simulate({push(1)}, subjects(12));
    const auto most = [](const MeasuredRun& run) {
        std::vector<double> all = forces(run, 0.2, 0.7);
        return *std::max_element(all.begin(), all.end());
    };
    for (std::size_t s = 0; s < dry.size(); ++s) {
        EXPECT_GT(most(bonded[s][0]), 1.1 * most(dry[s][0])) << s;
        EXPECT_EQ(most(other[s][0]), most(dry[s][0])) << "a bond of another joint";
    }
}

TEST(SimulatedTest, DoesNotDependOnTheOtherSubjectsRunsThreadsAndInstructionSet)
{
    const std::vector<TestSubject> on = subjects(9);
    const std::vector<MeasuredRun> plan{push(1), drop()};
    const auto all = simulate(plan, on);
    Observer silent;
    RunOptions scalar;
    scalar.isa = Isa::scalar;
    scalar.threads = 1;
    for (const std::size_t s : {std::size_t{3}, std::size_t{8}}) {
        const std::vector<TestSubject> alone{on[s]};
        const SimulatedTests one = simulated_tests(four_blocks(), contacts(), {&plan[1], 1}, alone, 7, scalar, silent);
        const std::vector<double>&got = one.runs[0][0].blocks.x_m.values, &want = all[s][1].blocks.x_m.values;
        ASSERT_EQ(got.size(), want.size());
        for (std::size_t i = 0; i < got.size(); ++i)
            EXPECT_TRUE(got[i] == want[i] || (std::isnan(got[i]) && std::isnan(want[i]))) << i;
    }
}

TEST(SimulatedTest, RefusesWhatIsNoTestOfAJoint)
{
    MeasuredRun run = push(1);
    run.joint.reset();
    const std::vector<TestSubject> on = subjects(1);
    Observer silent;
    EXPECT_THROW(simulated_tests(four_blocks(), contacts(), {&run, 1}, on, 7, {}, silent), InputError);
    run = push(1);
    run.forces.push_back(run.forces[0]);
    EXPECT_THROW(simulated_tests(four_blocks(), contacts(), {&run, 1}, on, 7, {}, silent), InputError);
}

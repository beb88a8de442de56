/// Tests on single joints in the virtual laboratory against statics and kinematics, under both its laws.

#include "tests/hidden/joint_test_plans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace stylobate::hidden {

namespace {

/// 2 degrees per second, the rate rising within half a second.
void tilt_by(MeasuredRun& run, double side)
{
    const double rise = 0.5, speed = side * 2 * std::numbers::pi / 180;
    for (const double t : run.time_s)
        run.base_tilt_rad.values.push_back(
            t < rise ? speed * (t / 2 - rise / (2 * std::numbers::pi) * std::sin(std::numbers::pi * t / rise))
                     : speed * (t - rise / 2));
}

class JointTestOf : public testing::TestWithParam<Law> {};

INSTANTIATE_TEST_SUITE_P(Healthy, JointTestOf, testing::Values(Law::nonsmooth, Law::compliant),
                         [](const auto& law) { return law.param == Law::nonsmooth ? "nonsmooth" : "compliant"; });

TEST_P(JointTestOf, NothingMovesWhereNothingIsMoved)
{
    for (const SpecimenKind kind :
         {SpecimenKind::small_column, SpecimenKind::two_drums, SpecimenKind::full_scale_column}) {
        const VirtualCampaign made = a_column(GetParam(), kind);
        MeasuredRun plan = plan_of(made, RunKind::pull, 1, 0.5);
        plan.base_displacement_m.values.assign(plan.time_s.size(), 0.0);
        plan.forces = {gauge_on(plan, made.planned.specimen.half_height_m[1] / 2, true, 0)};
        const MeasuredRun run = do_test(made, plan);
        const std::size_t last = run.time_s.size() - 1;
        for (const int block : {0, 1}) {
            const double width = made.planned.specimen.half_width_m[0];
            EXPECT_NEAR(column(made, run.blocks.x_m, last, block), column(made, run.blocks.x_m, 0, block),
                        1e-5 * width);
            EXPECT_NEAR(column(made, run.blocks.y_m, last, block), column(made, run.blocks.y_m, 0, block),
                        1e-5 * width);
            EXPECT_NEAR(column(made, run.blocks.theta_rad, last, block), 0, 1e-5);
        }
        const double weight = made.planned.specimen.mass_kg[1] * made.model.gravity_m_s2;
        EXPECT_LT(std::abs(run.forces[0].value_n.values[last]), 0.02 * weight);
        EXPECT_FALSE(*run.collapsed);
        for (int block = 2; block < made.model.body_count; ++block)
            EXPECT_TRUE(std::isnan(column(made, run.blocks.x_m, last, block))) << "block " << block << " is away";
    }
}

/// Mean force of the rod over the weight of its block at a constant speed of the table to the left and to the right:
/// from the middle of each stroke on, when the rod rings no longer.
std::pair<double, double> pulled(const VirtualCampaign& made, const MeasuredRun& run, double speed_m_s)
{
    double sum[2] = {0, 0};
    int count[2] = {0, 0};
    const std::vector<double>& u = run.base_displacement_m.values;
    const double reach = *std::max_element(u.begin(), u.end());
    for (std::size_t k = 500; k + 1 < u.size(); ++k) {
        const double v = (u[k + 1] - u[k - 1]) * camera_rate_hz / 2;
        if (std::abs(v) < 0.9 * speed_m_s || u[k] * v < 0 || std::abs(u[k]) > 0.9 * reach)
            continue;
        sum[v > 0] += run.forces[0].value_n.values[k];
        ++count[v > 0];
    }
    const Body& block = made.model.bodies[static_cast<std::size_t>(run.forces[0].block)];
    const double weight = block.mass_kg * made.model.gravity_m_s2;
    return {sum[0] / count[0] / weight, sum[1] / count[1] / weight};
}

/// The rod takes the whole friction, mu m g, against the block's motion with the table.
TEST_P(JointTestOf, ThePulledRodMeasuresFriction)
{
    VirtualCampaign made = a_column(GetParam());
    for (const int joint : {0, 1}) {
        const double mu = made.model.beds[static_cast<std::size_t>(joint)].friction;
        for (const double speed : {0.01, 0.06}) {
            const MeasuredRun run = do_test(made, pull_of(made, joint, speed));
            ASSERT_FALSE(*run.collapsed);
            const auto [left, right] = pulled(made, run, speed);
            EXPECT_NEAR(right, -mu, 0.01 * mu) << joint << ' ' << speed;
            EXPECT_NEAR(left, mu, 0.01 * mu) << joint << ' ' << speed;
            // what is clamped moves with the table
            if (joint == 1) {
                EXPECT_NEAR(column(made, run.blocks.x_m, 1000, 0) - column(made, run.blocks.x_m, 0, 0),
                            run.base_displacement_m.values[1000] - run.base_displacement_m.values[0], 1e-9);
            }
        }
    }
    // with the sensors' own noise, as far as its mean goes; a gauge of 0.5 %
    MeasuredRun plan = pull_of(made, 1, 0.06);
    plan.forces[0].gain_sd = 0.005;
    plan.forces[0].value_n.noise_sd.reset();
    const MeasuredRun run = do_test(made, plan);
    EXPECT_NEAR(*run.forces[0].value_n.noise_sd, 0.02, 0.0005);
    EXPECT_NEAR(pulled(made, run, 0.06).second, -made.model.beds[1].friction, 0.02);
}

TEST_P(JointTestOf, FrictionThatFallsWithSpeedIsLowerInFastCycles)
{
    VirtualCampaign made = a_column(GetParam());
    for (BedEffect& bed : made.model.effects.beds) {
        bed.dynamic_ratio = 0.7;
        bed.stribeck_m_s = 0.03;
    }
    const double mu = made.model.beds[1].friction;
    const auto at = [&](double v) { return mu * (0.7 + 0.3 * std::exp(-v / 0.03)); };
    EXPECT_NEAR(-pulled(made, do_test(made, pull_of(made, 1, 0.06)), 0.06).second, at(0.06), 0.03 * mu);
}

/// Memory: friction lost to 400 mm of slip goes on from one test to the next where it persists.
TEST_P(JointTestOf, WearGoesOnWhereItPersists)
{
    VirtualCampaign made = a_column(GetParam());
    made.model.effects.beds[1].wear_per_m = 0.5;
    Campaign plans;
    plans.specimen = made.planned.specimen;
    plans.tests.assign(2, pull_of(made, 1, 0.06));
    std::vector<double> forces;
    for (const bool persists : {false, true}) {
        made.model.effects.persists = persists;
        for (const MeasuredRun& run : tested(made, plans).tests)
            forces.push_back(pulled(made, run, 0.06).first);
    }
    EXPECT_NEAR(forces[1], forces[0], 1e-3 * forces[0]);
    EXPECT_NEAR(forces[2], forces[0], 1e-3 * forces[0]);
    EXPECT_NEAR(forces[3] - forces[2], -0.5 * 0.06 * 3.4 * made.model.beds[1].friction, 0.15 * forces[0] * 0.1);
}

/// Tilt at which the tested block slides by 20 um or turns by 0.5 mrad against the board; positive to the right.
double tilt_at_first_motion(const VirtualCampaign& made, const MeasuredRun& run, bool turning, double& motion)
{
    const Series& seen = turning ? run.blocks.theta_rad : run.blocks.x_m;
    const int block = run.present.back();
    for (std::size_t k = 0; k < run.time_s.size(); ++k) {
        motion = column(made, seen, k, block) - column(made, seen, 0, block);
        if (std::abs(motion) > (turning ? 5e-4 : 2e-5))
            return run.base_tilt_rad.values[k];
    }
    return 0;
}

TEST_P(JointTestOf, TheBlockOnTheBoardSlidesAtItsAngleOfFriction)
{
    const VirtualCampaign made = a_column(GetParam());
    for (const double side : {1.0, -1.0}) {
        MeasuredRun plan = plan_of(made, RunKind::board, 1, 20);
        tilt_by(plan, side);
        const MeasuredRun run = do_test(made, plan);
        double motion = 0;
        const double tilt = tilt_at_first_motion(made, run, false, motion);
        EXPECT_LT(side * motion, 0) << "down the board";
        EXPECT_NEAR(std::tan(side * tilt), made.model.beds[1].friction, 0.01 * made.model.beds[1].friction + 1e-3);
        // in the board's frame what is clamped stays where it was
        EXPECT_NEAR(column(made, run.blocks.x_m, 5000, 0), column(made, run.blocks.x_m, 0, 0), 1e-9);
        EXPECT_NEAR(column(made, run.blocks.theta_rad, 5000, 0), 0, 1e-9);
        // and the block slides down with the difference of weight and friction, in the end off its joint
        EXPECT_TRUE(*run.collapsed);
    }
}

TEST_P(JointTestOf, TheBodyTurnsAboutItsCorner)
{
    VirtualCampaign made = a_column(GetParam());
    const auto turning = [&](double side) {
        MeasuredRun plan = plan_of(made, RunKind::tilt, 1, 20);
        tape_dummies(made, plan);
        tilt_by(plan, side);
        double motion = 0;
        const double tilt = tilt_at_first_motion(made, do_test(made, plan), true, motion);
        EXPECT_GT(side * motion, 0) << "with the board";
        return std::tan(side * tilt);
    };
    const double half = std::min(made.model.bodies[0].half_width_m, made.model.bodies[1].half_width_m);
    const double height = 3 * made.planned.specimen.half_height_m[1];
    EXPECT_NEAR(turning(1), half / height, 0.015 * half / height);
    EXPECT_NEAR(turning(-1), half / height, 0.015 * half / height);

    // a corner lost on the left: there the body turns earlier, by the part of the half width that is lost
    const double healthy_left = turning(1), healthy_right = turning(-1);
    made.model.effects.beds[1].chip_left_m = 0.004;
    EXPECT_NEAR(turning(1) - healthy_left, -0.004 / height, 0.0006 / height);
    EXPECT_NEAR(turning(-1) - healthy_right, 0, 0.0003 / height);
    made.model.effects = {};
    // a centre of mass 3 mm to the right in one of three equal masses: later over the left corner, earlier over the
    // right
    made.model.effects.bodies[1].eccentricity_m = 0.003;
    EXPECT_NEAR(turning(1) - healthy_left, 0.001 / height, 0.0003 / height);
    EXPECT_NEAR(turning(-1) - healthy_right, -0.001 / height, 0.0003 / height);
}

MeasuredRun push_of(const VirtualCampaign& made, double side, double speed_m_s = 0.02)
{
    MeasuredRun plan = plan_of(made, RunKind::push, 1, 0.7 + 0.01 / speed_m_s);
    tape_dummies(made, plan);
    plan.forces = {gauge_on(plan, 0.9 * 6 * made.planned.specimen.half_height_m[1], false, side * speed_m_s)};
    return plan;
}

/// The force over that of a body which turns about its corner, with the moments of weight and rod.
double over_statics(const VirtualCampaign& made, const MeasuredRun& run, double mass, double half)
{
    double ratio = 0;
    int count = 0;
    const double height = 3 * made.planned.specimen.half_height_m[1], point = run.forces[0].height_m;
    for (std::size_t k = 0; k < run.time_s.size(); ++k) {
        const double turned = std::abs(column(made, run.blocks.theta_rad, k, 1));
        if (turned < 0.03 || turned > 0.1)
            continue;
        const double arm = half * std::cos(turned) - height * std::sin(turned);
        const double want = mass * made.model.gravity_m_s2 * arm / (point * std::cos(turned) + half * std::sin(turned));
        ratio += std::abs(run.forces[0].value_n.values[k]) / want;
        ++count;
    }
    EXPECT_GT(count, 20);
    return ratio / count;
}

TEST_P(JointTestOf, ThePushHasTheMomentOfTheWeight)
{
    VirtualCampaign made = a_column(GetParam());
    const double half = std::min(made.model.bodies[0].half_width_m, made.model.bodies[1].half_width_m);
    const double mass = made.model.bodies[1].mass_kg + 2 * made.planned.specimen.mass_kg[1];
    for (const double side : {1.0, -1.0}) {
        const MeasuredRun run = do_test(made, push_of(made, side));
        ASSERT_FALSE(*run.collapsed);
        for (std::size_t k = 0; k < run.time_s.size(); ++k) {
            EXPECT_GE(side * run.forces[0].value_n.values[k], 0);
            if (run.time_s[k] < 0.2) {
                EXPECT_NEAR(run.forces[0].value_n.values[k], 0, 2e-3);
            }
        }
        EXPECT_LT(side * column(made, run.blocks.theta_rad, 300, 1), -0.02) << "over the far corner";
        EXPECT_NEAR(over_statics(made, run, mass, half), 1, 0.02);
        // the rod stops after 10 mm
        const double turned = std::abs(column(made, run.blocks.theta_rad, 575, 1));
        EXPECT_NEAR(turned, 0.01 / run.forces[0].height_m, 0.01);
    }
    // a corner lost on the right: less to hold a push to the right; nothing changes to the left
    made.model.effects.beds[1].chip_right_m = 0.004;
    EXPECT_NEAR(over_statics(made, do_test(made, push_of(made, 1)), mass, half - 0.004), 1, 0.02);
    EXPECT_NEAR(over_statics(made, do_test(made, push_of(made, -1)), mass, half), 1, 0.02);
}

/// A bond holds the opening end: the first peak is higher by its moment, and what follows is not. Slowly: a rod of
/// 20 mm/s overshoots by v sqrt(k m), which is as large as the force itself, and a bond adds to that in squares.
TEST_P(JointTestOf, ABondMakesTheFirstPeakOfAPush)
{
    VirtualCampaign made = a_column(GetParam());
    const double half = std::min(made.model.bodies[0].half_width_m, made.model.bodies[1].half_width_m);
    const double mass = made.model.bodies[1].mass_kg + 2 * made.planned.specimen.mass_kg[1];
    const MeasuredRun plan = push_of(made, 1, 0.002);
    const auto peak = [](const MeasuredRun& run) {
        return *std::max_element(run.forces[0].value_n.values.begin(), run.forces[0].value_n.values.end());
    };
    const double healthy = peak(do_test(made, plan));
    const double tension = 40;
    made.model.effects.beds[1].tension_n_m = tension;
    State end;
    const MeasuredRun run = performed(made, plan, 3, nullptr, &end);
    const double more = 0.5 * tension * 2 * half * 2 * half / plan.forces[0].height_m;
    EXPECT_NEAR(peak(run) - healthy, more, 0.2 * more);
    EXPECT_NEAR(over_statics(made, run, mass, half), 1, 0.02) << "it is broken by then";
    EXPECT_TRUE(end.beds[1].opened[0]);
    EXPECT_FALSE(end.beds[1].opened[1]) << "the corner it turns about stays closed";
    EXPECT_NEAR(peak(performed(made, plan, 3, &end, nullptr)), healthy, 0.02 * more) << "and broken it stays";

    // stronger than the push: nothing opens or slides within a millimetre of the rod
    made.model.effects.beds[1].tension_n_m = made.model.effects.beds[1].adhesion_n_m = 4000;
    MeasuredRun brief = plan;
    brief.time_s.resize(350);
    EXPECT_FALSE(*performed(made, brief, 3, nullptr, &end).collapsed);
    EXPECT_FALSE(end.beds[1].opened[0] || end.beds[1].opened[1] || end.beds[1].slipped);
}

TEST_P(JointTestOf, ADroppedBodyComesToRestTheLaterTheLessIsDamped)
{
    VirtualCampaign made = a_column(GetParam());
    const auto time_until_rest = [&] {
        const MeasuredRun run = do_test(made, drop_of(made));
        EXPECT_FALSE(*run.collapsed);
        const std::size_t last = run.time_s.size() - 1;
        const double end = column(made, run.blocks.y_m, last, 1);
        EXPECT_NEAR(end, made.planned.specimen.rest_y_m[1], 5e-5);
        EXPECT_NEAR(column(made, run.blocks.theta_rad, last, 1), 0, 5e-4);
        EXPECT_NEAR(column(made, run.blocks.y_m, 100, 1), made.planned.specimen.rest_y_m[1] + 0.003, 1e-9) << "held";
        // it falls freely: 20 ms after the release by g t2 / 2
        EXPECT_NEAR(column(made, run.blocks.y_m, 110, 1),
                    made.planned.specimen.rest_y_m[1] + 0.003 - 0.5 * 9.81 * 0.02 * 0.02, 2e-5);
        std::size_t k = last;
        while (k > 0 && std::abs(column(made, run.blocks.y_m, k, 1) - end) < 2e-5)
            --k;
        return run.time_s[k] - 0.2;
    };
    made.model.parameters.restitution = 0.1;
    made.model.parameters.damping_s_m *= 2;
    const double damped = time_until_rest();
    made.model.parameters.restitution = 0.5;
    made.model.parameters.damping_s_m *= 0.15;
    const double bouncing = time_until_rest();
    EXPECT_GT(damped, std::sqrt(2 * 0.003 / 9.81) - 0.003);
    EXPECT_GT(bouncing, damped + 0.04);
}

TEST_P(JointTestOf, ASlidingBlockHasTheAccelerationOfFriction)
{
    const VirtualCampaign made = a_column(GetParam());
    MeasuredRun plan = plan_of(made, RunKind::slide, 1, 2.5);
    const double w = 2 * std::numbers::pi * 4;
    for (const double t : plan.time_s)
        plan.base_displacement_m.values.push_back(10.7 / (w * w) * std::pow(std::min(t / 0.5, 1.0), 3) *
                                                  std::sin(w * t));
    const MeasuredRun run = do_test(made, plan);
    ASSERT_FALSE(*run.collapsed);
    std::vector<double> accelerations;
    const auto x = [&](std::size_t k, int block) { return column(made, run.blocks.x_m, k, block); };
    for (std::size_t k = 500; k + 4 < run.time_s.size(); ++k) {
        bool sliding = true; // throughout, to the right
        for (std::size_t i = k - 5; i <= k + 4; ++i)
            sliding = sliding && (x(i, 1) - x(i, 0) - x(i - 1, 1) + x(i - 1, 0)) * camera_rate_hz > 0.02;
        if (sliding)
            accelerations.push_back((x(k + 4, 1) - 2 * x(k, 1) + x(k - 4, 1)) * camera_rate_hz * camera_rate_hz / 16);
    }
    ASSERT_GT(accelerations.size(), 50U);
    const double mean =
        std::accumulate(accelerations.begin(), accelerations.end(), 0.0) / static_cast<double>(accelerations.size());
    const double want = made.model.beds[1].friction * made.model.gravity_m_s2;
    EXPECT_NEAR(mean, -want, 0.01 * want);
}

/// Taped blocks slide as one: the rod holds the weight of both. With less friction than usual, because so high a body
/// on springy corners rocks by itself while it slides, and chatters.
TEST_P(JointTestOf, TapedBlocksMoveAsOne)
{
    VirtualCampaign made = a_column(GetParam());
    made.model.beds[0].friction = 0.3;
    MeasuredRun plan = pull_of(made, 0, 0.02);
    plan.present = {0, 1};
    plan.taped = {{0, 1}};
    const MeasuredRun run = do_test(made, plan);
    const double weights = 1 + made.model.bodies[1].mass_kg / made.model.bodies[0].mass_kg;
    const double want = made.model.beds[0].friction * weights;
    EXPECT_NEAR(pulled(made, run, 0.02).first, want, 0.01 * want);
    const double height = 2 * made.planned.specimen.half_height_m[0];
    for (std::size_t k = 0; k < run.time_s.size(); k += 100) {
        const double lower = column(made, run.blocks.theta_rad, k, 0);
        EXPECT_NEAR(column(made, run.blocks.theta_rad, k, 1), lower, 1e-12);
        EXPECT_NEAR(column(made, run.blocks.x_m, k, 1) - column(made, run.blocks.x_m, k, 0), -height * std::sin(lower),
                    1e-9);
    }
}

} // namespace

} // namespace stylobate::hidden

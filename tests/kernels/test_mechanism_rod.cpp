/// What a laboratory does to a block, each against its closed form, through the real kernel: rods that hold, pull and
/// push it, a base that is tilted, a release from above the bed, and a bond that holds against opening.

#include "ensemble/planar/structure/step_bound.hpp"
#include "studies/evidence/verification/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace stylobate;
using namespace stylobate::model;

namespace {

const Stone slab{0.2, 0.05, 4.0};
const Stone tall{0.048, 0.087, 0.4};

/// A slab with hardly any weight and no friction: nothing but the rod moves it.
Realization floating(double dt)
{
    Realization r = single(slab, {1e7, 0, 0}, dt, 8);
    r.gravity_m_s2 = 1e-6;
    return r;
}

/// A rod at a height of the block, to both sides.
BlockMechanisms& rod(Realization& r, double stiffness_n_m, double height_m)
{
    BlockMechanisms& e = r.blocks[1].mechanisms;
    e.rod_right_n_m = e.rod_left_n_m = stiffness_n_m;
    e.rod_height_m = height_m;
    return e;
}

/// A slender block whose beds are damped at their ends, with a safe step.
Realization standing(double mu, double eccentricity_m = 0, double K_n = 1e8)
{
    Realization r = single(tall, {K_n, 0.1, mu}, 1, 0.4);
    r.joints[0].mechanisms.face_damping = 1;
    r.blocks[1].mechanisms.eccentricity_m = eccentricity_m;
    r.step_s = 0.5 * step_bound(r).dt_s;
    return r;
}

/// Force of the rod of a block, from where the block is: F = k (x_e - x_p).
double force_n(const Realization& r, const Snapshot& start, const Snapshot& now, double end_m)
{
    const Block& block = r.blocks[1];
    const BlockMechanisms& e = block.mechanisms;
    const double arm = e.rod_height_m - block.half_height_m;
    const double point =
        (now.x_m[1] - arm * std::sin(now.theta_rad[1])) - (start.x_m[1] - arm * std::sin(start.theta_rad[1]));
    const double ahead = end_m - point;
    return (ahead > 0 ? e.rod_right_n_m : e.rod_left_n_m) * ahead;
}

/// Forces of a rod that pushes from the left at the top, after each chunk.
std::vector<double> pushed(Realization r, double speed_m_s, double time_s)
{
    BlockMechanisms& e = rod(r, 2e3, 0.9 * tall.height);
    (speed_m_s > 0 ? e.rod_left_n_m : e.rod_right_n_m) = 0;
    e.rod_speed_m_s = speed_m_s;
    e.rod_start_s = 0.05;
    e.rod_travel_m = 1;
    r.step_s = std::min(r.step_s, 0.5 * step_bound(r).dt_s);
    const Study study = still(10);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const Snapshot start = set.snapshot(0);
    std::vector<double> forces;
    for (double t = 0; t < time_s && !set.outcome(0);) {
        set.advance();
        t = static_cast<double>(set.steps(0)) * r.step_s;
        forces.push_back(force_n(r, start, set.snapshot(0), speed_m_s * std::max(t - e.rod_start_s, 0.0)));
    }
    return forces;
}

/// What an elastic bed takes from the lever of a weight before a block turns on it: the least of l / 3 + h theta, where
/// a length l of the bed still carries the weight N = K_N l2 theta / 2.
double lost_lever_m(double weight_n, double K_n)
{
    const double c = 2 * weight_n / K_n, h = 0.5 * tall.height, l = std::cbrt(6 * h * c);
    return l / 3 + h * c / (l * l);
}

/// Rotation of the base by 0.25 rad at 0.02 rad/s.
std::shared_ptr<const Motion> tilting(double sign)
{
    constexpr double dt = 0.05, rate = 0.02;
    std::vector<double> acceleration(255, 0.0);
    acceleration[1] = sign * rate / dt;
    acceleration[251] = -sign * rate / dt;
    return std::make_shared<const Motion>(motion_of(std::move(acceleration), dt));
}

/// Tilt at which a block has left its place, by a look at it. The base is out of level from the start on.
template <class Leaves>
double tilt_when(Realization r, double from_rad, double sign, Leaves leaves)
{
    r.base_tilt_rad = -sign * from_rad; // gravity to the right: clockwise
    r.tilt = tilting(sign);
    const Study study = still(12.5);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const Snapshot start = set.snapshot(0);
    while (!set.outcome(0)) {
        set.advance();
        if (leaves(start, set.snapshot(0)))
            return sign * from_rad +
                   set.place(0).motions[2].displacement_m(static_cast<double>(set.steps(0)) * r.step_s);
    }
    return 0;
}

} // namespace

TEST(Rod, PullsABlockAsASpringWhoseEndMoves)
{
    // m x'' = k (v t - x) from rest: x = v (t - sin(w t) / w), t counted from when the end begins to move
    const double k = 900, v = 0.02, t0 = 0.3, dt = 1e-4, w = std::sqrt(k / slab.mass);
    for (const double sign : {1.0, -1.0}) {
        Realization r = floating(dt);
        BlockMechanisms& e = rod(r, k, 0.5 * slab.height);
        e.rod_speed_m_s = sign * v;
        e.rod_start_s = t0;
        e.rod_travel_m = 0.02;
        const Study study = still(10);
        LaneSet set(study, nullptr, kernels(best_isa()), r);
        set.load(0, r);
        const double start = set.snapshot(0).x_m[1];
        const auto ramp = [&](double t) { return t > 0 ? v * (t - std::sin(w * t) / w) : 0; };
        for (int chunk = 1; chunk <= 400; ++chunk) {
            set.advance();
            const double t = chunk * chunk_steps * dt;
            const double x = ramp(t - t0) - ramp(t - t0 - e.rod_travel_m / v); // the end stops
            EXPECT_NEAR(sign * (set.snapshot(0).x_m[1] - start), x, 2e-5 * e.rod_travel_m) << t;
        }
    }
}

TEST(Rod, LeavesABlockThatItOnlyPushesAtTwiceItsOwnSpeed)
{
    // half a swing on the spring, seen from the end that moves with v: then the block flies off with 2 v
    const double k = 900, v = 0.02, dt = 1e-4;
    Realization r = single(slab, {1e7, 0, 0}, dt, 8);
    BlockMechanisms& e = rod(r, k, 0.5 * slab.height);
    e.rod_left_n_m = 0;
    e.rod_speed_m_s = v;
    e.rod_travel_m = 1;
    const Study study = still(10);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    for (double t = 0; t < 4 / std::sqrt(k / slab.mass); t += chunk_steps * dt)
        set.advance();
    const Snapshot a = set.snapshot(0);
    set.advance();
    EXPECT_NEAR((set.snapshot(0).x_m[1] - a.x_m[1]) / (chunk_steps * dt), 2 * v, 1e-4 * v);
    // the work of the rod is what the block has
    const EnergyBalance balance = set.model().balance(0, set.place(0));
    EXPECT_NEAR(balance.base_work, 0.5 * slab.mass * 4 * v * v, 1e-4 * slab.mass * v * v);
    EXPECT_NEAR(balance.kinetic, balance.base_work, 1e-6 * balance.base_work);
}

TEST(Rod, FromTheLaboratoryCarriesTheFrictionOfABlockThatTheTableMovesUnder)
{
    Realization r = single(slab, {1e8, 0.1, 0.4}, 1, 0.8);
    r.joints[0].mechanisms.face_damping = 1;
    rod(r, 2e3, 0).rod_laboratory = 1;
    r.frequency_hz = 0.1;
    r.pga_m_s2 = 0.0063; // +-16 mm at 10 mm/s: twice the way in which the rod takes up the friction
    r.step_s = 0.5 * step_bound(r).dt_s;
    const Study study = harmonic(4, 1);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const Snapshot start = set.snapshot(0);
    const double friction = 0.4 * slab.mass * gravity;
    double sum = 0, count = 0, before = 0;
    while (!set.outcome(0) && static_cast<double>(set.steps(0)) * r.step_s < 30) {
        set.advance();
        const double base = set.motion(0).displacement_m(static_cast<double>(set.steps(0)) * r.step_s);
        const double force = force_n(r, start, set.snapshot(0), -base);
        // where it begins to slide it swings about the friction, by no more than v sqrt(k m)
        EXPECT_LT(std::fabs(force), friction + 0.011 * std::sqrt(2e3 * slab.mass));
        if (std::fabs(force) > 0.92 * friction && std::fabs(base - before) > 4e-3 * chunk_steps * r.step_s) {
            EXPECT_LT(force * (base - before), 0) << "against the table";
            sum += std::fabs(force);
            ++count;
        }
        before = base;
    }
    EXPECT_GT(count, 500);
    EXPECT_NEAR(sum / count, friction, 0.01 * friction);
    EXPECT_LT(std::fabs(set.model().balance(0, set.place(0)).residual), 1e-3);
}

TEST(Rod, PushesABlockOverWithItsWeightTimesItsLevers)
{
    // F h = m g (b -+ e) about the corner, before the block has turned
    const double weight = tall.mass * gravity, height = 0.9 * tall.height;
    for (const double e : {0.0, 0.003})
        for (const double sign : {1.0, -1.0}) {
            const std::vector<double> forces = pushed(standing(5, e), sign * 1e-3, 1);
            const double want = weight * (0.5 * tall.width - sign * e - lost_lever_m(weight, 1e8)) / height;
            const double most = *std::max_element(forces.begin(), forces.end(),
                                                  [](double a, double b) { return std::fabs(a) < std::fabs(b); });
            EXPECT_NEAR(most, sign * want, 0.02 * want) << e;
            EXPECT_NEAR(forces.front(), 0, 1e-9) << "it just touches";
            for (const double force : forces)
                EXPECT_GE(sign * force, 0) << "it does not pull";
        }
}

TEST(Rod, IsStableUpToTheExactBound)
{
    const auto runs = [](double part) {
        const double k = 1e9; // much stiffer than the bed
        Realization r = floating(part * 2 / std::sqrt(k / slab.mass));
        r.joints[0].normal_stiffness_n_m2 = 1e4;
        BlockMechanisms& e = rod(r, k, 0.5 * slab.height);
        e.rod_speed_m_s = 1e-3;
        e.rod_travel_m = 1e-6;
        EXPECT_GT(r.step_s, step_bound(r).dt_s);
        EXPECT_NEAR(step_bound(r).dt_s, r.step_s / part / std::sqrt(2.0), 1e-3 * r.step_s) << "twice the block's own";
        const Study study = still(10);
        LaneSet set(study, nullptr, kernels(best_isa()), r);
        set.load(0, r);
        const double start = set.snapshot(0).x_m[1];
        for (int chunk = 0; chunk < 60; ++chunk)
            set.advance();
        return std::fabs(set.snapshot(0).x_m[1] - start) < 1e-3;
    };
    EXPECT_TRUE(runs(0.98));
    EXPECT_FALSE(runs(1.02));
    // at its point the stiffness turns the block too: 1 / m + a2 / I
    Realization r = floating(1);
    r.joints[0].normal_stiffness_n_m2 = 1e4;
    rod(r, 1e9, 0.7 * slab.height);
    const double a = 0.2 * slab.height, inertia = r.blocks[1].inertia_kg_m2;
    const double w2 = 1e9 * (1 / slab.mass + a * a / inertia);
    EXPECT_NEAR(step_bound(r).dt_s, 2 / std::sqrt(2 * w2), 1e-3 * step_bound(r).dt_s);
}

TEST(TableTilt, ABlockSlidesAtTheAngleOfItsFrictionToTheLowerSide)
{
    for (const double sign : {1.0, -1.0}) {
        const double at = tilt_when(standing(0.3, 0, 1e9), 0.2, sign, [&](const Snapshot& start, const Snapshot& now) {
            return sign * (start.x_m[1] - now.x_m[1]) > 5e-5; // counter-clockwise: to the left
        });
        EXPECT_NEAR(sign * std::tan(at), 0.3, 0.004);
    }
}

TEST(TableTilt, ATallBlockTurnsWhereItsCentreOfMassIsAboveTheCorner)
{
    for (const double e : {0.0, 0.003})
        for (const double sign : {1.0, -1.0}) {
            const double at = tilt_when(standing(2, e, 1e9), 0.4, sign, [&](const Snapshot&, const Snapshot& now) {
                return sign * now.theta_rad[1] > 0.01;
            });
            const double lever = 0.5 * tall.width + sign * e - lost_lever_m(tall.mass * gravity, 1e9);
            EXPECT_NEAR(sign * std::tan(at), lever / (0.5 * tall.height), 0.015) << e;
        }
}

TEST(InitialLift, ABlockFallsOntoItsBedAndComesToRest)
{
    Realization r = standing(0.5);
    r.joints[0].normal_damping_n_s_m *= 5;
    r.initial_lift_m = 0.003;
    r.step_s = 0.5 * step_bound(r).dt_s;
    const Study study = still(2);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const double start = set.snapshot(0).y_m[1];
    const double rest = r.blocks[1].y_m + Statics(r).before_tilt->y_m[1];
    EXPECT_NEAR(start - rest, 0.003, 1e-12);
    while (!set.outcome(0)) {
        set.advance();
        const double t = static_cast<double>(set.steps(0)) * r.step_s;
        if (t < 0.99 * std::sqrt(2 * 0.003 / gravity)) { // until then it is free
            EXPECT_NEAR(start - set.snapshot(0).y_m[1], 0.5 * gravity * t * t, 1e-6) << t;
        }
    }
    EXPECT_NEAR(set.snapshot(0).y_m[1], rest, 1e-6);
    EXPECT_LT(std::fabs(set.outcome(0)->energy_residual), 0.01);
}

TEST(Adhesion, WithATensionHoldsThePushedBlockUntilItsEdgeTears)
{
    // F h = m g b for a dry joint; (f + m g / B) B2 / 6 where the bond carries, and then the dry joint's
    const double weight = tall.mass * gravity, B = tall.width, height = 0.9 * tall.height;
    const double dry = weight * (0.5 * B - lost_lever_m(weight, 1e8)) / height, tension = 5 * weight / B;
    for (const ContactForm form : {ContactForm::area, ContactForm::two_corner, ContactForm::points}) {
        Realization r = standing(5);
        r.form = form;
        r.joints[0].mechanisms.adhesion_n_m = 1e4;
        r.joints[0].mechanisms.adhesion_tension_n_m = tension;
        const std::vector<double> forces = pushed(r, 1e-3, 2);
        const double most = *std::max_element(forces.begin(), forces.end());
        const double want = (tension + weight / B) * B * B / 6 / height;
        if (form == ContactForm::area) { // the others press with springs of their own
            EXPECT_NEAR(most, want, 0.03 * want);
        }
        EXPECT_GT(most, 1.5 * dry);
        r.joints[0].mechanisms.adhesion_tension_n_m = 0;
        const std::vector<double> sheared = pushed(r, 1e-3, 2);
        EXPECT_NEAR(*std::max_element(sheared.begin(), sheared.end()), dry,
                    (form == ContactForm::area ? 0.02 : 0.1) * dry)
            << "against sliding alone";
    }
}

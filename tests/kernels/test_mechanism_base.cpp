/// Mechanisms of the base and of the air, each against its closed form, through the real kernel.

#include "studies/evidence/verification/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace stylobate;
using namespace stylobate::model;

namespace {

/// Acceleration that rises smoothly to 1 m/s2 and then stays, for loads that are as good as static.
Motion ramp_and_hold(double rise_s, double hold_s)
{
    Motion motion;
    motion.dt_s = rise_s / 200;
    for (double t = 0; t < rise_s + hold_s; t += motion.dt_s) {
        const double x = std::min(t / rise_s, 1.0);
        motion.acceleration_m_s2.push_back(x * x * x * (10 + x * (6 * x - 15)));
    }
    motion.pga_m_s2 = 1;
    motion.predominant_frequency_hz = 1;
    return motion;
}

const Stone slab{0.2, 0.05, 4.0};

/// A slab with hardly any weight and no friction: nothing but the frame moves it along.
Realization floating(double dt)
{
    Realization r = single(slab, {1e7, 0, 0}, dt, 8);
    r.gravity_m_s2 = 1e-6;
    return r;
}

/// Lifts it off its base by pulling it up and to a stop again, a chunk each.
void lift(LaneSet& set, double height)
{
    const double time = chunk_steps * set.realization(0).step_s;
    for (const double sign : {1.0, -1.0}) {
        nudge(set, 0, 1, 0, sign * height / (time * time), 0);
        set.advance();
    }
    nudge(set, 0, 1, 0, 0, 0);
}

} // namespace

TEST(Drag, SlowsAsOneOverTime)
{
    // v = v0 / (1 + c v0 t / m), so x = m / c ln(1 + c v0 t / m)
    const double c = 2, dt = 1e-4;
    Realization r = floating(dt);
    r.blocks[1].mechanisms.drag_n_s2_m2 = c;
    const Study study = still(10);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    nudge(set, 0, 1, 300, 400, 0);
    set.advance();
    nudge(set, 0, 1, 0, 0, 0);
    const Snapshot a = set.snapshot(0);
    set.advance(0, 1);
    const Snapshot b = set.snapshot(0);
    const double v0 = std::hypot(b.x_m[1] - a.x_m[1], b.y_m[1] - a.y_m[1]) / dt;
    EXPECT_GT(v0, 1.5);
    set.advance(1, chunk_steps);
    for (int chunk = 0; chunk < 150; ++chunk)
        set.advance();
    const Snapshot end = set.snapshot(0);
    const double time = 151 * chunk_steps * dt, k = c / slab.mass;
    const double path = std::hypot(end.x_m[1] - a.x_m[1], end.y_m[1] - a.y_m[1]);
    EXPECT_NEAR(path, std::log(1 + k * v0 * time) / k, 1e-3 * path);
    EXPECT_LT(path, 0.7 * v0 * time);
}

TEST(Drag, IsThatOfTheLaboratory)
{
    // a base that moves under what floats drags nothing along
    Realization r = floating(1e-4);
    r.frequency_hz = 3;
    r.pga_m_s2 = 5;
    r.blocks[1].mechanisms.drag_n_s2_m2 = 50;
    const Study study = harmonic(20, 1);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const double start = set.snapshot(0).x_m[1];
    for (int chunk = 1; chunk <= 300; ++chunk) {
        set.advance();
        const double t = chunk * chunk_steps * r.step_s;
        EXPECT_NEAR(set.snapshot(0).x_m[1] - start + set.motion(0).displacement_m(t), 0, 1e-9) << chunk;
    }
}

TEST(Tie, SwingsAsADampedOscillatorAboutWhereItsForceHoldsIt)
{
    // m x'' + c x' + k x = f from rest at 0: x = f / k (1 - e^(-d t) (cos w t + d / w sin w t)), d = c / (2 m)
    const double k = 900, c = 8, f = 0.9, dt = 1e-4;
    Realization r = floating(dt);
    r.blocks[1].mechanisms.tie_n_m = k;
    r.blocks[1].mechanisms.tie_n_s_m = c;
    r.blocks[1].mechanisms.tie_n = f;
    const Study study = still(10);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const double start = set.snapshot(0).x_m[1];
    const double d = c / (2 * slab.mass), w = std::sqrt(k / slab.mass - d * d);
    for (int chunk = 1; chunk <= 150; ++chunk) {
        set.advance();
        const double t = chunk * chunk_steps * dt;
        const double x = f / k * (1 - std::exp(-d * t) * (std::cos(w * t) + d / w * std::sin(w * t)));
        EXPECT_NEAR(set.snapshot(0).x_m[1] - start, x, 2e-3 * f / k) << t;
    }
}

TEST(Tie, DrivesAwayFromThePlaceWithANegativeStiffness)
{
    // m x'' = f + |k| x: x = f / |k| (cosh(w t) - 1)
    const double k = 16, f = 0.01, dt = 1e-4;
    Realization r = floating(dt);
    r.blocks[1].mechanisms.tie_n_m = -k;
    r.blocks[1].mechanisms.tie_n = f;
    const Study study = still(10);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const double start = set.snapshot(0).x_m[1], w = std::sqrt(k / slab.mass);
    for (int chunk = 1; chunk <= 150; ++chunk)
        set.advance();
    const double t = 150 * chunk_steps * dt, x = f / k * (std::cosh(w * t) - 1);
    EXPECT_NEAR(set.snapshot(0).x_m[1] - start, x, 2e-3 * x);
    EXPECT_GT(x, 1.2 * f * t * t / (2 * slab.mass)) << "the spring has a part in it";
}

TEST(Tie, SlowsRotation)
{
    // I theta'' = -c_r theta': what turns freely turns by w0 I / c_r at last
    const double c = 0.2, dt = 1e-4;
    Realization r = floating(dt);
    r.blocks[1].mechanisms.tie_n_m_s = c;
    const Study study = still(10);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    lift(set, 0.2);
    nudge(set, 0, 1, 0, 0, 20);
    set.advance();
    nudge(set, 0, 1, 0, 0, 0);
    const Snapshot a = set.snapshot(0);
    set.advance(0, 1);
    const double rate = (set.snapshot(0).theta_rad[1] - a.theta_rad[1]) / dt;
    EXPECT_GT(rate, 0.05);
    set.advance(1, chunk_steps);
    const int chunks = 20;
    for (int chunk = 1; chunk < chunks; ++chunk)
        set.advance();
    const double inertia = r.blocks[1].inertia_kg_m2, t = chunks * chunk_steps * dt;
    const double turned = rate * inertia / c * (1 - std::exp(-c * t / inertia));
    EXPECT_NEAR(set.snapshot(0).theta_rad[1] - a.theta_rad[1], turned, 2e-3 * turned);
    EXPECT_LT(turned, 0.9 * rate * t);
}

TEST(TablePitch, WhatFloatsGoesStraightInTheLaboratory)
{
    // gravity apart, all terms of the turned frame: r_lab = U + R(phi) r and theta + phi go on evenly
    Realization r = floating(1e-4);
    r.frequency_hz = 15; // all within the first chunks: what weighs nothing has no energy to be audited against
    r.pga_m_s2 = 4;
    r.base.pitch_rad_s2_m = 0.03; // to .12 rad
    const Study study = harmonic(20, 1);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    lift(set, 0.04);
    std::vector<double> x, y, theta, turned, passed; // once per chunk
    for (int chunk = 3; chunk < 16; ++chunk) {
        set.advance();
        const double t = chunk * chunk_steps * r.step_s, h = 1e-5;
        const auto u = [&](double time) { return set.motion(0).displacement_m(time); };
        const double phi = r.base.pitch_rad_s2_m * (u(t + h) - 2 * u(t) + u(t - h)) / (h * h);
        const Snapshot s = set.snapshot(0);
        x.push_back(u(t) + s.x_m[1] * std::cos(phi) - s.y_m[1] * std::sin(phi));
        y.push_back(s.x_m[1] * std::sin(phi) + s.y_m[1] * std::cos(phi));
        theta.push_back(s.theta_rad[1] + phi);
        turned.push_back(phi);
        passed.push_back(s.x_m[1]);
    }
    const auto bend = [](const std::vector<double>& v) {
        double most = 0;
        for (std::size_t i = 1; i + 1 < v.size(); ++i)
            most = std::max(most, std::fabs(v[i + 1] - 2 * v[i] + v[i - 1]));
        return most;
    };
    EXPECT_GT(bend(turned), 0.03);
    EXPECT_GT(bend(passed), 1e-3);
    EXPECT_LT(bend(x), 0.02 * bend(passed)); // first order in dt
    EXPECT_LT(bend(y), 0.02 * bend(passed));
    EXPECT_LT(bend(theta), 1e-3 * bend(turned));
}

TEST(TablePitch, TiltsGravity)
{
    // no friction: x'' = -U'' - g phi + phi'' y, so x = -(1 + k (g + w2 y)) U in the steady state
    const double f = 2, k = 2e-3, w = 2 * std::numbers::pi * f;
    Realization r = single(slab, {1e9, 0.1, 0}, 2e-5, 8);
    r.frequency_hz = f;
    r.pga_m_s2 = 1;
    r.base.pitch_rad_s2_m = k;
    const Study study = harmonic(6, 2);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    double low = 0, high = 0, base_low = 0, base_high = 0;
    for (int chunk = 1; chunk * chunk_steps * r.step_s < 2; ++chunk) {
        set.advance();
        const double t = chunk * chunk_steps * r.step_s, x = set.snapshot(0).x_m[1],
                     u = set.motion(0).displacement_m(t);
        if (t < 1)
            continue;
        low = std::min(low, x);
        high = std::max(high, x);
        base_low = std::min(base_low, u);
        base_high = std::max(base_high, u);
    }
    const double gain = 1 + k * (gravity + w * w * slab.height / 2);
    EXPECT_NEAR((high - low) / (base_high - base_low), gain, 1e-3);
    EXPECT_GT(gain, 1.02);
}

TEST(VerticalMotion, SlipBeginsWhereTheLighterSlabLetsGo)
{
    // on a slope it slips when g sin > mu (g cos + V'')
    const double slope = 0.3, mu = 0.4, c = std::cos(std::atan(slope));
    const double lightest = gravity * c * (slope / mu - 1); // V'' at which it just slips
    for (const double part : {0.97, 1.03}) {
        Realization r = single(slab, {1e9, 0.3, mu}, 2e-5, 8);
        r.base_tilt_rad = std::atan(slope);
        Motion motion = ramp_and_hold(0.3, 0.3);
        for (double& a : motion.acceleration_m_s2)
            a *= part * lightest;
        motion.velocity_m_s.resize(motion.acceleration_m_s2.size());
        motion.displacement_m.resize(motion.acceleration_m_s2.size());
        r.vertical = std::make_shared<const Motion>(motion);
        const Outcome o = run_one(still(0.6), r);
        if (part < 1)
            EXPECT_EQ(o.total_sliding_m, 0);
        else
            EXPECT_GT(o.total_sliding_m, 1e-4);
    }
}

TEST(VerticalMotion, GoesWithTheHorizontalOne)
{
    // half of the horizontal displacement, upwards: what floats is left behind by that
    Realization r = floating(1e-4);
    r.frequency_hz = 15;
    r.pga_m_s2 = 5;
    r.base.vertical_ratio = 0.5;
    const Study study = harmonic(20, 0.5);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    lift(set, 0.04);
    const double early = set.motion(0).displacement_m(2 * chunk_steps * r.step_s);
    const Snapshot start = set.snapshot(0);
    for (int chunk = 1; chunk < 14; ++chunk) {
        set.advance();
        const Snapshot s = set.snapshot(0);
        const double u = set.motion(0).displacement_m((chunk + 2) * chunk_steps * r.step_s) - early;
        EXPECT_NEAR(s.x_m[1] - start.x_m[1], -u, 1e-5); // (what moved while it was lifted)
        EXPECT_NEAR(s.y_m[1] - start.y_m[1], -0.5 * u, 1e-5);
    }
    EXPECT_NE(set.snapshot(0).y_m[1], start.y_m[1]);
}

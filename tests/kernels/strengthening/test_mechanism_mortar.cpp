/// Bonded joints, each against the closed form of a linear elastic joint.

#include "ensemble/planar/structure/step_bound.hpp"
#include "kernels/planar/mechanisms/mortar.hpp"
#include "tests/kernels/strengthening/strengthened_runs.hpp"

#include <gtest/gtest.h>

using namespace stylobate;
using namespace stylobate::model;

namespace {

const Stone slab{0.2, 0.05, 4.0};
constexpr double K_n = 1e8, mu = 0.5;
const double weight = slab.mass * gravity;

/// @param tension f_t D and   @param cohesion c D [N/m]
Realization bonded(double tension, double cohesion)
{
    Realization r = single(slab, {K_n, 0.1, mu}, 1, 1);
    r.joints[0].strengthening.bond_tension_n_m = tension;
    r.joints[0].strengthening.bond_cohesion_n_m = cohesion;
    r.joints[0].mechanisms.face_damping = 1;
    r.step_s = 0.5 * step_bound(r).dt_s;
    return r;
}

} // namespace

TEST(Mortar, TensionOfATriangleAndOfATrapezoid)
{
    // force and moment about the origin by summing thin strips
    for (const auto& [left, right, at_left, at_right] : {std::array{-0.3, 0.5, -1e-3, 2e-3},
                                                         {-0.3, 0.5, 2e-3, -1e-3},
                                                         {-0.3, 0.5, 1e-3, 3e-3},
                                                         {-0.3, 0.5, 3e-3, 1e-3},
                                                         {-0.3, 0.5, 2e-3, 2e-3},
                                                         {-0.3, 0.5, -1e-3, -2e-3}}) {
        double force = 0, couple = 0, energy = 0;
        constexpr int strips = 200000;
        for (int i = 0; i < strips; ++i) {
            const double part = (i + 0.5) / strips, x = left + (right - left) * part;
            const double o = std::max(0.0, at_left + (at_right - at_left) * part), dx = (right - left) / strips;
            force += o * dx;
            couple += o * x * dx;
            energy += 0.5 * o * o * dx;
        }
        const BondPull<double> pull = bond_pull(left, right, at_left, at_right);
        EXPECT_NEAR(pull.force, force, 1e-8);
        EXPECT_NEAR(pull.couple, couple, 1e-8);
        EXPECT_NEAR(pull.energy, energy, 1e-10);
        EXPECT_EQ(pull.most, std::max(at_left, at_right));
    }
}

TEST(Mortar, CracksAtTheMomentOfItsStrengthAndTheLoad)
{
    // M = (f_t + N / A) D B2 / 6, and until then the rotation of a full bed
    const double tension = 500, B = slab.width, I = slab.mass * (B * B + slab.height * slab.height) / 12;
    const double want = (tension + weight / B) * B * B / 6;
    const Realization r = bonded(tension, 1e6);
    for (const double sign : {1.0, -1.0}) {
        double linear = 0;
        const double got = I * ramped(r, 10, 1.2 * want / I, {0, 0, sign}, [&](const Snapshot& s, double size) {
                               const double full = 12 * I * size / (K_n * B * B * B), turned = sign * s.theta_rad[1];
                               if (I * size > 0.5 * want && I * size < 0.9 * want)
                                   linear = std::max(linear, std::fabs(turned / full - 1));
                               return turned > 1.5 * full && I * size > 0.1 * want;
                           });
        EXPECT_NEAR(got, want, 0.01 * want) << sign;
        EXPECT_LT(linear, 0.01);
    }
}

TEST(Mortar, IsTornOffByItsStrengthTimesItsArea)
{
    const double tension = 500, want = weight + tension * slab.width;
    const double got = slab.mass * ramped(bonded(tension, 1e6), 2, 1.2 * want / slab.mass, {0, 1, 0},
                                          [](const Snapshot& s, double) { return s.y_m[1] > 1e-4; });
    EXPECT_NEAR(got, want, 0.01 * want);
}

TEST(Mortar, IsShearedOffByCohesionAndFriction)
{
    const double cohesion = 300, want = cohesion * slab.width + mu * weight;
    const double got = slab.mass * ramped(bonded(1e6, cohesion), 2, 1.2 * want / slab.mass, {1, 0, 0},
                                          [](const Snapshot& s, double) { return s.x_m[1] > 1e-4; });
    EXPECT_NEAR(got, want, 0.01 * want);
}

TEST(Mortar, OnceBrokenItIsADryJoint)
{
    // sheared off at 1.1 times its strength: what then drives it is what friction leaves
    const double cohesion = 300, push = 1.1 * (cohesion * slab.width + mu * weight) / slab.mass;
    double x = 0, before = 0, earlier = 0, chunk = 0, time = 0;
    pushed(
        bonded(1e6, cohesion), 0.4,
        [&](int, double) {
            return Push{push, 0, 0};
        },
        [&](double now, const Snapshot& s) {
            earlier = before;
            before = x;
            x = s.x_m[1];
            chunk = now - time;
            time = now;
            return x < 0.1;
        });
    ASSERT_GT(x, 0.1);
    const double want = push - mu * gravity;
    EXPECT_NEAR((x - 2 * before + earlier) / (chunk * chunk), want, 0.01 * want);
}

TEST(Mortar, HoldsALoadThatADryJointTips)
{
    // a slab that overhangs so far that a dry bed opens at rest; the bond carries the tension
    const auto overhang = [](double tension) {
        Realization r = stack({{0.2, 0.2, 8.0}, {0.2, 0.05, 2.0, 0.07}}, {K_n, 0.1, mu}, 1, 1);
        for (Joint& joint : r.joints) {
            joint.strengthening.bond_tension_n_m = tension;
            joint.strengthening.bond_cohesion_n_m = tension;
            joint.mechanisms.face_damping = 1;
        }
        r.step_s = 0.5 * step_bound(r).dt_s;
        return r;
    };
    const double depth = 10 * gravity / (K_n * 0.2);
    for (const double tension : {1e5, 0.0}) {
        const Realization r = overhang(tension);
        double moved = 0;
        const StaticState start = static_state(r);
        pushed(
            r, 0.5, [](int, double) { return Push{}; },
            [&](double, const Snapshot& s) {
                moved = std::max({moved, std::fabs(s.y_m[2] - start.y_m[2]),
                                  slab.width * std::fabs(s.theta_rad[2] - start.theta_rad[2])});
                return true;
            });
        EXPECT_LT(moved, 0.01 * depth) << tension;
    }
    // the bed of a linear joint turns by 12 N e / (K L3), e from the middle of what it has in common
    const StaticState s = static_state(overhang(1e5));
    const double N = 2 * gravity, L = 0.13, e = 0.035;
    EXPECT_NEAR(s.theta_rad[2] - s.theta_rad[1], -12 * N * e / (K_n * L * L * L),
                1e-3 * 12 * N * e / (K_n * L * L * L));
}

TEST(Mortar, WhatItHoldsWhenItBreaksIsCounted)
{
    Realization r = spec({1e8, 0.1, 0.3}, 1);
    for (Joint& joint : r.joints) {
        joint.strengthening.bond_tension_n_m = 300;
        joint.strengthening.bond_cohesion_n_m = 50;
    }
    r.step_s = 0.5 * step_bound(r).dt_s;
    r.frequency_hz = 4;
    r.pga_m_s2 = 6;
    const Outcome o = run_one(harmonic(6, 1), r);
    EXPECT_NE(o.state, State::invalid);
    EXPECT_GT(o.total_rocking_rad + o.total_sliding_m, 1e-3); // some did break
    EXPECT_LT(std::fabs(o.energy_residual), 0.02);
}

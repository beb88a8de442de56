/// Clamps between blocks and dowels that are pulled out, each against its closed form.

#include "ensemble/planar/structure/step_bound.hpp"
#include "kernels/planar/mechanisms/clamp.hpp"
#include "kernels/planar/mechanisms/pull_out.hpp"
#include "tests/kernels/strengthening/strengthened_runs.hpp"

#include <gtest/gtest.h>

using namespace stylobate;
using namespace stylobate::model;

namespace {

constexpr double m1 = 4, m2 = 6;

/// Two blocks side by side on a wide base, without friction, joined by a clamp.
Realization pair_of_blocks(double stiffness, double strength, double gap, double compression)
{
    Realization r = stack({{0.2, 0.1, m1}}, {1e8, 0.2, 0}, 1, 4);
    const Joint bed = r.joints[0];
    r.blocks.push_back({0.1, 0.06, m2, m2 * (0.04 + 0.0144) / 12, 0.21, 0.06, false});
    r.joints.push_back(bed);
    r.joints[1].upper = 2;
    r.blocks[2].column = 1;
    r.drums = 3;
    BlockStrengthening& clamp = r.blocks[1].strengthening;
    clamp.clamp_n_m = stiffness;
    clamp.clamp_strength_n = strength;
    clamp.clamp_gap_m = gap;
    clamp.clamp_compression = compression;
    clamp.clamp_to = 2;
    r.step_s = 0.5 * step_bound(r).dt_s;
    return r;
}

} // namespace

TEST(Clamp, TwoBlocksSwingAgainstEachOther)
{
    // w2 = k (1 / m1 + 1 / m2)
    const double k = 2e4, w = std::sqrt(k * (1 / m1 + 1 / m2));
    double before = 0, first = -1, last = 0, time_before = 0;
    int count = -1;
    pushed(
        pair_of_blocks(k, 1e9, 0, 1), 1.0,
        [](int block, double time) {
            return Push{block == 2 && time < 0.01 ? 1.0 : 0, 0, 0};
        },
        [&](double time, const Snapshot& s) {
            const double apart = s.x_m[2] - s.x_m[1];
            if (before < 0 && apart >= 0) {
                last = time_before + (time - time_before) * -before / (apart - before);
                if (first < 0)
                    first = last;
                ++count;
            }
            before = apart;
            time_before = time;
            return true;
        });
    ASSERT_GT(count, 5);
    EXPECT_NEAR((last - first) / count, 2 * pi / w, 2e-3 * 2 * pi / w);
}

TEST(Clamp, YieldsAndTheWorkIsDissipated)
{
    // pulled apart by more than the strength, with equal forces: each moves by (F - F_y) t2 / 2 m, as so stiff a
    // clamp yields at once
    const double k = 1e8, yield = 40, F = 60;
    double x1 = 0, x2 = 0, time = 0;
    pushed(
        pair_of_blocks(k, yield, 0, 1), 0.2,
        [&](int block, double) {
            return Push{block == 1 ? -F / m1 : F / m2, 0, 0};
        },
        [&](double now, const Snapshot& s) {
            x1 = s.x_m[1];
            x2 = s.x_m[2];
            time = now;
            return now < 0.15;
        });
    const double want = 0.5 * (F - yield) * time * time;
    EXPECT_NEAR(-x1, want / m1, 0.01 * want / m1);
    EXPECT_NEAR(x2, want / m2, 0.01 * want / m2);

    // a blow, after which the clamp brings both to the velocity of their common centre: what it takes is the loss
    const Realization r = pair_of_blocks(k, yield, 0, 1);
    double momentum = 0, apart = 0, most = 0;
    const auto outcome = pushed(
        r, 0.5,
        [&](int block, double at) {
            if (block != 2 || at > 0.02)
                return Push{};
            momentum += m2 * 30 * chunk_steps * r.step_s;
            return Push{30, 0, 0};
        },
        [&](double, const Snapshot& s) {
            apart = s.x_m[2] - s.x_m[1];
            most = std::max(most, apart);
            return true;
        });
    ASSERT_TRUE(outcome);
    EXPECT_GT(most, 1e-3);
    EXPECT_GT(apart, 0.99 * most); // what has yielded stays
    const double kinetic = momentum * momentum / (2 * (m1 + m2)), work = outcome->energy_base_work_j;
    EXPECT_LT(std::fabs(outcome->energy_residual), 1e-3);
    EXPECT_NEAR(outcome->energy_kinetic_j, kinetic, 0.01 * kinetic);
    EXPECT_NEAR(outcome->energy_damping_j, work - kinetic, 0.02 * work);
    EXPECT_GT(outcome->energy_damping_j, 0.2 * work);
}

TEST(Clamp, HasPlayAndMayActInTensionAlone)
{
    // pushed together: nothing resists without compression; with it, the gap closes first
    const double k = 2e4, gap = 0.002, w = std::sqrt(k * (1 / m1 + 1 / m2));
    double time = 0;
    const auto most_apart = [&](double compression, double sign) { // the left one is pushed with 1 m/s2
        double most = 0;
        pushed(
            pair_of_blocks(k, 1e9, gap, compression), 0.12,
            [&](int block, double) {
                return Push{block == 1 ? -sign : 0, 0, 0};
            },
            [&](double now, const Snapshot& s) {
                most = std::max(most, std::fabs(s.x_m[2] - s.x_m[1]));
                time = now;
                return true;
            });
        return most;
    };
    const double alone = most_apart(0, -1);
    EXPECT_NEAR(alone, 0.5 * time * time, 0.01 * alone);
    ASSERT_GT(alone, 2 * gap);
    // beyond the play: from the velocity there, under the push, e = 1 / w2 + sqrt(1 / w4 + v2 / w2), v2 = 2 gap
    const double beyond = 1 / (w * w) + std::sqrt(1 / (w * w * w * w) + 2 * gap / (w * w));
    for (const auto& [compression, sign] : {std::pair{0.0, 1.0}, std::pair{1.0, 1.0}, std::pair{1.0, -1.0}})
        EXPECT_NEAR(most_apart(compression, sign), gap + beyond, 0.05 * beyond) << compression << ' ' << sign;
}

TEST(Clamp, AboveTheMiddleItTurnsTheBlocks)
{
    // pulled apart with F at their middles, each bed turns by 12 M / (K B3) under the moment of F about the middle
    const double F = 20, height = 0.03, per_moment = 12 / (1e8 * std::pow(0.2, 3));
    Realization r = pair_of_blocks(1e6, 1e9, 0, 1);
    r.blocks[1].strengthening.clamp_height_m = height;
    for (Joint& joint : r.joints)
        joint.mechanisms.face_damping = 1;
    r.step_s = 0.5 * step_bound(r).dt_s;
    double left = 0, right = 0;
    pushed(
        r, 1,
        [&](int block, double time) {
            const double force = F * std::min(1.0, time / 0.5);
            return Push{block == 1 ? -force / m1 : force / m2, 0, 0};
        },
        [&](double, const Snapshot& s) {
            left = s.theta_rad[1];
            right = s.theta_rad[2];
            return true;
        });
    // the right block's middle is 0.01 m higher
    EXPECT_NEAR(left, -F * height * per_moment, 0.03 * F * height * per_moment);
    EXPECT_NEAR(right, F * (height - 0.01) * per_moment, 0.03 * F * height * per_moment);
}

TEST(Clamp, IsGoneOnceItHasBroken)
{
    const ClampForce<double> whole = clamp_force<double>(1e6, 1e6, 50, 0, 0.01, 0.009, 0.0089, 0);
    EXPECT_EQ(whole.force, 50);
    EXPECT_EQ(whole.broken, 0);
    const ClampForce<double> broken = clamp_force<double>(1e6, 1e6, 50, 0, 0.01, 0.011, whole.set, 0);
    EXPECT_EQ(broken.force, 0);
    EXPECT_EQ(broken.held, 0);
    EXPECT_EQ(clamp_force<double>(1e6, 1e6, 50, 0, 0.01, 0, 0, broken.broken).force, 0);
}

TEST(Clamp, HoldsNothingWhenTheBlocksComeBackAfterItHasBroken)
{
    // a blow to the right, then one back: the left block moves on as it was when the clamp broke
    Realization r = pair_of_blocks(1e6, 40, 0, 1);
    r.blocks[1].strengthening.clamp_break_m = 0.002;
    std::vector<double> x;
    double chunk = 0;
    int back = 0;
    pushed(
        r, 0.3,
        [](int block, double time) {
            return Push{block != 2 ? 0 : time < 0.02 ? 30.0 : time < 0.06 ? -30.0 : 0, 0, 0};
        },
        [&](double now, const Snapshot& s) {
            chunk = now / static_cast<double>(x.size() + 1);
            x.push_back(s.x_m[1]);
            const double apart = s.x_m[2] - s.x_m[1];
            if (now > 0.04 && apart < 0.002) {
                const std::size_t n = x.size();
                EXPECT_NEAR((x[n - 1] - 2 * x[n - 2] + x[n - 3]) / (chunk * chunk), 0, 0.1) << now;
                ++back;
            }
            return apart > -0.02;
        });
    EXPECT_GT(back, 3);
}

TEST(PullOut, TheDowelsHoldUntilTheyAreOut)
{
    // lifted: y'' = a - g - 2 F_a / m while y < length, then y'' = a - g
    const double hold = 15, length = 0.004, a = 2.2 * gravity;
    Realization r = single({0.2, 0.05, 4.0}, {1e9, 0.1}, 1, 1);
    r.joints[0].strengthening = {
        .hold_n = hold, .hold_stiffness_n_m = 1e8, .hold_length_m = length, .hold_spread_m = 0.05};
    r.step_s = 0.5 * step_bound(r).dt_s;
    double y = 0, v = 0, time = 0, worst = 0;
    pushed(
        r, 0.1,
        [&](int, double) {
            return Push{0, a, 0};
        },
        [&](double now, const Snapshot& s) {
            while (time < now - 1e-12) {
                const double dt = std::min(1e-6, now - time), rate = a - gravity - (y < length ? 2 * hold / 4.0 : 0);
                y += dt * (v + 0.5 * dt * rate);
                v += dt * rate;
                time += dt;
            }
            worst = std::max(worst, std::fabs(s.y_m[1] - y));
            return y < 0.02;
        });
    EXPECT_LT(worst, 5e-4); // what the beds give back and the dowels give way before they slip
    EXPECT_GT(y, 0.02);
}

TEST(PullOut, TheyHoldAgainstTheReturnUntilTheyAreOut)
{
    // let go after a lift: y'' = 2 F_a / m - g while they slip back, and -g for ever once they are out
    const double hold = 12, m = 4;
    for (const double length : {0.05, 0.002}) {
        Realization r = single({0.2, 0.05, m}, {1e8, 0.1}, 1, 1);
        r.joints[0].strengthening = {
            .hold_n = hold, .hold_stiffness_n_m = 1e7, .hold_length_m = length, .hold_spread_m = 0.05};
        r.step_s = 0.5 * step_bound(r).dt_s;
        std::vector<double> y;
        double chunk = 0, top = 0;
        pushed(
            r, 0.3,
            [&](int, double time) {
                return Push{0, time < 0.03 ? 2.5 * gravity : 0, 0};
            },
            [&](double now, const Snapshot& s) {
                chunk = now / static_cast<double>(y.size() + 1);
                y.push_back(s.y_m[1]);
                top = std::max(top, y.back());
                return y.back() > 0.5 * std::min(top, length) || now < 0.03;
            });
        ASSERT_GT(top, 0.003);
        ASSERT_GT(y.size(), 3u);
        const double last = (y[y.size() - 1] - 2 * y[y.size() - 2] + y[y.size() - 3]) / (chunk * chunk);
        const double want = (length > top ? 2 * hold / m : 0) - gravity;
        EXPECT_NEAR(last, want, 0.05 * gravity) << length;
    }
    EXPECT_EQ(hold_force<double>(10, 1e6, 1e-6, 0.01, 0.005, 0, 1).force, 0);
}

TEST(PullOut, TheirDistanceResistsRotation)
{
    // a block that is lifted by a hangs on both: I theta'' = -(2 k e2 + m (a - g) h) theta, e the distance
    const double k = 1e6, distance = 0.06, m = 4, a = 3 * gravity, I = m * (0.04 + 0.0025) / 12;
    Realization r = single({0.2, 0.05, m}, {1e6, 0, 0}, 1, 1);
    r.joints[0].strengthening = {.hold_n = 1e9, .hold_stiffness_n_m = k, .hold_length_m = 1, .hold_spread_m = distance};
    r.step_s = 0.005 * step_bound(r).dt_s;
    const double want = 2 * pi / std::sqrt((2 * k * distance * distance + m * (a - gravity) * 0.025) / I);
    double before = 0, time_before = 0, first = -1, last = 0;
    int count = -1;
    pushed(
        r, 40 * want,
        [&](int, double time) {
            return Push{0, a * std::min(1.0, time / (20 * want)), time < 0.5 * want ? 1.0 : 0};
        },
        [&](double time, const Snapshot& s) {
            if (time > 21 * want && before < 0 && s.theta_rad[1] >= 0) {
                last = time_before + (time - time_before) * -before / (s.theta_rad[1] - before);
                if (first < 0)
                    first = last;
                ++count;
            }
            before = s.theta_rad[1];
            time_before = time;
            return true;
        });
    ASSERT_GT(count, 5);
    EXPECT_NEAR((last - first) / count, want, 0.01 * want);
}

TEST(PullOut, TwoDowelsResistRockingAtTheirLeverArms)
{
    // m a h = W b + F_a (b - e) + F_a (b + e) about the corner, wherever the two are, less what the bed yields
    const double hold = 10, want = most_acceleration(mono_stone, 1e10, 2 * hold);
    for (const double spread : {0.0, 0.015}) {
        Realization r = single(mono_stone, {1e10, 0.1, 5}, 1);
        r.joints[0].strengthening = {
            .hold_n = hold, .hold_stiffness_n_m = 1e7, .hold_length_m = 0.05, .hold_spread_m = spread};
        r.joints[0].mechanisms.face_damping = 1;
        r.step_s = 0.5 * step_bound(r).dt_s;
        const double got = ramped(r, 20, 1.1 * want, {1, 0, 0},
                                  [](const Snapshot& s, double) { return std::fabs(s.theta_rad[1]) > 2e-3; });
        EXPECT_NEAR(got, want, 0.015 * want) << spread;
    }
}

TEST(PullOut, ItsLossesAreInTheBalance)
{
    Realization r = single(mono_stone, {1e8, 0.1, 0.6}, 1);
    r.joints[0].strengthening = {.hold_n = 2, .hold_stiffness_n_m = 1e6, .hold_length_m = 0.003, .hold_spread_m = 0.01};
    r.step_s = 0.5 * step_bound(r).dt_s;
    r.frequency_hz = 3;
    r.pga_m_s2 = 6;
    const Outcome o = run_one(harmonic(6, 1), r);
    EXPECT_NE(o.state, State::invalid);
    EXPECT_GT(o.total_rocking_rad, 0.02);
    EXPECT_LT(std::fabs(o.energy_residual), 0.02);
}

/// Tendons, each against its closed form or an equation of motion that is integrated here.

#include "ensemble/planar/structure/settle.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "kernels/planar/mechanisms/tendon.hpp"
#include "tests/kernels/strengthening/strengthened_runs.hpp"

#include <gtest/gtest.h>

using namespace stylobate;
using namespace stylobate::model;

namespace {

const double weight_n = mono_stone.mass * gravity;

Realization held_block(double K_n, double xi, double prestress, double stiffness)
{
    Realization r = single(mono_stone, {K_n, xi, 5}, 1);
    r.blocks[1].strengthening.tendon_n_m = stiffness;
    r.blocks[1].strengthening.tendon_prestress_n = prestress;
    r.step_s = 0.5 * step_bound(r).dt_s;
    return r;
}

/// Tension of the cable and its moment about the corner on which the rigid block rocks by `theta`.
struct Cable {
    double prestress, stiffness;
    double tension(double theta) const
    {
        return std::max(0.0, prestress + stiffness * (std::hypot(x(theta), y(theta)) - mono_stone.height));
    }
    /// The upper anchor from the lower one. The corner is at the left, the axis half a width beside it.
    double x(double theta) const { return arm_x(theta) - 0.5 * mono_stone.width; }
    double y(double theta) const { return arm_y(theta); }
    double arm_x(double theta) const
    {
        return 0.5 * mono_stone.width * std::cos(theta) - mono_stone.height * std::sin(theta);
    }
    double arm_y(double theta) const
    {
        return 0.5 * mono_stone.width * std::sin(theta) + mono_stone.height * std::cos(theta);
    }
    /// Counter-clockwise.
    double moment(double theta) const
    {
        const double l = std::hypot(x(theta), y(theta)), T = tension(theta);
        return T / l * (-arm_x(theta) * y(theta) + arm_y(theta) * x(theta));
    }
};

/// Time in which the rigid block falls from a tilt, counter-clockwise about its left corner, back to upright.
double quarter_period_s(const Cable& cable, double tilt)
{
    const double b = 0.5 * mono_stone.width, h = 0.5 * mono_stone.height, R = std::hypot(b, h),
                 alpha = std::atan(b / h);
    const double inertia = 4.0 / 3 * mono_stone.mass * R * R;
    const auto rate = [&](double theta) {
        return (-weight_n * R * std::sin(alpha - theta) + cable.moment(theta)) / inertia;
    };
    double theta = tilt, w = 0, time = 0;
    const double dt = 1e-6;
    while (theta > 0) { // by the midpoint rule
        const double half = theta + 0.5 * dt * w, w_half = w + 0.5 * dt * rate(theta);
        theta += dt * w_half;
        w += dt * rate(half);
        time += dt;
    }
    return time;
}

double simulated_quarter_s(const Realization& upright, double tilt)
{
    Realization r = upright;
    r.initial_tilt_rad = tilt;
    double before = tilt, time_before = 0, found = -1;
    pushed(
        r, 1, [](int, double) { return Push{}; },
        [&](double time, const Snapshot& s) {
            const double theta = s.theta_rad[1];
            if (theta <= 0)
                found = time_before + (time - time_before) * before / (before - theta);
            before = theta;
            time_before = time;
            return found < 0;
        });
    return found;
}

} // namespace

TEST(Tendon, IsSlackElasticAndYields)
{
    EXPECT_EQ(tendon_force<double>(1e6, 1e-3, 5e3, -2e-3, 0).tension, 0);
    EXPECT_EQ(tendon_force<double>(1e6, 1e-3, 5e3, 0, 0).tension, 1e3);
    EXPECT_NEAR(tendon_force<double>(1e6, 1e-3, 5e3, 2e-3, 0).tension, 3e3, 1e-9);
    const TendonForce<double> yields = tendon_force<double>(1e6, 1e-3, 5e3, 6e-3, 0);
    EXPECT_EQ(yields.tension, 5e3);
    EXPECT_NEAR(yields.set, 2e-3, 1e-15);
    // back at rest it is slack
    EXPECT_EQ(tendon_force<double>(1e6, 1e-3, 5e3, 0, yields.set).tension, 0);
    EXPECT_EQ(tendon_force<double>(0, 0, 0, 0.1, 0).tension, 0);
}

TEST(Tendon, ItsPrestressCompressesEveryBedBelow)
{
    const double K_n = 1e8, T = 50;
    Realization r = spec({K_n, 0.1}, 1e-5);
    r.blocks[4].strengthening.tendon_n_m = 1e5;
    r.blocks[4].strengthening.tendon_prestress_n = T;
    const StaticState s = static_state(r);
    double down = 0;
    for (std::size_t i = 1; i <= 6; ++i) {
        const double above = static_cast<double>(7 - i) * spec_drum.mass * gravity + (i <= 4 ? T : 0);
        down += above / (K_n * spec_drum.width);
        EXPECT_NEAR(s.y_m[i], -down, 1e-12) << i;
        EXPECT_NEAR(s.theta_rad[i], 0, 1e-15) << i;
    }
    for (int bed = 0; bed < 6; ++bed)
        EXPECT_NEAR(beds_at_rest(r)[static_cast<std::size_t>(bed)].force_n,
                    (6 - bed) * spec_drum.mass * gravity + (bed < 4 ? T : 0), 1e-12)
            << bed;
    // Newton's method finds the same
    std::vector<Pose> poses;
    for (const Block& block : r.blocks)
        poses.push_back({block.x_m, block.y_m, 0});
    std::vector<double> spring;
    EXPECT_LT(settle(r, beds_at_rest(r), poses, spring), 1e-9);
    for (std::size_t i = 1; i <= 6; ++i)
        EXPECT_NEAR(poses[i].y - r.blocks[i].y_m, s.y_m[i], 1e-11) << i;
}

TEST(Tendon, ARockingBlockFollowsTheEquationOfMotion)
{
    const double tilt = 0.5 * slenderness(mono_stone);
    const double without = quarter_period_s({0, 0}, tilt);
    EXPECT_NEAR(without, 0.14617, 1e-4); // Housner
    for (const auto& [prestress, stiffness] :
         {std::pair{0.0, 3e3}, std::pair{weight_n, 3e3}, std::pair{2 * weight_n, 2e4}}) {
        const Cable cable{prestress, stiffness};
        const double want = quarter_period_s(cable, tilt);
        EXPECT_LT(want, 0.92 * without);
        const double got = simulated_quarter_s(held_block(1e10, 0.1, prestress, stiffness), tilt);
        EXPECT_NEAR(got, want, 0.01 * want) << prestress;
    }
}

TEST(Tendon, UpliftBeginsAtTheWeightAndThePrestress)
{
    // m a h = (W + T0) b about the corner, less what the bed yields
    const double T = 1.5 * weight_n, rigid = gravity * mono_stone.width / mono_stone.height * (1 + T / weight_n);
    const double want = most_acceleration(mono_stone, 1e10, T);
    EXPECT_NEAR(want, rigid, 0.03 * rigid);
    Realization r = held_block(1e10, 0.1, T, 1); // so soft that the tension hardly changes
    for (Joint& joint : r.joints)
        joint.mechanisms.face_damping = 1;
    r.step_s = 0.5 * step_bound(r).dt_s;
    const double got = ramped(r, 20, 1.1 * want, {1, 0, 0},
                              [](const Snapshot& s, double) { return std::fabs(s.theta_rad[1]) > 2e-3; });
    EXPECT_NEAR(got, want, 0.015 * want);
}

TEST(Tendon, HoldsABlockThatIsLiftedUntilItYieldsAndIsSlackThen)
{
    // m y'' = F - W - T, T = T0 + k (y - y_p) between 0 and T_y; y_p is what it has yielded by. F ends at 0.045 s
    const double k = 2e3, T0 = 5, yield = 12, up = 4 * gravity, end = 0.045;
    Realization r = held_block(1e9, 0.1, T0, k);
    r.blocks[1].strengthening.tendon_yield_n = yield;
    const double m = mono_stone.mass;
    double y = 0, v = 0, set = 0, time = 0, push = 0;
    const auto tension = [&](double at) { return std::clamp(T0 + k * (std::max(at, 0.0) - set), 0.0, yield); };
    double worst = 0, most = 0, last = 0;
    pushed(
        r, 0.5,
        [&](int, double now) {
            push = now < end ? up : 0;
            return Push{0, push, 0};
        },
        [&](double now, const Snapshot& s) {
            while (time < now - 1e-12) {
                const double dt = std::min(1e-6, now - time);
                const double half = y + 0.5 * dt * v, v_half = v + 0.5 * dt * (push - gravity - tension(y) / m);
                y += dt * v_half;
                v += dt * (push - gravity - tension(half) / m);
                set = std::max(set, y - (yield - T0) / k);
                time += dt;
            }
            worst = std::max(worst, std::fabs(s.y_m[1] - y));
            last = s.y_m[1];
            most = std::max(most, last);
            return now < end || last > 0.002;
        });
    EXPECT_GT(most, 2 * (yield - T0) / k); // well into the yield
    EXPECT_LT(last, 0.003);                // and down again, where it is slack
    EXPECT_LT(worst, 3e-3 * most);
}

TEST(Tendon, ItsEnergyIsInTheBalance)
{
    Realization r = held_block(1e8, 0.1, weight_n, 2e4);
    for (const double yield : {1e12, 1.5 * weight_n}) {
        Realization shaken = r;
        shaken.blocks[1].strengthening.tendon_yield_n = yield;
        shaken.frequency_hz = 3;
        shaken.pga_m_s2 = 9;
        const Outcome o = run_one(harmonic(6, 1), shaken);
        EXPECT_NE(o.state, State::invalid);
        EXPECT_GT(o.total_rocking_rad, 0.01);
        EXPECT_LT(std::fabs(o.energy_residual), 0.02) << yield;
    }
}

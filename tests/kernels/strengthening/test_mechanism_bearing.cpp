/// Bearings, each against its closed form or an equation of motion that is integrated here.

#include "ensemble/planar/structure/step_bound.hpp"
#include "tests/kernels/strengthening/strengthened_runs.hpp"

#include <gtest/gtest.h>

using namespace stylobate;
using namespace stylobate::model;

namespace {

const Stone raft{0.4, 0.05, 6.0};

Realization on_bearing(double mu, double stiffness, double dashpot, double radius)
{
    Realization r = single(raft, {1e8, 0.2, mu}, 1, 2);
    r.joints[0].strengthening = {
        .bearing_n_m = stiffness, .bearing_n_s_m = dashpot, .bearing_per_m = radius > 0 ? 1 / radius : 0};
    r.step_s = 0.5 * step_bound(r).dt_s;
    return r;
}

/// Time between the first and the last of the upward passages through 0, over their number.
class Period {
public:
    void add(double time, double x)
    {
        if (before_ < 0 && x >= 0) {
            const double at = last_ + (time - last_) * -before_ / (x - before_);
            (count_ < 0 ? first_ : end_) = at;
            ++count_;
        }
        before_ = x;
        last_ = time;
    }
    double value() const { return (end_ - first_) / count_; }

private:
    double before_ = 0, last_ = 0, first_ = 0, end_ = 0;
    int count_ = -1;
};

/// Of a raft that is pushed for a moment and then left alone.
double free_period_s(const Realization& r, double duration_s)
{
    Period period;
    pushed(
        r, duration_s,
        [](int, double time) {
            return Push{time < 0.02 ? 3.0 : 0, 0, 0};
        },
        [&](double time, const Snapshot& s) {
            period.add(time, s.x_m[1]);
            return true;
        });
    return period.value();
}

} // namespace

TEST(Bearing, APendulumHasThePeriodOfItsRadius)
{
    for (const double R : {0.25, 1.0}) {
        const double want = 2 * pi * std::sqrt(R / gravity);
        EXPECT_NEAR(free_period_s(on_bearing(0, 0, 0, R), 5 * want), want, 1e-3 * want) << R;
    }
}

TEST(Bearing, AnElastomerHasThePeriodOfItsStiffness)
{
    const double want = 2 * pi * std::sqrt(raft.mass / 300);
    EXPECT_NEAR(free_period_s(on_bearing(0, 300, 0, 0), 5 * want), want, 1e-3 * want);
}

TEST(Bearing, ADampedOscillatorUnderASine)
{
    // steady amplitude of the offset: a / sqrt((w0^2 - w^2)^2 + (2 zeta w0 w)^2)
    const double k = 1200, zeta = 0.15, w0 = std::sqrt(k / raft.mass), c = 2 * zeta * w0 * raft.mass, pga = 0.8;
    for (const double ratio : {0.6, 1.0, 1.7}) {
        Realization r = on_bearing(0, k, c, 0);
        r.frequency_hz = ratio * w0 / (2 * pi);
        r.pga_m_s2 = pga;
        const double w = ratio * w0, cycles = 20, end = cycles / r.frequency_hz;
        double most = 0, time = 0;
        run_all(harmonic(cycles, 2), {r}, nullptr, [&](std::size_t, const Snapshot& s) {
            time += chunk_steps * r.step_s;
            if (time > 0.7 * end && time < 0.9 * end)
                most = std::max(most, std::fabs(s.x_m[1]));
        });
        const double want = pga / std::hypot(w0 * w0 - w * w, 2 * zeta * w0 * w);
        EXPECT_NEAR(most, want, 5e-3 * want) << ratio;
    }
}

TEST(Bearing, AFrictionPendulumSticksAndSlipsAsItsOwnEquation)
{
    // s'' = p - g s / R - mu g sign(s'), one degree of freedom, with Coulomb's law by impulses
    const double R = 0.5, mu = 0.06;
    const Realization r = on_bearing(mu, 0, 0, R);
    const auto push = [](double time) { return 1.4 * std::sin(2 * pi * 1.1 * time) * std::exp(-0.4 * time); };
    double s = 0, v = 0, time = 0, acceleration = 0, worst = 0, most = 0;
    int stuck = 0, all = 0;
    pushed(
        r, 5,
        [&](int, double now) {
            acceleration = push(now);
            return Push{acceleration, 0, 0};
        },
        [&](double now, const Snapshot& snapshot) {
            constexpr int steps = 200;
            const double dt = (now - time) / steps;
            for (int i = 0; i < steps; ++i) {
                const double free = v + dt * (acceleration - gravity * s / R);
                v = free - std::clamp(free, -mu * gravity * dt, mu * gravity * dt);
                s += dt * v;
                stuck += v == 0;
                ++all;
            }
            time = now;
            worst = std::max(worst, std::fabs(snapshot.x_m[1] - s));
            most = std::max(most, std::fabs(s));
            return true;
        });
    EXPECT_GT(most, 0.02);
    EXPECT_GT(stuck, all / 10); // it does stick
    EXPECT_LT(stuck, 9 * all / 10);
    EXPECT_LT(worst, 0.01 * most);
}

TEST(Bearing, HoldsALiftedBlockAsFarAsADowelDoes)
{
    // to half of the smaller half height: x'' = -k s / m below, s at the bottom face, and 0 above
    const double k = 2e3, reach = 0.5 * 0.025;
    const Realization r = on_bearing(0, k, 0, 0);
    std::vector<double> x, face;
    double chunk = 0;
    int below = 0, above = 0;
    pushed(
        r, 1,
        [](int, double time) {
            return Push{time < 0.03 ? 20.0 : 0, time < 0.03 ? 12.0 : 1.2 * gravity, 0};
        },
        [&](double now, const Snapshot& s) {
            chunk = now / static_cast<double>(x.size() + 1);
            x.push_back(s.x_m[1]);
            face.push_back(s.x_m[1] + 0.5 * raft.height * std::sin(s.theta_rad[1]));
            const double y = s.y_m[1];
            if (now < 0.04 || x.size() < 3)
                return true;
            const double rate = (x[x.size() - 1] - 2 * x[x.size() - 2] + x[x.size() - 3]) / (chunk * chunk);
            if (y > 0 && y < 0.9 * reach) {
                EXPECT_NEAR(rate, -k * face[x.size() - 2] / raft.mass, 0.05) << now;
                ++below;
            }
            if (y > 1.2 * reach) {
                EXPECT_NEAR(rate, 0, 0.05) << now;
                ++above;
            }
            return y < 3 * reach;
        });
    EXPECT_GT(below, 3);
    EXPECT_GT(above, 3);
}

TEST(Bearing, ABlockRocksOnItAsOnAnyBed)
{
    for (const double k : {0.0, 2e5}) {
        Realization r = single(mono_stone, {1e9, 0.1, 0.6}, 1);
        r.joints[0].strengthening.bearing_n_m = k;
        r.step_s = 0.5 * step_bound(r).dt_s;
        r.frequency_hz = 3;
        r.pga_m_s2 = 4;
        const Outcome o = run_one(harmonic(4, 1), r);
        EXPECT_GT(o.total_rocking_rad, 0.02) << k;
        EXPECT_NE(o.state, State::invalid);
        EXPECT_LT(std::fabs(o.energy_residual), 0.02) << k;
    }
}

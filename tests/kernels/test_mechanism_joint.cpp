/// Mechanisms of friction and of dowels, each against its closed form, through the real kernel.

#include "studies/evidence/verification/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace stylobate;
using namespace stylobate::model;

namespace {

const Stone slab{0.2, 0.05, 4.0};
constexpr double dt = 2e-5;

/// A slab on a slope of tan = `slope`, wide enough to slide on.
Realization on_slope(double slope, double mu)
{
    Realization r = single(slab, {1e8, 0.3, mu}, dt, 8);
    r.base_tilt_rad = std::atan(slope);
    return r;
}

/// Called with the time [s] and the slab's displacement down the slope [m], after every step.
using Watch = std::function<void(double time, double x)>;

void slide(const Realization& r, double duration_s, const Watch& watch)
{
    const Study study = still(duration_s);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const double start = set.snapshot(0).x_m[1];
    int steps = 0;
    while (!set.outcome(0)) {
        for (int k = 0; k < chunk_steps; ++k) {
            set.advance(k, k + 1);
            watch(++steps * dt, set.snapshot(0).x_m[1] - start);
        }
    }
    EXPECT_LT(std::fabs(set.outcome(0)->energy_residual), 1e-3);
}

double end_of_slide(const Realization& r, double duration_s)
{
    double end = 0;
    slide(r, duration_s, [&](double, double x) { end = x; });
    return end;
}

} // namespace

TEST(Stribeck, ASlidingSlabFollowsTheEquationOfItsFriction)
{
    // v' = g (sin - mu(v) cos) by Runge and Kutta
    const double slope = 0.5, mu = 0.45, ratio = 0.4, v_s = 0.2;
    Realization r = on_slope(slope, mu);
    r.joints[0].mechanisms.dynamic_ratio = ratio;
    r.joints[0].mechanisms.stribeck_velocity_m_s = v_s;
    const double c = std::cos(std::atan(slope)), s = c * slope;
    const auto rate = [&](double v) {
        return gravity * (s - c * mu * (ratio + (1 - ratio) * std::exp(-std::fabs(v) / v_s)));
    };
    double x = 0, v = 0;
    double steady = 0, last = 0, before = 0;
    slide(r, 0.6, [&](double, double got) {
        const double k1 = rate(v), k2 = rate(v + 0.5 * dt * k1), k3 = rate(v + 0.5 * dt * k2), k4 = rate(v + dt * k3);
        x += dt * (v + dt * (k1 + k2 + k3) / 6);
        v += dt * (k1 + 2 * k2 + 2 * k3 + k4) / 6;
        steady = got - last - (last - before);
        before = last;
        last = got;
    });
    EXPECT_NEAR(last, x, 2e-3 * x);
    // at many times v_s the dynamic friction is left
    EXPECT_GT(v, 6 * v_s);
    EXPECT_NEAR(steady / (dt * dt), gravity * (s - c * mu * ratio), 1e-3 * gravity);
}

TEST(FrictionWear, TheSlopeOfItsOwnSlipDecides)
{
    // S'' = A + B S with A = g (sin - mu cos), B = g mu k cos: S = A / B (cosh(sqrt(B) t) - 1)
    const double slope = 0.5, mu = 0.4, k = 0.5, time = 0.7;
    Realization r = on_slope(slope, mu);
    r.joints[0].mechanisms.wear_per_m = k;
    const double c = std::cos(std::atan(slope)), A = gravity * c * (slope - mu), B = gravity * mu * k * c;
    double got = 0, at = 0;
    slide(r, time, [&](double t, double x) {
        got = x;
        at = t;
    });
    const double want = A / B * (std::cosh(std::sqrt(B) * at) - 1);
    EXPECT_NEAR(got, want, 3e-3 * want);
    EXPECT_GT(want, 1.05 * 0.5 * A * at * at); // which plain friction would not reach
}

TEST(Adhesion, TheFirstSlipBeginsAtFrictionAndBond)
{
    const double slope = 0.5, mu = 0.4;
    Realization r = on_slope(slope, mu);
    const double c = std::cos(std::atan(slope)), W = slab.mass * gravity;
    const double needed = W * c * (slope - mu) / slab.width;
    r.joints[0].mechanisms.adhesion_n_m = 1.02 * needed;
    EXPECT_LT(std::fabs(end_of_slide(r, 0.5)), 1e-6);
    r.joints[0].mechanisms.adhesion_n_m = 0.98 * needed;
    // once it is broken, friction is all there is
    const double fallen = 0.5 * gravity * c * (slope - mu) * 0.25;
    EXPECT_NEAR(end_of_slide(r, 0.5), fallen, 5e-3 * fallen);
}

TEST(Dowel, StopsTheSlideWhereItsEnergySays)
{
    // no friction: W sin s = k (s - gap)^2 / 2 at the farthest point
    const double slope = 0.3, k = 2e4, gap = 0.003;
    Realization r = on_slope(slope, 0);
    r.joints[0].mechanisms.dowel_stiffness_n_m = k;
    r.joints[0].mechanisms.dowel_yield_n = 1e9;
    r.joints[0].mechanisms.dowel_gap_m = gap;
    const double pull = slab.mass * gravity * std::sin(std::atan(slope));
    const double want = gap + pull / k + std::sqrt(pull * pull / (k * k) + 2 * pull * gap / k);
    double most = 0;
    slide(r, 0.3, [&](double, double x) { most = std::max(most, x); });
    EXPECT_NEAR(most, want, 1e-3 * want);
}

TEST(Dowel, RestsAtGapAndForceOverStiffness)
{
    const double slope = 0.5, mu = 0.4, k = 2e4, gap = 0.002;
    Realization r = on_slope(slope, mu);
    r.joints[0].mechanisms.dowel_stiffness_n_m = k;
    r.joints[0].mechanisms.dowel_yield_n = 1e9;
    r.joints[0].mechanisms.dowel_gap_m = gap;
    // it comes to rest with friction holding on either side of gap + (W sin -+ mu W cos) / k
    const double c = std::cos(std::atan(slope)), W = slab.mass * gravity;
    const double end = end_of_slide(r, 1);
    EXPECT_GE(end, gap + W * c * (slope - mu) / k - 1e-6);
    EXPECT_LE(end, gap + W * c * (slope + mu) / k + 1e-6);
    // and does so with the dowel's force at the yield where it gives way: then it runs on
    r.joints[0].mechanisms.dowel_yield_n = 0.5 * W * c * (slope - mu);
    double last = 0, before = 0, steady = 0;
    slide(r, 0.5, [&](double, double x) {
        steady = x - last - (last - before);
        before = last;
        last = x;
    });
    EXPECT_NEAR(steady / (dt * dt), 0.5 * gravity * c * (slope - mu), 1e-3 * gravity);
}

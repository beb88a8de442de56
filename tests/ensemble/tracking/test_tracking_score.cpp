/// The score of free windows against closed forms, and what cameras saw as the model sees it.

#include "ensemble/numerics/interval.hpp"
#include "ensemble/tracking/tracking_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace stylobate;

namespace {

/// t with 4 degrees of freedom: its distribution function in closed form, u = t / sqrt(4 + t2).
double student4_probability(double t)
{
    const double u = t / std::sqrt(4 + t * t);
    return 0.5 + 0.75 * u * (1 - u * u / 3);
}

/// A block that is moved as `of_time` says, seen at 500 Hz for one second; the base is at rest until .1 s.
template <class Function>
MeasuredRun one_block(Function of_time)
{
    MeasuredRun run;
    run.rate_hz = 500;
    for (int i = 0; i <= 500; ++i) {
        run.time_s.push_back(10 + 0.002 * i);
        run.blocks.x_m.values.push_back(0.3 + of_time(0.002 * i));
        run.blocks.y_m.values.push_back(0.1);
        run.blocks.theta_rad.values.push_back(5 * of_time(0.002 * i));
    }
    run.blocks.x_m.noise_sd = run.blocks.y_m.noise_sd = 1e-4;
    run.blocks.theta_rad.noise_sd = 1e-3;
    return run;
}

Motion pushed_after(double time_s)
{
    Motion motion;
    motion.dt_s = 0.002;
    for (int i = 0; i <= 500; ++i) {
        motion.acceleration_m_s2.push_back(0.002 * i < time_s ? 0 : 1e-9); // moves nothing that shows
        motion.velocity_m_s.push_back(0);
        motion.displacement_m.push_back(0);
    }
    return motion;
}

} // namespace

TEST(TrackingScore, TheDensityIsStudents)
{
    // with 4 degrees 3/8 (1 + t2/4)^(-5/2), with 1 Cauchy's
    for (const double t : {0.0, 0.3, -1.7, 12.0, 400.0}) {
        EXPECT_NEAR(log_student(t, 4), std::log(0.375) - 2.5 * std::log(1 + t * t / 4), 1e-12) << t;
        EXPECT_NEAR(log_student(t, 1), -std::log(std::numbers::pi * (1 + t * t)), 1e-12) << t;
    }
    for (const double t : {0.5, 2.776445, 5.0})
        EXPECT_NEAR(student_quantile(student4_probability(t), 4), t, 1e-9);
}

TEST(TrackingScore, TheScaleIsTheLikeliest)
{
    // two residuals a and b > 0: with one of size z alone, k2 = (n + 1) z2 / (n + z2 / k2), so k = z
    EXPECT_NEAR(student_scale({3}, 4), 3, 1e-9);
    EXPECT_NEAR(student_scale({-2, 2, 2}, 4), 2, 1e-9);
    EXPECT_TRUE(std::isnan(student_scale({}, 4)));
    // quantiles of t4 times 2.5, as many as make the sum an integral: 2.5 again
    std::vector<double> z;
    for (int i = 0; i < 4000; ++i)
        z.push_back(2.5 * student_quantile((i + 0.5) / 4000, 4));
    const double k = student_scale(z, 4);
    EXPECT_NEAR(k, 2.5, 0.005);
    const auto likelihood = [&](double scale) {
        double sum = 0;
        for (const double value : z)
            sum += log_student(value / scale, 4) - std::log(scale);
        return sum;
    };
    EXPECT_GT(likelihood(k), likelihood(1.002 * k));
    EXPECT_GT(likelihood(k), likelihood(0.998 * k));
}

TEST(TrackingScore, AWindowIsScoredByItsResiduals)
{
    std::vector<SeenValue> seen(2);
    seen[0].value = 1.0;
    seen[0].scale = 0.1;
    seen[1].value = 2.0;
    seen[1].scale = 0.5;
    seen[1].coordinate = BlockCoordinate::y;
    seen[1].kind = 2;
    const Readings readings{{1.2}, {2.25}, {0}};
    const std::vector<double> z = residuals(seen, readings, 1, {0.5});
    ASSERT_EQ(z.size(), 2U);
    EXPECT_NEAR(z[0], 2, 1e-12);
    EXPECT_NEAR(z[1], -0.5, 1e-12); // (2.25 - .5 - 2) / .5
    const ResidualScales scales(residual_kinds(1));
    EXPECT_NEAR(scales.score(seen, z), log_student(2, 4) - std::log(0.1) + log_student(-0.5, 4) - std::log(0.5), 1e-12);
    const Readings lost{{std::numeric_limits<double>::quiet_NaN()}, {2.25}, {0}};
    EXPECT_EQ(residuals(seen, lost, 1, {0.5})[0], 1e4);
}

TEST(TrackingScore, KindsWithFewResidualsShareTheirScale)
{
    ResidualScales scales(residual_kinds(2));
    SeenValue of_first, of_second;
    of_second.block = 1;
    of_second.kind = coordinate_count * 2;
    for (int i = 0; i < 20; ++i)
        scales.add({of_first}, {i % 2 == 0 ? 3.0 : -3.0});
    scales.add({of_second}, {3.0});
    scales.fit();
    EXPECT_NEAR(scales.k(0), 3, 1e-9);
    EXPECT_NEAR(scales.k(of_second.kind), 3, 1e-9);
    EXPECT_EQ(scales.k(1), 1) << "nothing rocked";
}

TEST(TrackingTargets, AParabolaIsSeenAsItIs)
{
    // x = 3 t2 - t from where it stood, which is at t = 0; the base is at rest
    const MeasuredRun run = one_block([](double t) { return t < 0.2 ? 0.0 : 3 * (t - 0.2) * (t - 0.2); });
    const SeenRun seen = seen_run(run, pushed_after(0.2), {1}, {0.0, 0.29}, 0.01);
    ASSERT_EQ(seen.blocks, 2U);
    EXPECT_NEAR(seen.quiet_s, 0.2, 1e-9);
    EXPECT_NEAR(seen.standing_x_m[1], 0.01, 1e-9);
    EXPECT_TRUE(std::isnan(seen.standing_x_m[0]));
    for (const std::size_t k : {150U, 300U, 499U}) {
        const double t = 0.002 * static_cast<double>(k) - 0.2;
        EXPECT_NEAR(seen.smooth[0][2 * k + 1], 3 * t * t, 1e-9);
        EXPECT_NEAR(seen.rate[0][2 * k + 1], 6 * t, 1e-7);
        EXPECT_NEAR(seen.rate[2][2 * k + 1], 30 * t, 1e-7);
        EXPECT_TRUE(std::isnan(seen.smooth[0][2 * k]));
    }
    const Targets targets = targets_of(seen);
    EXPECT_NEAR(targets.spacing_s, 0.002, 1e-12);
    EXPECT_NEAR(targets.x_m[2 * 300 + 1], 3 * 0.16, 1e-9);
    EXPECT_NEAR(targets.velocity_m_s[2 * 300 + 1], 2.4, 1e-7);
}

TEST(TrackingTargets, WindowsFollowEachOtherAndEndBeforeACollapse)
{
    MeasuredRun run = one_block([](double) { return 0.0; });
    run.collapsed = true;
    run.collapse_time_s = 10.85;
    const SeenRun seen = seen_run(run, pushed_after(0.1), {0}, {0.3}, 0.01);
    const std::vector<SeenWindow> windows = windows_of(seen, 0.2);
    ASSERT_EQ(windows.size(), 3U); // .1 to .3, .3 to .5, .5 to .7; the next one would end at .9
    for (std::size_t w = 0; w < windows.size(); ++w) {
        EXPECT_NEAR(windows[w].window.start_s, 0.1 + 0.2 * static_cast<double>(w), 1e-9);
        EXPECT_NEAR(windows[w].window.times_s[0], windows[w].window.start_s + 0.1, 1e-9);
        EXPECT_NEAR(windows[w].window.times_s[1], windows[w].window.start_s + 0.2, 1e-9);
        EXPECT_EQ(windows[w].rows[1], static_cast<std::size_t>(std::lround(windows[w].window.times_s[1] * 500)));
    }
}

TEST(TrackingTargets, WhatWasNotSeenIsNotScored)
{
    MeasuredRun run = one_block([](double t) { return 0.01 * std::sin(20 * t); });
    for (std::size_t k = 100; k < 200; ++k)
        run.blocks.theta_rad.values[k] = std::numeric_limits<double>::quiet_NaN();
    const SeenRun seen = seen_run(run, pushed_after(0.02), {0}, {0.3}, 0.01);
    const std::vector<SeenWindow> windows = windows_of(seen, 0.2);
    const std::vector<std::vector<SeenValue>> values = seen_values(seen, windows, 0.02);
    ASSERT_EQ(values.size(), 4U);
    EXPECT_EQ(values[0].size(), 5U); // .12 and .22 s: no rotation at the end
    EXPECT_EQ(values[2].size(), 6U);
    for (const SeenValue& value : values[2])
        if (value.coordinate == BlockCoordinate::x) {
            // noise, and 20 ms times the speed of .2 m/s at the most
            EXPECT_GT(value.scale, 1e-4);
            EXPECT_LE(value.scale, 1e-4 + 0.02 * 0.2);
            EXPECT_EQ(value.kind % 2, 1U) << "it turns by 50 mrad";
        }
    EXPECT_TRUE(std::isnan(targets_of(seen).theta_rad[150]));
    EXPECT_FALSE(std::isnan(targets_of(seen).x_m[150]));
}

TEST(TrackingTargets, ScalesGoWithThePendulumTime)
{
    const TrackingScales small = tracking_scales(0.048, 9.81), large = tracking_scales(1.5, 9.81);
    EXPECT_NEAR(small.window_s, 0.2, 1e-9);
    EXPECT_NEAR(small.nudge_rad_s, 60, 1e-9);
    EXPECT_NEAR(large.window_s / small.window_s, std::sqrt(1.5 / 0.048), 1e-9);
    EXPECT_NEAR(large.nudge_rad_s, 24, 1);
}

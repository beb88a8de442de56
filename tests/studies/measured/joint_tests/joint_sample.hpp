#pragma once
/// A column of small blocks for the tests of single joints, the noise of cameras and gauge, and what is expected of an
/// estimate. The runs are performed in the tests from closed forms.

#include "studies/measured/joint_tests/estimates.hpp"
#include "studies/measured/joint_tests/procedures.hpp"
#include "tests/studies/measured/small_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate::joint_sample {

constexpr double gravity = 9.81, mass = 0.135, half_width = 0.024, half_height = 0.0145;
constexpr double weight = mass * gravity;
constexpr double camera_m = 50e-6, camera_rad = 1e-3, gauge_n = 0.02, level_rad = 0.5e-3; // 1 sigma
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Three blocks on a fixed one, joints from below.
inline Specimen column()
{
    Specimen s = small_blocks(3, 0.6, mass, 0.25);
    s.base_block_half_width_m = half_width;
    return s;
}

inline std::vector<MeasuredRun> plan(RunKind kind, int joint = 1)
{
    return planned_runs(column(), Laboratory{}, kind, joint);
}

/// Where the body above the joint goes, against its planned place; the others stand on the table.
struct Path {
    std::vector<double> x, y, theta;
};

/// Fills in what the cameras see. @param theta of the upper block
inline void see(MeasuredRun& run, const Path& path, unsigned seed)
{
    const Specimen s = column();
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const std::size_t n = run.time_s.size();
    const int upper = s.joints[static_cast<std::size_t>(*run.joint)].second;
    for (SeenMotion* seen : {&run.blocks, &run.table})
        *seen = {};
    for (std::size_t i = 0; i < n; ++i)
        for (int b = 0; b < s.blocks(); ++b) {
            const auto k = static_cast<std::size_t>(b);
            const bool present = std::ranges::count(run.present, b) > 0, of_test = b == upper;
            const double x = of_test ? path.x[i] : run.base_displacement_m.values[i];
            const double y = of_test && !path.y.empty() ? path.y[i] : 0;
            const double theta = of_test && !path.theta.empty() ? path.theta[i] : 0;
            run.blocks.x_m.values.push_back(present ? s.rest_x_m[k] + x + camera_m * normal(random) : none);
            run.blocks.y_m.values.push_back(present ? s.rest_y_m[k] + y + camera_m * normal(random) : none);
            run.blocks.theta_rad.values.push_back(present ? theta + camera_rad * normal(random) : none);
        }
    run.blocks.x_m.noise_sd = run.blocks.y_m.noise_sd = camera_m;
    run.blocks.theta_rad.noise_sd = camera_rad;
}

/// Noise on a series that is already filled in.
inline void disturb(Series& series, double sd, unsigned seed)
{
    std::mt19937 random(seed + 1000);
    std::normal_distribution<double> normal;
    for (double& value : series.values)
        value += sd * normal(random);
    series.noise_sd = sd;
}

inline std::optional<Estimate> find(const std::vector<Estimate>& all, std::string_view name)
{
    for (const Estimate& one : all)
        if (one.name == name)
            return one;
    return std::nullopt;
}

/// An estimate is the true value within 4.5 of its standard deviations (one in 150,000) and a tolerance for what the
/// equation of the estimator leaves out; and its standard deviation is below `largest_sd`, so that this says something.
inline void expect_estimate(const std::vector<Estimate>& all, std::string_view name, double value, double largest_sd,
                            double tolerance = 0)
{
    const auto found = find(all, name);
    ASSERT_TRUE(found) << name << " was not estimated";
    EXPECT_NEAR(found->value, value, 4.5 * found->sd + tolerance) << name << ", sd " << found->sd;
    EXPECT_GT(found->sd, 0) << name;
    EXPECT_LT(found->sd, largest_sd) << name;
}

/// Over 60 runs with other noise, every estimate scatters as its standard deviation says. The scatter of so many has a
/// standard deviation of 9 %; 35 % below and 40 % above are allowed.
template <class EstimatesOf>
void expect_stated_errors(const EstimatesOf& estimates_of, const std::vector<std::string_view>& but = {})
{
    constexpr int runs = 60;
    std::map<std::string, std::array<double, 4>> sums; // number, values, their squares, stated standard deviations
    for (unsigned run = 0; run < runs; ++run)
        for (const Estimate& one : estimates_of(1000 + 20 * run)) {
            auto& [count, value, square, sd] = sums[one.name];
            count += 1;
            value += one.value;
            square += one.value * one.value;
            sd += one.sd;
        }
    EXPECT_FALSE(sums.empty());
    for (const auto& [name, of] : sums) {
        const auto& [count, value, square, sd] = of;
        EXPECT_EQ(count, runs) << name;
        const double scatter = std::sqrt(square / count - value * value / (count * count));
        if (std::ranges::count(but, name) == 0) {
            EXPECT_GT(scatter, 0.65 * sd / count) << name;
            EXPECT_LT(scatter, 1.4 * sd / count) << name;
        }
    }
}

} // namespace stylobate::joint_sample

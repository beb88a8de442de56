/// The fit of an onset, against a motion of known start and against the least squares of every start.

#include "studies/measured/joint_tests/onset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace stylobate {
namespace {

constexpr double noise = 2e-5, curvature = 4e-9; // of the value, and per sample squared

OnsetMotion motion_from(double start, std::size_t i)
{
    const double since = static_cast<double>(i) - start;
    return {curvature * since * since, 0};
}

/// At rest up to `start`, and then as above.
std::vector<double> values_from(double start, std::size_t count, unsigned seed)
{
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal(0, noise);
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back((static_cast<double>(i) > start ? motion_from(start, i).fixed : 0) + normal(engine));
    return values;
}

/// Sum of squares about the mean for a start at sample k, over all values.
double squares_of(const std::vector<double>& values, std::size_t k)
{
    long double sum = 0, squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const long double left = values[i] - (i > k ? motion_from(static_cast<double>(k), i).fixed : 0);
        sum += left;
        squares += left * left;
    }
    return static_cast<double>(squares - sum * sum / static_cast<long double>(values.size()));
}

TEST(OnsetFit, IsTheLeastOfAllStartsOfALongRun)
{
    constexpr std::size_t count = 4000, before = 1500;
    double squared = 0;
    constexpr unsigned runs = 40;
    for (unsigned seed = 0; seed < runs; ++seed) {
        const double start = 2100.3 + 7.1 * seed;
        const std::vector<double> values = values_from(start, count, seed);
        const OnsetData data{values, 0.001, noise, 100, before};
        const std::optional<std::size_t> moved = first_motion(data);
        ASSERT_TRUE(moved) << seed;
        const std::optional<OnsetFit> fit = fit_onset(data, *moved, 1, false, motion_from);
        ASSERT_TRUE(fit) << seed;
        squared += std::pow((fit->start - start) / fit->start_sd, 2);

        if (seed % 8 != 0)
            continue;
        // all that the fit may use, in plain sums
        const std::size_t from = *moved > 2 * before ? *moved - 2 * before : 0;
        const std::vector<double> used(values.begin() + static_cast<std::ptrdiff_t>(from), values.end());
        std::size_t best = 0;
        double least = squares_of(used, 0);
        for (std::size_t k = 1; k + 1 < used.size(); ++k)
            if (const double left = squares_of(used, k); left < least) {
                least = left;
                best = k;
            }
        EXPECT_NEAR(fit->start, static_cast<double>(from + best), 3) << seed << ": half the width of the parabola";
    }
    // chi squared of 40: 1 in 1000 beyond these by chance
    EXPECT_GT(squared, 18);
    EXPECT_LT(squared, 74);
}

TEST(OnsetFit, IsNoneWhereNothingMoves)
{
    const std::vector<double> values = values_from(1e9, 3000, 1);
    EXPECT_FALSE(first_motion({values, 0.001, noise, 100, 400}));
    EXPECT_FALSE(fit_onset({values, 0.001, noise, 100, 400}, 1500, 1, false, motion_from))
        << "its best start is the last";
}

} // namespace
} // namespace stylobate

/// Resampled rows by hand: percentiles of the very resamples, and the jackknife of a mean, which is its standard error.

#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/row_bootstrap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace stylobate;

namespace {

/// Rows of two numbers: the mean of the first one, and the ratio of the means.
const std::vector<double> rows = {1, 2, 3, 1, 2, 2, 6, 3, 4, 1, 2, 3};
constexpr std::size_t n = 6;

void mean_and_ratio(std::span<const double> means, std::span<double> out)
{
    out[0] = means[0];
    out[1] = means[0] / means[1];
}

} // namespace

/// 41 resamples at level 0.95: a fortieth of the way of 40 is one, so that the limits are the second smallest and the
/// second largest estimate (definition 7 of Hyndman and Fan).
TEST(RowBootstrap, LimitsAreThoseOfTheResamples)
{
    EXPECT_EQ(row_means(rows, 2), (std::vector<double>{3, 2}));
    const auto found = bootstrap_rows(rows, 2, 2, mean_and_ratio, {.level = 0.95, .resamples = 41, .seed = 7});
    std::vector<double> mean, ratio;
    for (std::uint64_t resample = 0; resample < 41; ++resample) {
        double a = 0, b = 0;
        for (std::uint64_t i = 0; i < n; ++i) {
            const auto row = static_cast<std::size_t>(6 * uniform01(7, resample, Stream::bootstrap, i));
            a += rows[2 * row];
            b += rows[2 * row + 1];
        }
        mean.push_back(a / n);
        ratio.push_back(a / b);
    }
    std::sort(mean.begin(), mean.end());
    std::sort(ratio.begin(), ratio.end());
    EXPECT_NEAR(found[0].value, 3, 1e-12);
    EXPECT_NEAR(found[0].lower, mean[1], 1e-12);
    EXPECT_NEAR(found[0].upper, mean[39], 1e-12);
    EXPECT_NEAR(found[1].value, 1.5, 1e-12);
    EXPECT_NEAR(found[1].lower, ratio[1], 1e-12);
    EXPECT_NEAR(found[1].upper, ratio[39], 1e-12);
}

/// Of few resamples the jackknife is wider: for a mean it is the mean -+ t s / sqrt(n), here of 1, 3, 2, 6, 4, 2 with
/// s^2 = 16 / 5 and Student's quantile of five degrees of freedom, 2.570582.
TEST(RowBootstrap, JackknifeOfAMeanIsItsStandardError)
{
    const auto found = resampled_rows(rows, 2, 2, mean_and_ratio, {.level = 0.95, .resamples = 5, .seed = 1});
    const double reach = 2.570582 * std::sqrt(16.0 / 5 / 6);
    EXPECT_NEAR(found[0].value, 3, 1e-12);
    EXPECT_NEAR(found[0].lower, 3 - reach, 1e-6);
    EXPECT_NEAR(found[0].upper, 3 + reach, 1e-6);
    // of the ratio by the ratios without each row: (18 - a) / (12 - b)
    double sum = 0, square = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double without = (18 - rows[2 * i]) / (12 - rows[2 * i + 1]);
        sum += without;
        square += without * without;
    }
    const double of_ratio = 2.570582 * std::sqrt(5.0 / 6 * (square - sum * sum / 6));
    EXPECT_NEAR(found[1].lower, 1.5 - of_ratio, 1e-6);
    EXPECT_NEAR(found[1].upper, 1.5 + of_ratio, 1e-6);
}

/// An estimate is undetermined where so many resamples have none that they would reach into its interval.
TEST(RowBootstrap, ManyResamplesWithoutAnEstimateLeaveNone)
{
    const auto no_estimate_above = [](double limit) {
        return [limit](std::span<const double> means, std::span<double> out) {
            out[0] = means[0] > limit ? std::numeric_limits<double>::quiet_NaN() : means[0];
        };
    };
    const BootstrapOptions options{.level = 0.9, .resamples = 400, .seed = 2};
    EXPECT_TRUE(std::isnan(bootstrap_rows(rows, 2, 1, no_estimate_above(3.5), options)[0].value));
    EXPECT_EQ(bootstrap_rows(rows, 2, 1, no_estimate_above(6), options)[0].value, 3);
}

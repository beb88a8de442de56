/// Quantiles of distributions against published tables and closed forms, those of samples by hand.

#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace stylobate;

TEST(Quantiles, OfStudentsDistribution)
{
    // one degree of freedom: tan(pi (p - 1/2)); two: (2 p - 1) sqrt(2 / (4 p (1 - p)))
    for (const double p : {0.1, 0.6, 0.975, 0.995}) {
        EXPECT_NEAR(student_quantile(p, 1), std::tan(std::numbers::pi * (p - 0.5)), 1e-9) << p;
        EXPECT_NEAR(student_quantile(p, 2), (2 * p - 1) * std::sqrt(2 / (4 * p * (1 - p))), 1e-9) << p;
    }
    // Student (1908) as tabulated, with fractional degrees by the continued fraction of the incomplete beta function
    EXPECT_NEAR(student_quantile(0.975, 4), 2.776445, 1e-6);
    EXPECT_NEAR(student_quantile(0.95, 9), 1.833113, 1e-6);
    EXPECT_NEAR(student_quantile(0.975, 2.5), 3.574655, 1e-6);
}

TEST(Quantiles, OfTheNormalDistribution)
{
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
    EXPECT_NEAR(normal_quantile(0.05), -1.644853626951472, 1e-12);
    EXPECT_EQ(normal_quantile(0.5), 0);
}

/// Of 1, 2, 4, 8: definition 6 at p (n + 1), definition 7 at 1 + p (n - 1), and the value at floor(p n) + 1.
TEST(SampleQuantiles, DefinitionsByHand)
{
    const std::vector<double> four = {1, 2, 4, 8};
    const auto at = [&](double p, QuantileDefinition definition) { return sorted_quantile(four, p, definition); };
    EXPECT_DOUBLE_EQ(at(0.4, QuantileDefinition::weibull), 2);
    EXPECT_DOUBLE_EQ(at(0.5, QuantileDefinition::weibull), 3);
    EXPECT_DOUBLE_EQ(at(0.7, QuantileDefinition::weibull), 6);
    EXPECT_EQ(at(0.1, QuantileDefinition::weibull), 1) << "no extrapolation";
    EXPECT_EQ(at(0.95, QuantileDefinition::weibull), 8);
    EXPECT_EQ(at(0, QuantileDefinition::linear), 1);
    EXPECT_DOUBLE_EQ(at(0.25, QuantileDefinition::linear), 1.75);
    EXPECT_DOUBLE_EQ(at(0.75, QuantileDefinition::linear), 5);
    EXPECT_EQ(at(1, QuantileDefinition::linear), 8);
    EXPECT_EQ(at(0.49, QuantileDefinition::above), 2);
    EXPECT_EQ(at(0.5, QuantileDefinition::above), 4) << "the upper one";
    EXPECT_EQ(at(1, QuantileDefinition::above), 8);
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(sorted_quantile(std::vector<double>{1, infinite, infinite}, 0.8, QuantileDefinition::linear), infinite);
}

TEST(SampleQuantiles, MediansByHand)
{
    EXPECT_EQ(sorted_median(std::vector<double>{1, 2, 4, 8}), 3);
    EXPECT_EQ(sorted_median(std::vector<double>{1, 2, 4}), 2);
    EXPECT_EQ(upper_median({8, 1, 4, 2}), 4);
    EXPECT_EQ(upper_median({4, 1, 2}), 2);
}

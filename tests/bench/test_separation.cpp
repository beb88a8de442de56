/// Two sorts of campaigns told apart: against the power of the best test of two normal distributions.

#include "bench/separation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace stylobate {
namespace {

/// Rows of a normal distribution with equal correlations, shifted in the first number.
Eigen::MatrixXd rows_of(int count, int numbers, double correlation, double shift, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    Eigen::MatrixXd rows(count, numbers);
    for (int i = 0; i < count; ++i) {
        const double common = normal(random);
        for (int k = 0; k < numbers; ++k)
            rows(i, k) = 3 + std::sqrt(correlation) * common + std::sqrt(1 - correlation) * normal(random);
        rows(i, 0) += shift;
    }
    return rows;
}

double normal_distribution(double z)
{
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

TEST(Separation, HasThePowerOfTheBestTest)
{
    std::mt19937_64 random(1);
    constexpr int numbers = 6;
    constexpr double correlation = 0.5, shift = 1.5;
    const Separation told =
        separate(rows_of(4000, numbers, correlation, 0, random), rows_of(4000, numbers, correlation, shift, random));
    // element (0, 0) of the inverse of (1 - r) I + r 11': the distance of the means in standard deviations
    const double inverse = (1 - correlation / (1 + (numbers - 1) * correlation)) / (1 - correlation);
    const double distance = shift * std::sqrt(inverse);
    const double z = 2.1701; // 1.5 % of a normal distribution lie above
    EXPECT_NEAR(told.power(0.015), normal_distribution(distance - z), 0.03);
}

TEST(Separation, HasNoPowerWhereNothingDiffers)
{
    std::mt19937_64 random(2);
    const Separation told = separate(rows_of(1000, 20, 0.2, 0, random), rows_of(1000, 20, 0.2, 0, random));
    EXPECT_NEAR(told.power(0.1), 0.1, 0.04);
}

TEST(Separation, IgnoresWhatIsMissingOrConstant)
{
    std::mt19937_64 random(3);
    const auto with_gaps = [&](double shift) {
        Eigen::MatrixXd rows = rows_of(500, 5, 0, shift, random);
        rows.col(2).setConstant(7);
        rows.col(3).setConstant(std::numeric_limits<double>::quiet_NaN());
        for (Eigen::Index i = 0; i < rows.rows(); i += 5)
            rows(i, 1) = std::numeric_limits<double>::quiet_NaN();
        return rows;
    };
    const Separation told = separate(with_gaps(0), with_gaps(4));
    EXPECT_GT(told.power(0.02), 0.9);
}

} // namespace
} // namespace stylobate

/// Exponential and logarithm of the kernels against the C library's in long double.

#include "kernels/exponential.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace stylobate;

namespace {

/// |got - want| in units of the last place of `want`.
double ulps(double got, long double want)
{
    const double rounded = static_cast<double>(want);
    const double ulp = std::nextafter(std::fabs(rounded), INFINITY) - std::fabs(rounded);
    return static_cast<double>(std::fabs(static_cast<long double>(got) - want) / static_cast<long double>(ulp));
}

} // namespace

TEST(Exponential, IsWithinAnUlp)
{
    std::mt19937_64 random(1);
    double worst = 0;
    for (const double range : {1e-9, 1e-3, 0.4, 5.0, 60.0, 690.0}) {
        std::uniform_real_distribution<double> draw(-range, range);
        for (int i = 0; i < 100000; ++i) {
            const double x = draw(random);
            worst = std::max(worst, ulps(exponential(x), std::exp(static_cast<long double>(x))));
        }
    }
    EXPECT_LT(worst, 1.0);
    RecordProperty("ulp", std::to_string(worst));
}

TEST(Exponential, LogarithmIsWithinTwoUlps)
{
    std::mt19937_64 random(2);
    double worst = 0;
    for (const double range : {1e-6, 0.3, 3.0, 60.0, 690.0}) {
        std::uniform_real_distribution<double> draw(-range, range);
        for (int i = 0; i < 100000; ++i) {
            const double x = std::exp(draw(random));
            if (x != 1)
                worst = std::max(worst, ulps(logarithm(x), std::log(static_cast<long double>(x))));
        }
    }
    EXPECT_LT(worst, 2.0);
    RecordProperty("ulp", std::to_string(worst));
}

TEST(Exponential, NeutralValuesAreExact)
{
    EXPECT_EQ(exponential(0.0), 1);
    EXPECT_EQ(exponential(-0.0), 1);
    EXPECT_EQ(logarithm(1.0), 0);
    for (const double x : {0.0, 1e-300, 3e-8, 1.0, 7.5, 1e300})
        EXPECT_EQ(power(x, 0.0), 1) << x;
    EXPECT_LT(exponential(-1e308), 1e-300); // kept within its range
}

TEST(Exponential, PowersOfTwoAndExponents)
{
    for (int k = -1022; k <= 1023; ++k) {
        EXPECT_EQ(power_of_two(static_cast<double>(k)), std::ldexp(1.0, k));
        EXPECT_EQ(exponent_of(std::ldexp(1.0, k)), k);
        EXPECT_EQ(exponent_of(std::ldexp(1.9999999999999998, k)), k);
    }
}

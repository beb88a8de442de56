// Sine and versine of the kernels against the C library's extended precision.

#include "kernels/trig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace stylobate {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "the oracle needs extended precision");

const long double pi = std::numbers::pi_v<long double>;

std::uint64_t bits(double x)
{
    return std::bit_cast<std::uint64_t>(x);
}

/// Distance in units in the last place of the exact value.
double ulps(double got, long double exact)
{
    if (exact == 0)
        return got == 0 ? 0 : std::numeric_limits<double>::infinity();
    int exponent = 0;
    std::frexp(exact, &exponent);
    return static_cast<double>(std::fabs(got - exact) / std::ldexp(1.0L, exponent - 53));
}

/// 1 - cos x without cancellation.
long double versine(long double x)
{
    const long double s = std::sin(x / 2);
    return 2 * s * s;
}

/// Quarters of pi, their neighbours, and points between, with both signs.
std::vector<double> special_arguments(double limit)
{
    std::vector<double> x{0.0, 1e-300, 1e-160, 1e-20, 1e-16, 1e-8, 1e-4};
    for (long k = 1; static_cast<double>(k) * std::numbers::pi / 4 < limit; k = k < 64 ? k + 1 : k + k / 7) {
        const auto quarter = static_cast<double>(static_cast<long double>(k) * pi / 4);
        double below = quarter, above = quarter;
        x.push_back(quarter);
        for (int i = 0; i < 4; ++i) {
            below = std::nextafter(below, 0.0);
            above = std::nextafter(above, 1e9);
            x.insert(x.end(), {below, above});
        }
        x.insert(x.end(), {quarter - 1e-7, quarter + 1e-7, std::round(quarter)});
    }
    const std::size_t n = x.size();
    for (std::size_t i = 0; i < n; ++i)
        x.push_back(-x[i]);
    return x;
}

std::vector<double> random_arguments(double smallest, double largest, int count)
{
    std::mt19937_64 engine(20240611);
    std::uniform_real_distribution<double> exponent(std::log(smallest), std::log(largest));
    std::vector<double> x;
    for (int i = 0; i < count; ++i)
        x.push_back((i & 1 ? -1 : 1) * std::exp(exponent(engine)));
    return x;
}

TEST(Trig, SineWithinOneUlpAndVersineWithinTwoInTheFirstQuarter)
{
    std::vector<double> arguments = random_arguments(1e-9, std::numbers::pi / 4, 400000);
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> uniform(-std::numbers::pi / 4, std::numbers::pi / 4);
    for (int i = 0; i < 400000; ++i)
        arguments.push_back(uniform(engine));
    for (double x : special_arguments(0.78))
        arguments.push_back(x);
    double worst_sine = 0, worst_versine = 0;
    for (double x : arguments) {
        const Angle<double> a = angle(x);
        worst_sine = std::max(worst_sine, ulps(a.sine, std::sin(static_cast<long double>(x))));
        if (std::fabs(x) > 1e-140) // below, the versine leaves the normal numbers
            worst_versine = std::max(worst_versine, ulps(a.versine, versine(x)));
    }
    EXPECT_LT(worst_sine, 1.0);
    EXPECT_LT(worst_versine, 2.0);
    RecordProperty("sine_ulp", std::to_string(worst_sine));
    RecordProperty("versine_ulp", std::to_string(worst_versine));
}

TEST(Trig, LargeAnglesKeepTheirDigits)
{
    std::vector<double> arguments = random_arguments(std::numbers::pi / 4, 1e5, 400000);
    for (double x : special_arguments(1e5))
        arguments.push_back(x);
    double worst_sine = 0, worst_versine = 0;
    for (double x : arguments) {
        const Angle<double> a = angle(x);
        worst_sine = std::max(worst_sine, ulps(a.sine, std::sin(static_cast<long double>(x))));
        const auto wrong = static_cast<double>(std::fabs(a.versine - versine(x)));
        worst_versine = std::max(worst_versine, wrong);
    }
    // relative for the sine, also beside the multiples of pi; of the size of 1 for the versine beyond the first quarter
    EXPECT_LT(worst_sine, 2.5);
    EXPECT_LT(worst_versine, 2.5 * std::numeric_limits<double>::epsilon());
    RecordProperty("sine_ulp", std::to_string(worst_sine));
}

TEST(Trig, SineAndCosineLieOnTheUnitCircle)
{
    for (double x : random_arguments(1e-6, 1e5, 100000)) {
        const Angle<double> a = angle(x);
        const double cosine = 1 - a.versine;
        ASSERT_NEAR(a.sine * a.sine + cosine * cosine, 1, 1e-15) << x;
    }
}

TEST(Trig, ShortAndLongWayGiveTheSameBits)
{
    std::vector<double> arguments = random_arguments(1e-300, std::numbers::pi / 4, 200000);
    arguments.insert(arguments.end(), {0.0, -0.0, 5e-324, -5e-324});
    for (double x : arguments) {
        const double quarter = round_of(x * (2 / std::numbers::pi));
        ASSERT_EQ(quarter, 0) << x;
        const Angle<double> direct = angle(x);
        // what a register takes when a neighbour has turned far: the reduction, then the choice of the quarter
        double r = fnma(quarter, 0x1.921fb544p+0, x);
        r = fnma(quarter, 0x1.0b4611a6p-34, r);
        r = fnma(quarter, 0x1.3198a2e037073p-69, r);
        const Angle<double> turned = detail::turned_angle(quarter, r);
        ASSERT_EQ(bits(direct.sine), bits(turned.sine)) << x;
        ASSERT_EQ(bits(direct.versine), bits(turned.versine)) << x;
    }
}

TEST(Trig, OddAndEvenToTheBit)
{
    for (double x : random_arguments(1e-12, 1e5, 100000)) {
        const Angle<double> plus = angle(x), minus = angle(-x);
        ASSERT_EQ(bits(plus.sine), bits(-minus.sine)) << x;
        ASSERT_EQ(bits(plus.versine), bits(minus.versine)) << x;
    }
}

TEST(Trig, NotANumberStaysSo)
{
    const Angle<double> a = angle(std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(std::isnan(a.sine));
    EXPECT_TRUE(std::isnan(a.versine));
    const Angle<double> b = angle(std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(b.sine));
}

TEST(Trig, SineOfCyclesIsExactAtTheQuarters)
{
    EXPECT_EQ(sine_of_cycles(0.0), 0);
    EXPECT_EQ(sine_of_cycles(0.25), 1);
    EXPECT_EQ(sine_of_cycles(-0.25), -1);
    EXPECT_EQ(sine_of_cycles(0.5), 0);
    EXPECT_EQ(sine_of_cycles(-0.5), 0);
}

TEST(Trig, SineOfCyclesWithinTwoAndAHalfUlp)
{
    std::vector<double> cycles = random_arguments(1e-12, 0.5, 200000);
    std::mt19937_64 engine(11);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (int i = 0; i < 200000; ++i)
        cycles.push_back(uniform(engine));
    for (double edge : {0.125, 0.25, 0.375, 0.5})
        for (double step : {1e-17, 1e-16, 1e-12, 1e-6})
            cycles.insert(cycles.end(), {edge - step, step - edge});
    double worst = 0;
    for (double c : cycles) {
        // sin(2 pi c) = sin(pi - 2 pi c): the reduction to 1/4 of a cycle is exact, so the oracle has no large argument
        const long double folded = std::fabs(c) > 0.25 ? std::copysign(0.5L, c) - c : static_cast<long double>(c);
        worst = std::max(worst, ulps(sine_of_cycles(c), std::sin(2 * pi * folded)));
    }
    EXPECT_LT(worst, 2.5);
    RecordProperty("ulp", std::to_string(worst));
}

} // namespace
} // namespace stylobate

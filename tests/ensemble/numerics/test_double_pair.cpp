/// Exponential and logarithm with twice the digits: against values of 300 bits (mpmath 1.3), and against the C library
/// in long double.

#include "ensemble/numerics/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stylobate {
namespace {

/// A value of 300 bits, rounded to two doubles.
struct Known {
    double x, hi, lo;
};

TEST(DoublePair, ExponentialHasAHundredBits)
{
    for (const Known& known : {Known{0.7, 0x1.01c2a61268987p+1, -0x1.ce82f8a77f530p-53},
                               {-3.25, 0x1.3da368521902dp-5, 0x1.517478690bcdep-60},
                               {0.001, 0x1.0041919b7ee34p+0, -0x1.8bc2a4c3c7051p-55},
                               {12.5, 0x1.060c52565ba66p+18, -0x1.607621f784efep-36},
                               {-40.1, 0x1.1ba46d6527705p-58, 0x1.5ba9b0eb83e40p-112},
                               {1, 0x1.5bf0a8b145769p+1, 0x1.4d57ee2b1013ap-53}}) {
        const DoublePair found = exp_of(DoublePair(known.x));
        EXPECT_EQ(found.hi, known.hi) << known.x;
        EXPECT_NEAR(found.lo, known.lo, std::ldexp(known.hi, -95)) << known.x;
    }
    EXPECT_EQ(exp_of(DoublePair(0)).rounded(), 1);
}

TEST(DoublePair, LogarithmHasAHundredBits)
{
    for (const Known& known : {Known{2, 0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56},
                               {0.1, -0x1.26bb1bbb55515p+1, -0x1.8b752b6b15c17p-53},
                               {1.0000001, 0x1.ad7f2847b6492p-24, 0x1.d7f4a57fcf3ddp-80},
                               {12345.678, 0x1.2d79559791e31p+3, -0x1.b815cbf5bdc23p-53},
                               {1e-8, -0x1.26bb1bbb55516p+4, 0x1.fa92a494ea3e9p-50},
                               {3e9, 0x1.5d2669ad6cfe9p+4, -0x1.1a833d82a464bp-51}}) {
        const DoublePair found = log_pair(known.x);
        EXPECT_EQ(found.hi, known.hi) << known.x;
        EXPECT_NEAR(found.lo, known.lo, std::ldexp(1 + std::fabs(known.hi), -95)) << known.x;
    }
    EXPECT_EQ(log_pair(1).rounded(), 0);
}

/// The library's value in long double is the nearest double but where 64 bits do not decide it.
TEST(DoublePair, RoundsAsLongDoubleDoes)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> exponent(-30, 30);
    constexpr int count = 100'000;
    int apart = 0;
    for (int i = 0; i < count; ++i) {
        const double x = exponent(random), library = static_cast<double>(std::exp(static_cast<long double>(x)));
        const double found = exp_of(DoublePair(x)).rounded();
        ASSERT_LE(std::fabs(found - library), std::nextafter(library, 2 * library) - library) << x;
        apart += found != library;
        const double back = log_pair(found).rounded(),
                     known = static_cast<double>(std::log(static_cast<long double>(found)));
        ASSERT_LE(std::fabs(back - known), std::nextafter(std::fabs(known), 100.0) - std::fabs(known)) << x;
        apart += back != known;
    }
    EXPECT_LT(apart, count / 250) << "one in a thousand is near a tie in 64 bits";
}

/// Sums, products and quotients keep what double loses.
TEST(DoublePair, ArithmeticKeepsTheDigitsThatDoubleLoses)
{
    const DoublePair third = DoublePair(1) / 3, one = third + third + third;
    EXPECT_EQ(one.hi, 1);
    EXPECT_NEAR(one.lo, 0, 0x1p-103);
    const DoublePair square = (DoublePair(1) + DoublePair(0x1p-60)) * (DoublePair(1) + DoublePair(0x1p-60));
    EXPECT_EQ((square - DoublePair(1)).rounded(), 0x1p-59);
}

} // namespace
} // namespace stylobate

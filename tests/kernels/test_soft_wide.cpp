// The register whose fused multiply-add is computed from sums and products gives the bits of the fused one.

#include "kernels/soft_wide.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace stylobate {
namespace {

std::uint64_t bits(double x)
{
    return std::isnan(x) ? 0x7ff8000000000000 : std::bit_cast<std::uint64_t>(x); // which NaN, nothing depends on
}

/// Numbers of all sizes, and those with which rounding is difficult.
class DifficultNumbers {
public:
    double next()
    {
        const std::uint64_t random = engine_(), fraction = random & 0x800fffffffffffff;
        switch (engine_() % 8) {
        case 0: // any
            return std::bit_cast<double>(random);
        case 1: // few bits: ties
            return std::ldexp(static_cast<double>(random >> (engine_() % 64)), static_cast<int>(engine_() % 80) - 40);
        case 2: // around 1
            return std::bit_cast<double>(fraction | (1019 + engine_() % 8) << 52);
        case 3: // of some orders of magnitude
            return std::bit_cast<double>(fraction | (991 + engine_() % 64) << 52);
        case 4:
            return random % 2 == 0 ? 0.0 : -0.0;
        case 5: // half of the bits: products without an error
            return std::bit_cast<double>((fraction & ~0x7ffffffULL) | (1019 + engine_() % 8) << 52);
        case 6: // products that underflow
            return std::bit_cast<double>(fraction | (engine_() % 120) << 52);
        default:
            return special[random % std::size(special)];
        }
    }
    /// Of a sum with a product: of its size, its opposite, or nearly that.
    double beside(double product)
    {
        switch (engine_() % 4) {
        case 0:
            return -product;
        case 1:
            return -product * (1 + std::ldexp(1.0, -static_cast<int>(engine_() % 60)));
        case 2:
            return product * std::ldexp(1.0, static_cast<int>(engine_() % 120) - 60);
        default:
            return next();
        }
    }

private:
    static constexpr double infinite = std::numeric_limits<double>::infinity();
    static constexpr double special[] = {1,
                                         -1,
                                         0.5,
                                         2,
                                         3,
                                         1.0 / 3,
                                         1e300,
                                         -1e300,
                                         1e-300,
                                         5e-324,
                                         -5e-324,
                                         0x1p-1022,
                                         infinite,
                                         -infinite,
                                         std::numeric_limits<double>::quiet_NaN(),
                                         std::numeric_limits<double>::max()};
    std::mt19937_64 engine_{20080601};
};

struct Triple {
    double a, b, c;
};

/// The software's result in one lane, with another triple in the other.
double soft(const Triple& x, const Triple& neighbour, int lane)
{
    const auto both = [&](double Triple::*member) {
        alignas(16) double two[2] = {neighbour.*member, neighbour.*member};
        two[lane] = x.*member;
        return Lanes<SoftWide>::load(two);
    };
    alignas(16) double result[2];
    Lanes<SoftWide>::store(result, fma(both(&Triple::a), both(&Triple::b), both(&Triple::c)));
    return result[lane];
}

TEST(SoftWide, FusedMultiplyAddHasTheBitsOfTheLibrary)
{
    DifficultNumbers numbers;
    Triple before{1, 1, 1};
    for (int i = 0; i < 2'000'000; ++i) {
        Triple x{numbers.next(), numbers.next(), 0};
        x.c = numbers.beside(x.a * x.b);
        ASSERT_EQ(bits(soft(x, before, i % 2)), bits(std::fma(x.a, x.b, x.c)))
            << std::hexfloat << x.a << ' ' << x.b << ' ' << x.c;
        before = x;
    }
}

TEST(SoftWide, WithoutTheLibraryItIsRightOrItIsNoted)
{
    using Bare = SoftWideBy<soft::Noted>;
    const auto sure = [](double a, double b, double c) {
        soft::Noted::unsure = soft::Bits{};
        alignas(16) double two[2];
        Lanes<Bare>::store(two, fma(Bare(a), Bare(b), Bare(c)));
        if (soft::Noted::any_unsure())
            return false;
        EXPECT_EQ(bits(two[0]), bits(std::fma(a, b, c))) << std::hexfloat << a << ' ' << b << ' ' << c;
        return true;
    };
    DifficultNumbers numbers;
    int noted = 0;
    for (int i = 0; i < 200'000 && !::testing::Test::HasFailure(); ++i) {
        const double a = numbers.next(), b = numbers.next();
        noted += sure(a, b, numbers.beside(a * b)) ? 0 : 1;
    }
    EXPECT_GT(noted, 1000); // those that overflow or underflow at least
    EXPECT_LT(noted, 150'000);
    const double third = 1.0 / 3;
    EXPECT_TRUE(sure(third, 0.1, 7.0)); // as nearly all of the engine's
    EXPECT_TRUE(sure(0.0, third, 0.0));
    EXPECT_TRUE(sure(1.0, 1.0, 0x1p-53));              // a tie of an exact product
    EXPECT_TRUE(sure(3.0, 0x1.833184b649a25p-5, 0.0)); // of an exact sum
    EXPECT_TRUE(sure(third, 3.0, -1.0));               // the error of a product
    EXPECT_FALSE(sure(1e-200, 1e-200, 1.0));           // it underflows
}

TEST(SoftWide, TiesAndSignedZerosAreThoseOfTheStandard)
{
    struct Case {
        Triple x;
        double result;
    };
    constexpr double tiny = 0x1p-1074;
    const Case cases[] = {
        {{1, 1, 0x1p-53}, 1},                                         // a tie, to the even one
        {{1 + 0x1p-52, 1, 0x1p-53}, 1 + 0x1p-51},                     // upwards
        {{1 + 0x1p-27, 1 + 0x1p-27, 0x1p-53}, 1 + 0x1p-26 + 0x1p-52}, // 2^-54 + 2^-53 above 1 + 2^-26: no tie
        {{1 + 0x1p-30, 1 - 0x1p-30, -1}, -0x1p-60},                   // the error of the product alone
        {{0.0, -1, -0.0}, -0.0},
        {{0.0, -1, 0.0}, 0.0},
        {{3, 5, -15}, 0.0},
        {{-tiny, 0.25, -0.0}, -0.0}, // the product is rounded to a zero that is none
        {{-tiny, 0.25, 0.0}, -0.0},
        {{tiny, 0.5, tiny}, 2 * tiny}, // a tie between two subnormal numbers
        {{tiny, 0.5, 2 * tiny}, 2 * tiny},
        {{0x1p1023, 2, -0x1p1023}, 0x1p1023}, // the product alone would overflow
    };
    for (const Case& each : cases)
        for (int lane = 0; lane < 2; ++lane)
            EXPECT_EQ(bits(soft(each.x, {1, 2, 3}, lane)), bits(each.result))
                << std::hexfloat << each.x.a << ' ' << each.x.b << ' ' << each.x.c;
}

TEST(SoftWide, OtherFormsAreThoseOfTheScalarKernel)
{
    DifficultNumbers numbers;
    for (int i = 0; i < 100'000; ++i) {
        const double a = numbers.next(), b = numbers.next(), c = numbers.next();
        const SoftWide x(a), y(b), z(c);
        const auto one = [](SoftWide value) {
            alignas(16) double two[2];
            Lanes<SoftWide>::store(two, value);
            EXPECT_EQ(bits(two[0]), bits(two[1]));
            return bits(two[0]);
        };
        ASSERT_EQ(one(fnma(x, y, z)), bits(fnma(a, b, c)));
        ASSERT_EQ(one(fms(x, y, z)), bits(fms(a, b, c)));
        ASSERT_EQ(one(min_of(x, y)), bits(min_of(a, b)));
        ASSERT_EQ(one(max_of(x, y)), bits(max_of(a, b)));
        ASSERT_EQ(one(select(x < y, y, z)), bits(select(a < b, b, c)));
        ASSERT_EQ(one(select((!(x >= y)) | (z != z), y, z)), bits(select(!(a >= b) || c != c, b, c)));
        ASSERT_EQ(one(abs_of(x)), bits(abs_of(a)));
        ASSERT_EQ(one(round_of(x)), bits(round_of(a)));
        ASSERT_EQ(one(turn_sign(x, y)), bits(turn_sign(a, b)));
        ASSERT_EQ(any((x > y) & (y <= z)), a > b && b <= c);
        if (a > 0) {
            ASSERT_EQ(one(sqrt_of(x)), bits(sqrt_of(a)));
            ASSERT_EQ(one(exponent_of(x)), bits(exponent_of(a)));
        }
    }
    for (double k = -1022; k <= 1023; ++k) {
        alignas(16) double two[2];
        Lanes<SoftWide>::store(two, power_of_two(SoftWide(k)));
        EXPECT_EQ(two[1], std::ldexp(1.0, static_cast<int>(k)));
    }
}

} // namespace
} // namespace stylobate

#pragma once
/// Numbers of two doubles, hi + lo with |lo| at most half a unit in the last place of hi: about 100 bits. Exponential
/// and logarithm of such numbers, so that a function that is rounded to double at the end has the nearest double
/// whichever processor computes it. The C library's functions in long double do not: x86 processors of different makers
/// differ in the last bit of f2xm1 and fyl2x, and draws are part of a realization's identity.
///
/// Sums and products: Dekker, "A floating-point technique for extending the available precision", Numerische Mathematik
/// 18 (1971) 224; Knuth, "The Art of Computer Programming", volume 2, 4.2.2. Functions by argument reduction in three
/// parts (Cody & Waite, "Software Manual for the Elementary Functions" (1980)) and a truncated series.

#include "ensemble/numerics/elementary.hpp"

#include <cmath>

namespace stylobate {

struct DoublePair {
    double hi = 0, lo = 0;
    DoublePair() = default;
    constexpr DoublePair(double high, double low = 0) : hi(high), lo(low) {}
    /// The nearest double.
    double rounded() const { return hi + lo; }
};

/// a + b, exact.
inline DoublePair exact_sum(double a, double b)
{
    const double sum = a + b, of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// a b, exact.
inline DoublePair exact_product(double a, double b)
{
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

inline DoublePair operator+(DoublePair p, DoublePair q)
{
    const DoublePair high = exact_sum(p.hi, q.hi), low = exact_sum(p.lo, q.lo);
    const DoublePair sum = exact_sum(high.hi, high.lo + low.hi);
    return exact_sum(sum.hi, sum.lo + low.lo);
}
inline DoublePair operator-(DoublePair p)
{
    return {-p.hi, -p.lo};
}
inline DoublePair operator-(DoublePair p, DoublePair q)
{
    return p + -q;
}
inline DoublePair operator*(DoublePair p, DoublePair q)
{
    const DoublePair product = exact_product(p.hi, q.hi);
    return exact_sum(product.hi, product.lo + (p.hi * q.lo + p.lo * q.hi));
}
inline DoublePair operator/(DoublePair p, double q)
{
    const double first = p.hi / q;
    const DoublePair rest = p - exact_product(first, q);
    return exact_sum(first, rest.rounded() / q);
}

/// exp x for |x| <= 700: x = k ln 2 + 512 r, and (exp r)^512 by nine squarings of exp r - 1, whose series is taken to
/// the ninth power.
inline DoublePair exp_of(DoublePair x)
{
    // ln 2 in three parts, of which the first two have 40 bits: times k they are exact
    constexpr double ln2[] = {0x1.62e42fefa4000p-1, -0x1.8432a1b0e2000p-43, -0x1.8cff81a12a17ep-85};
    constexpr DoublePair terms[] = {
        // 1 / 9! to 1 / 2!
        {0x1.71de3a556c734p-19, -0x1.c154f8ddc6c00p-73}, {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01ap-76},
        {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73},  {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},
        {0x1.1111111111111p-7, 0x1.1111111111111p-63},   {0x1.5555555555555p-5, 0x1.5555555555555p-59},
        {0x1.5555555555555p-3, 0x1.5555555555555p-57},   {0.5, 0}};
    constexpr int squarings = 9;
    const double k = std::nearbyint(x.hi * 0x1.71547652b82fep+0);
    DoublePair r = x + DoublePair(-k * ln2[0]) + DoublePair(-k * ln2[1]) + exact_product(-k, ln2[2]);
    r.hi = std::ldexp(r.hi, -squarings);
    r.lo = std::ldexp(r.lo, -squarings);
    DoublePair series;
    for (const DoublePair& term : terms)
        series = series * r + term;
    DoublePair less_one = (series * r + DoublePair(1)) * r;
    for (int i = 0; i < squarings; ++i) // (1 + p)^2 = 1 + (2 p + p^2)
        less_one = less_one + less_one + less_one * less_one;
    const DoublePair all = less_one + DoublePair(1);
    return {std::ldexp(all.hi, static_cast<int>(k)), std::ldexp(all.lo, static_cast<int>(k))};
}

/// ln x for x > 0, exp(-ln x) not beyond the range of `exp_of`: y + ln(1 + e) with e = x exp(-y) - 1, y nearly ln x.
inline DoublePair log_pair(double x)
{
    const double y = log_of(x);
    const DoublePair e = DoublePair(x) * exp_of(DoublePair(-y)) - DoublePair(1);
    return DoublePair(y) + e - e * e / 2;
}

} // namespace stylobate

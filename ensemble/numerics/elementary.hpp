#pragma once
/// Exponential, logarithm, sine and cosine of a double whose bits do not depend on the machine's library: written in +
/// - * / and `fma` only. They are used for base motions, which are part of a realization's identity. Host code, scalar.
/// Method: argument reduction with a constant in two parts (Cody & Waite, "Software Manual for the Elementary
/// Functions" (1980)), then a truncated series.

#include "kernels/trig.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace stylobate {

namespace detail {

inline constexpr double ln2_high = 0x1.62e42fefa0000p-1; ///< its last 17 bits are 0: times any exponent it is exact
inline constexpr double ln2_low = 0x1.cf79abc9e3b3ap-40;

} // namespace detail

/// exp x for |x| <= 700: x = k ln 2 + r with |r| <= 0.347, and Taylor's series of exp r to the 13th power, whose
/// remainder is 4e-18. Less than 1 ULP, which the tests measure.
inline double exp_of(double x)
{
    constexpr double terms[] = {1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800,
                                1.0 / 362880,     1.0 / 40320,     1.0 / 5040,     1.0 / 720,
                                1.0 / 120,        1.0 / 24,        1.0 / 6,        1.0 / 2};
    const double k = round_of(x * 0x1.71547652b82fep+0);
    const double r = fnma(k, detail::ln2_low, fnma(k, detail::ln2_high, x));
    double series = 0;
    for (const double term : terms)
        series = fma(series, r, term);
    return std::ldexp(1 + fma(r * r, series, r), static_cast<int>(k));
}

/// ln x for x > 0: x = 2^k m with m from sqrt(1/2) to sqrt(2), and ln m = 2 (s + s3/3 + s5/5 + ...) with s = (m - 1) /
/// (m + 1), to the 21st power (series of artanh), whose remainder is 1e-18. Less than 2 ULP, which the tests measure.
inline double log_of(double x)
{
    int exponent = 0;
    double m = std::frexp(x, &exponent); // from 1/2 to 1
    if (m < 0x1.6a09e667f3bcdp-1) {
        m *= 2;
        --exponent;
    }
    const double s = (m - 1) / (m + 1), z = s * s;
    double series = 0;
    for (double odd = 21; odd >= 3; odd -= 2)
        series = fma(series, z, 1 / odd);
    const double k = exponent;
    // m - 1 is exact; ln m = f - s (f - 2 z series ...): f = m - 1 = s (2 + f)
    const double f = m - 1;
    const double rest = fma(k, detail::ln2_low, fnma(s, f - 2 * z * series, 0)); // 2 s = f - s f
    return fma(k, detail::ln2_high, f + rest);
}

/// sin(2 pi c) of any number of cycles.
inline double sine_of(double cycles)
{
    return sine_of_cycles<double>(cycles - round_of(cycles));
}

/// cos(2 pi c) of any number of cycles.
inline double cosine_of(double cycles)
{
    const double c = cycles - round_of(cycles) + 0.25;
    return sine_of_cycles<double>(c > 0.5 ? c - 1 : c);
}

// Numbers of two doubles, hi + lo with |lo| at most half a unit in the last place of hi: about 100 bits. Exponential
// and logarithm of such numbers, so that a function that is rounded to double at the end has the nearest double
// whichever processor computes it. The C library's functions in long double do not: x86 processors of different makers
// differ in the last bit of f2xm1 and fyl2x, and draws are part of a realization's identity.
//
// Sums and products: Dekker, "A floating-point technique for extending the available precision", Numerische Mathematik
// 18 (1971) 224; Knuth, "The Art of Computer Programming", volume 2, 4.2.2. Functions by argument reduction in three
// parts (Cody & Waite, "Software Manual for the Elementary Functions" (1980)) and a truncated series.

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

// The fast Fourier transform, with the same bits on every machine (Cooley & Tukey, "An algorithm for the machine
// calculation of complex Fourier series", Mathematics of Computation 19 (1965) 297).

/// Discrete Fourier transform in place, decimation in time: Z_k = sum of z_j exp(-2 pi i j k / n).
/// @pre the size is a power of two
void transform(std::vector<std::complex<double>>& z);

/// The least power of two that is not below n, and at least 2.
std::size_t power_of_two_from(std::size_t n);

} // namespace stylobate

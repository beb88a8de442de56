#pragma once
/// Exponential, logarithm, sine and cosine of a double whose bits do not depend on the machine's library: written in +
/// - * / and `fma` only. They are used for base motions, which are part of a realization's identity. Host code, scalar.
/// Method: argument reduction with a constant in two parts (Cody & Waite, "Software Manual for the Elementary
/// Functions" (1980)), then a truncated series.

#include "kernels/trig.hpp"

#include <cmath>

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

} // namespace stylobate

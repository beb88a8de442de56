#pragma once
/// Exponential and natural logarithm: one polynomial for every width, as in `trig.hpp`.
///
/// exp: x = k ln 2 + r with |r| <= ln 2 / 2 (reduced in two parts, Cody & Waite 1980), Taylor's polynomial of degree 13
/// in r (remainder below 5e-18), times 2^k. ln: x = 2^k m with m from sqrt(1/2) to sqrt(2), f = (m - 1) / (m + 1),
/// ln m = 2 artanh f by its series to f^21 (remainder below 3e-17 of it). exp(0) is 1 and ln(1) is 0 to the bit. Errors
/// below 1 ULP (exp) and 2 ULP (ln), which the tests measure.

#include "kernels/real.hpp"

namespace stylobate {

/// e^x; x is kept within [-700, 700].
template <class Real>
STYLOBATE_INLINE Real exponential(Real x)
{
    x = clamp(x, Real(-700.0), Real(700.0));
    const Real k = round_of(x * Real(0x1.71547652b82fep+0));
    Real r = fnma(k, Real(0x1.62e42feep-1), x);
    r = fnma(k, Real(0x1.a39ef35793c76p-33), r);
    Real p = fma(r, Real(0x1.6124613a86d09p-33), Real(0x1.1eed8eff8d898p-29)); // 1 / 13!, 1 / 12! and so on
    p = fma(r, p, Real(0x1.ae64567f544e4p-26));
    p = fma(r, p, Real(0x1.27e4fb7789f5cp-22));
    p = fma(r, p, Real(0x1.71de3a556c734p-19));
    p = fma(r, p, Real(0x1.a01a01a01a01ap-16));
    p = fma(r, p, Real(0x1.a01a01a01a01ap-13));
    p = fma(r, p, Real(0x1.6c16c16c16c17p-10));
    p = fma(r, p, Real(0x1.1111111111111p-7));
    p = fma(r, p, Real(0x1.5555555555555p-5));
    p = fma(r, p, Real(0x1.5555555555555p-3));
    p = fma(r, p, Real(0.5));
    return (Real(1.0) + fma(r * r, p, r)) * power_of_two(k);
}

/// ln x; x is kept within [1e-300, 1e300].
template <class Real>
STYLOBATE_INLINE Real logarithm(Real x)
{
    x = clamp(x, Real(1e-300), Real(1e300));
    const Real down = exponent_of(x);
    const Real whole = x * power_of_two(Real(0.0) - down); // from 1 to 2
    const auto high = whole > Real(0x1.6a09e667f3bcdp+0);
    const Real m = select(high, whole * Real(0.5), whole);
    const Real k = select(high, down + Real(1.0), down);
    const Real f = (m - Real(1.0)) / (m + Real(1.0));
    const Real s = f * f;
    Real p = fma(s, Real(1.0 / 21.0), Real(1.0 / 19.0));
    p = fma(s, p, Real(1.0 / 17.0));
    p = fma(s, p, Real(1.0 / 15.0));
    p = fma(s, p, Real(1.0 / 13.0));
    p = fma(s, p, Real(1.0 / 11.0));
    p = fma(s, p, Real(1.0 / 9.0));
    p = fma(s, p, Real(1.0 / 7.0));
    p = fma(s, p, Real(1.0 / 5.0));
    p = fma(s, p, Real(1.0 / 3.0));
    const Real twice = f + f;
    return fma(k, Real(0x1.62e42feep-1), fma(k, Real(0x1.a39ef35793c76p-33), fma(twice * s, p, twice)));
}

/// x^p for x > 0, as e^(p ln x): the error grows by |p ln x| ULP. p = 0 gives 1 to the bit.
template <class Real>
STYLOBATE_INLINE Real power(Real x, Real p)
{
    return exponential(p * logarithm(x));
}

} // namespace stylobate

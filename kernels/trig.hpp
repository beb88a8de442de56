#pragma once
/// Sine, cosine and versine: one polynomial for every width and for the device.
///
/// On |r| <= pi/4:  sin r = r + r^3 S(r^2),  1 - cos r = r^2/2 + r^4 V(r^2),  S and V of degree 5, interpolating at the
/// Chebyshev nodes of [0, (pi/4)^2] (relative error of the polynomials 2.0e-17 and 2.6e-18, computed in exact
/// arithmetic; rounding brings it to less than 1 ULP for the sine and 2 ULP for the versine, which the tests
/// measure). Larger angles are reduced by multiples of pi/2 in three parts (Cody & Waite, "Software Manual for the
/// Elementary Functions" (1980)), valid for |x| up to 1e5.
///
/// In single precision S and V are of degree 2 (1.3e-8 and 2.4e-9, with the coefficients rounded: less than a quarter
/// of an ULP). Its parts of pi/2 have all 24 digits: the fused multiply-add subtracts the first from x exactly.

#include "kernels/real.hpp"

#include <type_traits>

namespace stylobate {

template <class Real>
struct Angle {
    Real sine;
    Real versine; ///< 1 - cos, which keeps its digits where the angle is small
};

namespace detail {

template <class Real>
inline constexpr bool is_single = std::is_same_v<NumberOf<Real>, float>;

template <class Real>
STYLOBATE_INLINE Angle<Real> reduced_angle(Real r)
{
    const Real z = r * r;
    if constexpr (is_single<Real>) {
        Real s = fma(z, Real(-0x1.9ac9bp-13), Real(0x1.110c28p-7));
        s = fma(z, s, Real(-0x1.555552p-3));
        Real v = fma(z, Real(-0x1.9bd89cp-16), Real(0x1.6c12d2p-10));
        v = fma(z, v, Real(-0x1.555554p-5));
        v = fma(z, v, Real(0.5));
        return {fma(r * z, s, r), z * v};
    }
    Real s = fma(z, Real(0x1.5e0333e3ccba1p-33), Real(-0x1.ae5ff4f957b14p-26));
    s = fma(z, s, Real(0x1.71de3781495ffp-19));
    s = fma(z, s, Real(-0x1.a01a019e73325p-13));
    s = fma(z, s, Real(0x1.1111111110b6cp-7));
    s = fma(z, s, Real(-0x1.5555555555555p-3));
    Real v = fma(z, Real(0x1.9075bb669682cp-37), Real(-0x1.1eeb5de1e2b95p-29));
    v = fma(z, v, Real(0x1.27e4fa0d3726cp-22));
    v = fma(z, v, Real(-0x1.a01a019f4671dp-16));
    v = fma(z, v, Real(0x1.6c16c16c16944p-10));
    v = fma(z, v, Real(-0x1.5555555555555p-5));
    v = fma(z, v, Real(0.5));
    return {fma(r * z, s, r), z * v};
}

/// The angle quarter * pi/2 + r, for an integer quarter.
template <class Real>
STYLOBATE_INLINE Angle<Real> turned_angle(Real quarter, Real r)
{
    const Angle<Real> a = reduced_angle(r);
    const Real cosine = Real(1.0) - a.versine;
    const Real half = quarter * Real(0.5);
    const auto odd = half != round_of(half);
    // quarter mod 4, from 0 to 3
    const Real turn = fnma(Real(4.0), round_of(fma(quarter, Real(0.25), Real(-0.375))), quarter);
    const auto sine_negative = turn > Real(1.5);
    const auto cosine_negative = abs_of(turn - Real(1.5)) < Real(1.0);
    const Real sine = select(odd, cosine, a.sine);
    const Real other = select(odd, a.sine, cosine);
    const Real sine_signed = select(sine_negative, Real(0.0) - sine, sine);
    const Real versine = Real(1.0) - select(cosine_negative, Real(0.0) - other, other);
    return {sine_signed, select(abs_of(quarter) < Real(0.5), a.versine, versine)};
}

} // namespace detail

/// Sine and versine of x [rad].
template <class Real>
STYLOBATE_INLINE Angle<Real> angle(Real x)
{
    const Real quarter = round_of(x * Real(0x1.45f306dc9c883p-1));
    // Blocks that stand are in the first quarter: with quarter = 0 the long way gives the same bits, so the short one
    // may be taken whenever all realizations of the register allow it.
    if (!any(quarter != Real(0.0)))
        return detail::reduced_angle(x);
    constexpr bool single = detail::is_single<Real>;
    Real r = fnma(quarter, Real(single ? 0x1.921fb6p+0 : 0x1.921fb544p+0), x);
    r = fnma(quarter, Real(single ? -0x1.777a5cp-25 : 0x1.0b4611a6p-34), r);
    r = fnma(quarter, Real(single ? -0x1.ee59dap-50 : 0x1.3198a2e037073p-69), r);
    return detail::turned_angle(quarter, r);
}

/// sin(2 pi c) for |c| <= 1/2: c in cycles, so that the reduction is exact.
template <class Real>
STYLOBATE_INLINE Real sine_of_cycles(Real c)
{
    const Real quarter = round_of(c * Real(4.0));
    const Real rest = fnma(quarter, Real(0.25), c);
    return detail::turned_angle(quarter, rest * Real(0x1.921fb54442d18p+2)).sine;
}

} // namespace stylobate

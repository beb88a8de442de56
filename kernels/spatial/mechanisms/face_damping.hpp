#pragma once
/// Normal dashpots at the two ends of the patch, where the face lies deepest and highest, instead of one that is spread
/// over it. An impact then takes nearly what that of rigid blocks takes, and rolling what it takes without them.
///
///   e = sqrt(f / (A a.J a)) J a          the ends, from the centre of the patch; a: slope, J: its central moments
///   c_e = min(c A, C / 2)                of each end of a disc: what is spread over the patch, at most half of the
///   face's c_e = C / 2                          of a rectangle F = min(c_e (v + b.e), N_+) + min(c_e (v - b.e), N_-)
///   K = (F_+ - F_-) e + c J (b - b_a a)
///
/// v, b: rate at the centre of the patch and its growth over the face; b_a: part of b along a, in J. N_+ and N_-: the
/// elastic force by the lever rule, so that no end pulls. Across the slope the dashpot stays spread, and a disc's
/// fades with its patch: a drum that rolls on its rim moves across, with a small patch, and is braked nearly as without
/// the mechanism. A rectangle does not roll.
///
/// Source: own derivation (THEORY.md, section 10).
///
/// Parameter: share of the normal dashpot at the ends.  Neutral: 0.  Acts in the normal force of a bed.
/// Signature: rocking in a plane decays faster, rolling as before.
/// Confounded with C_N in the decay of rocking.

#include "kernels/spatial/friction.hpp"

namespace stylobate::spatial {

template <class Real>
struct FaceDamping {
    Real share;   ///< of the normal dashpot that acts at the ends
    Real dashpot; ///< share c_e of each end, per step [N/m]
    Real reach2;  ///< f, of `disc_reach2` or `rectangle_reach2`
};

/// f: square of the distance from the centre of a face to its edge over its radius of gyration, in the direction in
/// which the depth grows. The face is whole or a ring.
/// @param inner_ratio of a ring: inner over outer size; 0 of a whole face
template <class Real>
STYLOBATE_INLINE Real disc_reach2(Real inner_ratio)
{
    return Real(4.0) / fma(inner_ratio, inner_ratio, Real(1.0));
}

/// The same for a rectangle: from 3 where it is deepest along an edge to 6 in a corner, of a whole face.
/// @param half_x, half_y half sizes along the axes of the slope [m]
template <class Real>
STYLOBATE_INLINE Real rectangle_reach2(Real slope_x, Real slope_y, Real half_x, Real half_y, Real inner_ratio)
{
    const Real x = abs_of(slope_x) * half_x, y = abs_of(slope_y) * half_y, sum = x + y;
    const Real square = max_of(fma(x, x, y * y), Real(Extreme<NumberOf<Real>>::tiny));
    const Real whole = clamp(Real(3.0) * sum * sum / square, Real(3.0), Real(6.0));
    return whole / fma(inner_ratio, inner_ratio, Real(1.0));
}

/// The normal dashpot of a pressed bed.
/// @param C_n spread dashpot per area and step [N/m3]
/// @pre load.force > 0
template <class Real>
STYLOBATE_INLINE void face_dashpot(const BedLoad<Real>& load, const FaceDamping<Real>& ends, Real C_n,
                                   const BedComponents<Real>& rates, BedComponents<Real>& resistance)
{
    const Real zero(0.0), one(1.0), half(0.5), tiny = Real(Extreme<NumberOf<Real>>::tiny);
    const Real per_area = one / max_of(load.area, tiny), N = load.force;
    const Real cx = load.first_x * per_area, cy = load.first_y * per_area; // centre of the patch
    const Real jxx = fnma(load.first_x, cx, load.second_xx), jxy = fnma(load.first_x, cy, load.second_xy),
               jyy = fnma(load.first_y, cy, load.second_yy);
    const Real ax = load.slope_x, ay = load.slope_y, bx = rates.tilt_x, by = rates.tilt_y;
    const Real v = fma(bx, cx, fma(by, cy, rates.normal));
    // J a and a.J a; a strip too narrow for the digits of its moments counts as a point
    const Real sx = fma(jxx, ax, jxy * ay), sy = fma(jxy, ax, jyy * ay);
    const Real about_P =
        fma(load.second_xx * ax, ax, fma(load.second_yy * ay, ay, Real(2.0) * load.second_xy * ax * ay));
    const Real moment = max_of(fma(sx, ax, sy * ay), fma(Real(1e-7), abs_of(about_P), tiny)), per_moment = one / moment;
    const Real along = fma(bx, sx, by * sy) * per_moment; // b_a
    const Real out = sqrt_of(ends.reach2 * per_area * per_moment), ex = out * sx, ey = out * sy;

    // spread: all of what is across the slope, and what the ends leave of the rest
    const Real pull = C_n * load.area * v, left = one - ends.share;
    const auto pulls = pull > N;
    const Real c = C_n * select(pulls, N / select(pulls, pull, one), one), less = ends.share * along;
    const Real tilt_x = fnma(less, ax, bx), tilt_y = fnma(less, ay, by);
    const Real spread = left * c * load.area * v;
    const Real spread_x = c * fma(jxx, tilt_x, jxy * tilt_y), spread_y = c * fma(jxy, tilt_x, jyy * tilt_y);
    // the ends: the centre of the pressure between them decides what each may take from the elastic force
    const Real lever = fma(fnma(N, cx, load.moment_x), ax, fnma(N, cy, load.moment_y) * ay) / (N * out * moment);
    const Real side = clamp(lever, zero - one, one), rise = fma(bx, ex, by * ey), most = half * ends.share * N;
    const Real deep = min_of(ends.dashpot * (v + rise), fma(most, side, most));
    const Real high = min_of(ends.dashpot * (v - rise), fnma(most, side, most));
    const Real force = spread + (deep + high), apart = deep - high;
    resistance.normal = force;
    resistance.tilt_x = fma(force, cx, fma(apart, ex, spread_x));
    resistance.tilt_y = fma(force, cy, fma(apart, ey, spread_y));
}

} // namespace stylobate::spatial

#pragma once
/// Normal dashpots at the two ends of the patch, where the face lies deepest and highest, instead of one that is spread
/// over it: an impact then loses what that of rigid blocks loses.
///
///   e = sqrt(f / (A a.J a)) J a          the ends, from the centre of the patch; a: slope, J: its central moments
///   F = min(C/2 (v + b.e), N_+) + min(C/2 (v - b.e), N_-)        K = (F_+ - F_-) e + c J (b - b_a a)
///
/// v, b: rate at the centre of the patch and its growth over the face; b_a: part of b along a, in J. N_+ and N_-: the
/// elastic force by the lever rule, so that no end pulls. C is the whole face's coefficient, however small the patch.
/// Across the slope the dashpot stays spread, so that a drum that rolls on its rim is braked as without the mechanism.
///
/// Source: own derivation (THEORY.md, section 10).
///
/// Parameter: share of the normal dashpot at the ends.  Neutral: 0.  Acts in the dashpot of a bed.
/// Signature: rocking decays faster, rolling as before.
/// Confounded with C_N in the decay of rocking.

#include "kernels/spatial/friction.hpp"

namespace stylobate::spatial {

template <class Real>
struct FaceDamping {
    Real share;   ///< of the normal dashpot that acts at the ends
    Real dashpot; ///< share of C / 2, per step: of each end [N/m]
};

/// Square of the distance from the centre of a face to its edge over its radius of gyration, in the direction in which
/// the depth grows: 4 for a disc.
template <class Real>
STYLOBATE_INLINE Real disc_reach2()
{
    return Real(4.0);
}

/// The same for a rectangle: from 3 where it is deepest along an edge to 6 in a corner.
/// @param half_x, half_y half sizes along the axes of the slope [m]
template <class Real>
STYLOBATE_INLINE Real rectangle_reach2(const BedLoad<Real>& load, Real half_x, Real half_y)
{
    const Real x = abs_of(load.slope_x) * half_x, y = abs_of(load.slope_y) * half_y, sum = x + y;
    const Real tiny = Real(Extreme<NumberOf<Real>>::tiny);
    return clamp(Real(3.0) * sum * sum / max_of(fma(x, x, y * y), tiny), Real(3.0), Real(6.0));
}

/// The normal dashpot of a pressed bed.
/// @param reach2 `disc_reach2` or `rectangle_reach2`
/// @param C_n    spread dashpot per area and step [N/m3]
/// @pre load.force > 0
template <class Real>
STYLOBATE_INLINE void face_dashpot(const BedLoad<Real>& load, const FaceDamping<Real>& ends, Real reach2, Real C_n,
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
    const Real out = sqrt_of(reach2 * per_area * per_moment), ex = out * sx, ey = out * sy;

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

#pragma once
/// The bed of two discs of any radii, in closed form. THEORY.md section 4 derives it.
///
/// The common part of the two faces, a lens, is replaced by the ellipse of the same two axes; everything else is
/// exact. An ellipse with a depth that grows linearly across it is a unit disc with the depth g (xi + t), after a
/// change of scale: all of the bed follows from the integrals over a segment of the unit disc, and these from one
/// function of xi.

#include "kernels/spatial/bed.hpp"

namespace stylobate::spatial {

template <class Real>
struct DiscBed {
    Real stiffness;    ///< k [N/m3]
    Real upper_radius; ///< [m]
    Real lower_radius; ///< [m]; very large for a plane
};

/// Integrals over the part t > -xi of the unit disc, t along the direction of the largest depth, u across it.
template <class Real>
struct DiscSegment {
    Real pressure; ///< f: of xi + t
    Real moment;   ///< m: of (xi + t) t; also that of u2
    Real area;     ///< of 1
    Real first;    ///< of t
    Real second;   ///< of t2
};

/// xi at least 1 is the whole disc, at most -1 none of it.
///
/// m = eta^(5/2) P(eta) with eta = 1 - |xi|, and pi/4 minus that where xi > 0. P interpolates at the 13 Chebyshev
/// nodes of [0, 1]; its relative error is 3.5e-14. The other integrals are m and powers of w = sqrt(1 - xi2).
template <class Real>
STYLOBATE_INLINE DiscSegment<Real> disc_segment(Real xi)
{
    const double coefficients[] = {0.7542472332656586,     -0.40406101782355625,   0.039283710214639035,
                                   0.0026784315420540906,  0.00042498032656365794, 9.182987861084572e-05,
                                   2.4714130785724018e-05, 3.9626336088755745e-06, 7.492482377329048e-06,
                                   -6.083723737122011e-06, 5.792028119162959e-06,  -2.6237145181884165e-06,
                                   6.604581049354832e-07};
    const Real zero(0.0), two_thirds = Real(2.0 / 3);
    const Real eta = max_of(Real(1.0) - abs_of(xi), zero);
    Real p = Real(coefficients[12]);
    for (int i = 11; i >= 0; --i)
        p = fma(p, eta, Real(coefficients[i]));
    const Real part = eta * eta * sqrt_of(eta) * p;
    const Real m = select(xi > zero, Real(0.25 * 0x1.921fb54442d18p+1) - part, part);
    const Real w2 = eta * (Real(2.0) - eta);
    const Real first = two_thirds * w2 * sqrt_of(w2); // 2/3 w3
    const Real f = fma(Real(4.0) * xi, m, first * w2);
    return {f, m, fnma(xi, first, Real(4.0) * m), first, fnma(xi, first, m)};
}

/// The ellipse for the common part of two discs whose centres are apart by an offset, with the origin in the upper
/// centre and the first axis towards the lower one. Primes are derivatives with respect to the offset.
template <class Real>
struct Ellipse {
    Real half_along, half_across;                    ///< A along the line of the centres and B across it [m]
    Real across2;                                    ///< B2 [m2]
    Real centre;                                     ///< s [m]
    Real half_along_rate, centre_rate, across2_rate; ///< A', s', (B2)'
    Real size, size_rate;                            ///< A B and (A B)'; 0 where the discs are apart
};

/// @pre offset > 0
template <class Real>
STYLOBATE_INLINE Ellipse<Real> common_ellipse(Real offset, Real per_offset, Real upper_radius, Real lower_radius)
{
    const Real zero(0.0), one(1.0), half(0.5);
    // along the line of the centres: from the nearest end to the farthest
    const Real far = offset + lower_radius, near = offset - lower_radius;
    const Real high = min_of(upper_radius, far), low = max_of(zero - upper_radius, near);
    const Real high_rate = select(far < upper_radius, one, zero);
    const Real low_rate = select(near > zero - upper_radius, one, zero);
    const auto meet = high > low;
    // across it: half of the common chord, or of the smaller disc where its centre lies inside that chord
    const Real difference = (upper_radius - lower_radius) * (upper_radius + lower_radius);
    const Real chord = half * fma(difference, per_offset, offset); // where it is, from the upper centre
    const Real at = clamp(chord, zero, offset), rest = offset - at;
    const Real left_upper = fms(upper_radius, upper_radius, at * at);
    const Real left_lower = fms(lower_radius, lower_radius, rest * rest);
    Ellipse<Real> e;
    e.half_along = max_of(half * (high - low), Real(1e-9));
    e.centre = half * (high + low);
    e.half_along_rate = half * (high_rate - low_rate);
    e.centre_rate = half * (high_rate + low_rate);
    e.across2 = max_of(min_of(left_upper, left_lower), Real(1e-18));
    e.half_across = sqrt_of(e.across2);
    const Real chord_rate = fnma(difference * per_offset, per_offset, one); // twice the derivative of `chord`
    e.across2_rate = select(chord > zero, select(chord < offset, zero - chord * chord_rate, zero), zero);
    e.size = select(meet, e.half_along * e.half_across, zero);
    const Real size_rate = fma(e.half_along_rate, e.half_across, half * e.half_along * e.across2_rate / e.half_across);
    e.size_rate = select(meet, size_rate, zero);
    return e;
}

/// Area of the patch, its first and its second moments about the centre of the upper face.
/// @param n     direction of the ellipse's centre;  @param s_a  S a of THEORY.md
/// @param per_g 1/g
template <class Real>
STYLOBATE_INLINE void set_patch(BedLoad<Real>& load, const Ellipse<Real>& e, const DiscSegment<Real>& disc,
                                const Vector<Real>& n, const Vector<Real>& s_a, Real per_g)
{
    const Real two(2.0);
    const Real area = e.size * disc.area, first = e.size * disc.first * per_g;
    const Real centre_x = e.centre * n.x, centre_y = e.centre * n.y; // of the ellipse
    const Real from_x = first * s_a.x, from_y = first * s_a.y;       // first moments about that centre
    load.area = area;
    load.first_x = fma(area, centre_x, from_x);
    load.first_y = fma(area, centre_y, from_y);
    // about the ellipse's centre: m S + (second - m) (S a)(S a)^T / g2; then moved to the face's centre
    const Real across = e.size * disc.moment, difference = fms(e.half_along, e.half_along, e.across2) * across;
    const Real along = e.size * (disc.second - disc.moment) * per_g * per_g;
    const auto moved = [&](Real a, Real from, Real centre) {
        return fma(along * a, a, fma(area * centre, centre, two * centre * from));
    };
    load.second_xx = fma(across, e.across2, fma(difference, n.x * n.x, moved(s_a.x, from_x, centre_x)));
    load.second_yy = fma(across, e.across2, fma(difference, n.y * n.y, moved(s_a.y, from_y, centre_y)));
    load.second_xy =
        fma(difference * n.x, n.y,
            fma(along * s_a.x, s_a.y, fma(area * centre_x, centre_y, fma(centre_x, from_y, centre_y * from_x))));
}

/// Radius of friction of a segment of the unit disc: a fit of the pressure's mean distance from its centre (THEORY.md).
template <class Real>
STYLOBATE_INLINE Real disc_friction_radius(Real xi)
{
    const Real zero(0.0), one(1.0);
    const Real in = clamp(one + xi, zero, Real(2.0)), per = one / max_of(xi, one);
    const Real part = sqrt_of(in) * fma(in, fma(in, Real(-0.0153), Real(0.0275)), Real(0.4420));
    return select(xi > one, fnma(Real(0.0503) * per, per, Real(2.0 / 3)), part);
}

/// The elastic load of the bed and its patch. Coordinates on the upper face do not turn with it about its normal.
/// @pre the anchors are the centres of the faces
template <class Real>
STYLOBATE_INLINE BedLoad<Real> disc_bed(const BedPose<Real>& pose, const DiscBed<Real>& bed)
{
    const Real zero(0.0), one(1.0), half(0.5), tiny = Real(Extreme<NumberOf<Real>>::tiny);
    // the upper normal (a, c): the depth on the upper face is a . p - P_z
    const Vector<Real> a{pose.turn.m13, pose.turn.m23, zero};
    const Real c = one + pose.turn.m33, per_c = one / max_of(one + c, Real(1e-3));
    const Real tilt = sqrt_of(fma(a.x, a.x, fma(a.y, a.y, tiny))), per_tilt = one / tilt;
    // the lower centre as seen from the upper one. A tilted face is shorter in plan: the rim of the smaller disc, about
    // which it rocks, stays where it is
    const Real radius = min_of(bed.upper_radius, bed.lower_radius), shift = radius * tilt * per_c;
    const Real o_x = fms(shift, a.x, pose.place.x), o_y = fms(shift, a.y, pose.place.y);
    const Real offset = sqrt_of(fma(o_x, o_x, fma(o_y, o_y, Real(1e-36)))), per_offset = one / offset;
    const Vector<Real> n{o_x * per_offset, o_y * per_offset, zero};
    const Ellipse<Real> e = common_ellipse(offset, per_offset, bed.upper_radius, bed.lower_radius);

    // depth at the ellipse's centre, g its increase from there to the deepest point
    const Real along = fma(n.x, a.x, n.y * a.y), across = fms(n.x, a.y, n.y * a.x);
    const Real depth = fms(e.centre, along, pose.place.z);
    const Real difference = fms(e.half_along, e.half_along, e.across2); // A2 - B2
    const Vector<Real> s_a{fma(e.across2, a.x, difference * along * n.x), fma(e.across2, a.y, difference * along * n.y),
                           zero};
    const Real g2 = max_of(fma(s_a.x, a.x, s_a.y * a.y), tiny), g = sqrt_of(g2), per_g = one / g;
    const Real xi = depth * per_g;
    const DiscSegment<Real> disc = disc_segment(xi);
    const Real pressure = g * disc.pressure, energy = half * g2 * fma(xi, disc.pressure, disc.moment);

    BedLoad<Real> load;
    const Real size = bed.stiffness * e.size;
    load.force = size * pressure;
    load.energy = size * energy;
    load.moment_x = size * fma(pressure * e.centre, n.x, disc.moment * s_a.x);
    load.moment_y = size * fma(pressure * e.centre, n.y, disc.moment * s_a.y);
    // lateral: the derivative of the energy with respect to the offset, along and across it
    const Real g2_rate =
        fma(e.across2_rate, across * across, (e.half_along + e.half_along) * e.half_along_rate * along * along);
    const Real inner = fma(pressure * e.centre_rate, along, half * disc.moment * g2_rate);
    const Real radial = fma(bed.stiffness * e.size_rate, energy, size * inner);
    const Real around = size * fma(pressure, e.centre, disc.moment * difference * along) * across * per_offset;
    load.lateral_x = fms(radial, n.x, around * n.y);
    load.lateral_y = fma(radial, n.y, around * n.x);
    // torque about P: the derivative with respect to the normal, whose tilt also shifts the offset
    const Real steep_x = a.x * per_tilt, steep_y = a.y * per_tilt;
    const Real uphill = fma(load.lateral_x, steep_x, load.lateral_y * steep_y);
    const Vector<Real> gradient{fma(shift, fnma(uphill, steep_x, load.lateral_x), load.moment_x),
                                fma(shift, fnma(uphill, steep_y, load.lateral_y), load.moment_y),
                                zero - radius * uphill};
    load.torque = cross(gradient, Vector<Real>{a.x, a.y, c});

    set_patch(load, e, disc, n, s_a, per_g);
    load.friction_radius = disc_friction_radius(xi) * half * (e.half_along + e.half_across);
    // the smallest rotation that tilts the normal
    load.t11 = fnma(a.x * a.x, per_c, one);
    load.t12 = zero - a.x * a.y * per_c;
    load.t21 = load.t12;
    load.t22 = fnma(a.y * a.y, per_c, one);
    load.slope_x = a.x;
    load.slope_y = a.y;
    return load;
}

} // namespace stylobate::spatial

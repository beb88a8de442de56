#pragma once
/// Contact form `two_corner`: springs at the two ends of the face that the blocks have in common.
///
///   F_i = K_N L / 2 d_i,  d_i >= 0: depth of the upper face under the lower one at the end
///
/// L is the length in common now, so that the vertical stiffness at full contact is that of the area form, K_N B, and
/// the rotational one three times its, K_N B3 / 4. The force is along the lower face's normal; the dashpots are at the
/// ends (`face_damping.hpp`).
///
/// Source: the two-spring foundation of Psycharis & Jennings, "Rocking of slender rigid bodies allowed to uplift",
/// Earthquake Engineering and Structural Dynamics 11 (1983) 57, on the common face of two blocks.

#include "kernels/overlap.hpp"

namespace stylobate {

/// Where the springs of a form are, in the frame of the (turned) lower face, and their forces over K_N.
template <class Real, int count>
struct FormPoints {
    Real x[count > 0 ? count : 1];
    Real area[count > 0 ? count : 1];
    Real weight[count > 0 ? count : 1]; ///< part of the dashpot
    Real moment;                        ///< of the forces over K_N about the middle of the frame [m3]
};

/// The common part of two faces, and the depth of the upper one.
template <class Real>
struct CommonFace {
    Real left, length;
    Real slope; ///< tan of the relative rotation
};

template <class Real>
STYLOBATE_INLINE CommonFace<Real> common_face(const Placement<Real>& p, Real lower_half_width, Real upper_half_width)
{
    const Real reach = upper_half_width * p.cosine;
    const Real left = max_of(p.x - reach, Real(0.0) - lower_half_width);
    const Real right = min_of(p.x + reach, lower_half_width);
    return {left, max_of(right - left, Real(0.0)), p.sine / p.cosine};
}

/// Where along the face the springs are, from 0 to 1, and what part of the stiffness each has (sum 1).
template <int count>
struct FaceRule {
    double at[count];
    double part[count];
};

/// Springs at the points of a rule; `pressure` takes a depth [m] to the depth [m] of a linear bed with the same
/// pressure, and its energy [m2].
/// @param fits as in `stacked_overlap`: where not, the overlap of the area form is taken
template <class Real, int count, class Pressure, class Mask>
STYLOBATE_INLINE Overlap<Real> spring_points(const Placement<Real>& p, Real lower_half_width, Real upper_half_width,
                                             Real depth_limit, const FaceRule<count>& rule, const Pressure& pressure,
                                             FormPoints<Real, count>& points, Mask& fits)
{
    const Real zero(0.0);
    const CommonFace<Real> face = common_face(p, lower_half_width, upper_half_width);
    Overlap<Real> o{zero, zero, zero, zero, face.length, zero};
    Real deepest(0.0);
    for (int i = 0; i < count; ++i) {
        const Real x = fma(face.length, Real(rule.at[i]), face.left);
        const Real depth = max_of(fnma(x - p.x, face.slope, p.depth), zero);
        Real energy;
        const Real area = face.length * Real(rule.part[i]) * pressure(depth, energy);
        points.x[i] = x;
        points.area[i] = area;
        points.weight[i] = select(depth > zero, Real(rule.part[i]), zero);
        o.area = o.area + area;
        o.moment_x = fma(x, area, o.moment_x);
        o.moment_depth = fma(Real(0.5) * depth, area, o.moment_depth);
        o.elastic = fma(face.length * Real(rule.part[i]), energy, o.elastic);
        deepest = max_of(deepest, depth);
    }
    points.moment = o.moment_x;
    fits = (p.cosine > Real(0.2)) & (deepest < depth_limit) & (face.length > zero);
    return o;
}

/// A linear bed.
struct LinearPressure {
    template <class Real>
    STYLOBATE_INLINE Real operator()(Real depth, Real& energy) const
    {
        energy = Real(0.5) * depth * depth;
        return depth;
    }
};

template <class Real, class Mask>
STYLOBATE_INLINE Overlap<Real> two_corner_overlap(const Placement<Real>& p, Real lower_half_width,
                                                  Real upper_half_width, Real depth_limit, FormPoints<Real, 2>& points,
                                                  Mask& fits)
{
    constexpr FaceRule<2> ends{{0, 1}, {0.5, 0.5}};
    return spring_points(p, lower_half_width, upper_half_width, depth_limit, ends, LinearPressure{}, points, fits);
}

} // namespace stylobate

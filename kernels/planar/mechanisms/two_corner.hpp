#pragma once
/// Contact form `two_corner`: springs at the two ends of the face that the blocks have in common.
///
///   F_i = K_N L / 2 d_i,  d_i >= 0: depth of the upper face under the lower one at the end
///
/// L is the length in common now, so that the vertical stiffness at full contact is that of the area form, K_N B, and
/// the rotational one three times its, K_N B3 / 4. The dashpots are at the ends (`face_damping.hpp`).
///
/// The force is along the lower face's normal. Where the faces are steep against each other (tan of the rotation above
/// `lean_from`; a block that falls), an end that is the lower block's corner presses along the upper face's normal
/// instead, by the depth along it: the gradient of its energy (own derivation, `THEORY.md` section 5). Along the lower
/// one a block that slides down would do work tan(rotation) F_i s that no energy pays for.
///
/// Source: the two-spring foundation of Psycharis & Jennings, "Rocking of slender rigid bodies allowed to uplift",
/// Earthquake Engineering and Structural Dynamics 11 (1983) 57, on the common face of two blocks.

#include "kernels/planar/overlap.hpp"

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

/// How the springs at a steep face lean: along the gradient of their energy.
template <class Real>
struct SpringLean {
    Real slope;       ///< tan of the relative rotation, 0 up to `lean_from`
    Real left, right; ///< 1 where the end of the common face is the upper block's corner, 0 where it is the lower's
};

/// Slope of a face up to which all springs act along the lower face's normal, and from which on they lean wholly. (What
/// only rocks stays below: the law is the published one there, with its bits.)
inline constexpr double lean_from = 0.25, lean_whole = 0.5;

template <class Real>
STYLOBATE_INLINE SpringLean<Real> spring_lean(const Placement<Real>& p, Real lower_half_width, Real upper_half_width,
                                              const CommonFace<Real>& face)
{
    const Real zero(0.0), one(1.0), tiny = Real(Extreme<NumberOf<Real>>::tiny);
    const Real reach = upper_half_width * p.cosine, middle = fma(p.x, face.slope, p.depth);
    const Real part = clamp((abs_of(face.slope) - Real(lean_from)) * Real(1 / (lean_whole - lean_from)), zero, one);
    // one corner takes over from the other over a distance of the depth, as in the area form
    const auto corner = [&](Real inset, Real x) {
        const Real depth = max_of(fnma(x, face.slope, middle), tiny);
        return min_of(max_of(inset, zero) / depth, one);
    };
    return {part * face.slope, corner(p.x - reach + lower_half_width, face.left),
            corner(lower_half_width - (p.x + reach), face.left + face.length)};
}

/// The sums over the springs at the points of a rule.
/// @tparam leaning whether a face is steep in some realization; in the others the bits are those of false
template <bool leaning, class Real, int count, class Pressure>
STYLOBATE_INLINE Overlap<Real> spring_sums(const Placement<Real>& p, const CommonFace<Real>& face,
                                           const SpringLean<Real>& lean, const FaceRule<count>& rule,
                                           const Pressure& pressure, FormPoints<Real, count>& points, Real& deepest)
{
    const Real zero(0.0), one(1.0);
    Overlap<Real> o{zero, zero, zero, zero, face.length, zero};
    Real along(0.0), across(0.0);
    deepest = zero;
    for (int i = 0; i < count; ++i) {
        const Real x = fma(face.length, Real(rule.at[i]), face.left);
        Real depth = max_of(fnma(x - p.x, face.slope, p.depth), zero);
        deepest = max_of(deepest, depth);
        [[maybe_unused]] Real slope(0.0), cosine(1.0);
        if constexpr (leaning) {
            slope = lean.slope * (one - fma(lean.right - lean.left, Real(rule.at[i]), lean.left));
            cosine = one / sqrt_of(fma(slope, slope, one));
            depth = depth * cosine;
        }
        Real energy;
        const Real area = face.length * Real(rule.part[i]) * pressure(depth, energy);
        points.x[i] = x;
        points.area[i] = area;
        points.weight[i] = select(depth > zero, Real(rule.part[i]), zero);
        o.area = o.area + area;
        o.moment_x = fma(x, area, o.moment_x);
        o.moment_depth = fma(Real(0.5) * depth, area, o.moment_depth);
        o.elastic = fma(face.length * Real(rule.part[i]), energy, o.elastic);
        if constexpr (leaning) {
            along = fnma(area * cosine, slope, along);
            across = fma(area, cosine, across);
        }
    }
    if constexpr (leaning) {
        // (the sum of forces that lean differently is less than their sum in size)
        const Real size = sqrt_of(fma(along, along, across * across));
        const auto leans = (lean.slope != zero) & (size > zero);
        const Real per_size = face.length / select(leans, size, one);
        o.normal_x = select(leans, along * per_size, zero);
        o.normal_y = select(leans, across * per_size, face.length);
        const Real less = select(leans, size / select(leans, o.area, one), one);
        o.area = o.area * less;
        o.moment_x = o.moment_x * less;
        o.moment_depth = o.moment_depth * less;
        for (int i = 0; i < count; ++i)
            points.area[i] = points.area[i] * less;
    }
    return o;
}

/// Springs at the points of a rule; `pressure` takes a depth [m] to the depth [m] of a linear bed with the same
/// pressure, and its energy [m2].
/// @param fits as in `stacked_overlap`: where not, the overlap of the area form is taken
template <class Real, int count, class Pressure, class Mask>
STYLOBATE_INLINE Overlap<Real> spring_points(const Placement<Real>& p, Real lower_half_width, Real upper_half_width,
                                             Real depth_limit, const FaceRule<count>& rule, const Pressure& pressure,
                                             FormPoints<Real, count>& points, Mask& fits)
{
    const CommonFace<Real> face = common_face(p, lower_half_width, upper_half_width);
    Real deepest;
    Overlap<Real> o;
    if (any(abs_of(face.slope) > Real(lean_from))) [[unlikely]]
        o = spring_sums<true>(p, face, spring_lean(p, lower_half_width, upper_half_width, face), rule, pressure, points,
                              deepest);
    else
        o = spring_sums<false>(p, face, SpringLean<Real>{}, rule, pressure, points, deepest);
    points.moment = o.moment_x;
    fits = (p.cosine > Real(0.2)) & (deepest < depth_limit) & (face.length > Real(0.0));
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

#pragma once
/// A face out of square: the lower block's top face is turned about its middle.
///
///   the upper block meets a lower block that is turned by theta_l + wedge
///
/// Source: own derivation (geometry).
///
/// Parameter: wedge [rad], counter-clockwise.  Neutral: 0.  Acts in the overlap of a bed.
/// Signature: the structure rests at a tilt of the sum of the wedges under it; residual tilt and drift to one side.
/// Confounded with `eccentricity`, a tilted base and `table_pitch` as a bias.

#include "kernels/planar/overlap.hpp"

namespace stylobate {

/// A placement as seen from the turned face.
template <class Real>
STYLOBATE_INLINE Placement<Real> onto_wedge(const Placement<Real>& p, Real sine, Real versine)
{
    const Real cosine = Real(1.0) - versine;
    return {fnma(p.depth, sine, p.x * cosine), fma(p.x, sine, p.depth * cosine), fnma(p.cosine, sine, p.sine * cosine),
            fma(p.sine, sine, p.cosine * cosine)};
}

/// Moments and direction of an overlap back in the lower block's own frame.
template <class Real>
STYLOBATE_INLINE void off_wedge(Overlap<Real>& o, Real sine, Real versine)
{
    const Real cosine = Real(1.0) - versine;
    const Real moment_x = o.moment_x, normal_x = o.normal_x;
    o.moment_x = fma(o.moment_depth, sine, moment_x * cosine);
    o.moment_depth = fnma(moment_x, sine, o.moment_depth * cosine);
    o.normal_x = fnma(o.normal_y, sine, normal_x * cosine);
    o.normal_y = fma(normal_x, sine, o.normal_y * cosine);
}

} // namespace stylobate

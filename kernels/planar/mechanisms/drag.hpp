#pragma once
/// Drag of the air (or of cables) on a block.
///
///   F = -(c |v| + d) v,  v: velocity of the centre of mass in the laboratory
///
/// Source: the quadratic drag law (a fluid), and the linear one (creeping flow, a viscous damper to the laboratory).
///
/// Parameters: c [N s2/m2], d [N s/m].  Neutral: 0.  Acts in the update of a block.
/// Signature: decay that depends on the amplitude, without a jump at impacts.
/// Confounded with C_N and `rate_damping` in the decay of rocking.

#include "kernels/real.hpp"

namespace stylobate {

/// dt2 / m times the force is -factor x displacement of the last step in the laboratory.
/// @param per_mass c / m [1/m];  @param linear dt d / m;  @param dx, dy displacement of the last step in the laboratory
/// [m]
template <class Real>
STYLOBATE_INLINE Real drag_factor(Real per_mass, Real linear, Real dx, Real dy)
{
    return per_mass * sqrt_of(fma(dx, dx, dy * dy)) + linear;
}

} // namespace stylobate

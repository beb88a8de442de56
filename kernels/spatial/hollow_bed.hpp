#pragma once
/// A hollow bed (anathyrosis): both faces have a recess in their middle, and only the rings outside the recesses bear.
///
/// Its load is that of the whole faces less that of the recesses on each other, by the same law. THEORY.md says where
/// this is exact. A sum of gradients is one: the load is the gradient of E_whole - E_inner.

#include "kernels/spatial/bed.hpp"

namespace stylobate::spatial {

/// @param inner load of the recesses on each other, at the same pose; no load: the result is `whole` to the bit
template <class Real>
STYLOBATE_INLINE BedLoad<Real> hollow_load(const BedLoad<Real>& whole, const BedLoad<Real>& inner)
{
    const Real zero(0.0), one(1.0);
    BedLoad<Real> ring = whole; // the coordinates on the face are the same
    ring.force = whole.force - inner.force;
    ring.lateral_x = whole.lateral_x - inner.lateral_x;
    ring.lateral_y = whole.lateral_y - inner.lateral_y;
    ring.torque = whole.torque - inner.torque;
    ring.moment_x = whole.moment_x - inner.moment_x;
    ring.moment_y = whole.moment_y - inner.moment_y;
    ring.energy = whole.energy - inner.energy;
    ring.area = whole.area - inner.area;
    ring.first_x = whole.first_x - inner.first_x;
    ring.first_y = whole.first_y - inner.first_y;
    ring.second_xx = whole.second_xx - inner.second_xx;
    ring.second_xy = whole.second_xy - inner.second_xy;
    ring.second_yy = whole.second_yy - inner.second_yy;
    // the torques of friction of a spin subtract: exact for a ring that is pressed evenly, and nearly so elsewhere
    const auto both = (inner.force > zero) & (ring.force > zero);
    const Real torque = fms(whole.force, whole.friction_radius, inner.force * inner.friction_radius);
    ring.friction_radius = select(both, torque / select(both, ring.force, one), whole.friction_radius);
    return ring;
}

} // namespace stylobate::spatial

#pragma once
/// A dowel in a joint: an elastic, perfectly plastic spring with play against offsets of the faces in any direction.
///
///   F = k_d (b - gap) n,  at most F_d       b = |s - s_p|,  n = (s - s_p) / b;  no force while b < gap
///
/// s is the offset of the upper body's anchor from the lower body's, along the lower body's axes, s_p the plastic
/// offset: it takes up the excess over F_d along n (radial return). The force acts at the upper anchor, also while that
/// has lifted, up to a quarter of the lower of the two heights: there the dowel comes out of its hole.
///
/// Source: return mapping of perfect plasticity (Simo & Laursen, Computers & Structures 42 (1992) 97) with the circle
/// |F| = F_d; the round play is an own choice.
///
/// Parameters: k_d [N/m], F_d [N], gap [m].  Neutral: k_d = 0.  Acts beside a bed.
/// Signature: the offset of a joint stops at gap + F / k_d, in every direction; the twist is not hindered.

#include "kernels/spatial/friction.hpp"

namespace stylobate::spatial {

/// How far out a dowel holds, in `OfJoint::depth_limit` (a tenth of the smaller height).
inline constexpr double dowel_reach = 2.5;

template <class Real>
struct DowelForce {
    Real x, y;         ///< on the upper body, against its offset [N]
    Real set_x, set_y; ///< plastic offset [m]
};

/// @param per_stiffness 1 / k_d, 0 where there is none
template <class Real>
STYLOBATE_INLINE DowelForce<Real> dowel_force(Real stiffness, Real per_stiffness, Real yield, Real gap, Real offset_x,
                                              Real offset_y, Real set_x, Real set_y)
{
    const Real zero(0.0);
    const Real bx = offset_x - set_x, by = offset_y - set_y;
    const Real beyond = detail::length_of(bx, by, zero);
    const Real per_beyond = Real(1.0) / beyond;
    const Real nx = bx * per_beyond, ny = by * per_beyond;
    const Real trial = stiffness * max_of(beyond - gap, zero);
    const Real force = min_of(trial, yield);
    const Real moved = (trial - force) * per_stiffness;
    return {force * nx, force * ny, fma(moved, nx, set_x), fma(moved, ny, set_y)};
}

} // namespace stylobate::spatial

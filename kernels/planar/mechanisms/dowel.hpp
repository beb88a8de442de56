#pragma once
/// A dowel in the middle of the joint: an elastic, perfectly plastic spring with play against offsets of the faces.
///
///   F = clamp(k_d D(s - s_p), -F_d, F_d)      D(s) = s - clamp(s, -gap, gap)
///
/// s is the offset of the upper block's face along the lower one's, s_p the plastic offset: it takes up the excess over
/// F_d. The force acts at the middle of the upper block's bottom face, also while that has lifted, up to half of the
/// smaller half height: there the dowel comes out of its hole.
///
/// Source: return mapping of perfect plasticity (Simo & Laursen, Computers & Structures 42 (1992) 97); the play is an
/// own choice.
///
/// Parameters: k_d [N/m], F_d [N], gap [m].  Neutral: k_d = 0.  Acts beside the contact of a bed.
/// Signature: the offset of a joint stops at gap + F / k_d; slip is as before within the gap.

#include "kernels/real.hpp"

namespace stylobate {

/// How far out a dowel holds, in `OfJoint::depth_limit` (a tenth of the smaller half height).
inline constexpr double dowel_reach = 5;

template <class Real>
struct DowelForce {
    Real force; ///< on the upper block against its offset [N]
    Real set;   ///< plastic offset [m]
};

/// @param per_stiffness 1 / k_d, 0 where there is none
template <class Real>
STYLOBATE_INLINE DowelForce<Real> dowel_force(Real stiffness, Real per_stiffness, Real yield, Real gap, Real offset,
                                              Real set)
{
    const Real beyond = offset - set;
    const Real trial = stiffness * (beyond - clamp(beyond, Real(0.0) - gap, gap));
    const Real force = clamp(trial, Real(0.0) - yield, yield);
    return {force, fma(trial - force, per_stiffness, set)};
}

} // namespace stylobate

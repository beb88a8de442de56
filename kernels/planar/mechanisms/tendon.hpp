#pragma once
/// A cable through a column: from the middle of a block's top face down to the fixed ground, vertical at rest.
///
///   T = clamp(k (e_0 + e - e_p), 0, T_y)      e = l - l_0      e_0 = T_0 / k
///
/// along the line between its anchors. l_0 is their distance at rest, where the tension is the prestress T_0; e_p, the
/// plastic elongation, takes up what exceeds the yield T_y. A cable that is shortened beyond e_0 is slack.
///
/// Source: Hooke's law of a bar, k = E A / L, and the return mapping of perfect plasticity (Simo & Laursen, Computers &
/// Structures 42 (1992) 97), without compression.
///
/// Parameters: k [N/m], T_0 [N], T_y [N].  Neutral: k = 0.  Acts in the sum of the forces on a block; T_0 changes the
/// state of rest (`ensemble/planar/structure`).
/// Energy: T2 / (2 k) is stored; what yields is dissipated.
/// Step bound: k at the anchor in both directions.
/// Limits: it touches no block between its anchors, has no mass, and its lower anchor does not move.
/// Signature: rocking with a restoring moment that grows with the rotation; less slip, as every bed is pressed more.

#include "kernels/real.hpp"

namespace stylobate {

template <class Real>
struct TendonForce {
    Real tension; ///< [N]
    Real set;     ///< plastic elongation [m]
};

/// @param stretch e_0 [m];  @param elongation e [m];  @param set e_p [m]
/// @pre stiffness > 0, or all is 0
template <class Real>
STYLOBATE_INLINE TendonForce<Real> tendon_force(Real stiffness, Real stretch, Real yield, Real elongation, Real set)
{
    const Real zero(0.0), one(1.0);
    const auto there = stiffness > zero;
    const Real trial = stiffness * ((stretch + elongation) - set);
    const Real excess = max_of(trial - yield, zero);
    const Real tension = min_of(max_of(trial, zero), yield);
    return {select(there, tension, zero), select(there, set + excess / select(there, stiffness, one), set)};
}

} // namespace stylobate

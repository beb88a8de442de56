#pragma once
/// A bonded joint: until it breaks, the part of the face that opens carries tension as the rest carries compression.
///
///   T = K_N int_o o dx      V = K_T s + C_T s'      o > 0 the opening along the face, s the offset from rest
///
/// It breaks permanently and at once when the opening at either edge reaches f_t D / K_N, that is when the tensile
/// stress reaches f_t, or the shear reaches c D L + mu N. Then the joint is an ordinary one, with friction.
///
/// Source: linear elastic joint with a tension cut-off and the Coulomb shear limit, as in P. B. Lourenco and J. G.
/// Rots, "Multisurface interface model for analysis of masonry structures", Journal of Engineering Mechanics 123 (1997)
/// 660-668, here without softening. The integral is an own derivation: the opening is linear along the face.
///
/// Parameters: f_t D [N/m], c D [N/m] (D the depth).  Neutral: f_t = 0.  Acts beside the contact of a bed, whose
/// friction waits until it has broken. A bed that opens at rest is closed by it (`ensemble/planar/structure`).
/// Energy: K_N int_o o2 dx / 2 + V2 / (2 K_T) is stored; what is stored when it breaks is dissipated.
/// Step bound: none of its own; a full contact has the same stiffness.
/// Limits: no softening, so a brittle upper limit of the strength and a lower one of the energy; contact form `area`.
/// Signature: no uplift up to a moment of (f_t + N / A) D B2 / 6, and then the uplift of a dry joint.

#include "kernels/real.hpp"

namespace stylobate {

template <class Real>
struct BondPull {
    Real force;  ///< T / K_N [m2]
    Real couple; ///< of it about the origin of the arms, over K_N [m3]
    Real energy; ///< over K_N [m3]
    Real most;   ///< opening of the more opened edge [m]
};

/// Tension over the opened part of a face whose opening is linear along it.
/// @param left, right arms of the ends of the face [m];  @param at_left, at_right openings there, negative where it is
/// pressed [m]
template <class Real>
STYLOBATE_INLINE BondPull<Real> bond_pull(Real left, Real right, Real at_left, Real at_right)
{
    const Real zero(0.0), one(1.0), third(1.0 / 3);
    const auto to_right = at_right > at_left;
    const Real most = max_of(at_left, at_right), least = min_of(at_left, at_right);
    const auto open = most > zero;
    const Real low = max_of(least, zero);
    // from the more opened end, so long is the opened part
    const Real span = select(open, most - min_of(least, zero), one);
    const Real length = (right - left) * select(open, most / span, zero);
    const Real sum = most + low;
    const Real force = select(open, Real(0.5) * length * sum, zero);
    const Real from_end = length * third * fma(Real(2.0), low, most) / select(open, sum, one);
    const Real arm = select(to_right, right - from_end, left + from_end);
    const Real square = fma(most, most, fma(most, low, low * low));
    return {force, force * arm, select(open, length * square * Real(1.0 / 6), zero), most};
}

} // namespace stylobate

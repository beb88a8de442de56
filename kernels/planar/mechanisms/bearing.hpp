#pragma once
/// A seismic isolator in a joint: a horizontal force against the offset s of its faces, beside the joint's friction.
///
///   F = k s + c s' + N s / R
///
/// s counts from the state of rest; N is the normal force of the joint. Kinds: a flat slider has the joint's friction
/// alone, a friction pendulum 1 / R and friction, an elastomeric bearing k and c with nearly no friction.
///
/// Source: the pendulum of V. A. Zayas, S. S. Low and S. A. Mahin, "A simple pendulum technique for achieving seismic
/// isolation", Earthquake Spectra 6 (1990) 317-333, for small s / R; the linear spring and dashpot (Kelvin and Voigt).
///
/// Parameters: k [N/m], c [N s/m], 1 / R [1/m].  Neutral: 0.  Acts beside the contact of a bed, at the middle of the
/// upper face, also where that has lifted, as far as a dowel does (`dowel_reach`). The state of rest is the one
/// without. Energy: k s2 / 2 + N s2 / (2 R) is stored; the remainder of the work is damping. Step bound: k + N / R and
/// c along the face. Limits: the joint does not rise on the dish (s2 / 2R is left out), has no end stop, and carries no
/// tension. Signature: the blocks above move as one, with the period 2 pi sqrt(m / k) or 2 pi sqrt(R / g).

#include "kernels/real.hpp"

namespace stylobate {

/// @param dashpot c / dt [N/m];  @param per_radius 1 / R [1/m];  @param normal N [N]
/// @param offset s [m];  @param change of s in the last step [m]
/// @return on the upper block against its offset [N]
template <class Real>
STYLOBATE_INLINE Real bearing_force(Real stiffness, Real dashpot, Real per_radius, Real normal, Real offset,
                                    Real change)
{
    return fma(fma(normal, per_radius, stiffness), offset, dashpot * change);
}

} // namespace stylobate

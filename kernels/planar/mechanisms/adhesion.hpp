#pragma once
/// A bond of the faces against sliding, until they first slip or part.
///
///   |F_T| <= mu F_N + c L,  L: contact length
///
/// In space the same with the area of the patch: |F_T| <= mu F_N + c A, c [Pa].
///
/// With a tension t [N/m] the bond holds against opening too: it is then that of `mortar.hpp`, with f_t D = t and
/// c D = c, and has its rows; the limit of the shear is the same.
///
/// Source: cohesion of the Mohr-Coulomb law; its loss at the first slip is an own choice.
///
/// Parameter: c [N/m].  Neutral: 0.  Acts in the friction of a bed, which has no tension across its faces.
/// Signature: only the first slip comes late, and with a jump (the friction spring releases c L).
/// Confounded with mu where a run has one slip only.

#include "kernels/real.hpp"

namespace stylobate {

/// @param broken 0 while the bond is whole, then 1
/// @return the bound on |F_T| [N]
template <class Real>
STYLOBATE_INLINE Real adhesion_limit(Real friction, Real adhesion, Real length, Real broken)
{
    return fma(adhesion * (Real(1.0) - broken), length, friction);
}

/// @param excess force that the friction spring lost in this step [N]
template <class Real, class Mask>
STYLOBATE_INLINE Real adhesion_broken(Real broken, Mask pressed, Real excess)
{
    return select(pressed, select(excess > Real(0.0), Real(1.0), broken), Real(1.0));
}

} // namespace stylobate

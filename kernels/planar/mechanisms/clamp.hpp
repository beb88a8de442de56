#pragma once
/// Clamps between two blocks that stand side by side: an elastic, perfectly plastic spring with play along the left
/// block's axis, between points of their facing faces.
///
///   F = clamp(k D(e - e_p), -F_y, F_y)      D(e) = e - clamp(e, -gap, gap)
///
/// e is the elongation since rest, e_p the plastic one. In compression k and the yield's slope are `push` instead; with
/// push = 0 it acts in tension alone. Beyond its breaking elongation it is gone permanently.
///
/// Source: return mapping of perfect plasticity (Simo & Laursen, Computers & Structures 42 (1992) 97); play, different
/// stiffness in compression and the breaking are own choices.
///
/// Parameters: k [N/m], F_y [N], gap [m], push / k, height [m], e at break [m].  Neutral: k = 0.  Acts between two
/// blocks; the force is on both at the right end of the clamp, so that the moments balance. It is put in at rest.
/// Energy: F2 / (2 k) is stored; what yields, and what is stored when it breaks, is dissipated.
/// Step bound: k along the axis at the height of the clamp.
/// Limits: no bending, no dowel action across the clamp; the stone around it does not break.
/// Signature: epistyles that move together along the colonnade.

#include "kernels/real.hpp"

namespace stylobate {

template <class Real>
struct ClampForce {
    Real force;  ///< tension positive [N]
    Real set;    ///< plastic elongation [m]
    Real broken; ///< 1 once it has broken
    Real held;   ///< energy stored [J]
};

/// @param pull, push stiffness in tension and in compression [N/m]
template <class Real>
STYLOBATE_INLINE ClampForce<Real> clamp_force(Real pull, Real push, Real strength, Real gap, Real most, Real elongation,
                                              Real set, Real broken)
{
    const Real zero(0.0), one(1.0);
    const Real gone = select(elongation > most, one, broken);
    const auto whole = (gone < Real(0.5)) & (pull > zero);
    const Real beyond = elongation - set;
    const Real stretch = beyond - clamp(beyond, zero - gap, gap);
    const Real stiffness = select(stretch < zero, push, pull);
    const Real trial = stiffness * stretch;
    const Real force = select(whole, clamp(trial, zero - strength, strength), zero);
    const Real per = one / select(stiffness > zero, stiffness, one);
    return {force, select(whole, fma(trial - force, per, set), set), select(pull > zero, gone, zero),
            Real(0.5) * force * force * per};
}

} // namespace stylobate

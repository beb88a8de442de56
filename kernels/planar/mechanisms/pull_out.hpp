#pragma once
/// Two dowels of a joint that hold against its opening, at a distance to either side of the middle of the upper face.
///
///   F = clamp(k_a (o - o_p), -F_a, F_a)      o = max(0, opening of the faces at the dowel)
///
/// o_p is the part of the opening by which the dowel has slipped out. Once o reaches the embedded length the dowel is
/// out, and holds no more. When the joint closes again, the dowel that slips back holds against that too.
///
/// Source: bond of constant strength along an anchor (elastic, perfectly plastic; return mapping as of `dowel.hpp`);
/// the force against the return is an own choice.
///
/// Parameters: F_a [N] and k_a [N/m] of one dowel, embedded length [m], distance from the middle [m].  Neutral: F_a =
/// 0. Acts beside the contact of a bed. The state of rest is the one without. Energy: F2 / (2 k_a) is stored; slipping,
/// and what is stored when a dowel is out, is dissipated. Step bound: k_a of both dowels, normal to the face and in
/// rotation. Limits: the hold does not fall with the length that is still in; dowels do not bend. Their shear is
/// `dowel`. Signature: uplift later by 2 F_a x (lever arm), and rocking that loses energy in every cycle.

#include "kernels/real.hpp"

namespace stylobate {

template <class Real>
struct HoldForce {
    Real force; ///< on the upper block, towards the lower one [N]
    Real set;   ///< o_p [m]
    Real out;   ///< 1 once it is out
};

/// @param per_stiffness 1 / k_a, 0 where there is none;  @param opening o [m]
template <class Real>
STYLOBATE_INLINE HoldForce<Real> hold_force(Real limit, Real stiffness, Real per_stiffness, Real length, Real opening,
                                            Real set, Real out)
{
    const Real zero(0.0), one(1.0);
    const auto there = limit > zero;
    const Real gone = select(there & (opening > length), one, out);
    const Real trial = stiffness * (opening - set);
    const Real force = clamp(trial, zero - limit, limit);
    const auto holds = there & (gone < Real(0.5));
    return {select(holds, force, zero), select(holds, fma(trial - force, per_stiffness, set), set), gone};
}

} // namespace stylobate

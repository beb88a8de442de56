#pragma once
/// A linear tie between a block and the base: a spring and dashpots, and a constant pull.
///
///   F = f - k x - c x'      M = -c_r theta'
///
/// x: horizontal displacement of the centre of mass from its place in the reference stack, in the frame of the base;
/// theta: rotation against the base.
///
/// Source: the linear spring and dashpot (Kelvin and Voigt). A negative k drives the block away from its place.
///
/// Parameters: k [N/m], c [N s/m], f [N], c_r [N m s].  Neutral: 0.  Acts in the update of a block. The pull acts from
/// the first step on: the state of rest is the one without it.
/// Signature: a force on one block that depends on where it is, or how fast it moves, and not on its joints.
/// Confounded with `drag` and `eccentricity` in small amplitudes, and with the friction of the block's joints.

#include "kernels/real.hpp"

namespace stylobate {

/// dt2 / m times minus the force.
/// @param spring dt2 k / m;  @param dashpot dt c / m;  @param pull dt2 f / m [m];  @param x [m];  @param dx increment
/// of the last step [m];  @param other what slows it besides [m]
template <class Real>
STYLOBATE_INLINE Real tie_resistance(Real spring, Real dashpot, Real pull, Real x, Real dx, Real other)
{
    return fma(spring, x, fma(dashpot, dx, other)) - pull;
}

} // namespace stylobate

#pragma once
/// Friction that decreases with the sliding velocity (Stribeck).
///
///   mu(v) = mu_d + (mu_s - mu_d) exp(-|v| / v_s) = mu_s (1 - drop (1 - exp(-|v| / v_s))),  drop = 1 - mu_d / mu_s
///
/// Source: exponential form in Armstrong-Helouvry, Dupont & Canudas de Wit, "A survey of models, analysis tools and
/// compensation methods for the control of machines with friction", Automatica 30 (1994) 1083.
///
/// Parameters: mu_d / mu_s, v_s [m/s].  Neutral: mu_d / mu_s = 1.  Acts in the friction of a bed.
/// Signature: once a joint slips it accelerates; slip comes in bursts, which grow more than in proportion to velocity.
/// Confounded with `joint_friction` where every slip is fast, and with `friction_wear`.

#include "kernels/exponential.hpp"

namespace stylobate {

/// @param sliding of this step [m];  @param per_step 1 / (v_s dt) [1/m]
/// @return the factor on mu
template <class Real>
STYLOBATE_INLINE Real stribeck_factor(Real drop, Real per_step, Real sliding)
{
    const Real kept = exponential(Real(0.0) - abs_of(sliding) * per_step);
    return fnma(drop, Real(1.0) - kept, Real(1.0));
}

} // namespace stylobate

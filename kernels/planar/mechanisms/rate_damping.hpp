#pragma once
/// Damping in proportion to the force (Hunt and Crossley).
///
///   F_N = max(0, F_el (1 + lambda v_N) + C_N v_N)
///
/// Source: Hunt & Crossley, "Coefficient of restitution interpreted as damping in vibroimpact", Journal of Applied
/// Mechanics 42 (1975) 440; beside it the dashpot of Eq. 1.
///
/// Parameter: lambda [s/m].  Neutral: 0 (with C_N = 0 too the bed is elastic).  Acts in the normal force of a bed.
/// Signature: no jump of the force when faces meet; losses grow with the velocity of the impact.
/// Confounded with C_N and drag in the decay of rocking.

#include "kernels/real.hpp"

namespace stylobate {

/// @param rate lambda / dt [1/m];  @param dashpot C_N / dt [N/m]
/// @return force per closing of this step [N/m]
template <class Real>
STYLOBATE_INLINE Real rate_coefficient(Real rate, Real elastic, Real dashpot)
{
    return fma(rate, elastic, dashpot);
}

} // namespace stylobate

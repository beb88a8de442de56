#pragma once
/// Friction that wears with the slip of its joint.
///
///   mu = mu_0 max(0, 1 - k S),  S: sum of |slip| of the joint so far
///
/// Source: own choice, linear in the slip path.
///
/// Parameter: k [1/m].  Neutral: 0.  Acts in the friction of a bed.
/// Signature: under steady shaking the slip of each cycle is larger than that of the one before.
/// Confounded with `stribeck` in a single run.

#include "kernels/real.hpp"

namespace stylobate {

/// @return the factor on mu
template <class Real>
STYLOBATE_INLINE Real wear_factor(Real wear, Real slip)
{
    return max_of(fnma(wear, slip, Real(1.0)), Real(0.0));
}

} // namespace stylobate

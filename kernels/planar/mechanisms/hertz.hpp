#pragma once
/// A bed that stiffens (or softens) with its load.
///
///   F_el = K_N A_ref (A / A_ref)^q
///
/// A: overlap (of the other forms: their force over K_N), A_ref: the overlap at which the force is the linear law's.
///
/// Source: own choice; it generalizes the power law of Hertz, "Ueber die Beruehrung fester elastischer Koerper",
/// Journal fuer die reine und angewandte Mathematik 92 (1882) 156, to the overlap.
///
/// Parameters: q, A_ref [m2].  Neutral: q = 1.  Acts in the elastic normal force of a bed.
/// Signature: natural frequencies rise with the load above a joint (q > 1), and with the amplitude in closing.
/// Confounded with K_N where all joints carry about the same.

#include "kernels/exponential.hpp"

namespace stylobate {

/// @param exponent q - 1;  @param per_reference 1 / A_ref [1/m2]
/// @return the factor on K_N A
template <class Real>
STYLOBATE_INLINE Real hertz_factor(Real exponent, Real per_reference, Real area)
{
    return power(area * per_reference, exponent);
}

} // namespace stylobate

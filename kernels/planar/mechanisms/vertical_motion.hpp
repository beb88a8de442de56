#pragma once
/// Vertical motion of the base, from a record of its own or in proportion to the horizontal one.
///
///   y'' = F_y / m - g - V''
///
/// Source: Newton's law in an accelerated frame.
///
/// Parameter: V (as its second differences), or k_v with V = k_v U.  Neutral: 0.  Acts in the update of all blocks.
/// Signature: the normal forces, and so the slip, follow the vertical motion; for k_v simultaneously with the
/// horizontal one, and at twice the frequency in products of both.

#include "kernels/real.hpp"

namespace stylobate {

/// dt2 x the additional downward acceleration in the frame of a base that accelerates upwards.
template <class Real>
STYLOBATE_INLINE Real vertical_pull(Real gravity, Real vertical)
{
    return gravity - vertical;
}

} // namespace stylobate

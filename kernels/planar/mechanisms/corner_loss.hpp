#pragma once
/// Chipped arrises: the contact face of a joint has lost a length at either end.
///
///   face = [left + chip_left, right - chip_right]
///
/// of the face that the two blocks have in common in the reference stack. The loss is taken from the block whose side
/// ends the face there (the upper one where both do), over its whole height: for this joint that block is narrower.
///
/// Source: own derivation (geometry; uplift at g (b - c) / h by the balance of moments).
///
/// Parameters: chip_left, chip_right [m].  Neutral: 0.  Acts in the overlap of a bed.
/// Signature: uplift begins earlier, at g (b - c) / h, at lower frequency; one-sided chips lean to their side.
/// Confounded with the gain (at uplift) and K_N (at small amplitude).

#include "kernels/planar/overlap.hpp"

namespace stylobate {

/// Lost lengths of the two faces, at their left and right ends [m].
template <class Real>
struct FaceLoss {
    Real lower_left, lower_right, upper_left, upper_right;
};

/// @param left_of_lower, right_of_lower 1 where that end of the face is the lower block's, else 0
template <class Real>
STYLOBATE_INLINE FaceLoss<Real> face_loss(Real left, Real right, Real left_of_lower, Real right_of_lower)
{
    const Real lower_left = left * left_of_lower, lower_right = right * right_of_lower;
    return {lower_left, lower_right, left - lower_left, right - lower_right};
}

/// A pair seen as blocks that have lost their ends.
template <class Real>
struct ChippedPair {
    Placement<Real> place; ///< of the remaining faces
    Real lower_half_width, upper_half_width;
    Real shift; ///< middle of the remaining lower face, relative to the whole face's [m]
};

template <class Real>
STYLOBATE_INLINE ChippedPair<Real> chipped_pair(const Placement<Real>& p, Real lower_half_width, Real upper_half_width,
                                                const FaceLoss<Real>& loss)
{
    const Real half(0.5);
    const Real shift = half * (loss.lower_left - loss.lower_right);
    const Real aside = half * (loss.upper_left - loss.upper_right); // of the upper face's middle, along it
    return {{fma(aside, p.cosine, p.x) - shift, fnma(aside, p.sine, p.depth), p.sine, p.cosine},
            fnma(half, loss.lower_left + loss.lower_right, lower_half_width),
            fnma(half, loss.upper_left + loss.upper_right, upper_half_width),
            shift};
}

} // namespace stylobate

#pragma once
/// Arrises that wear while a joint rocks.
///
///   loss = chip + k P,  P: path of the relative rotation so far
///
/// at both ends, as `corner_loss` takes it from the face, up to 0.45 of the narrower block's width each.
///
/// Source: own choice, linear in the path (as Archard, "Contact and rubbing of flat surfaces", Journal of Applied
/// Physics 24 (1953) 981, for the volume worn by sliding).
///
/// Parameter: k [m/rad].  Neutral: 0.  Acts in the overlap of a bed. The bed's energy over the lost length is lost too.
/// Signature: uplift begins earlier in each run than in the one before.
/// Confounded with `corner_loss` in a single run.

#include "kernels/real.hpp"

namespace stylobate {

inline constexpr double most_worn = 0.45; // of the width

/// @param half_width of the narrower block [m]
template <class Real>
STYLOBATE_INLINE Real worn_corner(Real chip, Real wear, Real path, Real half_width)
{
    return min_of(fma(wear, path, chip), Real(2.0 * most_worn) * half_width);
}

/// Energy of the linear bed over the lengths that both ends lose in a step [J].
/// @param lost at each end [m]
template <class Real>
STYLOBATE_INLINE Real worn_energy(Real K_n, Real area, Real length, Real sine, Real lost)
{
    const Real depth = area / max_of(length, Real(1e-12)), half = Real(0.5) * length * sine;
    const Real left = max_of(depth + half, Real(0.0)), right = max_of(depth - half, Real(0.0));
    return Real(0.5) * K_n * lost * fma(left, left, right * right);
}

} // namespace stylobate

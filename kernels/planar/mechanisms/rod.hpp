#pragma once
/// A horizontal rod between a block and an end that is held or moves: what a laboratory pulls or pushes a block with.
///
///   F = k (x_e - x_p)      k = k_r where x_e > x_p, else k_l
///   x_p = x - (h - H / 2) sin theta      x_e = clamp(v (t - t_0), 0, s) - a U(t)
///
/// x_p: displacement of the block's point, at the height h above its lower face on its centre line (x: of the geometric
/// centre; H: the block's height), x_e that of the end, both since the start, when the rod just touches. F is the
/// horizontal force on the block at that point. A rod with k_l = 0 only pushes to the right. With a = 0 the end is on
/// the base, with a = 1 in the laboratory, where the base with the displacement U moves away under it.
///
/// Source: Hooke's law.
///
/// Parameters: k_r, k_l [N/m], h [m], v [m/s], t_0 [s], s [m], a.  Neutral: k_r = k_l = 0.  Acts in the update of a
/// block. The rod has no mass, no friction at the point, and stays horizontal in the frame of the base.
/// Energy: the work of F on the block counts as work of the base; what the rod stores is no part of the structure.
/// Step bound: k at the point, beside the block's contacts.
/// Signature: a force that is known at every time, k (x_e - x_p).

#include "kernels/real.hpp"

namespace stylobate {

/// Where the end is [m].
/// @param path v (t - t_0), also before it begins to move;  @param least, most of it: 0 and s, in their order
/// @param share a;  @param base U [m]
template <class Real>
STYLOBATE_INLINE Real rod_end(Real path, Real least, Real most, Real share, Real base)
{
    return fnma(share, base, clamp(path, least, most));
}

/// Where the point is [m].
/// @param centre displacement of the geometric centre since the start [m];  @param arm h - H / 2 [m]
template <class Real>
STYLOBATE_INLINE Real rod_point(Real centre, Real arm, Real sine)
{
    return fnma(arm, sine, centre);
}

/// F [N]. @param to_right, to_left k_r, k_l [N/m];  @param ahead x_e - x_p [m]
template <class Real>
STYLOBATE_INLINE Real rod_force(Real to_right, Real to_left, Real ahead)
{
    return select(ahead > Real(0.0), to_right, to_left) * ahead;
}

} // namespace stylobate

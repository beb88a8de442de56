#pragma once
/// Contact form `points`: Hertz-like springs at the five Gauss-Lobatto points of the face that the blocks have in
/// common, its ends among them.
///
///   F_i = w_i / 2  K_N L  d_i^1.5 / sqrt(d_ref)
///
/// w_i: 1/10, 49/90, 32/45, 49/90, 1/10 at -1, -sqrt(3/7), 0, sqrt(3/7), 1. d_ref is the depth at which an even face
/// carries what the area form does: that of the weight above, W / (K_N B), so that both rest alike. About it the bed is
/// 1.5 times as stiff. Direction of the forces as in `two_corner.hpp`; dashpots at the points (`face_damping.hpp`).
///
/// Source: nodes and weights of Abramowitz & Stegun, "Handbook of Mathematical Functions" (1964), 25.4.32; exponent 1.5
/// of Hertz (1882); the form is an own choice.

#include "kernels/planar/mechanisms/two_corner.hpp"

namespace stylobate {

constexpr FaceRule<5> lobatto_rule()
{
    return {{0, 0.17267316464601146, 0.5, 0.8273268353539885, 1},
            {1.0 / 20, 49.0 / 180, 16.0 / 45, 49.0 / 180, 1.0 / 20}};
}

template <class Real>
struct HertzPressure {
    Real per_root_depth;
    STYLOBATE_INLINE Real operator()(Real depth, Real& energy) const
    {
        const Real pressure = depth * sqrt_of(depth) * per_root_depth;
        energy = Real(0.4) * depth * pressure;
        return pressure;
    }
};

/// @param per_root_depth 1 / sqrt(d_ref) [m^-1/2]
template <class Real, class Mask>
STYLOBATE_INLINE Overlap<Real> points_overlap(const Placement<Real>& p, Real lower_half_width, Real upper_half_width,
                                              Real depth_limit, Real per_root_depth, FormPoints<Real, 5>& points,
                                              Mask& fits)
{
    constexpr FaceRule<5> rule = lobatto_rule();
    return spring_points(p, lower_half_width, upper_half_width, depth_limit, rule, HertzPressure<Real>{per_root_depth},
                         points, fits);
}

} // namespace stylobate

#pragma once
/// Rigid drums on a rigid plane: the values that the trials in space are compared with.

#include "studies/evidence/verification/rigid_block.hpp"

#include <array>

namespace stylobate::peers {

inline constexpr double space_gravity_m_s2 = 9.81;

struct DrumSize {
    double radius_m, half_height_m;
};
/// The specimen's drums as one, and one of them.
inline constexpr DrumSize tall_drum{0.024, 0.087}, flat_drum{0.024, 0.0145};

/// Over the mass, about a point of the rim of its foot: 5 R2 / 4 + 4 h2 / 3 across the plane of rocking [m2].
double rim_inertia(const DrumSize& drum);

/// A drum that rocks on its rim is a rigid block with its own slenderness and frequency parameter.
verification::RigidBlock rocking_drum(const DrumSize& drum);

/// Ratio of the rates of rotation after and before a drum that rocks in a plane meets the plane with its whole face:
/// the moment of momentum about the new point of the rim is kept.
double drum_restitution(const DrumSize& drum);

/// The lean at which it turns back after its first impact, over the one at which it was let go.
double first_turn_back(const DrumSize& drum, double start_rad);

/// Steady motion on the rim at a lean [rad/s]: rolling without a rotation about the vertical, and with a centre that
/// stays in its place (wobble).
double rolling_rate(const DrumSize& drum, double lean_rad);
double wobble_rate(const DrumSize& drum, double lean_rad);

/// Time in which friction stops a drum that spins upright about its axis [s]: 3 R w / (4 mu g), the pressure being
/// even.
double spin_down_s(double radius_m, double spin_rad_s, double friction);

/// A drum that falls face down and rises on the other side: the angle between the two points of its rim [deg], of
/// the flat and the tall drum, gravity and a rate of 0.03 aside taken into account (pi sqrt(1 + R2 / (k1 + h2)) without
/// them, 276.370 and 184.995).
inline constexpr std::array face_down_deg{281.672, 189.810};
inline constexpr double face_down_lean_rad = 0.01, face_down_aside = 0.03;

} // namespace stylobate::peers

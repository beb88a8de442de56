#pragma once
/// Static equilibrium of blocks under their contact forces, and what holds it beside the contacts.

#include "ensemble/planar/structure/bed.hpp"
#include "ensemble/realization/realization.hpp"
#include "kernels/planar/overlap.hpp"

#include <cmath>
#include <vector>

namespace stylobate {

/// Whether a mechanism acts on the realization at rest: its form, exponents, chips, wedges, bonds, eccentricities or
/// prestress.
bool rests_otherwise(const Realization& realization);

struct Pose {
    double x, y, theta; ///< centre in the frame of the base [m], rotation [rad]
};

/// Overlap of two blocks, in the lower one's frame with the origin in the middle of its top face.
Overlap<double> overlap_of(const Block& lower, const Pose& lower_pose, const Block& upper, const Pose& upper_pose);

/// Overlap of a bed's faces in its contact form: in the other forms than `area`, what stands for the overlap.
Overlap<double> overlap_of(const BedAtRest& bed, const Pose& lower_pose, const Pose& upper_pose);

/// From the lower anchor of a block's tendon, which is under the upper one in the reference stack, to the upper one.
struct TendonAnchors {
    double x, y;         ///< [m]
    double arm_x, arm_y; ///< of the upper one from the block's geometric centre [m]
    double length() const { return std::hypot(x, y); }
};
TendonAnchors tendon_anchors(const Realization& realization, int block, const Pose& pose);

/// Force of a block's tendon at rest and its moment about the block's geometric centre, in the frame of the base.
struct TendonPull {
    double x_n, y_n, moment_n_m;
};
/// @param pose of the block; all 0 where it has no prestress
TendonPull tendon_pull(const Realization& realization, int block, const Pose& pose);

/// Finds the poses in which the contact forces of all joints (Eqs. 1 to 3 at rest: K_N A_c, and K_T times the sliding
/// since the reference stack, within the friction cone; watched pairs without friction) carry the weight.
///
/// Newton's method: the residual is that of the exact overlaps, the tangent that of a bed on the length that is in
/// contact, without the turning of the forces, which is smaller by (weight x height) / (rotational stiffness). Steps
/// that make the residual larger are halved. A structure that cannot stand stays at the last step that reduced it.
///
/// @param beds of the realization (`beds_at_rest`)
/// @param poses (blocks) in: the reference stack; out: the equilibrium
/// @param spring_n (joints) out: elastic parts of the friction forces [N]
/// @return the largest force or moment that is not balanced, over the weight (and half width) of its block
double settle(const Realization& realization, const std::vector<BedAtRest>& beds, std::vector<Pose>& poses,
              std::vector<double>& spring_n);

} // namespace stylobate

#pragma once
/// Static equilibrium of blocks under their contact forces.

#include "ensemble/model/realization.hpp"
#include "ensemble/statics/extension.hpp"
#include "kernels/overlap.hpp"

#include <vector>

namespace stylobate {

struct Pose {
    double x, y, theta; ///< centre in the frame of the base [m], rotation [rad]
};

/// Overlap of two blocks, in the lower one's frame with the origin in the middle of its top face.
Overlap<double> overlap_of(const Block& lower, const Pose& lower_pose, const Block& upper, const Pose& upper_pose);

/// The same of a bed in the realization's model: in the other forms, what stands for the overlap.
Overlap<double> bed_overlap_of(const Realization& realization, int bed, const BedLaw& law, const Pose& lower_pose,
                               const Pose& upper_pose);
/// Elastic normal force of a bed in the realization's model [N].
double bed_elastic_n(const Realization& realization, int bed, const Pose& lower_pose, const Pose& upper_pose);

/// Finds the poses in which the contact forces of all joints (Eqs. 1 to 3 at rest: K_N A_c, and K_T times the sliding
/// since the reference stack, within the friction cone; watched pairs without friction) carry the weight.
///
/// Newton's method: the residual is that of the exact overlaps, the tangent that of a bed on the length that is in
/// contact, without the turning of the forces, which is smaller by (weight x height) / (rotational stiffness). Steps
/// that make the residual larger are halved. A structure that cannot stand stays at the last step that reduced it.
///
/// @param poses (blocks) in: the reference stack; out: the equilibrium
/// @param spring_n (joints) out: elastic parts of the friction forces [N]
/// @return the largest force or moment that is not balanced, over the weight (and half width) of its block
double settle(const Realization& realization, std::vector<Pose>& poses, std::vector<double>& spring_n);

} // namespace stylobate

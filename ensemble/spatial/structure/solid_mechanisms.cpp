#include "ensemble/spatial/structure/solid_mechanisms.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

using BodyRows = spatial::OfBodyMechanisms;
using JointRows = spatial::OfJointMechanisms;

bool acts(const JointMechanisms& e)
{
    return e.dynamic_ratio != 1 || e.wear_per_m != 0 || e.adhesion_pa != 0 || e.dowel_stiffness_n_m != 0 ||
           e.face_damping != 0 || e.wedge_rad != 0 || e.wedge_x_rad != 0;
}

bool acts(const BlockMechanisms& e)
{
    return e.tie_n_m != 0 || e.tie_n_s_m != 0 || e.tie_n != 0 || e.tie_n_m_s != 0;
}

} // namespace

spatial::StepModel model_in_space(const SpatialStructure& structure)
{
    return {structure.with_mechanisms ||
            std::any_of(structure.joints.begin(), structure.joints.end(),
                        [](const SolidJoint& joint) { return acts(joint.mechanisms); }) ||
            std::any_of(structure.solids.begin(), structure.solids.end(),
                        [](const Solid& solid) { return acts(solid.mechanisms); })};
}

spatial::Wedge<double> wedge_of(const SolidJoint& joint, const std::array<double, 2>& at, bool reversed)
{
    const double z = joint.mechanisms.wedge_rad, x = joint.mechanisms.wedge_x_rad, angle = std::hypot(x, z);
    const double per_angle = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
    // the axes of a bed are z and x; of a reversed one z and -x, and the rotation is the opposite one
    return {(reversed ? -z : z) * per_angle, x * per_angle, at[0], at[1]};
}

void store_solid_mechanisms(const Realization& r, const SolidTopology& topology, const spatial::Bundle& b, int lane)
{
    const double dt = r.step_s;
    const spatial::Topology& kernel = topology.kernel();
    for (int k = kernel.fixed; k < kernel.bodies; ++k) {
        const Solid& solid = r.space.solids[static_cast<std::size_t>(topology.order()[static_cast<std::size_t>(k)])];
        const BlockMechanisms& e = solid.mechanisms;
        b.at(BodyRows::tie_spring, k, lane) = dt * dt * e.tie_n_m / solid.mass_kg;
        b.at(BodyRows::tie_dashpot, k, lane) = dt * e.tie_n_s_m / solid.mass_kg;
        b.at(BodyRows::tie_pull, k, lane) = dt * dt * e.tie_n / solid.mass_kg;
        b.at(BodyRows::tie_turning, k, lane) = dt * e.tie_n_m_s;
    }
    for (int j = 0; j < kernel.joints; ++j) {
        const SolidJoint& joint = r.space.joints[static_cast<std::size_t>(j)];
        const JointMechanisms& e = joint.mechanisms;
        b.at(JointRows::friction_drop, j, lane) = 1 - e.dynamic_ratio;
        b.at(JointRows::per_stribeck_step, j, lane) = 1 / (e.stribeck_velocity_m_s * dt);
        b.at(JointRows::wear, j, lane) = e.wear_per_m;
        b.at(JointRows::adhesion, j, lane) = e.adhesion_pa;
        b.at(JointRows::dowel_stiffness, j, lane) = e.dowel_stiffness_n_m;
        b.at(JointRows::per_dowel_stiffness, j, lane) = e.dowel_stiffness_n_m > 0 ? 1 / e.dowel_stiffness_n_m : 0;
        b.at(JointRows::dowel_yield, j, lane) = e.dowel_yield_n;
        b.at(JointRows::dowel_gap, j, lane) = e.dowel_gap_m;
        b.at(JointRows::face_share, j, lane) = e.face_damping;
        b.at(JointRows::face_dashpot, j, lane) =
            e.face_damping * joint.normal_damping_n_s_m3 * joint.area_m2 / (2 * dt);
        if (joint.normal != Normal::y)
            continue;
        using K = spatial::OfJoint;
        const bool reversed = kernel.joint[j].reversed;
        const spatial::Wedge<double> wedge = wedge_of(joint,
                                                      {b.at(reversed ? K::upper_centre_1 : K::lower_centre_1, j, lane),
                                                       b.at(reversed ? K::upper_centre_2 : K::lower_centre_2, j, lane)},
                                                      reversed);
        b.at(JointRows::wedge, j, lane) = wedge.e_1;
        b.at(static_cast<JointRows::Field>(JointRows::wedge + 1), j, lane) = wedge.e_2;
        b.at(JointRows::wedge_at, j, lane) = wedge.at_1;
        b.at(static_cast<JointRows::Field>(JointRows::wedge_at + 1), j, lane) = wedge.at_2;
    }
}

} // namespace stylobate

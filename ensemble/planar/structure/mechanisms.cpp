#include "ensemble/planar/structure/mechanisms.hpp"

#include "ensemble/planar/structure/settle.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

std::vector<Pose> poses_of(const Realization& r, const StaticState& state)
{
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        poses.push_back({r.blocks[i].x_m + state.x_m[i], r.blocks[i].y_m + state.y_m[i], state.theta_rad[i]});
    return poses;
}

/// Offset of a bed's faces, along the lower one [m].
double offset_m(const BedAtRest& bed, const std::vector<Pose>& poses)
{
    const Pose& l = poses[static_cast<std::size_t>(bed.joint.lower)];
    const Pose& u = poses[static_cast<std::size_t>(bed.joint.upper)];
    const double x = u.x + bed.upper.half_height_m * std::sin(u.theta) - l.x;
    const double y = u.y - bed.upper.half_height_m * std::cos(u.theta) - l.y;
    return x * std::cos(l.theta) + y * std::sin(l.theta) - (bed.upper.x_m - bed.lower.x_m);
}

/// Place of a clamp's right end along the left block's axis, from that block's centre of mass [m].
double clamp_length_m(const Realization& r, int left, double x, double y, const std::vector<Pose>& poses)
{
    const Block& b = block_of(r, left);
    const Pose& l = poses[static_cast<std::size_t>(left)];
    const Pose& u = poses[static_cast<std::size_t>(b.strengthening.clamp_to)];
    const double end_x = u.x + x * std::cos(u.theta) - y * std::sin(u.theta);
    const double end_y = u.y + x * std::sin(u.theta) + y * std::cos(u.theta);
    return (end_x - l.x) * std::cos(l.theta) + (end_y - l.y) * std::sin(l.theta) - b.mechanisms.eccentricity_m;
}

void store_block(const Realization& r, int block, int i, const std::vector<Pose>& rest, const Bundle& b, int lane)
{
    using R = OfBlockStrengthening;
    const Block& of = block_of(r, block);
    const BlockStrengthening& e = of.strengthening;
    if (e.tendon_n_m > 0) {
        const Pose upright{of.x_m, of.y_m, 0};
        b.at(R::tendon_stiffness, i, lane) = e.tendon_n_m;
        b.at(R::tendon_stretch, i, lane) = e.tendon_prestress_n / e.tendon_n_m;
        b.at(R::tendon_yield, i, lane) = e.tendon_yield_n;
        const TendonAnchors anchors = tendon_anchors(r, block, upright);
        b.at(R::tendon_x, i, lane) = anchors.x;
        b.at(R::tendon_y, i, lane) = anchors.y;
        b.at(R::tendon_length, i, lane) = tendon_anchors(r, block, rest[static_cast<std::size_t>(block)]).length();
    }
    if (e.clamp_to >= 0 && e.clamp_n_m > 0) {
        const Block& right = block_of(r, e.clamp_to);
        const double x = -right.half_width_m, y = of.y_m + e.clamp_height_m - right.y_m;
        b.at(R::clamp_pull, i, lane) = e.clamp_n_m;
        b.at(R::clamp_push, i, lane) = e.clamp_compression * e.clamp_n_m;
        b.at(R::clamp_strength, i, lane) = e.clamp_strength_n;
        b.at(R::clamp_gap, i, lane) = e.clamp_gap_m;
        b.at(R::clamp_break, i, lane) = e.clamp_break_m;
        b.at(R::clamp_x, i, lane) = x;
        b.at(R::clamp_y, i, lane) = y;
        b.at(R::clamp_length, i, lane) = clamp_length_m(r, block, x, y, rest);
    }
}

void store_bed(const BedAtRest& bed, int j, double step_s, double spring_n, const std::vector<Pose>& rest,
               const Bundle& b, int lane)
{
    using R = OfJointStrengthening;
    const JointStrengthening& e = bed.joint.strengthening;
    b.at(R::bearing_stiffness, j, lane) = e.bearing_n_m;
    b.at(R::bearing_dashpot, j, lane) = e.bearing_n_s_m / step_s;
    b.at(R::bearing_per_radius, j, lane) = e.bearing_per_m;
    b.at(R::rest_offset, j, lane) = offset_m(bed, rest);
    b.at(R::bond_tension, j, lane) = bed.joint.bond_tension_n_m();
    b.at(R::bond_cohesion, j, lane) = bed.joint.bond_cohesion_n_m();
    b.at(R::hold_limit, j, lane) = e.hold_n;
    b.at(R::hold_stiffness, j, lane) = e.hold_n > 0 ? e.hold_stiffness_n_m : 0;
    b.at(R::per_hold_stiffness, j, lane) = e.hold_n > 0 ? 1 / e.hold_stiffness_n_m : 0;
    b.at(R::hold_length, j, lane) = e.hold_length_m;
    b.at(R::hold_spread, j, lane) = e.hold_spread_m;
    if (bed.joint.bonded()) { // the bond has what friction would hold
        b.at(R::bond, j, lane) = 1;
        b.at(R::bond_spring, j, lane) = spring_n;
        b.at(OfJoint::spring, j, lane) = 0;
        b.at(OfJoint::shear_force, j, lane) = 0;
    }
}

void store_rods(const Statics& statics, const std::vector<int>& order, const Bundle& b, int lane)
{
    using R = OfBlockMechanisms;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const auto i = static_cast<std::size_t>(order[k]);
        const Block& block = statics.realization.blocks[i];
        const BlockMechanisms& e = block.mechanisms;
        if (block.fixed || !e.has_rod())
            continue;
        const int at = static_cast<int>(k);
        const double arm = e.rod_height_m - block.half_height_m;
        const double travel = std::copysign(e.rod_travel_m, e.rod_speed_m_s);
        b.at(R::rod_right, at, lane) = e.rod_right_n_m;
        b.at(R::rod_left, at, lane) = e.rod_left_n_m;
        b.at(R::rod_arm, at, lane) = arm;
        b.at(R::rod_zero, at, lane) = statics.start.x_m[i] - arm * std::sin(statics.start.theta_rad[i]);
        b.at(R::rod_share, at, lane) = e.rod_laboratory;
        b.at(R::rod_least, at, lane) = std::min(travel, 0.0);
        b.at(R::rod_most, at, lane) = std::max(travel, 0.0);
        b.at(R::rod_step, at, lane) = e.rod_speed_m_s * statics.realization.step_s;
        b.at(R::rod_path, at, lane) = -e.rod_speed_m_s * e.rod_start_s;
    }
}

} // namespace

StepModel model_of(const Realization& r)
{
    const bool strengthened =
        r.strengthened ||
        std::any_of(r.blocks.begin(), r.blocks.end(),
                    [](const Block& block) { return block.strengthening != BlockStrengthening{}; }) ||
        std::any_of(r.joints.begin(), r.joints.end(),
                    [](const Joint& joint) { return joint.strengthening != JointStrengthening{} || joint.bonded(); });
    const bool mechanisms = strengthened || r.with_mechanisms || r.vertical != nullptr || r.tilt != nullptr ||
                            r.base != BaseMechanisms{} ||
                            std::any_of(r.blocks.begin(), r.blocks.end(),
                                        [](const Block& block) { return block.mechanisms != BlockMechanisms{}; }) ||
                            std::any_of(r.joints.begin(), r.joints.end(),
                                        [](const Joint& joint) { return joint.mechanisms != JointMechanisms{}; });
    return {mechanisms, r.form, strengthened};
}

void store_mechanisms(const Statics& statics, const std::vector<int>& order, const Bundle& b, int lane)
{
    const Realization& r = statics.realization;
    const double dt = r.step_s;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Block& block = block_of(r, order[k]);
        const int i = static_cast<int>(k);
        b.at(OfBlockMechanisms::eccentricity, i, lane) = block.mechanisms.eccentricity_m;
        b.at(OfBlockMechanisms::reference_x, i, lane) = block.x_m + block.mechanisms.eccentricity_m;
        b.at(OfBlockMechanisms::reference_y, i, lane) = block.y_m;
        b.at(OfBlockMechanisms::drag_per_mass, i, lane) = block.mechanisms.drag_n_s2_m2 / block.mass_kg;
        b.at(OfBlockMechanisms::drag_linear, i, lane) =
            block.mechanisms.drag_n_s_m * statics.realization.step_s / block.mass_kg;
        b.at(OfBlockMechanisms::tie_spring, i, lane) = dt * dt * block.mechanisms.tie_n_m / block.mass_kg;
        b.at(OfBlockMechanisms::tie_dashpot, i, lane) = dt * block.mechanisms.tie_n_s_m / block.mass_kg;
        b.at(OfBlockMechanisms::tie_pull, i, lane) = dt * dt * block.mechanisms.tie_n / block.mass_kg;
        b.at(OfBlockMechanisms::tie_turning, i, lane) = dt * block.mechanisms.tie_n_m_s / block.inertia_kg_m2;
    }
    store_rods(statics, order, b, lane);
    // of beds: watched pairs meet as in the paper's model
    for (int j = 0; j < r.beds(); ++j) {
        using J = OfJointMechanisms;
        const BedAtRest& bed = statics.beds()[static_cast<std::size_t>(j)];
        const Joint& joint = bed.joint;
        const JointMechanisms& e = joint.mechanisms;
        const BedLaw& law = bed.law;
        b.at(J::friction_drop, j, lane) = 1 - e.dynamic_ratio;
        b.at(J::per_stribeck_step, j, lane) = 1 / (e.stribeck_velocity_m_s * dt);
        b.at(J::wear, j, lane) = e.wear_per_m;
        b.at(J::adhesion, j, lane) = joint.adhesion_n_m();
        b.at(J::dowel_stiffness, j, lane) = e.dowel_stiffness_n_m;
        b.at(J::per_dowel_stiffness, j, lane) = e.dowel_stiffness_n_m > 0 ? 1 / e.dowel_stiffness_n_m : 0;
        b.at(J::dowel_yield, j, lane) = e.dowel_yield_n;
        b.at(J::dowel_gap, j, lane) = e.dowel_gap_m;
        b.at(J::exponent, j, lane) = law.exponent;
        b.at(J::per_reference, j, lane) = law.per_reference;
        b.at(J::rate_per_dt, j, lane) = e.rate_s_m / dt;
        b.at(J::chip_left, j, lane) = e.chip_left_m;
        b.at(J::chip_right, j, lane) = e.chip_right_m;
        b.at(J::left_of_lower, j, lane) = bed.left_of_lower;
        b.at(J::right_of_lower, j, lane) = bed.right_of_lower;
        b.at(J::corner_wear, j, lane) = e.corner_wear_m_rad;
        b.at(J::wedge_sine, j, lane) = law.faces.wedge_sine;
        b.at(J::wedge_versine, j, lane) = law.faces.wedge_versine;
        b.at(J::per_root_depth, j, lane) = law.faces.per_root_depth;
        // what the ends have of the dashpot is not at the centroid
        const double C = joint.normal_damping_n_s_m / dt;
        const bool own_points = r.form != ContactForm::area;
        const double length = joint.damping_chord_m > 0 ? joint.damping_chord_m : bed.length_m;
        b.at(J::face_dashpot, j, lane) = own_points ? C : e.face_damping * C / length;
        const double left = own_points ? 0 : 1 - e.face_damping;
        b.at(OfJoint::C_n_per_dt, j, lane) *= left;
        b.at(OfJoint::C_n_chord, j, lane) *= left;
    }
}

void store_strengthening(const Statics& statics, const std::vector<int>& order, const Bundle& b, int lane)
{
    const Realization& r = statics.realization;
    const std::vector<Pose> rest = poses_of(r, statics.before_tilt.value_or(statics.start));
    for (std::size_t k = 0; k < order.size(); ++k)
        if (!block_of(r, order[k]).fixed || block_of(r, order[k]).strengthening.clamp_to >= 0)
            store_block(r, order[k], static_cast<int>(k), rest, b, lane);
    for (int j = 0; j < r.beds(); ++j) {
        const auto at = static_cast<std::size_t>(j);
        store_bed(statics.beds()[at], j, r.step_s, statics.start.spring_n[at], rest, b, lane);
    }
}

} // namespace stylobate

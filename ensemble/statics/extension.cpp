#include "ensemble/statics/extension.hpp"

#include "ensemble/statics/reinforcement.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

struct Face {
    double left, right;                 ///< in the reference stack [m]
    bool left_of_lower, right_of_lower; ///< whose side ends it; the upper block's where both do
};

Face common_face(const Block& lower, const Block& upper)
{
    const double ll = lower.x_m - lower.half_width_m, lr = lower.x_m + lower.half_width_m;
    const double ul = upper.x_m - upper.half_width_m, ur = upper.x_m + upper.half_width_m;
    return {std::max(ll, ul), std::min(lr, ur), ll > ul, lr < ur};
}

const Joint& joint_of(const Realization& r, int joint)
{
    return r.joints[static_cast<std::size_t>(joint)];
}
const Block& block_of(const Realization& r, int block)
{
    return r.blocks[static_cast<std::size_t>(block)];
}

} // namespace

bool has_mechanisms(const Realization& r)
{
    return r.extended || is_reinforced(r) || r.vertical != nullptr || r.base != BaseExtension{} ||
           std::any_of(r.blocks.begin(), r.blocks.end(),
                       [](const Block& block) { return block.extension != BlockExtension{}; }) ||
           std::any_of(r.joints.begin(), r.joints.end(),
                       [](const Joint& joint) { return joint.extension != JointExtension{}; });
}

bool is_extended(const Realization& r)
{
    return model_of(r).extended();
}

bool rests_otherwise(const Realization& r)
{
    return (r.form != ContactForm::area && r.form != ContactForm::rigid) ||
           std::any_of(r.blocks.begin(), r.blocks.end(),
                       [](const Block& block) {
                           return block.extension.eccentricity_m != 0 || block.reinforcement.tendon_prestress_n > 0;
                       }) ||
           std::any_of(r.joints.begin(), r.joints.end(), [](const Joint& joint) {
               const JointExtension& e = joint.extension;
               return joint.reinforcement.bonded() || e.force_exponent != 1 || e.chip_left_m != 0 ||
                      e.chip_right_m != 0 || e.wedge_rad != 0;
           });
}

Model model_of(const Realization& r)
{
    return {has_mechanisms(r), r.form, is_reinforced(r)};
}

double bed_load_n(const Realization& r, int bed)
{
    const Block& foot = block_of(r, joint_of(r, bed).upper);
    const auto seats = [&](int block) {
        int count = 0;
        for (int j = 0; j < r.beds(); ++j)
            count += joint_of(r, j).upper == block ? 1 : 0;
        return count;
    };
    double mass = 0;
    if (foot.role == BlockRole::epistyle) {
        mass = foot.mass_kg / seats(joint_of(r, bed).upper);
    } else {
        for (int j = 0; j < r.beds(); ++j) {
            const Joint& joint = joint_of(r, j);
            const Block& upper = block_of(r, joint.upper);
            if (upper.role == BlockRole::epistyle && block_of(r, joint.lower).column == foot.column)
                mass += upper.mass_kg / seats(joint.upper);
            else if (upper.role == BlockRole::drum && upper.column == foot.column && j >= bed)
                mass += upper.mass_kg;
        }
    }
    return mass * r.gravity_m_s2 * std::cos(r.base_tilt_rad);
}

double longest_contact_m(const Block& a, const Block& b)
{
    return 2 * std::min(std::max(a.half_width_m, a.half_height_m), std::max(b.half_width_m, b.half_height_m));
}

double contact_mass_kg(const Block& a, const Block& b)
{
    return a.fixed ? b.mass_kg : b.fixed ? a.mass_kg : std::min(a.mass_kg, b.mass_kg);
}

double face_length_m(const Realization& r, int bed)
{
    const Joint& joint = joint_of(r, bed);
    const Face face = common_face(block_of(r, joint.lower), block_of(r, joint.upper));
    return face.right - face.left - joint.extension.chip_left_m - joint.extension.chip_right_m;
}

BedLaw bed_law(const Realization& r, int bed)
{
    const Joint& joint = joint_of(r, bed);
    const JointExtension& e = joint.extension;
    const Block& lower = block_of(r, joint.lower);
    const Block& upper = block_of(r, joint.upper);
    const Face face = common_face(lower, upper);
    BedLaw law;
    law.form = r.form;
    law.faces.sizes = {lower.half_width_m, lower.half_height_m, upper.half_width_m, upper.half_height_m};
    law.faces.depth_limit = 0.1 * std::min(lower.half_height_m, upper.half_height_m);
    law.faces.loss = face_loss<double>(e.chip_left_m, e.chip_right_m, face.left_of_lower, face.right_of_lower);
    law.faces.wedge_sine = std::sin(e.wedge_rad);
    law.faces.wedge_versine = 2 * std::sin(0.5 * e.wedge_rad) * std::sin(0.5 * e.wedge_rad);
    law.K_n = joint.normal_stiffness_n_m2;
    law.bonded = joint.reinforcement.bonded();
    law.exponent = e.force_exponent - 1;
    law.per_reference = 1 / e.reference_overlap_m2;
    if (r.form == ContactForm::points)
        law.faces.per_root_depth = std::sqrt(law.K_n * face_length_m(r, bed) / bed_load_n(r, bed));
    return law;
}

double BedLaw::force(double area) const
{
    return exponent == 0 || area <= 0 ? K_n * area : K_n * area * std::pow(area * per_reference, exponent);
}

double BedLaw::area(double force) const
{
    return exponent == 0 ? force / K_n : std::pow(force * per_reference / K_n, 1 / (1 + exponent)) / per_reference;
}

void store_extension(const Realization& r, const std::vector<int>& order, const Bundle& b, int lane)
{
    const double dt = r.step_s;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Block& block = block_of(r, order[k]);
        const int i = static_cast<int>(k);
        b.at(OfBlockExtension::eccentricity, i, lane) = block.extension.eccentricity_m;
        b.at(OfBlockExtension::reference_x, i, lane) = block.x_m + block.extension.eccentricity_m;
        b.at(OfBlockExtension::reference_y, i, lane) = block.y_m;
        b.at(OfBlockExtension::drag_per_mass, i, lane) = block.extension.drag_n_s2_m2 / block.mass_kg;
        b.at(OfBlockExtension::tie_spring, i, lane) = dt * dt * block.extension.tie_n_m / block.mass_kg;
        b.at(OfBlockExtension::tie_dashpot, i, lane) = dt * block.extension.tie_n_s_m / block.mass_kg;
        b.at(OfBlockExtension::tie_pull, i, lane) = dt * dt * block.extension.tie_n / block.mass_kg;
        b.at(OfBlockExtension::tie_turning, i, lane) = dt * block.extension.tie_n_m_s / block.inertia_kg_m2;
    }
    // the extensions are of beds; watched pairs meet as in the baseline
    for (int j = 0; j < r.beds(); ++j) {
        using J = OfJointExtension;
        const Joint& joint = joint_of(r, j);
        const JointExtension& e = joint.extension;
        const BedLaw law = bed_law(r, j);
        const Face face = common_face(block_of(r, joint.lower), block_of(r, joint.upper));
        b.at(J::friction_drop, j, lane) = 1 - e.dynamic_ratio;
        b.at(J::per_stribeck_step, j, lane) = 1 / (e.stribeck_velocity_m_s * dt);
        b.at(J::wear, j, lane) = e.wear_per_m;
        b.at(J::adhesion, j, lane) = e.adhesion_n_m;
        b.at(J::dowel_stiffness, j, lane) = e.dowel_stiffness_n_m;
        b.at(J::per_dowel_stiffness, j, lane) = e.dowel_stiffness_n_m > 0 ? 1 / e.dowel_stiffness_n_m : 0;
        b.at(J::dowel_yield, j, lane) = e.dowel_yield_n;
        b.at(J::dowel_gap, j, lane) = e.dowel_gap_m;
        b.at(J::exponent, j, lane) = law.exponent;
        b.at(J::per_reference, j, lane) = law.per_reference;
        b.at(J::rate_per_dt, j, lane) = e.rate_s_m / dt;
        b.at(J::chip_left, j, lane) = e.chip_left_m;
        b.at(J::chip_right, j, lane) = e.chip_right_m;
        b.at(J::left_of_lower, j, lane) = face.left_of_lower;
        b.at(J::right_of_lower, j, lane) = face.right_of_lower;
        b.at(J::corner_wear, j, lane) = e.corner_wear_m_rad;
        b.at(J::wedge_sine, j, lane) = law.faces.wedge_sine;
        b.at(J::wedge_versine, j, lane) = law.faces.wedge_versine;
        b.at(J::per_root_depth, j, lane) = law.faces.per_root_depth;
        // what the ends have of the dashpot is not at the centroid
        const double C = joint.normal_damping_n_s_m / dt;
        const bool own_points = r.form != ContactForm::area;
        const double length = joint.damping_chord_m > 0 ? joint.damping_chord_m : face_length_m(r, j);
        b.at(J::face_dashpot, j, lane) = own_points ? C : e.face_damping * C / length;
        const double left = own_points ? 0 : 1 - e.face_damping;
        b.at(OfJoint::C_n_per_dt, j, lane) *= left;
        b.at(OfJoint::C_n_chord, j, lane) *= left;
    }
}

} // namespace stylobate

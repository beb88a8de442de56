#include "ensemble/spatial/structure/solid_bundle.hpp"

#include "ensemble/spatial/structure/solid_mechanisms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

using spatial::Axis;
using spatial::BedKind;
using B = spatial::OfBody;
using J = spatial::OfJoint;
using W = spatial::OfRealization; // the whole

/// Deeper than this part of the lower of the two bodies, faces are not in contact: no load presses them so far.
constexpr double deepest_part = 0.1;

/// A disc on a rectangle is a polygon of 16 corners of so many times its radius, which has its area and its second
/// moment to 0.1 and 0.2 %: the corners lie 1.3 % beyond the rim, the middles of the sides 0.6 % inside.
constexpr double corner_radius = 1.013;

Axis axis_of(Normal normal)
{
    return normal == Normal::x ? Axis::x : normal == Normal::y ? Axis::y : Axis::z;
}

/// How the kernel sees a joint. Of a round face and a rectangle its law asks for the rectangle below.
spatial::TopologyJoint kernel_joint(const SolidJoint& joint, const std::vector<int>& place_of)
{
    const bool lower_round = joint.lower_face.round, upper_round = joint.upper_face.round;
    spatial::TopologyJoint of;
    of.lower = place_of[static_cast<std::size_t>(joint.lower)];
    of.upper = place_of[static_cast<std::size_t>(joint.upper)];
    of.kind = lower_round && upper_round     ? BedKind::disc
              : !lower_round && !upper_round ? BedKind::rectangle
                                             : BedKind::round;
    of.normal = axis_of(joint.normal);
    of.reversed = of.kind == BedKind::round && lower_round;
    of.hollow = joint.inner_ratio > 0;
    if (of.reversed)
        std::swap(of.lower, of.upper);
    return of;
}

Axis correction_of(const Solid& solid)
{
    const auto& I = solid.inertia_kg_m2;
    return spatial::correction_axis(1 / I[0], 1 / I[1], 1 / I[2]);
}

void store_body(const Solid& solid, double dt2, Axis correction, const spatial::Bundle& b, int body, int lane)
{
    b.at(B::q_w, body, lane) = 1;
    b.at(B::mass, body, lane) = solid.mass_kg;
    if (solid.fixed)
        return;
    const auto& I = solid.inertia_kg_m2;
    const spatial::Inertia<double> inertia = spatial::inertia_of(1 / I[0], 1 / I[1], 1 / I[2], correction);
    b.at(B::dt2_per_mass, body, lane) = dt2 / solid.mass_kg;
    b.at(B::per_sphere, body, lane) = inertia.sphere;
    b.at(B::per_top, body, lane) = inertia.top;
    b.at(B::per_correction, body, lane) = correction == Axis::none ? 0 : inertia.correction;
}

/// The half sizes and the middle of a face along the first two axes of the joint, as (half 1, half 2, middle 1,
/// middle 2).
/// @param reversed the second axis points in the opposite direction   @param times of the sizes
std::array<double, 4> face_fields(const Face& face, const std::array<double, 2>& middle_m, Normal normal, bool reversed,
                                  double times)
{
    // the normal is the third axis of the joint, so that those of a bed are z and x; the other faces have their order
    const double first = normal == Normal::y ? face.half_z_m : face.half_x_m;
    const double second = normal == Normal::y ? face.half_x_m : face.half_z_m;
    return {times * first, times * second, middle_m[0], reversed ? -middle_m[1] : middle_m[1]};
}

void store_joint(const SolidJoint& joint, const Realization& r, bool reversed, const spatial::Bundle& b, int j,
                 int lane)
{
    const auto solid = [&](int i) -> const Solid& { return r.space.solids[static_cast<std::size_t>(i)]; };
    const Solid &lower = solid(reversed ? joint.upper : joint.lower),
                &upper = solid(reversed ? joint.lower : joint.upper);
    const double dt = r.step_s;
    b.at(J::stiffness, j, lane) = joint.normal_stiffness_n_m3;
    b.at(J::K_t, j, lane) = joint.tangential_stiffness_n_m;
    b.at(J::per_K_t, j, lane) = joint.tangential_stiffness_n_m > 0 ? 1 / joint.tangential_stiffness_n_m : 0;
    b.at(J::C_n, j, lane) = joint.normal_damping_n_s_m3 / dt;
    b.at(J::C_t, j, lane) = joint.tangential_damping_n_s_m3 / dt;
    b.at(J::mu, j, lane) = joint.friction;
    b.at(J::depth_limit, j, lane) = deepest_part * std::min(lower.height_m, upper.height_m);
    const auto store = [&](int first, const auto& values) {
        for (std::size_t k = 0; k < values.size(); ++k)
            b.at(static_cast<J::Field>(first + static_cast<int>(k)), j, lane) = values[k];
    };
    std::array<double, 3> point = joint.point_m;
    std::array<double, 2> lower_middle = joint.lower_middle_m, upper_middle = joint.upper_middle_m;
    if (joint.lower_face.round && joint.upper_face.round) { // the law of discs: from the centre of the upper one
        point[2] += upper_middle[0];
        point[0] += upper_middle[1];
        lower_middle = {lower_middle[0] - upper_middle[0], lower_middle[1] - upper_middle[1]};
        upper_middle = {};
    }
    const auto anchor = [&](const Solid& body, double beyond) {
        std::array<double, 3> to{};
        for (std::size_t k = 0; k < 3; ++k)
            to[k] = point[k] - body.centre_m[k];
        to[static_cast<std::size_t>(joint.normal)] += beyond;
        return to;
    };
    store(J::lower_anchor, anchor(lower, 0));
    store(J::upper_anchor, anchor(upper, joint.gap_m));
    b.at(J::gap, j, lane) = joint.gap_m;
    b.at(J::inner_ratio, j, lane) = joint.inner_ratio;
    const Face &below = reversed ? joint.upper_face : joint.lower_face,
               &above = reversed ? joint.lower_face : joint.upper_face;
    const auto &below_m = reversed ? upper_middle : lower_middle, &above_m = reversed ? lower_middle : upper_middle;
    store(J::lower_half_1, face_fields(below, below_m, joint.normal, reversed, 1));
    store(J::upper_half_1,
          face_fields(above, above_m, joint.normal, reversed, above.round && !below.round ? corner_radius : 1));
}

} // namespace

SolidTopology::SolidTopology(const SpatialStructure& pattern) : place_of_(pattern.solids.size(), -1)
{
    const auto take = [&](int solid) {
        if (place_of_[static_cast<std::size_t>(solid)] < 0) {
            place_of_[static_cast<std::size_t>(solid)] = static_cast<int>(order_.size());
            order_.push_back(solid);
        }
    };
    for (const SolidJoint& joint : pattern.joints)
        for (int solid : {joint.lower, joint.upper})
            if (pattern.solids[static_cast<std::size_t>(solid)].fixed)
                take(solid);
    topology_.fixed = static_cast<int>(order_.size());
    for (std::size_t i = 0; i < pattern.solids.size(); ++i)
        if (!pattern.solids[i].fixed)
            take(static_cast<int>(i));
    for (const SolidJoint& joint : pattern.joints)
        joints_.push_back(kernel_joint(joint, place_of_));
    for (int solid : order_)
        corrections_.push_back(correction_of(pattern.solids[static_cast<std::size_t>(solid)]));
    topology_.bodies = static_cast<int>(order_.size());
    topology_.top = topology_.bodies - 1;
    topology_.joints = static_cast<int>(joints_.size());
    topology_.joint = joints_.data();
    topology_.correction = corrections_.data();
    topology_.model = model_in_space(pattern);
    lists_.resize(static_cast<std::size_t>(spatial::joint_lists_size(topology_)));
    spatial::list_joints(topology_, lists_.data());
}

void store_solids(const Realization& r, const SolidTopology& topology, const spatial::Bundle& b, int lane)
{
    const double dt2 = r.step_s * r.step_s;
    const spatial::Topology& kernel = topology.kernel();
    for (int k = 0; k < kernel.bodies; ++k)
        store_body(r.space.solids[static_cast<std::size_t>(topology.order()[static_cast<std::size_t>(k)])], dt2,
                   kernel.correction[k], b, k, lane);
    for (int j = 0; j < kernel.joints; ++j)
        store_joint(r.space.joints[static_cast<std::size_t>(j)], r, kernel.joint[j].reversed, b, j, lane);
    if (kernel.model.mechanisms)
        store_solid_mechanisms(r, topology, b, lane);
    const double about_z = r.space.base_tilt_rad[0], about_x = r.space.base_tilt_rad[1];
    b.at(W::dt2, lane) = dt2;
    b.at(W::gravity_dx, lane) = dt2 * r.gravity_m_s2 * std::sin(about_z) * std::cos(about_x);
    b.at(W::gravity_dy, lane) = -dt2 * r.gravity_m_s2 * std::cos(about_z) * std::cos(about_x);
    b.at(W::gravity_dz, lane) = dt2 * r.gravity_m_s2 * std::sin(about_x);
}

} // namespace stylobate

#include "ensemble/statics/reinforcement.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

const Block& block_at(const Realization& r, int block)
{
    return r.blocks[static_cast<std::size_t>(block)];
}

/// Height of the fixed ground under a column: of its highest fixed drum, or of the base.
double ground_y_m(const Realization& r, int column)
{
    double y = 0;
    for (const Block& block : r.blocks)
        if (block.fixed && block.role == BlockRole::drum && block.column == column)
            y = std::max(y, block.y_m + block.half_height_m);
    return y;
}

/// From the lower anchor of a block's tendon, which is under the upper one in the reference stack, to the upper one.
struct Anchors {
    double x, y;         ///< [m]
    double arm_x, arm_y; ///< of the upper one from the block's geometric centre [m]
    double length() const { return std::hypot(x, y); }
};
Anchors anchors(const Realization& r, int block, const Pose& pose)
{
    const Block& b = block_at(r, block);
    const double arm_x = -b.half_height_m * std::sin(pose.theta), arm_y = b.half_height_m * std::cos(pose.theta);
    return {pose.x + arm_x - b.x_m, pose.y + arm_y - ground_y_m(r, b.column), arm_x, arm_y};
}

std::vector<Pose> poses_of(const Realization& r, const StaticState& state)
{
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        poses.push_back({r.blocks[i].x_m + state.x_m[i], r.blocks[i].y_m + state.y_m[i], state.theta_rad[i]});
    return poses;
}

/// Offset of a bed's faces, along the lower one [m].
double offset_m(const Realization& r, const Joint& joint, const std::vector<Pose>& poses)
{
    const Block &lower = block_at(r, joint.lower), &upper = block_at(r, joint.upper);
    const Pose& l = poses[static_cast<std::size_t>(joint.lower)];
    const Pose& u = poses[static_cast<std::size_t>(joint.upper)];
    const double x = u.x + upper.half_height_m * std::sin(u.theta) - l.x;
    const double y = u.y - upper.half_height_m * std::cos(u.theta) - l.y;
    return x * std::cos(l.theta) + y * std::sin(l.theta) - (upper.x_m - lower.x_m);
}

/// Place of a clamp's right end along the left block's axis, from that block's centre of mass [m].
double clamp_length_m(const Realization& r, int left, double x, double y, const std::vector<Pose>& poses)
{
    const Block& b = block_at(r, left);
    const Pose& l = poses[static_cast<std::size_t>(left)];
    const Pose& u = poses[static_cast<std::size_t>(b.reinforcement.clamp_to)];
    const double end_x = u.x + x * std::cos(u.theta) - y * std::sin(u.theta);
    const double end_y = u.y + x * std::sin(u.theta) + y * std::cos(u.theta);
    return (end_x - l.x) * std::cos(l.theta) + (end_y - l.y) * std::sin(l.theta) - b.extension.eccentricity_m;
}

void store_block(const Realization& r, int block, int i, const std::vector<Pose>& rest, const Bundle& b, int lane)
{
    using R = OfBlockReinforcement;
    const Block& of = block_at(r, block);
    const BlockReinforcement& e = of.reinforcement;
    if (e.tendon_n_m > 0) {
        const Pose upright{of.x_m, of.y_m, 0};
        b.at(R::tendon_stiffness, i, lane) = e.tendon_n_m;
        b.at(R::tendon_stretch, i, lane) = e.tendon_prestress_n / e.tendon_n_m;
        b.at(R::tendon_yield, i, lane) = e.tendon_yield_n;
        b.at(R::tendon_x, i, lane) = anchors(r, block, upright).x;
        b.at(R::tendon_y, i, lane) = anchors(r, block, upright).y;
        b.at(R::tendon_length, i, lane) = anchors(r, block, rest[static_cast<std::size_t>(block)]).length();
    }
    if (e.clamp_to >= 0 && e.clamp_n_m > 0) {
        const Block& right = block_at(r, e.clamp_to);
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

void store_joint(const Realization& r, int j, double spring_n, const std::vector<Pose>& rest, const Bundle& b, int lane)
{
    using R = OfJointReinforcement;
    const Joint& joint = r.joints[static_cast<std::size_t>(j)];
    const JointReinforcement& e = joint.reinforcement;
    b.at(R::bearing_stiffness, j, lane) = e.bearing_n_m;
    b.at(R::bearing_dashpot, j, lane) = e.bearing_n_s_m / r.step_s;
    b.at(R::bearing_per_radius, j, lane) = e.bearing_per_m;
    b.at(R::rest_offset, j, lane) = offset_m(r, joint, rest);
    b.at(R::bond_tension, j, lane) = e.bond_tension_n_m;
    b.at(R::bond_cohesion, j, lane) = e.bond_cohesion_n_m;
    b.at(R::hold_limit, j, lane) = e.hold_n;
    b.at(R::hold_stiffness, j, lane) = e.hold_n > 0 ? e.hold_stiffness_n_m : 0;
    b.at(R::per_hold_stiffness, j, lane) = e.hold_n > 0 ? 1 / e.hold_stiffness_n_m : 0;
    b.at(R::hold_length, j, lane) = e.hold_length_m;
    b.at(R::hold_spread, j, lane) = e.hold_spread_m;
    if (e.bonded()) { // the bond has what friction would hold
        b.at(R::bond, j, lane) = 1;
        b.at(R::bond_spring, j, lane) = spring_n;
        b.at(OfJoint::spring, j, lane) = 0;
        b.at(OfJoint::shear_force, j, lane) = 0;
    }
}

} // namespace

bool is_reinforced(const Realization& r)
{
    return r.reinforced ||
           std::any_of(r.blocks.begin(), r.blocks.end(),
                       [](const Block& block) { return block.reinforcement != BlockReinforcement{}; }) ||
           std::any_of(r.joints.begin(), r.joints.end(),
                       [](const Joint& joint) { return joint.reinforcement != JointReinforcement{}; });
}

TendonPull tendon_pull(const Realization& r, int block, const Pose& pose)
{
    const double T = block_at(r, block).reinforcement.tendon_prestress_n;
    if (!(T > 0))
        return {0, 0, 0};
    const Anchors a = anchors(r, block, pose);
    const double x = -T * a.x / a.length(), y = -T * a.y / a.length();
    return {x, y, a.arm_x * y - a.arm_y * x};
}

double bed_force_n(const Realization& r, int bed)
{
    double force = bed_load_n(r, bed);
    const Block& foot = block_at(r, r.joints[static_cast<std::size_t>(bed)].upper);
    for (int j = bed; j < r.beds(); ++j) {
        const Block& above = block_at(r, r.joints[static_cast<std::size_t>(j)].upper);
        if (foot.role == BlockRole::drum && above.role == BlockRole::drum && above.column == foot.column)
            force += above.reinforcement.tendon_prestress_n;
    }
    return force;
}

void store_reinforcement(const Realization& r, const StaticState& start, const std::vector<int>& order, const Bundle& b,
                         int lane)
{
    std::vector<Pose> rest = poses_of(r, start);
    if (r.initial_tilt_rad != 0) {
        Realization upright = r;
        upright.initial_tilt_rad = 0;
        rest = poses_of(r, static_state(upright));
    }
    for (std::size_t k = 0; k < order.size(); ++k)
        if (!r.blocks[static_cast<std::size_t>(order[k])].fixed ||
            r.blocks[static_cast<std::size_t>(order[k])].reinforcement.clamp_to >= 0)
            store_block(r, order[k], static_cast<int>(k), rest, b, lane);
    for (int j = 0; j < r.beds(); ++j)
        store_joint(r, j, start.spring_n[static_cast<std::size_t>(j)], rest, b, lane);
}

} // namespace stylobate

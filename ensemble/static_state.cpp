#include "ensemble/static_state.hpp"

#include "kernels/overlap.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

struct Pose {
    double x, y, theta; ///< centre in the frame of the base, rotation
};

/// What rests on a joint.
struct Load {
    double weight; ///< across the joint [N]
    double x, y;   ///< centre of mass in the reference stack
};

Load load_above(const Realization& r, std::size_t joint)
{
    double mass = 0, x = 0, y = 0;
    for (std::size_t j = joint; j < r.joints.size(); ++j) {
        const Block& block = r.blocks[static_cast<std::size_t>(r.joints[j].upper)];
        mass += block.mass_kg;
        x += block.mass_kg * block.x_m;
        y += block.mass_kg * block.y_m;
    }
    return {mass * r.gravity_m_s2 * std::cos(r.base_tilt_rad), x / mass, y / mass};
}

/// Depth at the middle of the contact, and rotation of the upper block against the lower one, of a bed of stiffness K
/// per area on a contact of length L under the force N at the eccentricity e from its middle.
struct Bedding {
    double depth, rotation;
};

Bedding bedding(double K, double L, double N, double e)
{
    const double eccentric = std::fabs(e);
    if (eccentric <= L / 6)
        return {N / (K * L), -12 * N * e / (K * L * L * L)};
    if (eccentric >= L / 2) // it cannot stand: let it fall from where it is
        return {N / (K * L), 0};
    const double pressed = 3 * (L / 2 - eccentric); // a triangle under the nearer edge
    const double edge_depth = 2 * N / (K * pressed);
    const double rotation = edge_depth / pressed;
    return {edge_depth - rotation * L / 2, e > 0 ? -rotation : rotation};
}

Overlap<double> overlap_of(const Block& lower, const Pose& l, const Block& upper, const Pose& u)
{
    const double sine = std::sin(u.theta - l.theta), cosine = std::cos(u.theta - l.theta);
    // bottom face of the upper block, then into the lower block's frame with its origin in the top face
    const double bx = u.x + upper.half_height_m * std::sin(u.theta) - l.x;
    const double by = u.y - upper.half_height_m * std::cos(u.theta) - l.y;
    const double x = bx * std::cos(l.theta) + by * std::sin(l.theta);
    const double y = -bx * std::sin(l.theta) + by * std::cos(l.theta) - lower.half_height_m;
    return general_overlap<double>({x, -y, sine, cosine},
                                   {lower.half_width_m, lower.half_height_m, upper.half_width_m, upper.half_height_m});
}

/// Turns the free blocks about the lowest one's corner, then lowers them until the base carries their weight.
void lean(const Realization& r, std::vector<Pose>& poses)
{
    const Joint& base = r.joints.front();
    const auto lower = static_cast<std::size_t>(base.lower), upper = static_cast<std::size_t>(base.upper);
    const Block& foot = r.blocks[upper];
    const double side = r.initial_tilt_rad > 0 ? -1 : 1;
    const Pose& p = poses[upper];
    const double sine = std::sin(r.initial_tilt_rad), cosine = std::cos(r.initial_tilt_rad);
    const double corner_x = p.x + side * foot.half_width_m * std::cos(p.theta) + foot.half_height_m * std::sin(p.theta);
    const double corner_y = p.y + side * foot.half_width_m * std::sin(p.theta) - foot.half_height_m * std::cos(p.theta);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (r.blocks[i].fixed)
            continue;
        const double dx = poses[i].x - corner_x, dy = poses[i].y - corner_y;
        poses[i].x = corner_x + cosine * dx - sine * dy;
        poses[i].y = corner_y + sine * dx + cosine * dy;
        poses[i].theta += r.initial_tilt_rad;
    }
    const double weight = load_above(r, 0).weight;
    double high = foot.half_height_m, low = -foot.half_height_m; // shift: in the air, and far too deep
    for (int i = 0; i < 200; ++i) {
        const double shift = 0.5 * (high + low);
        Pose moved = poses[upper];
        moved.y += shift;
        const double force = base.normal_stiffness_n_m2 * overlap_of(r.blocks[lower], poses[lower], foot, moved).area;
        (force > weight ? low : high) = shift;
    }
    for (std::size_t i = 0; i < poses.size(); ++i)
        if (!r.blocks[i].fixed)
            poses[i].y += low;
}

} // namespace

StaticState static_state(const Realization& r)
{
    std::vector<Pose> poses;
    for (const Block& block : r.blocks)
        poses.push_back({block.x_m, block.y_m, 0});
    StaticState state;
    const double slope = std::tan(r.base_tilt_rad);
    for (std::size_t j = 0; j < r.joints.size(); ++j) {
        const Joint& joint = r.joints[j];
        const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
        const double left = std::max(lower.x_m - lower.half_width_m, upper.x_m - upper.half_width_m);
        const double right = std::min(lower.x_m + lower.half_width_m, upper.x_m + upper.half_width_m);
        const double middle = 0.5 * (left + right), length = std::max(right - left, 1e-6 * upper.half_width_m);
        const Load load = load_above(r, j);
        const double face_y = lower.y_m + lower.half_height_m;
        const double eccentricity = load.x + slope * (load.y - face_y) - middle;
        const Bedding bed = bedding(joint.normal_stiffness_n_m2, length, load.weight, eccentricity);

        // the bottom face is the line through (middle, -depth) with this rotation, in the lower block's frame
        const double X = upper.x_m - lower.x_m;
        const double Y = -bed.depth + (upper.x_m - middle) * std::tan(bed.rotation);
        const Pose& l = poses[static_cast<std::size_t>(joint.lower)];
        const double cx = X - upper.half_height_m * std::sin(bed.rotation);
        const double cy = lower.half_height_m + Y + upper.half_height_m * std::cos(bed.rotation);
        poses[static_cast<std::size_t>(joint.upper)] = {l.x + cx * std::cos(l.theta) - cy * std::sin(l.theta),
                                                        l.y + cx * std::sin(l.theta) + cy * std::cos(l.theta),
                                                        l.theta + bed.rotation};
        const double limit = joint.friction * load.weight;
        state.spring_n.push_back(std::clamp(load.weight * slope, -limit, limit));
    }
    if (r.initial_tilt_rad != 0)
        lean(r, poses);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        state.x_m.push_back(poses[i].x - r.blocks[i].x_m);
        state.y_m.push_back(poses[i].y - r.blocks[i].y_m);
        state.theta_rad.push_back(poses[i].theta);
    }
    return state;
}

} // namespace stylobate

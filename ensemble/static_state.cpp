#include "ensemble/static_state.hpp"

#include "ensemble/settle.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

const Block& upper_of(const Realization& r, int bed)
{
    return r.blocks[static_cast<std::size_t>(r.joints[static_cast<std::size_t>(bed)].upper)];
}

bool is_one_column(const Realization& r)
{
    return std::all_of(r.blocks.begin(), r.blocks.end(), [](const Block& block) {
        return block.role == BlockRole::ground || (block.role == BlockRole::drum && block.column == 0);
    });
}

/// What of its own column rests on a bed.
struct Load {
    double weight; ///< across the bed [N]
    double x, y;   ///< centre of mass in the reference stack
};

Load load_above(const Realization& r, int bed)
{
    const int column = upper_of(r, bed).column;
    double mass = 0, x = 0, y = 0;
    for (int j = bed; j < r.beds(); ++j) {
        const Block& block = upper_of(r, j);
        if (block.column != column || block.role != BlockRole::drum)
            continue;
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

/// Lowers some blocks, by bisection, until the beds between them and the others carry a weight.
void sink(const Realization& r, std::vector<Pose>& poses, const std::vector<bool>& moved, double weight, double reach)
{
    double high = reach, low = -reach; // shift: in the air, and far too deep
    for (int i = 0; i < 200; ++i) {
        const double shift = 0.5 * (high + low);
        double force = 0;
        for (int j = 0; j < r.beds(); ++j) {
            const Joint& joint = r.joints[static_cast<std::size_t>(j)];
            const auto l = static_cast<std::size_t>(joint.lower), u = static_cast<std::size_t>(joint.upper);
            if (moved[l] || !moved[u])
                continue;
            Pose pose = poses[u];
            pose.y += shift;
            force += joint.normal_stiffness_n_m2 * overlap_of(r.blocks[l], poses[l], r.blocks[u], pose).area;
        }
        (force > weight ? low : high) = shift;
    }
    for (std::size_t i = 0; i < poses.size(); ++i)
        if (moved[i])
            poses[i].y += low;
}

/// Corner of a block: `side` -1 left, 1 right; `end` -1 bottom, 1 top.
Pose corner(const Block& block, const Pose& p, double side, double end)
{
    const double sine = std::sin(p.theta), cosine = std::cos(p.theta);
    const double x = side * block.half_width_m, y = end * block.half_height_m;
    return {p.x + x * cosine - y * sine, p.y + x * sine + y * cosine, 0};
}

/// Weight that the epistyles bring onto a column, each shared equally by its seats [N].
double epistyle_share(const Realization& r, int column)
{
    double mass = 0;
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        if (upper_of(r, j).role != BlockRole::epistyle ||
            r.blocks[static_cast<std::size_t>(joint.lower)].column != column)
            continue;
        int seats = 0;
        for (int k = 0; k < r.beds(); ++k)
            seats += r.joints[static_cast<std::size_t>(k)].upper == joint.upper ? 1 : 0;
        mass += upper_of(r, j).mass_kg / seats;
    }
    return mass * r.gravity_m_s2 * std::cos(r.base_tilt_rad);
}

/// Turns the columns from `initial_tilt_block` up about that block's corner, sinks them in, and puts the epistyles on.
void lean(const Realization& r, std::vector<Pose>& poses)
{
    const double side = r.initial_tilt_rad > 0 ? -1 : 1;
    const double sine = std::sin(r.initial_tilt_rad), cosine = std::cos(r.initial_tilt_rad);
    std::vector<Pose> before = poses;
    std::vector<int> drums_seen; // of each column
    for (int bed = 0; bed < r.beds(); ++bed) {
        const Block& foot = upper_of(r, bed);
        if (foot.role != BlockRole::drum)
            continue;
        const auto column = static_cast<std::size_t>(foot.column);
        drums_seen.resize(std::max(drums_seen.size(), column + 1), 0);
        const auto upper = static_cast<std::size_t>(r.joints[static_cast<std::size_t>(bed)].upper);
        int place = 0; // of the block in its column
        for (std::size_t i = 0; i < upper; ++i)
            place += r.blocks[i].role == BlockRole::drum && r.blocks[i].column == foot.column ? 1 : 0;
        const bool pivot = place >= r.initial_tilt_block && drums_seen[column]++ == 0;
        if (!pivot)
            continue;
        const Pose about = corner(foot, poses[upper], side, -1);
        std::vector<bool> moved(poses.size(), false);
        for (int j = bed; j < r.beds(); ++j) {
            const auto i = static_cast<std::size_t>(r.joints[static_cast<std::size_t>(j)].upper);
            if (r.blocks[i].role != BlockRole::drum || r.blocks[i].column != foot.column)
                continue;
            moved[i] = true;
            const double dx = poses[i].x - about.x, dy = poses[i].y - about.y;
            poses[i].x = about.x + cosine * dx - sine * dy;
            poses[i].y = about.y + sine * dx + cosine * dy;
            poses[i].theta += r.initial_tilt_rad;
        }
        sink(r, poses, moved, load_above(r, bed).weight + epistyle_share(r, foot.column), foot.half_height_m);
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (r.blocks[i].role != BlockRole::epistyle)
            continue;
        // it goes where the risen corners of its seats went, on the mean
        double x = 0, y = 0;
        int seats = 0;
        for (int j = 0; j < r.beds(); ++j) {
            const Joint& joint = r.joints[static_cast<std::size_t>(j)];
            if (static_cast<std::size_t>(joint.upper) != i)
                continue;
            const auto l = static_cast<std::size_t>(joint.lower);
            const Pose now = corner(r.blocks[l], poses[l], -side, 1), then = corner(r.blocks[l], before[l], -side, 1);
            x += now.x - then.x;
            y += now.y - then.y;
            ++seats;
        }
        poses[i].x += x / seats;
        poses[i].y += y / seats;
        std::vector<bool> moved(poses.size(), false);
        moved[i] = true;
        sink(r, poses, moved, r.blocks[i].mass_kg * r.gravity_m_s2 * std::cos(r.base_tilt_rad),
             r.blocks[i].half_height_m);
    }
}

/// A single column, bed by bed from the bottom.
void stack_up(const Realization& r, std::vector<Pose>& poses, StaticState& state)
{
    const double slope = std::tan(r.base_tilt_rad);
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
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
}

} // namespace

StaticState static_state(const Realization& r)
{
    std::vector<Pose> poses;
    for (const Block& block : r.blocks)
        poses.push_back({block.x_m, block.y_m, 0});
    StaticState state;
    if (is_one_column(r))
        stack_up(r, poses, state);
    else
        settle(r, poses, state.spring_n);
    state.spring_n.resize(r.joints.size(), 0);
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

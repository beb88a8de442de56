#include "ensemble/statics/static_state.hpp"

#include "ensemble/statics/bedding.hpp"
#include "ensemble/statics/extension.hpp"
#include "ensemble/statics/reinforcement.hpp"
#include "ensemble/statics/settle.hpp"

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

/// Lowers some blocks, by bisection, until the beds between them and the others carry a weight.
void sink(const Realization& r, std::vector<Pose>& poses, const std::vector<bool>& moved, double weight, double reach)
{
    const bool extended = rests_otherwise(r);
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
            force += extended ? bed_elastic_n(r, j, poses[l], pose)
                              : joint.normal_stiffness_n_m2 * overlap_of(r.blocks[l], poses[l], r.blocks[u], pose).area;
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
        if (r.form != ContactForm::rigid)
            sink(r, poses, moved, bed_force_n(r, bed), foot.half_height_m);
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
        if (r.form != ContactForm::rigid)
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
        const double Y = -bed.depth_m + (upper.x_m - middle) * std::tan(bed.rotation_rad);
        const Pose& l = poses[static_cast<std::size_t>(joint.lower)];
        const double cx = X - upper.half_height_m * std::sin(bed.rotation_rad);
        const double cy = lower.half_height_m + Y + upper.half_height_m * std::cos(bed.rotation_rad);
        poses[static_cast<std::size_t>(joint.upper)] = {l.x + cx * std::cos(l.theta) - cy * std::sin(l.theta),
                                                        l.y + cx * std::sin(l.theta) + cy * std::cos(l.theta),
                                                        l.theta + bed.rotation_rad};
        const double limit = joint.friction * load.weight + joint.extension.adhesion_n_m * length;
        state.spring_n.push_back(std::clamp(load.weight * slope, -limit, limit));
    }
}

/// The same with extensions: on the faces as they are, under the load where it is. How the blocks lean decides where
/// their loads act, so it is gone through until nothing moves.
void stack_up_extended(const Realization& r, std::vector<Pose>& poses, StaticState& state)
{
    const double down_x = std::sin(r.base_tilt_rad), down_y = -std::cos(r.base_tilt_rad);
    constexpr int most_passes = 100;
    constexpr double still = 1e-15; // m, rad
    double moved = 1;
    for (int pass = 0; pass < most_passes && moved > still; ++pass) {
        moved = 0;
        state.spring_n.clear();
        for (int j = 0; j < r.beds(); ++j) {
            const Joint& joint = r.joints[static_cast<std::size_t>(j)];
            const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
            const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
            const Pose& l = poses[static_cast<std::size_t>(joint.lower)];
            double mass = 0, x = 0, y = 0; // of what stands on the bed, at its centres of mass
            for (int k = j; k < r.beds(); ++k) {
                const auto i = static_cast<std::size_t>(r.joints[static_cast<std::size_t>(k)].upper);
                const double m = r.blocks[i].mass_kg, e = r.blocks[i].extension.eccentricity_m;
                mass += m;
                x += m * (poses[i].x + e * std::cos(poses[i].theta));
                y += m * (poses[i].y + e * std::sin(poses[i].theta));
            }
            // the lower face with its wedge: middle, tangent, normal
            const double turn = l.theta + joint.extension.wedge_rad;
            const double tx = std::cos(turn), ty = std::sin(turn), nx = -ty, ny = tx;
            const double fx = l.x - lower.half_height_m * std::sin(l.theta);
            const double fy = l.y + lower.half_height_m * std::cos(l.theta);
            const double weight = mass * r.gravity_m_s2;
            double N = -weight * (down_x * nx + down_y * ny), T = weight * (down_x * tx + down_y * ty);
            const double rx = x / mass - fx, ry = y / mass - fy;
            double crossing = rx * tx + ry * ty + (rx * nx + ry * ny) * T / N;
            for (int k = j; k < r.beds(); ++k) {
                const int i = r.joints[static_cast<std::size_t>(k)].upper;
                const Pose& at = poses[static_cast<std::size_t>(i)];
                const TendonPull pull = tendon_pull(r, i, at);
                if (pull.y_n == 0)
                    continue;
                const double px = at.x - fx, py = at.y - fy;
                const double moment = pull.moment_n_m + px * pull.y_n - py * pull.x_n;
                const double more = -(pull.x_n * nx + pull.y_n * ny);
                crossing = (crossing * N - moment) / (N + more);
                N += more;
                T += pull.x_n * tx + pull.y_n * ty;
            }

            const BedLaw law = bed_law(r, j);
            const double X = upper.x_m - lower.x_m;
            const double left = std::max(-lower.half_width_m + law.faces.loss.lower_left,
                                         X - upper.half_width_m + law.faces.loss.upper_left);
            const double right = std::min(lower.half_width_m - law.faces.loss.lower_right,
                                          X + upper.half_width_m - law.faces.loss.upper_right);
            const double middle = 0.5 * (left + right), length = std::max(right - left, 1e-6 * upper.half_width_m);
            const Bedding bed = bedding(law, length, N, crossing - middle);

            const double Y = -bed.depth_m + (X - middle) * std::tan(bed.rotation_rad);
            const double theta = turn + bed.rotation_rad;
            const Pose put{fx + X * tx + Y * nx - upper.half_height_m * std::sin(theta),
                           fy + X * ty + Y * ny + upper.half_height_m * std::cos(theta), theta};
            Pose& pose = poses[static_cast<std::size_t>(joint.upper)];
            moved = std::max(
                {moved, std::fabs(put.x - pose.x), std::fabs(put.y - pose.y), std::fabs(put.theta - pose.theta)});
            pose = put;
            const double bond = joint.reinforcement.bonded() ? joint.reinforcement.bond_cohesion_n_m : 0;
            const double limit = joint.friction * N + (joint.extension.adhesion_n_m + bond) * length;
            state.spring_n.push_back(std::clamp(T, -limit, limit));
        }
    }
}

} // namespace

StaticState static_state(const Realization& r)
{
    std::vector<Pose> poses;
    for (const Block& block : r.blocks)
        poses.push_back({block.x_m, block.y_m, 0});
    StaticState state;
    if (r.form == ContactForm::rigid)
        ; // faces just touch: the reference stack itself
    else if (is_one_column(r))
        rests_otherwise(r) ? stack_up_extended(r, poses, state) : stack_up(r, poses, state);
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

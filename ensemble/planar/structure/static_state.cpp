#include "ensemble/planar/structure/static_state.hpp"

#include "ensemble/planar/structure/settle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

bool is_one_column(const Realization& r)
{
    return std::all_of(r.blocks.begin(), r.blocks.end(), [](const Block& block) {
        return block.role == BlockRole::ground || (block.role == BlockRole::drum && block.column == 0);
    });
}

/// Lowers some blocks, by bisection, until the beds between them and the others carry a weight.
void press_in(const Realization& r, const std::vector<BedAtRest>& beds, std::vector<Pose>& poses,
              const std::vector<bool>& moved, double weight, double reach)
{
    const bool mechanisms = rests_otherwise(r);
    double high = reach, low = -reach; // shift: in the air, and far too deep
    for (int i = 0; i < 200; ++i) {
        const double shift = 0.5 * (high + low);
        double force = 0;
        for (const BedAtRest& bed : beds) {
            const auto l = static_cast<std::size_t>(bed.joint.lower), u = static_cast<std::size_t>(bed.joint.upper);
            if (moved[l] || !moved[u])
                continue;
            Pose pose = poses[u];
            pose.y += shift;
            force += mechanisms ? bed.law.force(overlap_of(bed, poses[l], pose).area)
                                : bed.law.K_n * overlap_of(bed.lower, poses[l], bed.upper, pose).area;
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
void lean(const Realization& r, const std::vector<BedAtRest>& beds, std::vector<Pose>& poses)
{
    const double side = r.initial_tilt_rad > 0 ? -1 : 1;
    const double sine = std::sin(r.initial_tilt_rad), cosine = std::cos(r.initial_tilt_rad);
    std::vector<Pose> before = poses;
    std::vector<int> drums_seen; // of each column
    for (const BedAtRest& bed : beds) {
        const Block& foot = bed.upper;
        if (foot.role != BlockRole::drum)
            continue;
        const auto column = static_cast<std::size_t>(foot.column);
        drums_seen.resize(std::max(drums_seen.size(), column + 1), 0);
        const auto upper = static_cast<std::size_t>(bed.joint.upper);
        int place = 0; // of the block in its column
        for (std::size_t i = 0; i < upper; ++i)
            place += r.blocks[i].role == BlockRole::drum && r.blocks[i].column == foot.column ? 1 : 0;
        const bool pivot = place >= r.initial_tilt_block && drums_seen[column]++ == 0;
        if (!pivot)
            continue;
        const Pose about = corner(foot, poses[upper], side, -1);
        std::vector<bool> moved(poses.size(), false);
        for (const BedAtRest* above = &bed; above != beds.data() + beds.size(); ++above) {
            const auto i = static_cast<std::size_t>(above->joint.upper);
            if (above->upper.role != BlockRole::drum || above->upper.column != foot.column)
                continue;
            moved[i] = true;
            const double dx = poses[i].x - about.x, dy = poses[i].y - about.y;
            poses[i].x = about.x + cosine * dx - sine * dy;
            poses[i].y = about.y + sine * dx + cosine * dy;
            poses[i].theta += r.initial_tilt_rad;
        }
        if (r.form != ContactForm::rigid && r.initial_lift_m == 0)
            press_in(r, beds, poses, moved, bed.force_n, foot.half_height_m);
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (r.blocks[i].role != BlockRole::epistyle)
            continue;
        // it goes where the risen corners of its seats went, on the mean
        double x = 0, y = 0;
        int seats = 0;
        for (const BedAtRest& bed : beds) {
            if (static_cast<std::size_t>(bed.joint.upper) != i)
                continue;
            const auto l = static_cast<std::size_t>(bed.joint.lower);
            const Pose now = corner(bed.lower, poses[l], -side, 1), then = corner(bed.lower, before[l], -side, 1);
            x += now.x - then.x;
            y += now.y - then.y;
            ++seats;
        }
        poses[i].x += x / seats;
        poses[i].y += y / seats;
        std::vector<bool> moved(poses.size(), false);
        moved[i] = true;
        if (r.form != ContactForm::rigid)
            press_in(r, beds, poses, moved, r.blocks[i].mass_kg * r.gravity_m_s2 * std::cos(r.base_tilt_rad),
                     r.blocks[i].half_height_m);
    }
}

/// Raises the columns from `initial_tilt_block` up, and the epistyles; nothing presses where they stood.
void lift(const Realization& r, const std::vector<BedAtRest>& beds, std::vector<Pose>& poses,
          std::vector<double>& spring_n)
{
    std::vector<int> drums_below; // of each column
    std::vector<bool> raised(poses.size(), false);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Block& block = r.blocks[i];
        bool high = block.role == BlockRole::epistyle;
        if (block.role == BlockRole::drum) {
            const auto column = static_cast<std::size_t>(block.column);
            drums_below.resize(std::max(drums_below.size(), column + 1), 0);
            high = drums_below[column]++ >= r.initial_tilt_block;
        }
        raised[i] = high && !block.fixed;
        if (raised[i])
            poses[i].y += r.initial_lift_m;
    }
    for (std::size_t j = 0; j < beds.size(); ++j)
        if (raised[static_cast<std::size_t>(beds[j].joint.lower)] !=
            raised[static_cast<std::size_t>(beds[j].joint.upper)])
            spring_n[j] = 0;
}

/// A single column, bed by bed from the bottom.
void stack_up(const Realization& r, std::vector<Pose>& poses, std::vector<double>& spring_n)
{
    const double slope = std::tan(r.base_tilt_rad), upright = std::cos(r.base_tilt_rad);
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const Block &lower = block_of(r, joint.lower), &upper = block_of(r, joint.upper);
        const double left = std::max(lower.x_m - lower.half_width_m, upper.x_m - upper.half_width_m);
        const double right = std::min(lower.x_m + lower.half_width_m, upper.x_m + upper.half_width_m);
        const double middle = 0.5 * (left + right), length = std::max(right - left, 1e-6 * upper.half_width_m);
        double mass = 0, x = 0, y = 0; // of what stands on the bed, in the reference stack
        for (int k = j; k < r.beds(); ++k) {
            const Block& above = block_of(r, r.joints[static_cast<std::size_t>(k)].upper);
            mass += above.mass_kg;
            x += above.mass_kg * above.x_m;
            y += above.mass_kg * above.y_m;
        }
        const double weight = mass * r.gravity_m_s2 * upright;
        const double face_y = lower.y_m + lower.half_height_m;
        const double eccentricity = x / mass + slope * (y / mass - face_y) - middle;
        const Bedding bed = bedding(joint.normal_stiffness_n_m2, length, weight, eccentricity);

        // the bottom face is the line through (middle, -depth) with this rotation, in the lower block's frame
        const double X = upper.x_m - lower.x_m;
        const double Y = -bed.depth_m + (upper.x_m - middle) * std::tan(bed.rotation_rad);
        const Pose& l = poses[static_cast<std::size_t>(joint.lower)];
        const double cx = X - upper.half_height_m * std::sin(bed.rotation_rad);
        const double cy = lower.half_height_m + Y + upper.half_height_m * std::cos(bed.rotation_rad);
        poses[static_cast<std::size_t>(joint.upper)] = {l.x + cx * std::cos(l.theta) - cy * std::sin(l.theta),
                                                        l.y + cx * std::sin(l.theta) + cy * std::cos(l.theta),
                                                        l.theta + bed.rotation_rad};
        const double limit = joint.friction * weight + joint.adhesion_n_m() * length;
        spring_n.push_back(std::clamp(weight * slope, -limit, limit));
    }
}

/// A single column with mechanisms that act at rest: on the faces as they are, under the load where it is. How the
/// blocks lean decides where their loads act, so it is gone through until nothing moves.
void stack_up_with_mechanisms(const Realization& r, const std::vector<BedAtRest>& beds, std::vector<Pose>& poses,
                              std::vector<double>& spring_n)
{
    const double down_x = std::sin(r.base_tilt_rad), down_y = -std::cos(r.base_tilt_rad);
    constexpr int most_passes = 100;
    constexpr double still = 1e-15; // m, rad
    double moved = 1;
    for (int pass = 0; pass < most_passes && moved > still; ++pass) {
        moved = 0;
        spring_n.clear();
        for (auto at = beds.begin(); at != beds.end(); ++at) {
            const Joint& joint = at->joint;
            const Block &lower = at->lower, &upper = at->upper;
            const Pose& l = poses[static_cast<std::size_t>(joint.lower)];
            double mass = 0, x = 0, y = 0; // of what stands on the bed, at its centres of mass
            for (auto above = at; above != beds.end(); ++above) {
                const Pose& pose = poses[static_cast<std::size_t>(above->joint.upper)];
                const double m = above->upper.mass_kg, e = above->upper.mechanisms.eccentricity_m;
                mass += m;
                x += m * (pose.x + e * std::cos(pose.theta));
                y += m * (pose.y + e * std::sin(pose.theta));
            }
            // the lower face with its wedge: middle, tangent, normal
            const double turn = l.theta + joint.mechanisms.wedge_rad;
            const double tx = std::cos(turn), ty = std::sin(turn), nx = -ty, ny = tx;
            const double fx = l.x - lower.half_height_m * std::sin(l.theta);
            const double fy = l.y + lower.half_height_m * std::cos(l.theta);
            const double weight = mass * r.gravity_m_s2;
            double N = -weight * (down_x * nx + down_y * ny), T = weight * (down_x * tx + down_y * ty);
            const double rx = x / mass - fx, ry = y / mass - fy;
            double crossing = rx * tx + ry * ty + (rx * nx + ry * ny) * T / N;
            for (auto above = at; above != beds.end(); ++above) {
                const int i = above->joint.upper;
                const Pose& pose = poses[static_cast<std::size_t>(i)];
                const TendonPull pull = tendon_pull(r, i, pose);
                if (pull.y_n == 0)
                    continue;
                const double px = pose.x - fx, py = pose.y - fy;
                const double moment = pull.moment_n_m + px * pull.y_n - py * pull.x_n;
                const double more = -(pull.x_n * nx + pull.y_n * ny);
                crossing = (crossing * N - moment) / (N + more);
                N += more;
                T += pull.x_n * tx + pull.y_n * ty;
            }

            const BedLaw& law = at->law;
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
            const double bond = joint.bonded() ? joint.bond_cohesion_n_m() : 0;
            const double limit = joint.friction * N + (joint.adhesion_n_m() + bond) * length;
            spring_n.push_back(std::clamp(T, -limit, limit));
        }
    }
}

/// @param spring_n of the friction forces at rest
StaticState state_of(const Realization& r, const std::vector<Pose>& poses, std::vector<double> spring_n)
{
    StaticState state;
    for (std::vector<double>* values : {&state.x_m, &state.y_m, &state.theta_rad})
        values->reserve(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        state.x_m.push_back(poses[i].x - r.blocks[i].x_m);
        state.y_m.push_back(poses[i].y - r.blocks[i].y_m);
        state.theta_rad.push_back(poses[i].theta);
    }
    state.spring_n = std::move(spring_n);
    return state;
}

} // namespace

const std::vector<BedAtRest>& Statics::beds() const
{
    if (beds_.empty())
        beds_ = beds_at_rest(realization);
    return beds_;
}

Statics::Statics(const Realization& r) : realization(r)
{
    std::vector<Pose> poses;
    poses.reserve(r.blocks.size());
    for (const Block& block : r.blocks)
        poses.push_back({block.x_m, block.y_m, 0});
    std::vector<double> spring_n;
    spring_n.reserve(r.joints.size());
    if (r.form == ContactForm::rigid)
        ; // faces just touch: the reference stack itself
    else if (!is_one_column(r))
        settle(r, beds(), poses, spring_n);
    else if (rests_otherwise(r))
        stack_up_with_mechanisms(r, beds(), poses, spring_n);
    else
        stack_up(r, poses, spring_n);
    spring_n.resize(r.joints.size(), 0);
    start = state_of(r, poses, std::move(spring_n));
    if (r.initial_tilt_rad == 0 && r.initial_lift_m == 0)
        return;
    before_tilt = start;
    if (r.initial_tilt_rad != 0)
        lean(r, beds(), poses);
    std::vector<double> held_n = before_tilt->spring_n;
    if (r.initial_lift_m != 0)
        lift(r, beds(), poses, held_n);
    start = state_of(r, poses, std::move(held_n));
}

StaticState static_state(const Realization& r)
{
    return Statics(r).start;
}

} // namespace stylobate

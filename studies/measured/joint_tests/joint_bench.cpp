#include "studies/measured/joint_tests/joint_bench.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/measured/joint_tests/procedures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr double usual_rod_n_m = 2e4; // where the gauge does not state its stiffness
constexpr double rod_damping = 0.05;  // of critical: of rod and gauge
constexpr double least_lift_m = 1e-5; // what is held lower stands on its bed

/// A rigid part of the tested body.
struct BodyPart {
    double mass_kg, inertia_kg_m2;
    double x_m, y_m; ///< centre of mass in the reference stack
};

/// The blocks of the body: the upper one of the joint, and those that are taped to it.
std::vector<int> body_blocks(const MeasuredRun& planned, int upper)
{
    std::vector<int> blocks{upper};
    for (const std::vector<int>& group : planned.taped)
        if (std::find(group.begin(), group.end(), upper) != group.end())
            for (const int block : group)
                if (std::find(blocks.begin(), blocks.end(), block) == blocks.end())
                    blocks.push_back(block);
    return blocks;
}

void check_planned(const Specimen& specimen, const MeasuredRun& planned)
{
    const auto refuse = [&](const std::string& what) {
        throw InputError(fmt::format("run {}: {}", planned.name, what));
    };
    if (!planned.joint)
        refuse("it is a test of a joint, and names none.\n  Give the joint.");
    if (*planned.joint < 0 || static_cast<std::size_t>(*planned.joint) >= specimen.joints.size())
        refuse(fmt::format("joint {} is outside 0 to {}.", *planned.joint, specimen.joints.size() - 1));
    for (const auto& group : planned.taped)
        for (const int block : group)
            if (block < 0 || block >= specimen.blocks())
                refuse(fmt::format("taped block {} is outside 0 to {}.", block, specimen.blocks() - 1));
    if (planned.time_s.size() < 2)
        refuse("it has no clock.\n  Give time_s with two samples at least.");
}

std::vector<BodyPart> body_parts(const MeasuredRun& planned, const SpecimenStructure& built, const Realization& whole,
                                 const std::vector<int>& blocks)
{
    std::vector<BodyPart> parts;
    for (const int b : blocks) {
        const Block& block = whole.blocks[static_cast<std::size_t>(built.block[static_cast<std::size_t>(b)])];
        parts.push_back({block.mass_kg, block.inertia_kg_m2, block.x_m + block.mechanisms.eccentricity_m, block.y_m});
        for (const Dummy& dummy : planned.dummies)
            if (dummy.block == b)
                parts.push_back(
                    {dummy.mass_kg,
                     dummy.mass_kg *
                         (dummy.half_width_m * dummy.half_width_m + dummy.half_height_m * dummy.half_height_m) / 3,
                     block.x_m + dummy.x_m, block.y_m + dummy.y_m});
    }
    return parts;
}

/// The parts as one block with the lower face of the first one.
Block one_body(const Block& foot, const std::vector<BodyPart>& parts)
{
    Block body = foot;
    double x = 0, y = 0;
    body.mass_kg = 0;
    for (const BodyPart& part : parts) {
        body.mass_kg += part.mass_kg;
        x += part.mass_kg * part.x_m;
        y += part.mass_kg * part.y_m;
    }
    x /= body.mass_kg;
    y /= body.mass_kg;
    body.inertia_kg_m2 = 0;
    for (const BodyPart& part : parts)
        body.inertia_kg_m2 +=
            part.inertia_kg_m2 + part.mass_kg * ((part.x_m - x) * (part.x_m - x) + (part.y_m - y) * (part.y_m - y));
    body.half_height_m = y - (foot.y_m - foot.half_height_m);
    body.y_m = y;
    body.mechanisms.eccentricity_m = x - foot.x_m;
    body.strengthening = {};
    return body;
}

/// Puts the rod of the run's gauge onto the body.
void hold_by_rod(const Specimen& specimen, const SpecimenStructure& built, const Realization& whole,
                 const MeasuredRun& planned, JointBench& bench)
{
    Block& body = bench.realization.blocks[bench.body];
    for (std::size_t i = 0; i < planned.forces.size(); ++i) {
        const ForceGauge& gauge = planned.forces[i];
        if (std::find(bench.blocks.begin(), bench.blocks.end(), gauge.block) == bench.blocks.end())
            continue;
        if (bench.gauge)
            throw InputError(fmt::format("run {}: gauges {} and {} hold one body.\n  A test has one rod on its body.",
                                         planned.name, planned.forces[*bench.gauge].name, gauge.name));
        bench.gauge = i;
        const Block& at = whole.blocks[static_cast<std::size_t>(built.block[static_cast<std::size_t>(gauge.block)])];
        const double k = gauge.stiffness_n_m > 0 ? gauge.stiffness_n_m : usual_rod_n_m;
        const bool pulls = gauge.to_laboratory || gauge.speed_m_s == 0;
        BlockMechanisms& e = body.mechanisms;
        e.rod_right_n_m = pulls || gauge.speed_m_s > 0 ? k : 0;
        e.rod_left_n_m = pulls || gauge.speed_m_s < 0 ? k : 0;
        e.rod_height_m = gauge.height_m + (at.y_m - at.half_height_m) - (body.y_m - body.half_height_m);
        e.rod_speed_m_s = gauge.speed_m_s;
        e.rod_start_s = std::max(test_start_s - bench.released_s, 0.0);
        e.rod_travel_m =
            gauge.speed_m_s != 0 ? push_reach_m * tested_body(specimen, *planned.joint, {}).length_ratio : 0;
        e.rod_laboratory = gauge.to_laboratory ? 1 : 0;
        if (gauge.to_laboratory) // without it the block would swing on the rod for ever: friction does not damp that
            e.drag_n_s_m += 2 * rod_damping * std::sqrt(k * body.mass_kg);
    }
}

/// Where hands hold the upper block until the release: the body begins there.
void put_held(const SpecimenStructure& built, const MeasuredRun& planned, double lean_rad, JointBench& bench)
{
    const auto u = static_cast<std::size_t>(bench.blocks.front()), columns = built.block.size();
    const std::vector<double>&x = planned.blocks.x_m.values, &y = planned.blocks.y_m.values,
          &theta = planned.blocks.theta_rad.values;
    Realization& r = bench.realization;
    Block& body = r.blocks[bench.body];
    for (std::size_t i = planned.time_s.size(); i-- > 0;) {
        const std::size_t at = i * columns + u;
        if (planned.time_s[i] - planned.time_s.front() > bench.released_s ||
            at >= std::min({x.size(), y.size(), theta.size()}) || !std::isfinite(x[at] + y[at] + theta[at]))
            continue;
        const double base_m = planned.base_displacement_m.empty() ? 0 : planned.base_displacement_m.values[i];
        // turned about its lower corner, then raised
        const double turn = theta[at] + lean_rad;
        const double side = turn > 0 ? -1 : 1, sine = std::sin(turn), cosine = std::cos(turn);
        const double corner_x = body.x_m + side * body.half_width_m, corner_y = body.y_m - body.half_height_m;
        const double dx = body.x_m + bench.centre_m.front().first - corner_x,
                     dy = body.y_m + bench.centre_m.front().second - corner_y;
        const double lift = y[at] - built.origin_y_m - (corner_y + sine * dx + cosine * dy);
        body.x_m += x[at] - base_m - built.origin_x_m - (corner_x + cosine * dx - sine * dy);
        r.initial_tilt_rad = turn;
        r.initial_lift_m = lift > least_lift_m ? lift : 0;
        return;
    }
}

} // namespace

JointBench joint_bench(const Specimen& specimen, const SpecimenStructure& built, const Realization& whole,
                       const MeasuredRun& planned, double offset_m, double lean_rad)
{
    check_planned(specimen, planned);
    JointBench bench;
    bench.released_s = planned.released_s ? *planned.released_s - planned.time_s.front() : 0;
    bench.blocks = body_blocks(planned, specimen.joints[static_cast<std::size_t>(*planned.joint)].second);
    const int foot_place = built.block[static_cast<std::size_t>(bench.blocks.front())];
    const Block& foot = whole.blocks[static_cast<std::size_t>(foot_place)];
    Block body = one_body(foot, body_parts(planned, built, whole, bench.blocks));
    for (std::size_t i = 1; i < bench.blocks.size(); ++i)
        body.mechanisms.drag_n_s2_m2 +=
            whole.blocks[static_cast<std::size_t>(built.block[static_cast<std::size_t>(bench.blocks[i])])]
                .mechanisms.drag_n_s2_m2;

    Realization& r = bench.realization;
    r = whole;
    r.blocks.clear();
    r.joints.clear();
    r.watched = 0;
    r.with_mechanisms = true;
    for (int j = 0; j < whole.beds(); ++j) {
        Joint joint = whole.joints[static_cast<std::size_t>(j)];
        if (joint.upper != foot_place)
            continue;
        Block below = whole.blocks[static_cast<std::size_t>(joint.lower)];
        below.fixed = true;
        below.mechanisms = {};
        below.strengthening = {};
        joint.lower = static_cast<int>(r.blocks.size());
        r.blocks.push_back(below);
        r.joints.push_back(joint);
    }
    bench.body = r.blocks.size();
    for (Joint& joint : r.joints)
        joint.upper = static_cast<int>(bench.body);
    if (r.joints.size() == 1) { // a column, whatever they were
        if (r.blocks[0].role != BlockRole::ground) {
            r.blocks[0].role = BlockRole::drum;
            r.blocks[0].column = 0;
        }
        body.role = BlockRole::drum;
        body.column = 0;
    }
    body.fixed = false;
    for (const int b : bench.blocks) {
        const Block& block = whole.blocks[static_cast<std::size_t>(built.block[static_cast<std::size_t>(b)])];
        bench.centre_m.emplace_back(block.x_m - body.x_m, block.y_m - body.y_m);
    }
    body.x_m += offset_m;
    r.blocks.push_back(body);
    r.drums = static_cast<int>(std::count_if(r.blocks.begin(), r.blocks.end(),
                                             [](const Block& block) { return block.role != BlockRole::ground; }));
    if (planned.released_s)
        put_held(built, planned, lean_rad, bench);
    hold_by_rod(specimen, built, whole, planned, bench);
    return bench;
}

double rod_force_n(const JointBench& bench, double time_s, double moved_m, double start_rad, double now_rad,
                   double base_m)
{
    const Block& body = bench.realization.blocks[bench.body];
    const BlockMechanisms& e = body.mechanisms;
    const double arm = e.rod_height_m - body.half_height_m;
    const double ahead = e.rod_end_m(time_s, base_m) - (moved_m - arm * (std::sin(now_rad) - std::sin(start_rad)));
    return (ahead > 0 ? e.rod_right_n_m : e.rod_left_n_m) * ahead;
}

} // namespace stylobate

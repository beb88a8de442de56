#include "studies/measured/joint_tests/procedures.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace stylobate {

namespace {

using std::numbers::pi;

constexpr double small_half_width_m = 0.024, small_mass_kg = 0.135; // of the blocks that the numbers are for
constexpr double rod_stiffness_n_m = 2e4;                           // for them
constexpr double still_before_pull_s = 1, creep_s = 1;
constexpr double turn_s = 0.020; // in which the table turns round
constexpr double board_rate_rad_s = 2 * pi / 180, board_start_s = 0.5;
constexpr double push_height = 0.9; // over the body's height
constexpr double push_s = 3, drop_s = 1.2, rest_s = 0.5, slide_still_s = 0.3, slide_plateau_s = 3;
constexpr double slide_hz = 4, slide_m_s2 = 10.7;
constexpr int slide_ramp_cycles = 2;
constexpr double most_friction = 1; // for which the force gauge must do

/// A velocity that is held from a time on.
struct VelocityStep {
    double from_s;
    double to_m_s;
};

/// The displacement whose velocity goes from step to step in half cosines of duration `turn`, centred at the steps:
/// away from the turns it is the displacement of the steps themselves.
double stepped_displacement(const std::vector<VelocityStep>& steps, double turn, double t)
{
    double x = 0, before = 0;
    for (const VelocityStep& step : steps) {
        const double change = step.to_m_s - before, since = t - step.from_s;
        before = step.to_m_s;
        if (since >= turn / 2)
            x += change * since;
        else if (since > -turn / 2) {
            const double phase = pi * (since / turn + 0.5); // 0 to pi
            x += change * turn / 2 * (phase - std::sin(phase)) / pi;
        }
    }
    return x;
}

std::vector<VelocityStep> pull_steps(double s, double times)
{
    const double reach = pull_reach_m * s, per_speed = s / times;
    double t = still_before_pull_s * times;
    std::vector<VelocityStep> steps = {{t, pull_creep_m * s / (creep_s * times)}};
    t += creep_s * times;
    double first = reach - pull_creep_m * s; // left of the first quarter
    for (const auto& [cycles, speed] :
         {std::pair(2, pull_slow_m_s), std::pair(3, pull_fast_m_s), std::pair(2, pull_slow_m_s)}) {
        const double v = speed * per_speed;
        for (int i = 0; i < cycles; ++i) {
            steps.push_back({t, v});
            t += first / v;
            steps.push_back({t, -v});
            t += 2 * reach / v;
            steps.push_back({t, v});
            t += reach / v;
            first = reach;
        }
    }
    steps.push_back({t, 0});
    return steps;
}

/// The displacement of the harmonic; its amplitude goes smoothly from 0 to its plateau and back.
double slide_displacement(double t, double times, double s)
{
    const double f = slide_hz / times, w = 2 * pi * f, ramp = slide_ramp_cycles / f;
    const double amplitude = slide_m_s2 / (w * w) * (s / (times * times)); // times^2 = s: the acceleration is the same
    const double plateau = slide_plateau_s * times, since = t - slide_still_s * times;
    const double left = 2 * ramp + plateau - since;
    if (since <= 0 || left <= 0)
        return 0;
    const auto smooth = [](double u) { return u >= 1 ? 1.0 : u * u * u * (10 + u * (6 * u - 15)); };
    return amplitude * smooth(since / ramp) * smooth(left / ramp) * std::sin(w * since);
}

/// A tilt that starts smoothly, and stays at its largest.
double board_tilt(double t, double times, double most)
{
    const double rate = board_rate_rad_s / times, start = board_start_s * times, since = t - start;
    if (since <= 0)
        return 0;
    const double tilt = since < start ? rate * start / 2 * (since / start - std::sin(pi * since / start) / pi)
                                      : rate * (since - start / 2);
    return std::min(tilt, most);
}

/// How far the board must be tilted for a test; two dummies are on the block in `tilt`.
double needed_tilt(const Specimen& specimen, RunKind kind, const TestedBody& body)
{
    const double half_width = specimen.half_width_m[static_cast<std::size_t>(body.upper)];
    if (kind == RunKind::board)
        return std::max(steepest_board_rad, std::atan(1.15 * specimen.friction_nominal.value_or(0)));
    return std::max(steepest_board_rad, 1.1 * std::atan2(half_width, body.centre_m));
}

std::vector<Dummy> dummies_on(const Specimen& specimen, RunKind kind, int upper)
{
    std::vector<Dummy> dummies;
    if (kind != RunKind::tilt && kind != RunKind::push && kind != RunKind::drop)
        return dummies;
    const auto b = static_cast<std::size_t>(upper);
    for (const int above : {1, 2})
        dummies.push_back({upper, specimen.mass_kg[b], specimen.half_width_m[b], specimen.half_height_m[b], 0,
                           2 * above * specimen.half_height_m[b]});
    return dummies;
}

/// The blocks below a joint, and the joints below them.
void add_below(const Specimen& specimen, int block, std::vector<int>& present, std::vector<int>& clamped)
{
    if (block < 0 || std::ranges::count(present, block) > 0)
        return;
    present.push_back(block);
    for (int j = 0; j < static_cast<int>(specimen.joints.size()); ++j)
        if (specimen.joints[static_cast<std::size_t>(j)].second == block) {
            clamped.push_back(j);
            add_below(specimen, specimen.joints[static_cast<std::size_t>(j)].first, present, clamped);
        }
}

/// What all runs of a test have: the blocks, the clock up to `duration`, a table that stands still.
MeasuredRun empty_run(const Specimen& specimen, RunKind kind, int joint, double duration)
{
    static constexpr const char* words[] = {"shake", "pull", "board", "tilt", "push", "drop", "slide", "rest"};
    const auto [lower, upper] = specimen.joints[static_cast<std::size_t>(joint)];
    MeasuredRun run;
    run.name = fmt::format("{}_joint_{}", words[static_cast<std::size_t>(kind)], joint);
    run.test = kind;
    run.joint = joint;
    add_below(specimen, lower, run.present, run.clamped);
    run.present.push_back(upper);
    std::ranges::sort(run.present);
    std::ranges::sort(run.clamped);
    run.dummies = dummies_on(specimen, kind, upper);
    run.motion_id = 10000 * static_cast<int>(kind) + 10 * joint;
    run.rate_hz = test_rate_hz;
    run.base_source = BaseSource::command;
    const auto samples = static_cast<std::size_t>(std::ceil(duration * test_rate_hz)) + 1;
    if (duration > 0)
        for (std::size_t i = 0; i < samples; ++i)
            run.time_s.push_back(static_cast<double>(i) / test_rate_hz);
    run.base_displacement_m.values.assign(run.time_s.size(), 0.0);
    return run;
}

double rod_stiffness(const Specimen& specimen, const TestedBody& body)
{
    return rod_stiffness_n_m * specimen.mass_kg[static_cast<std::size_t>(body.upper)] / small_mass_kg /
           body.length_ratio;
}

MeasuredRun pull_run(const Specimen& specimen, int joint, const TestedBody& body)
{
    const std::vector<VelocityStep> steps = pull_steps(body.length_ratio, body.time_ratio);
    MeasuredRun run = empty_run(specimen, RunKind::pull, joint, steps.back().from_s + 0.3 * body.time_ratio);
    for (std::size_t i = 0; i < run.time_s.size(); ++i)
        run.base_displacement_m.values[i] = stepped_displacement(steps, turn_s * body.time_ratio, run.time_s[i]);
    ForceGauge rod;
    rod.name = "rod";
    rod.block = body.upper;
    rod.height_m = specimen.half_height_m[static_cast<std::size_t>(body.upper)] / 2;
    rod.stiffness_n_m = rod_stiffness(specimen, body);
    run.forces.push_back(rod);
    return run;
}

/// @param side +1: to the right. A board that is turned clockwise lets the body slide or turn to the right.
MeasuredRun tilted_run(const Specimen& specimen, const Laboratory& laboratory, RunKind kind, int joint,
                       const TestedBody& body, int side)
{
    const double most = std::min(needed_tilt(specimen, kind, body),
                                 laboratory.tilt_rad.value_or(std::numeric_limits<double>::infinity()));
    const double times = body.time_ratio, duration = (1.5 * board_start_s + most / board_rate_rad_s + 0.5) * times;
    MeasuredRun run = empty_run(specimen, kind, joint, duration);
    for (const double t : run.time_s)
        run.base_tilt_rad.values.push_back(-side * board_tilt(t, times, most));
    return run;
}

MeasuredRun push_run(const Specimen& specimen, int joint, const TestedBody& body, int side)
{
    MeasuredRun run = empty_run(specimen, RunKind::push, joint, test_start_s + push_s * body.time_ratio);
    ForceGauge rod;
    rod.name = "rod";
    rod.block = body.upper;
    rod.height_m = push_height * body.height_m;
    rod.to_laboratory = false;
    rod.speed_m_s = side * push_speed_m_s * body.length_ratio / body.time_ratio;
    rod.stiffness_n_m = rod_stiffness(specimen, body);
    run.forces.push_back(rod);
    return run;
}

/// @param side on which the lower corner is: -1 left, 1 right
MeasuredRun drop_run(const Specimen& specimen, int joint, const TestedBody& body, int side)
{
    MeasuredRun run =
        empty_run(specimen, RunKind::drop, joint, test_start_s + (drop_s - test_start_s) * body.time_ratio);
    run.released_s = test_start_s;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto tested = static_cast<std::size_t>(body.upper);
    const double w = specimen.half_width_m[tested], h = specimen.half_height_m[tested];
    // the lower corner half as far inside its place as the lean would bring it
    const double aside = side * h * std::sin(drop_lean_rad) / 2;
    const double up =
        drop_height_m * body.length_ratio + w * std::sin(drop_lean_rad) - h * (1 - std::cos(drop_lean_rad));
    for (const double t : run.time_s)
        for (std::size_t b = 0; b < static_cast<std::size_t>(specimen.blocks()); ++b) {
            const bool held = t <= test_start_s && std::ranges::count(run.present, static_cast<int>(b)) > 0;
            const bool hangs = b == tested;
            run.blocks.x_m.values.push_back(held ? specimen.rest_x_m[b] + (hangs ? aside : 0) : none);
            run.blocks.y_m.values.push_back(held ? specimen.rest_y_m[b] + (hangs ? up : 0) : none);
            run.blocks.theta_rad.values.push_back(held ? (hangs ? -side * drop_lean_rad : 0) : none);
        }
    return run;
}

MeasuredRun slide_run(const Specimen& specimen, int joint, const TestedBody& body)
{
    const double times = body.time_ratio;
    const double shaken = slide_plateau_s + 2 * slide_ramp_cycles / slide_hz;
    MeasuredRun run = empty_run(specimen, RunKind::slide, joint, (shaken + 2 * slide_still_s) * times);
    for (std::size_t i = 0; i < run.time_s.size(); ++i)
        run.base_displacement_m.values[i] = slide_displacement(run.time_s[i], times, body.length_ratio);
    return run;
}

/// Largest displacement, speed and acceleration of the table in a run.
struct TableNeeds {
    double stroke_m = 0, speed_m_s = 0, acceleration_m_s2 = 0;
};

TableNeeds needs_of(const MeasuredRun& run)
{
    TableNeeds needs;
    const std::vector<double>& x = run.base_displacement_m.values;
    for (std::size_t i = 1; i + 1 < x.size(); ++i) {
        needs.stroke_m = std::max(needs.stroke_m, std::fabs(x[i]));
        needs.speed_m_s = std::max(needs.speed_m_s, std::fabs(x[i + 1] - x[i - 1]) * run.rate_hz / 2);
        needs.acceleration_m_s2 =
            std::max(needs.acceleration_m_s2, std::fabs(x[i + 1] - 2 * x[i] + x[i - 1]) * run.rate_hz * run.rate_hz);
    }
    return needs;
}

std::string too_little(const char* what, double needed, double has, const char* unit)
{
    return fmt::format("{} of {:.3g} {} is needed, the laboratory has {:.3g} {}", what, needed, unit, has, unit);
}

/// Why a laboratory cannot do these runs on one joint.
std::optional<std::string> falls_short(const Specimen& specimen, const Laboratory& laboratory, RunKind kind,
                                       const MeasuredRun& run)
{
    constexpr double rounding = 1.001;
    const TestedBody body = tested_body(specimen, *run.joint, run.dummies);
    const TableNeeds needs = needs_of(run);
    const double weight = body.mass_kg * specimen.gravity_m_s2;
    const auto lacks = [&](const std::optional<double>& has, double needed) { return has && needed > *has * rounding; };
    if (lacks(laboratory.stroke_m, needs.stroke_m))
        return too_little("A stroke", needs.stroke_m, *laboratory.stroke_m, "m");
    if (lacks(laboratory.speed_m_s, needs.speed_m_s))
        return too_little("A table's speed", needs.speed_m_s, *laboratory.speed_m_s, "m/s");
    if (lacks(laboratory.acceleration_m_s2, needs.acceleration_m_s2))
        return too_little("A table's acceleration", needs.acceleration_m_s2, *laboratory.acceleration_m_s2, "m/s2");
    const bool tilts = kind == RunKind::board || kind == RunKind::tilt;
    const double friction = specimen.friction_nominal.value_or(0.6);
    const double angle =
        kind == RunKind::board
            ? std::atan(1.15 * friction)
            : 1.05 * std::atan2(specimen.half_width_m[static_cast<std::size_t>(body.upper)], body.centre_m);
    if (tilts && lacks(laboratory.tilt_rad, angle))
        return too_little("A board's tilt", angle, *laboratory.tilt_rad, "rad");
    const bool gauged = kind == RunKind::pull || kind == RunKind::push;
    if (gauged && laboratory.force_n && *laboratory.force_n <= 0)
        return "A force gauge is needed, the laboratory has none";
    if (gauged && lacks(laboratory.force_n, most_friction * weight))
        return too_little("A force", most_friction * weight, *laboratory.force_n, "N");
    return std::nullopt;
}

} // namespace

TestedBody tested_body(const Specimen& specimen, int joint, const std::vector<Dummy>& dummies)
{
    if (joint < 0 || joint >= static_cast<int>(specimen.joints.size()))
        throw InputError(
            fmt::format("joint {} is not one of 0 to {}.\n  Joints are counted from 0, in the order of the "
                        "specimen.",
                        joint, static_cast<int>(specimen.joints.size()) - 1));
    TestedBody body;
    std::tie(body.lower, body.upper) = specimen.joints[static_cast<std::size_t>(joint)];
    const auto u = static_cast<std::size_t>(body.upper);
    const double half_height = specimen.half_height_m[u];
    std::vector<Dummy> parts = {{body.upper, specimen.mass_kg[u], specimen.half_width_m[u], half_height, 0, 0}};
    for (const Dummy& dummy : dummies)
        if (dummy.block == body.upper)
            parts.push_back(dummy);
    for (const Dummy& part : parts) {
        body.mass_kg += part.mass_kg;
        body.centre_m += part.mass_kg * (half_height + part.y_m);
        body.height_m = std::max(body.height_m, half_height + part.y_m + part.half_height_m);
    }
    body.centre_m /= body.mass_kg;
    for (const Dummy& part : parts) {
        const double away = half_height + part.y_m - body.centre_m;
        const double own = (part.half_width_m * part.half_width_m + part.half_height_m * part.half_height_m) / 3;
        body.inertia_m2 += part.mass_kg / body.mass_kg * (own + away * away + part.x_m * part.x_m);
    }
    body.length_ratio = specimen.half_width_m[u] / small_half_width_m;
    body.time_ratio = std::sqrt(body.length_ratio);
    return body;
}

bool stands_alone(const Specimen& specimen, int joint)
{
    const int upper = specimen.joints[static_cast<std::size_t>(joint)].second;
    return std::ranges::count_if(specimen.joints, [&](const auto& other) { return other.second == upper; }) == 1;
}

std::vector<MeasuredRun> planned_runs(const Specimen& specimen, const Laboratory& laboratory, RunKind kind, int joint)
{
    TestedBody body = tested_body(specimen, joint, {});
    if (!stands_alone(specimen, joint) || kind == RunKind::shake)
        return {};
    body = tested_body(specimen, joint, dummies_on(specimen, kind, body.upper));
    const auto both_sides = [](const auto& run_of) {
        std::vector<MeasuredRun> runs;
        for (const int side : {-1, 1}) {
            runs.push_back(run_of(side));
            runs.back().name += side < 0 ? "_left" : "_right";
            runs.back().motion_id += side < 0 ? 0 : 1;
        }
        return runs;
    };
    switch (kind) {
    case RunKind::pull:
        return {pull_run(specimen, joint, body)};
    case RunKind::board:
    case RunKind::tilt:
        return both_sides([&](int side) { return tilted_run(specimen, laboratory, kind, joint, body, side); });
    case RunKind::push:
        return both_sides([&](int side) { return push_run(specimen, joint, body, side); });
    case RunKind::drop: {
        std::vector<MeasuredRun> runs;
        for (int i = 0; i < drop_repeats; ++i) {
            const bool right = i % 2 != 0;
            runs.push_back(drop_run(specimen, joint, body, right ? 1 : -1));
            runs.back().motion_id += right ? 1 : 0;
            runs.back().repeat = i / 2;
            runs.back().name += fmt::format("_{}_{}", right ? "right" : "left", i / 2);
        }
        return runs;
    }
    case RunKind::slide:
        return {slide_run(specimen, joint, body)};
    case RunKind::rest:
        return {empty_run(specimen, kind, joint, rest_s)};
    case RunKind::shake:
        break;
    }
    return {};
}

std::optional<std::string> cannot_do(const Specimen& specimen, const Laboratory& laboratory, RunKind kind)
{
    if (kind == RunKind::shake)
        return std::nullopt;
    if (!laboratory.may_dismantle && specimen.blocks() > 1)
        return "The specimen may not be taken apart";
    std::optional<std::string> why = "No block stands on a single joint";
    for (int joint = 0; joint < static_cast<int>(specimen.joints.size()); ++joint) {
        const std::vector<MeasuredRun> runs = planned_runs(specimen, laboratory, kind, joint);
        if (runs.empty())
            continue;
        why = falls_short(specimen, laboratory, kind, runs.front());
        if (!why)
            return std::nullopt;
    }
    return why;
}

double default_cost(RunKind kind)
{
    switch (kind) {
    case RunKind::shake:
    case RunKind::slide:
    case RunKind::board:
        return 1;
    case RunKind::rest:
        return 0.5;
    case RunKind::pull:
    case RunKind::tilt:
    case RunKind::push:
        return 1.25; // clamping and dismantling at every joint is most of any test
    case RunKind::drop:
        return 1.1;
    }
    return 1;
}

} // namespace stylobate

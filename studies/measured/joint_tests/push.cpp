/// `push`: a rod on the table pushes the body near its top until it turns about a corner. Quasi-static moments about
/// that corner (F: force, z: height of the rod, M: mass, h: height of the centre of mass, a: its distance from the
/// bearing's end, t: tangent of the rotation, c: a lever that only matters when it has turned):
///
///   F (z + c t) = M g (a - h t)
///
/// For each side a and c by regression of F z / (M g) + h t on 1 and -F t / (M g), the latter with the force of a whole
/// face. Weights vanish at both ends of the time of pushing, so that vibrations on the rod's spring cancel. a is
/// compared with the bearing of whole faces as the cameras see them stand.
///
///   bond     mean over the sides of ln(peak of F / (M g a / z)); the peak is that of a parabola through three samples.
///            Healthy joints have it too, by the inertia of the body: only its contrast between joints tells
///   width    (a_left + a_right) less the bearing of whole faces [m]: -1 times the length of the corners that are lost
///   centre   (a_left - a_right) / 2 less that of whole faces [m]: by how much the body's centre of mass is to the
///   right,
///            and half of what the right corner has lost more than the left one. The body is three blocks: a block's
///            centre counts a third
///
/// Errors: noise of the gauge through the regression; of the peak, that noise once. The gauge's gain acts on `width`
/// alone. No estimate of a side on which the body did not turn, or slid.
///
/// Blind to friction and to all that depends on it, to damping and drag (slow).

#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace stylobate {

namespace {

constexpr double least_push_turn = 0.02;   // rad, at the end
constexpr double most_push_slip_m = 0.001; // times s, of the lower face's middle
constexpr double settled_push = 0.2;       // of the way of the rod, before the regression begins
constexpr double peak_within = 0.25;       // of the way of the rod: the body stands, or has just begun to turn

struct PushSide {
    double arm_m = 0, arm_sd = 0; ///< a, less the bearing of whole faces
    double bond = 0, bond_sd = 0;
    double gain_sd = 0;
    double whole_m = 0; ///< a itself
};

/// Peak of a series by a parabola through its largest sample and the two beside it.
std::optional<double> peak_of(const std::vector<double>& values, std::size_t from, std::size_t to)
{
    std::size_t at = from;
    for (std::size_t i = from; i < to; ++i)
        if (std::isfinite(values[i]) && !(values[i] <= values[at]))
            at = i;
    if (at == 0 || at + 1 >= values.size())
        return std::nullopt;
    const double before = values[at - 1], top = values[at], after = values[at + 1];
    const double bend = before - 2 * top + after, tilt = (after - before) / 2;
    if (!std::isfinite(bend))
        return std::nullopt;
    return bend < 0 ? top - tilt * tilt / (2 * bend) : top;
}

/// a and c of the equation at the top.
std::optional<PushSide> push_side(const Specimen& specimen, const MeasuredRun& run)
{
    const std::optional<JointRun> seen = joint_run(specimen, run, false);
    if (!seen)
        return std::nullopt;
    const TestedBody& body = seen->body;
    const ForceGauge* rod = nullptr;
    for (const ForceGauge& gauge : run.forces)
        if (gauge.block == body.upper && !gauge.to_laboratory && gauge.speed_m_s != 0 && gauge.height_m > 0 &&
            gauge.value_n.values.size() == run.time_s.size())
            rod = &gauge;
    if (!rod)
        return std::nullopt;
    const double side = rod->speed_m_s > 0 ? 1 : -1;
    const double way = push_reach_m * body.length_ratio, lasts = way / std::fabs(rod->speed_m_s);
    const auto index = [&](double t) { return static_cast<std::size_t>(std::max(0.0, t) * run.rate_hz + 0.5); };
    const std::size_t start = index(test_start_s), from = index(test_start_s + settled_push * lasts),
                      to = std::min(index(test_start_s + lasts), seen->samples);
    if (to < from + 30)
        return std::nullopt;
    const double noise = rod->value_n.noise_sd.value_or(noise_of(rod->value_n.values));
    const auto [zero, count] = finite_mean(rod->value_n.values, 0, start);
    std::vector<double> force = rod->value_n.values;
    for (double& f : force)
        f = side * (f - (count > 10 ? zero : 0));
    std::vector<double> arms, levers, weights;
    double worst_slip = 0, turned = 0;
    for (std::size_t i = from; i < to; ++i) {
        const double turn = -side * seen->turn(i), t = std::tan(turn), f = force[i] / seen->weight_n;
        const double phase = std::numbers::pi * (static_cast<double>(i - from) + 0.5) / static_cast<double>(to - from);
        arms.push_back(f * rod->height_m + body.centre_m * t);
        levers.push_back(-t * (seen->half_width_m - body.centre_m * t) / rod->height_m); // F / (M g) without vibrations
        weights.push_back(std::pow(std::sin(phase), 2));
        const double half_height = specimen.half_height_m[static_cast<std::size_t>(body.upper)];
        const double foot =
            side * seen->slip(i) - half_height * std::sin(turn) - seen->half_width_m * (1 - std::cos(turn));
        if (std::isfinite(foot))
            worst_slip = std::max(worst_slip, std::fabs(foot));
        if (std::isfinite(turn))
            turned = std::max(turned, turn);
    }
    const LineFit line = line_fit(levers, arms, weights);
    if (turned < least_push_turn || 2 * static_cast<std::size_t>(line.count) < to - from || !(line.at_zero > 0) ||
        worst_slip > most_push_slip_m * body.length_ratio + 6 * seen->slip_sd())
        return std::nullopt;
    const auto [left, right] = seen->bearing_m(specimen);
    PushSide found;
    found.whole_m = line.at_zero;
    found.arm_m = line.at_zero - (side > 0 ? right : left);
    const double arm_noise = std::hypot(noise / seen->weight_n * rod->height_m, body.centre_m * seen->turn_sd());
    found.arm_sd = std::hypot(line.at_zero_sd * arm_noise, seen->offset_sd_m);
    found.gain_sd = rod->gain_sd;
    const double plateau = seen->weight_n * line.at_zero / rod->height_m;
    const std::size_t soon = std::min(index(test_start_s + peak_within * lasts), seen->samples);
    const auto peak = peak_of(force, start, soon);
    if (!peak || *peak < 6 * noise)
        return std::nullopt;
    found.bond = std::log(*peak / plateau);
    found.bond_sd = std::hypot(noise / *peak, line.at_zero_sd * arm_noise / line.at_zero);
    return found;
}

/// Mean of the runs to one side.
std::optional<PushSide> push_to(const Specimen& specimen, std::span<const MeasuredRun> runs, double side)
{
    std::vector<PushSide> found;
    for (const MeasuredRun& run : runs)
        if (!run.forces.empty() && run.forces.front().speed_m_s * side > 0)
            if (const auto one = push_side(specimen, run))
                found.push_back(*one);
    if (found.empty())
        return std::nullopt;
    PushSide mean;
    const auto n = static_cast<double>(found.size());
    for (const PushSide& one : found) {
        mean.arm_m += one.arm_m / n;
        mean.whole_m += one.whole_m / n;
        mean.bond += one.bond / n;
        mean.arm_sd = std::hypot(mean.arm_sd, one.arm_sd / n);
        mean.bond_sd = std::hypot(mean.bond_sd, one.bond_sd / n);
        mean.gain_sd = one.gain_sd;
    }
    return mean;
}

std::vector<Estimate> push_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    std::vector<Estimate> all;
    const auto left = push_to(specimen, runs, -1), right = push_to(specimen, runs, 1);
    if (left || right) {
        const double n = left && right ? 2 : 1;
        const double sum = (left ? left->bond : 0) + (right ? right->bond : 0);
        const double sd = std::hypot(left ? left->bond_sd : 0, right ? right->bond_sd : 0);
        all.push_back({"push.bond", 0, sum / n, sd / n, {.friction = 0, .geometry_m = 0, .force = 1, .damping = 0}});
    }
    if (left && right) {
        const double sd = std::hypot(left->arm_sd, right->arm_sd), whole = left->whole_m + right->whole_m;
        all.push_back({"push.width",
                       0,
                       left->arm_m + right->arm_m,
                       std::hypot(sd, whole * right->gain_sd),
                       {.friction = 0, .geometry_m = 1, .force = whole / std::numbers::sqrt2, .damping = 0}});
        all.push_back({"push.centre",
                       0,
                       (left->arm_m - right->arm_m) / 2,
                       sd / 2,
                       {.friction = 0, .geometry_m = 1, .force = 0, .damping = 0}});
    }
    return all;
}

} // namespace

const TestEstimators& push_estimators()
{
    static const TestEstimators all = {
        push_of,
        {{"push.bond", "", "logarithm of the peak of the force over the force that turns the body",
          "friction, wear, dowels that slip, damping, drag", "", true},
         {"push.width", "m", "bearing width less that of whole faces", "friction, centres of mass, damping, drag", "",
          true},
         {"push.centre", "m", "centre of mass of the body to the right of the middle of its bearing",
          "friction, corners lost alike on both sides, damping, drag"}}};
    return all;
}

} // namespace stylobate

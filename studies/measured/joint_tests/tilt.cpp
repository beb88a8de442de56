/// `tilt`: the body with its dummies is tilted until it turns about a corner, to both sides. At the first turn the
/// centre of mass is above the end of the bearing (a: distance of the two along the joint, h: height of the centre):
///
///   a = h tan |t|
///
/// and from then on, with the tilt's rate r and p^2 = g R / (k^2 + R^2), R^2 = a^2 + h^2, k: radius of gyration,
///
///   rotation = r (sinh(p (time - t_0)) / p - (time - t_0))
///
/// t_0 by least squares over rotations up to 30 mrad, or 15 mrad where that does not describe the motion; else the time
/// at which the body has turned by 6 standard deviations of a mean of 50 ms, less the time that the equation needs for
/// it, half of which is its error. a is compared with the bearing of whole faces as the cameras see them stand.
///
///   width    (a_left + a_right) less the bearing of whole faces [m]: -1 times the length of the corners that are lost
///   centre   (a_left - a_right) / 2 less that of whole faces [m]; of a block's centre of mass a third, as in `push`
///
/// Errors: noise of cameras and inclinometer through the fit. No estimate of a side on which the body did not turn, or
/// slid first.
///
/// Blind to friction and all that depends on it, damping, drag. A wedge turns both sides alike: it counts as a centre,
/// by its angle times h.

#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/onset.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stylobate {

namespace {

constexpr double most_turn_scatter = 1.25;
constexpr double slid_first_m = 0.0005; // times s, of the lower face's middle when the body is seen to turn

struct TiltSide {
    double arm_m = 0, sd = 0; ///< a, less the bearing of whole faces
};

/// Time [s] that a body needs for a rotation after its first turn.
double time_to_turn(double rotation, double rate, double p)
{
    double low = 0, high = 10 / p;
    for (int i = 0; i < 60; ++i) {
        const double t = (low + high) / 2;
        (rate * (std::sinh(p * t) / p - t) < rotation ? low : high) = t;
    }
    return high;
}

bool slid_first(const Specimen& specimen, const JointRun& seen, const std::vector<double>& turn, std::size_t moved,
                std::size_t window)
{
    const double half_height = specimen.half_height_m[static_cast<std::size_t>(seen.body.upper)];
    std::vector<double> foot;
    for (std::size_t i = moved; i < std::min(moved + window, seen.samples); ++i) {
        const double sine = std::sin(seen.turn(i)); // the block's centre goes against it
        foot.push_back(seen.slip(i) + half_height * sine);
    }
    const auto [mean, count] = finite_mean(foot, 0, foot.size());
    const double turned = finite_mean(turn, moved, moved + window).first;
    const double rolled = seen.half_width_m * turned * turned / 2;
    return count == 0 || std::fabs(mean) > slid_first_m * seen.body.length_ratio + rolled;
}

std::optional<TiltSide> tilt_side(const Specimen& specimen, const BoardRun& board)
{
    const JointRun& seen = board.seen;
    std::vector<double> turn(seen.samples);
    for (std::size_t i = 0; i < turn.size(); ++i)
        turn[i] = -board.side * seen.turn(i);
    const double g = specimen.gravity_m_s2, h = seen.body.centre_m, rate_hz = seen.run->rate_hz;
    const OnsetData data = board.data_of(turn, seen.turn_sd());
    const auto moved = first_motion(data);
    if (!moved || slid_first(specimen, seen, turn, *moved, data.window))
        return std::nullopt;
    const auto now = tilt_at(board.tilt, static_cast<double>(*moved), data.window, board.tilt_sd);
    if (!now || !(now->tilt > 0) || !(now->rate > 0))
        return std::nullopt;
    const double rate = now->rate * rate_hz, arm = h * std::tan(now->tilt), squared = arm * arm + h * h;
    const double p = std::sqrt(g * std::sqrt(squared) / (seen.body.inertia_m2 + squared));
    std::optional<OnsetFit> fit;
    for (const double most : {0.03, 0.015}) {
        fit = fit_onset(data, *moved, most, false, [&](double start, std::size_t i) {
            const double t = (static_cast<double>(i) - start) * data.step_s;
            return OnsetMotion{rate * (std::sinh(p * t) / p - t), 0};
        });
        if (fit && fit->scatter < most_turn_scatter)
            break;
        fit.reset();
    }
    double start = 0, start_sd = 0; // samples
    if (fit) {
        start = fit->start;
        start_sd = fit->start_sd;
    } else {
        const double limit = 6 * data.sd / std::sqrt(static_cast<double>(data.window));
        const double delay = time_to_turn(limit, rate, p) * rate_hz;
        start = std::max(0.0, static_cast<double>(*moved) - delay);
        start_sd = delay / 2;
    }
    const auto at = tilt_at(board.tilt, start, data.window, board.tilt_sd);
    if (!at || !(at->tilt > 0))
        return std::nullopt;
    const double tangent = std::tan(at->tilt);
    const auto [left, right] = seen.bearing_m(specimen);
    const double sd = h * (1 + tangent * tangent) * std::hypot(at->sd, at->rate * start_sd);
    return TiltSide{h * tangent - (board.side < 0 ? left : right), std::hypot(sd, seen.offset_sd_m)};
}

std::vector<Estimate> tilt_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    double arm[2] = {0, 0}, variance[2] = {0, 0}, count[2] = {0, 0}; // left, right
    for (const MeasuredRun& run : runs) {
        const std::optional<BoardRun> board = board_run(specimen, run);
        if (const auto found = board ? tilt_side(specimen, *board) : std::nullopt) {
            const int k = board->side < 0 ? 0 : 1;
            arm[k] += found->arm_m;
            variance[k] += found->sd * found->sd;
            ++count[k];
        }
    }
    if (count[0] == 0 || count[1] == 0)
        return {};
    const double left = arm[0] / count[0], right = arm[1] / count[1];
    const double sd = std::hypot(std::sqrt(variance[0]) / count[0], std::sqrt(variance[1]) / count[1]);
    const LaboratoryFloor geometry = {.friction = 0, .geometry_m = 1, .force = 0, .damping = 0};
    return {{"tilt.width", 0, left + right, sd, geometry}, {"tilt.centre", 0, (left - right) / 2, sd / 2, geometry}};
}

} // namespace

const TestEstimators& tilt_estimators()
{
    static const TestEstimators all = {
        tilt_of,
        {{"tilt.width", "m", "bearing width less that of whole faces",
          "friction, centres of mass, wedges, damping, drag", "", true},
         {"tilt.centre", "m", "centre of mass of the body to the right of the middle of its bearing",
          "friction, corners lost alike on both sides, damping, drag"}}};
    return all;
}

} // namespace stylobate

/// `board`: the block alone is tilted on its joint until it slides, to both sides (t: tilt, counter-clockwise).
///
///   mu_s = tan |t| at the first slip;   after it  x'' = g (sin |t| - mu_k cos |t|)  down the slope
///
/// The time of the first slip and mu_k by least squares over the slip up to 10 mm (times s), from the measured tilt,
/// smoothed over 0.8 s and integrated twice; where this equation does not describe the motion (scatter above 1.25 of
/// the noise: friction that changes on the way), up to 5, 2.5 and 1.2 mm. Where it describes none of them (a dowel
/// stops the block), the first slip is that at which the block has moved by 6 standard deviations of a mean of 50 ms,
/// less the time in which a block of constant friction slips so far; half of that time is its error, and there is no
/// mu_k.
///
///   static      mean over the sides of ln mu_s
///   kinetic     mean over the sides of ln(mu_k / mu_s): below 0 where friction falls with speed or path, or a bond
///   broke direction   ln mu_s to the left less to the right; a wedge counts twice
///
/// Errors: noise of cameras and inclinometer through the fit. A block that the steepest board does not move has the
/// mu_s of that board: it has at least that. No estimate of a side on which the block turned first.
///
/// Blind to corners and centres of mass (as long as the block does not turn), damping, bonds against opening, drag.

#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/onset.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace stylobate {

namespace {

constexpr double most_scatter = 1.25;
constexpr double most_board_turn = 0.02; // rad

struct BoardSide {
    double log_static = 0, static_sd = 0;
    std::optional<double> log_kinetic; ///< over static
    double kinetic_sd = 0;
};

/// Sine and cosine of the tilt, integrated once and twice.
struct TiltIntegrals {
    std::vector<double> sine, sine2, cosine, cosine2;
    double step = 0;

    double after(const std::vector<double>& once, const std::vector<double>& twice, double start, std::size_t i) const
    {
        const auto k = static_cast<std::size_t>(start);
        const double part = start - static_cast<double>(k);
        const double at = twice[k] + part * (twice[k + 1] - twice[k]), speed = once[k] + part * (once[k + 1] - once[k]);
        return twice[i] - at - speed * (static_cast<double>(i) - start) * step;
    }
};

TiltIntegrals integrals_of(const std::vector<double>& tilt, double step)
{
    TiltIntegrals all;
    all.step = step;
    const auto add = [&](std::vector<double>& once, std::vector<double>& twice, auto of) {
        once.assign(tilt.size(), 0.0);
        twice.assign(tilt.size(), 0.0);
        for (std::size_t i = 1; i < tilt.size(); ++i) {
            const double a = of(tilt[i - 1]), b = of(tilt[i]);
            once[i] = once[i - 1] + step * (a + b) / 2;
            twice[i] = twice[i - 1] + step * once[i - 1] + step * step * (2 * a + b) / 6;
        }
    };
    add(all.sine, all.sine2, [](double t) { return std::sin(t); });
    add(all.cosine, all.cosine2, [](double t) { return std::cos(t); });
    return all;
}

/// A block that the steepest board does not move has at least the friction of that board.
std::optional<BoardSide> held_to_the_end(const std::vector<double>& tilt, const std::vector<double>& down,
                                         std::size_t window, double noise)
{
    const std::size_t from = down.size() - std::min(window, down.size());
    const auto seen = std::ranges::count_if(down.begin() + static_cast<std::ptrdiff_t>(from), down.end(),
                                            [](double v) { return std::isfinite(v); });
    const double steepest = finite_mean(tilt, from, down.size()).first;
    if (down.size() < tilt.size() || 2 * static_cast<std::size_t>(seen) < window || !(steepest > 0))
        return std::nullopt;
    BoardSide found;
    const double mu = std::tan(steepest);
    found.log_static = std::log(mu);
    found.static_sd = (1 + mu * mu) / mu * noise / std::sqrt(static_cast<double>(window));
    return found;
}

std::optional<BoardSide> board_side(const Specimen& specimen, const BoardRun& board)
{
    const JointRun& seen = board.seen;
    const std::vector<double>& tilt = board.tilt;
    std::vector<double> down(seen.samples);
    for (std::size_t i = 0; i < down.size(); ++i)
        down[i] = std::fabs(seen.turn(i)) < most_board_turn ? board.side * seen.slip(i)
                                                            : std::numeric_limits<double>::quiet_NaN();
    const double s = seen.body.length_ratio, g = specimen.gravity_m_s2, noise = board.tilt_sd;
    const OnsetData data = board.data_of(down, seen.slip_sd());
    const auto moved = first_motion(data);
    if (std::ranges::any_of(tilt, [](double t) { return !std::isfinite(t); }))
        return std::nullopt;
    if (!moved)
        return held_to_the_end(tilt, down, data.before, noise);
    const std::size_t from = *moved > 3 * data.before ? *moved - 3 * data.before : 0;
    const std::size_t to = std::min(tilt.size(), *moved + 3 * data.before);
    std::vector<double> smooth = tilt;
    std::ranges::copy(smoothed(std::span(tilt).subspan(from, to - from), static_cast<int>(data.before)),
                      smooth.begin() + static_cast<std::ptrdiff_t>(from));
    const TiltIntegrals integrals = integrals_of(smooth, seen.step_s());
    std::optional<OnsetFit> fit;
    for (const double most : {0.010, 0.005, 0.0025, 0.0012}) {
        fit = fit_onset(data, *moved, most * s, true, [&](double start, std::size_t i) {
            return OnsetMotion{g * integrals.after(integrals.sine, integrals.sine2, start, i),
                               -g * integrals.after(integrals.cosine, integrals.cosine2, start, i)};
        });
        if (fit && fit->scatter < most_scatter)
            break;
        fit.reset();
    }
    BoardSide found;
    if (fit) {
        const auto at = tilt_at(tilt, fit->start, data.window, noise);
        if (!at || !(at->tilt > 0) || !(fit->coefficient > 0))
            return std::nullopt;
        const double mu = std::tan(at->tilt), per_tilt = (1 + mu * mu) / mu; // of ln tan
        found.log_static = std::log(mu);
        found.static_sd = per_tilt * std::hypot(at->sd, at->rate * fit->start_sd);
        found.log_kinetic = std::log(fit->coefficient / mu);
        const double per_start = fit->per_start / fit->coefficient - per_tilt * at->rate;
        found.kinetic_sd = std::hypot(std::hypot(per_start * fit->start_sd, fit->coefficient_sd / fit->coefficient),
                                      per_tilt * at->sd);
        return found;
    }
    const auto now = tilt_at(tilt, static_cast<double>(*moved), data.window, noise);
    if (!now || !(now->tilt > 0) || !(now->rate > 0))
        return std::nullopt;
    // x = g r / cos t (time)^3 / 6 of a block whose friction stays as it was at the first slip, r: rate of the tilt
    const double limit = 6 * data.sd / std::sqrt(static_cast<double>(data.window));
    const double rate = now->rate * seen.run->rate_hz, delay = std::cbrt(6 * limit * std::cos(now->tilt) / (g * rate));
    const double mu = std::tan(now->tilt - rate * delay);
    if (!(mu > 0))
        return std::nullopt;
    found.log_static = std::log(mu);
    found.static_sd = (1 + mu * mu) / mu * std::hypot(now->sd, rate * delay / 2);
    return found;
}

std::vector<Estimate> board_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    std::vector<BoardSide> left, right;
    for (const MeasuredRun& run : runs) {
        const std::optional<BoardRun> board = board_run(specimen, run);
        if (const auto found = board ? board_side(specimen, *board) : std::nullopt)
            (board->side < 0 ? left : right).push_back(*found);
    }
    const auto friction = [](const char* name, double value, double sd) {
        return Estimate{name, 0, value, sd, {.friction = 1, .geometry_m = 0, .force = 0, .damping = 0}};
    };
    struct Mean {
        double value = 0, variance = 0, count = 0;
        void add(double v, double sd)
        {
            value += v;
            variance += sd * sd;
            ++count;
        }
        double mean() const { return value / count; }
        double sd() const { return std::sqrt(variance) / count; }
    } of_static, of_kinetic, of_left, of_right;
    for (const auto* sides : {&left, &right})
        for (const BoardSide& one : *sides) {
            of_static.add(one.log_static, one.static_sd);
            (sides == &left ? of_left : of_right).add(one.log_static, one.static_sd);
            if (one.log_kinetic)
                of_kinetic.add(*one.log_kinetic, one.kinetic_sd);
        }
    std::vector<Estimate> all;
    if (of_static.count > 0)
        all.push_back(friction("board.static", of_static.mean(), of_static.sd()));
    if (of_kinetic.count > 0)
        all.push_back(friction("board.kinetic", of_kinetic.mean(), of_kinetic.sd()));
    if (of_left.count > 0 && of_right.count > 0)
        all.push_back(
            friction("board.direction", of_left.mean() - of_right.mean(), std::hypot(of_left.sd(), of_right.sd())));
    return all;
}

} // namespace

const TestEstimators& board_estimators()
{
    static const TestEstimators all = {
        board_of,
        {{"board.static", "", "logarithm of the friction at the first slip",
          "corners, centres of mass, damping, drag, bonds against opening"},
         {"board.kinetic", "", "logarithm of the friction after the first slip over that at it",
          "the size of friction, corners, centres of mass, damping", "speed"},
         {"board.direction", "", "logarithm of the friction at the first slip, to the left less to the right",
          "all but friction that depends on direction, and wedges", "direction"}}};
    return all;
}

} // namespace stylobate

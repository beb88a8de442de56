/// `drop`: the body falls some millimetres onto the joint, several times. How long it bounces and rocks is what the
/// joint's damping leaves of the fall's energy.
///
///   T = t_r - t_0      t_r: the last time at which height or rotation (times the half width) is farther from where the
///                      body comes to rest than 0.1 mm (times s), or than 5.5 standard deviations of a mean of three
///                      samples; t_0 = release + sqrt(2 H / g), H: fall
///
///   time      median of ln(T + 10 ms sqrt(s)) over the repeats: less than some frames of a camera is nothing. Error:
///             1.25 of their scatter over sqrt(n), but at least that of one interval of the cameras' clock, which is
///             1 / (rate sqrt(12)) over T
///   early     median of ln(E + 0.003)      0.003: the noise of the cameras; E: energy in flight over that of the fall,
///             (y - y_rest + (y'^2 + r^2 theta'^2) / 2 g) / H, mean over the first 2 sqrt(2 H / g) after the impact
///   late      the same from 150 to 250 ms (times sqrt(s)) after the impact. Errors as of `time`; at least 1 %
///
/// For bounces of restitution e, v_0 = sqrt(2 g H): T is near 2 v_0 / g e / (1 - e). A body that still bounces at the
/// end of the run has its end; `early` and `late` tell then. The common damping of all joints is in all of them; only
/// the contrast between joints tells. No estimate from fewer than two repeats, nor from a body beside its place.
///
/// Blind to friction, dowels, bonds that are already broken, drag (slow), and to damping that depends on speed and is
/// the common one at the speed of this fall. Lost corners and shifted centres make the body rock more.

#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace stylobate {

namespace {

constexpr double rest_threshold_m = 0.0001; // times s
constexpr double clear_motion = 5.5;        // standard deviations: one late sample that is noise would spoil the time
constexpr double some_frames_s = 0.01;      // times sqrt(s)
constexpr double rest_window_s = 0.2;       // times sqrt(s), at the end of the run
constexpr double most_off_place_m = 0.0015; // times s: in height, half of the fall
constexpr double late_s = 0.15, late_window_s = 0.1; // times sqrt(s), after the first impact
constexpr double least_energy = 0.003;               // of the fall's: less is within the noise of the cameras
constexpr std::size_t speed_samples = 2;             // to either side of one of which the speed is wanted

/// A fall as it was seen.
struct SeenDrop {
    double time_s = 0;          ///< until rest, with some frames more; up to the end of the run
    double early = 0, late = 0; ///< logarithms of the energy that is left, over that of the fall
};

/// Mean of the energy in free flight over that of the fall, in samples [from, to).
double energy_left(const JointRun& seen, double rest, double fall, double gravity, std::size_t from, std::size_t to)
{
    double sum = 0, count = 0;
    for (std::size_t i = from; i < to; ++i) {
        const double span = 2 * static_cast<double>(speed_samples) * seen.step_s();
        const double up = (seen.y_m[i + speed_samples] - seen.y_m[i - speed_samples]) / span;
        const double turn = (seen.theta_rad[i + speed_samples] - seen.theta_rad[i - speed_samples]) / span;
        const double e = gravity * (seen.y_m[i] - rest) + (up * up + seen.body.inertia_m2 * turn * turn) / 2;
        if (std::isfinite(e)) {
            sum += e / (gravity * fall);
            ++count;
        }
    }
    return 2 * count > static_cast<double>(to - from) ? std::max(sum / count, 0.0)
                                                      : std::numeric_limits<double>::quiet_NaN();
}

/// Where it stands at the end, or between which it still bounces.
double place_at_end(const std::vector<double>& y, std::size_t from, double noise)
{
    std::vector<double> last(y.begin() + static_cast<std::ptrdiff_t>(from), y.end());
    std::erase_if(last, [](double value) { return !std::isfinite(value); });
    if (2 * last.size() < y.size() - from)
        return std::numeric_limits<double>::quiet_NaN();
    std::sort(last.begin(), last.end());
    return last[last.size() / 10] + 1.28 * noise; // a tenth of a normal distribution is below that
}

std::optional<SeenDrop> seen_drop(const Specimen& specimen, const MeasuredRun& run)
{
    const std::optional<JointRun> seen = joint_run(specimen, run, false);
    if (!seen || !run.released_s || seen->samples < run.time_s.size())
        return std::nullopt;
    const double s = seen->body.length_ratio, times = seen->body.time_ratio;
    const std::size_t n = seen->samples;
    const auto released =
        static_cast<std::size_t>(std::ranges::upper_bound(run.time_s, *run.released_s + 1e-9) - run.time_s.begin());
    const auto samples = [&](double seconds) { return static_cast<std::size_t>(seconds * times * run.rate_hz + 0.5); };
    const std::size_t window = samples(rest_window_s);
    if (released < 5 || n < released + 3 * window)
        return std::nullopt;
    const auto [before, before_count] = finite_mean(seen->y_m, 0, released);
    const double held = before_count > 0 ? before : seen->y_m[released]; // the state at release is the first after it
    const double rest = place_at_end(seen->y_m, n - window, seen->y_sd);
    const auto [lean, lean_count] = finite_mean(seen->theta_rad, n - window, n);
    const double fall = held - rest;
    if (!std::isfinite(fall) || 2 * static_cast<std::size_t>(lean_count) < window ||
        std::fabs(fall - drop_height_m * s) > most_off_place_m * s)
        return std::nullopt;
    const auto away = [&](std::size_t i) { // mean of three samples, farthest of both
        double y = 0, turn = 0;
        for (std::size_t k = i - 1; k <= i + 1; ++k) {
            y += (seen->y_m[k] - rest) / 3;
            turn += (seen->theta_rad[k] - lean) / 3;
        }
        return std::max(std::fabs(y), seen->half_width_m * std::fabs(turn));
    };
    const double noise = std::max(seen->y_sd, seen->half_width_m * seen->theta_sd) / std::sqrt(3.0);
    const double threshold = std::max(rest_threshold_m * s, clear_motion * noise);
    std::size_t last = n - 2;
    int gaps = 0;
    while (last > released && !(away(last) > threshold)) {
        gaps += std::isfinite(away(last)) ? 0 : 1;
        --last;
    }
    constexpr int most_gaps = 25;
    if (last <= released || gaps > most_gaps)
        return std::nullopt; // not dropped, or not seen
    double t = run.time_s[last];
    if (last < n - 2) {
        const double above = away(last), below = away(last + 1);
        if (!std::isfinite(below))
            return std::nullopt;
        t += (above - threshold) / (above - below) * seen->step_s();
    }
    const double flight = std::sqrt(2 * fall / specimen.gravity_m_s2), met = *run.released_s + flight;
    const auto impact = static_cast<std::size_t>((met - run.time_s.front()) * run.rate_hz + 0.5);
    const auto logarithm = [&](std::size_t from, std::size_t to) {
        return std::log(energy_left(*seen, rest, fall, specimen.gravity_m_s2, from, std::min(to, n - speed_samples)) +
                        least_energy);
    };
    SeenDrop out;
    out.time_s = std::max(t - met, 0.0) + some_frames_s * times;
    out.early = logarithm(impact + speed_samples + 1, impact + static_cast<std::size_t>(2 * flight * run.rate_hz));
    out.late = logarithm(impact + samples(late_s), impact + samples(late_s + late_window_s));
    return std::isfinite(out.early + out.late) ? std::optional(out) : std::nullopt;
}

/// Median over the repeats and its error: a body that lands on its other corner now and then loses much more.
struct OfRepeats {
    double median = 0, sd = 0;
};

OfRepeats of_repeats(std::vector<double> values, double resolution)
{
    const std::size_t n = values.size();
    double mean = 0, squares = 0;
    for (const double value : values)
        mean += value / static_cast<double>(n);
    for (const double value : values)
        squares += (value - mean) * (value - mean) / static_cast<double>(n - 1);
    std::sort(values.begin(), values.end());
    constexpr double of_median = 1.25; // its standard deviation over that of the mean, of normal numbers
    return {(values[(n - 1) / 2] + values[n / 2]) / 2,
            of_median * std::max(std::sqrt(squares), resolution) / std::sqrt(static_cast<double>(n))};
}

std::vector<Estimate> drop_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    std::vector<double> logs, early, late;
    double resolution = 0;
    for (const MeasuredRun& run : runs)
        if (const auto drop = seen_drop(specimen, run)) {
            logs.push_back(std::log(drop->time_s));
            early.push_back(drop->early);
            late.push_back(drop->late);
            resolution = std::max(resolution, 1 / (run.rate_hz * std::sqrt(12.0) * drop->time_s));
        }
    if (logs.size() < 2)
        return {};
    constexpr LaboratoryFloor time = {.friction = 0, .geometry_m = 0, .force = 0, .time = 1};
    const OfRepeats t = of_repeats(logs, resolution), e = of_repeats(early, 0.01), l = of_repeats(late, 0.01);
    return {{"drop.time", 0, t.median, t.sd, time},
            {"drop.early", 0, e.median, e.sd, time},
            {"drop.late", 0, l.median, l.sd, time}};
}

} // namespace

const TestEstimators& drop_estimators()
{
    static const TestEstimators all = {
        drop_of,
        {{"drop.time", "", "median logarithm of the time [s] from the first impact until rest, with 10 ms more",
          "friction, dowels, drag, damping that is the common one at this speed", "", true},
         {"drop.early", "", "logarithm of the energy after the first impact", "friction, dowels, drag", "", true},
         {"drop.late", "", "logarithm of the energy after many impacts", "friction, dowels, drag", "", true}}};
    return all;
}

} // namespace stylobate

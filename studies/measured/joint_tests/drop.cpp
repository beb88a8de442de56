/// `drop`: the body falls some millimetres onto the joint, several times. How long it bounces and rocks is what the
/// joint's damping leaves of the fall's energy.
///
///   T = t_r - t_0      t_r: the last time at which height or rotation (times the half width) is farther from where the
///                      body comes to rest than 0.1 mm (times s), or than 5.5 standard deviations of a mean of three
///                      samples; t_0 = release + sqrt(2 H / g), H: fall
///
///   time      mean of ln(T + 10 ms sqrt(s)) over the repeats: less than some frames of a camera is nothing. Error:
///             their scatter over sqrt(n), but at least that of one interval of the cameras' clock, which is
///             1 / (rate sqrt(12)) over T
///   scatter   standard deviation of these logarithms; error 1 / sqrt(2 (n - 1)) of it
///
/// For bounces of restitution e, v_0 = sqrt(2 g H): T is near 2 v_0 / g e / (1 - e). The common damping of all joints
/// is in it; only its contrast between joints tells. No estimate from fewer than two repeats, nor from a body that does
/// not come to rest on its place.
///
/// Blind to friction, dowels, bonds that are already broken, drag (slow), and to damping that depends on speed and is
/// the common one at the speed of this fall. Lost corners and shifted centres make the body rock more.

#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stylobate {

namespace {

constexpr double rest_threshold_m = 0.0001; // times s
constexpr double clear_motion = 5.5;        // standard deviations: one late sample that is noise would spoil the time
constexpr double some_frames_s = 0.01;      // times sqrt(s)
constexpr double rest_window_s = 0.2;       // times sqrt(s), at the end of the run
constexpr double most_off_place_m = 0.0015; // times s: in height, half of the fall

std::optional<double> time_to_rest(const Specimen& specimen, const MeasuredRun& run)
{
    const std::optional<JointRun> seen = joint_run(specimen, run, false);
    if (!seen || !run.released_s || seen->samples < run.time_s.size())
        return std::nullopt;
    const double s = seen->body.length_ratio, from_end = rest_window_s * seen->body.time_ratio;
    const std::size_t n = seen->samples;
    const auto released =
        static_cast<std::size_t>(std::ranges::upper_bound(run.time_s, *run.released_s + 1e-9) - run.time_s.begin());
    const auto window = static_cast<std::size_t>(from_end * run.rate_hz);
    if (released < 5 || n < released + 3 * window)
        return std::nullopt;
    const auto [before, before_count] = finite_mean(seen->y_m, 0, released);
    const double held = before_count > 0 ? before : seen->y_m[released]; // the state at release is the first after it
    const auto [rest, rest_count] = finite_mean(seen->y_m, n - window, n);
    const auto [lean, lean_count] = finite_mean(seen->theta_rad, n - window, n);
    if (!std::isfinite(held) || 2 * static_cast<std::size_t>(std::min(rest_count, lean_count)) < window)
        return std::nullopt;
    const double fall = held - rest, expected = drop_height_m * s;
    if (std::fabs(fall - expected) > most_off_place_m * s)
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
    if (last >= n - window || last <= released || gaps > most_gaps)
        return std::nullopt; // still moving at the end, not dropped, or not seen
    const double above = away(last), below = away(last + 1);
    if (!std::isfinite(below))
        return std::nullopt;
    const double t = run.time_s[last] + (above - threshold) / (above - below) * seen->step_s();
    const double met = *run.released_s + std::sqrt(2 * fall / specimen.gravity_m_s2);
    return std::max(t - met, 0.0) + some_frames_s * seen->body.time_ratio;
}

std::vector<Estimate> drop_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    std::vector<double> logs;
    double resolution = 0;
    for (const MeasuredRun& run : runs)
        if (const auto time = time_to_rest(specimen, run)) {
            logs.push_back(std::log(*time));
            resolution = std::max(resolution, 1 / (run.rate_hz * std::sqrt(12.0) * *time));
        }
    if (logs.size() < 2)
        return {};
    const auto n = static_cast<double>(logs.size());
    double mean = 0, squares = 0;
    for (const double value : logs)
        mean += value / n;
    for (const double value : logs)
        squares += (value - mean) * (value - mean);
    const double scatter = std::sqrt(squares / (n - 1)), sd = std::max(scatter, resolution);
    return {{"drop.time", 0, mean, sd / std::sqrt(n), {.friction = 0, .geometry_m = 0, .force = 0, .time = 1}},
            {"drop.scatter",
             0,
             scatter,
             sd / std::sqrt(2 * (n - 1)),
             {.friction = 0, .geometry_m = 0, .force = 0, .time = 1}}};
}

} // namespace

const TestEstimators& drop_estimators()
{
    static const TestEstimators all = {
        drop_of,
        {{"drop.time", "", "mean logarithm of the time [s] from the first impact until rest, with 10 ms more",
          "friction, dowels, drag, damping that is the common one at this speed", "", true},
         {"drop.scatter", "", "standard deviation of these logarithms", "all that repeats itself"}}};
    return all;
}

} // namespace stylobate

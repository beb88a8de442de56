/// `drop`: the body hangs with a lean, falls some millimetres and lands on one corner, three times on either. How far
/// that corner bounces is what the joint's damping leaves.
///
///   z = y - y_rest + x sin theta + h (1 - cos theta)      height of the corner, x = -b or b
///
///   bounce    ln(Z / H + 0.01)      Z: mean of z over the time of the fall, from the first impact on; H: height of the
///             fall; 0.01: the noise of the cameras. The median of each side, and the mean of both. Error: 1.25 of the
///             scatter of the repeats over sqrt(n), at least 1 %
///
/// Where a corner leaves with the part e of its speed, e up to one half, Z is 4/3 e^3 H. The lean is
/// so large that the other corner lands later. With a level body it is chance which corner lands first, and what a
/// corner takes is divided among several impacts: the energy that is left tells of the body's shape.
///
/// The common damping of all joints is in it; only the contrast between joints tells. No estimate from fewer than two
/// repeats on either side, nor from a body beside its place.
///
/// Blind to friction, dowels, bonds that are already broken, drag (slow), and to damping that depends on speed and is
/// the common one at the speed of this fall.

#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

constexpr double rest_window_s = 0.2;       // times sqrt(s), at the end of the run
constexpr double most_off_place_m = 0.0015; // times s: in height, half of the fall
constexpr double least_bounce = 0.01;       // of the height of the fall: less is within the noise of the cameras

/// Where its middle is when it stands, by the last samples: a body that still rocks stands on one corner, and one that
/// still hops touches down now and then.
double place_at_end(const JointRun& seen, std::size_t from)
{
    constexpr int smoothing = 2; // samples to either side
    const std::vector<double> y = smoothed(seen.y_m, smoothing), theta = smoothed(seen.theta_rad, smoothing);
    std::vector<double> last;
    for (std::size_t i = from; i < y.size(); ++i)
        if (const double place = y[i] - seen.half_width_m * std::fabs(std::sin(theta[i])); std::isfinite(place))
            last.push_back(place);
    if (2 * last.size() < y.size() - from)
        return std::numeric_limits<double>::quiet_NaN();
    std::sort(last.begin(), last.end());
    const double noise = std::hypot(seen.y_sd, seen.half_width_m * seen.theta_sd) / std::sqrt(2 * smoothing + 1);
    return last[last.size() / 10] + 1.28 * noise; // a tenth of a normal distribution is below that
}

/// One landing: on which corner, and the logarithm of its bounce.
struct Landing {
    bool on_the_left = false;
    double bounce = 0;
};

std::optional<Landing> seen_landing(const Specimen& specimen, const MeasuredRun& run)
{
    const std::optional<JointRun> seen = joint_run(specimen, run, false);
    if (!seen || !run.released_s || seen->samples < run.time_s.size())
        return std::nullopt;
    const double s = seen->body.length_ratio;
    const std::size_t n = seen->samples;
    const auto released =
        static_cast<std::size_t>(std::ranges::upper_bound(run.time_s, *run.released_s + 1e-9) - run.time_s.begin());
    const auto window = static_cast<std::size_t>(rest_window_s * seen->body.time_ratio * run.rate_hz + 0.5);
    if (released < 5 || n < released + 3 * window)
        return std::nullopt;
    const auto held_at = [&](const std::vector<double>& values) {
        const auto [mean, count] = finite_mean(values, 0, released);
        return count > 0 ? mean : values[released]; // the state at release is the first after it
    };
    const double held_y = held_at(seen->y_m), held_rad = held_at(seen->theta_rad);
    const double rest_y = place_at_end(*seen, n - window);
    const Landing side{held_rad > 0, 0}; // counter-clockwise: the left corner is the lower one
    const double x = (side.on_the_left ? -1 : 1) * seen->half_width_m;
    const double h = specimen.half_height_m[static_cast<std::size_t>(seen->body.upper)];
    const auto height = [&](double y, double turn) {
        return y - rest_y + x * std::sin(turn) + h * (1 - std::cos(turn));
    };
    const double fall = height(held_y, held_rad);
    if (!std::isfinite(fall) || std::fabs(fall - drop_height_m * s) > most_off_place_m * s)
        return std::nullopt;
    const double flight = std::sqrt(2 * fall / specimen.gravity_m_s2);
    const auto impact = static_cast<std::size_t>((*run.released_s + flight - run.time_s.front()) * run.rate_hz + 1);
    const auto end = std::min(impact + static_cast<std::size_t>(flight * run.rate_hz), n);
    double sum = 0, count = 0;
    for (std::size_t i = impact; i < end; ++i)
        if (const double z = height(seen->y_m[i], seen->theta_rad[i]); std::isfinite(z)) {
            sum += z;
            ++count;
        }
    if (2 * count <= static_cast<double>(end - impact))
        return std::nullopt;
    return Landing{side.on_the_left, std::log(std::max(sum / count, 0.0) / fall + least_bounce)};
}

/// Of one side: a landing that went wrong counts little.
struct Median {
    double value = 0, variance = 0;
};

Median median_of(std::vector<double> values)
{
    const std::size_t n = values.size();
    double mean = 0, squares = 0;
    for (const double value : values)
        mean += value / static_cast<double>(n);
    for (const double value : values)
        squares += (value - mean) * (value - mean) / static_cast<double>(n - 1);
    std::sort(values.begin(), values.end());
    constexpr double of_median = 1.25, least_sd = 0.01; // over that of the mean, of normal numbers; of one drop
    const double sd = of_median * std::max(std::sqrt(squares), least_sd);
    return {(values[(n - 1) / 2] + values[n / 2]) / 2, sd * sd / static_cast<double>(n)};
}

std::vector<Estimate> drop_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    std::vector<double> left, right;
    for (const MeasuredRun& run : runs)
        if (const auto landing = seen_landing(specimen, run))
            (landing->on_the_left ? left : right).push_back(landing->bounce);
    if (left.size() < 2 || right.size() < 2)
        return {};
    const Median one = median_of(std::move(left)), other = median_of(std::move(right));
    return {{"drop.bounce",
             0,
             (one.value + other.value) / 2,
             std::sqrt(one.variance + other.variance) / 2,
             {.friction = 0, .geometry_m = 0, .force = 0, .damping = 1}}};
}

} // namespace

const TestEstimators& drop_estimators()
{
    static const TestEstimators all = {
        drop_of,
        {{"drop.bounce", "", "logarithm of the bounce of the corner that lands first",
          "friction, dowels, drag, damping that is the common one at this speed", "", true}}};
    return all;
}

} // namespace stylobate

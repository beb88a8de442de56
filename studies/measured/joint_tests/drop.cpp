/// `drop`: the body falls some millimetres onto the joint, several times. The energy that it has afterwards is what the
/// joint's damping leaves of the fall's.
///
///   E = (y - y_rest + (y'^2 + r^2 theta'^2) / 2 g) / H      in flight; H: fall, r: radius of gyration
///
///   early     median over the repeats of ln(E + 0.003), E: mean over the first 2 sqrt(2 H / g) after the impact.
///             0.003: the noise of the cameras. Error: 1.25 of the scatter of the repeats over sqrt(n), at least 1 %
///   late      the same from 150 to 250 ms (times sqrt(s)) after the impact: it tells where a bed bounces long
///
/// For bounces of restitution e, E is e^2 in the first flight, e^4 in the second one. The common damping of all joints
/// is in both; only the contrast between joints tells. No estimate from fewer than two repeats, nor from a body beside
/// its place.
///
/// Blind to friction, dowels, bonds that are already broken, drag (slow), and to damping that depends on speed and is
/// the common one at the speed of this fall. Lost corners and shifted centres make the body rock more.

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

constexpr double rest_window_s = 0.2;                // times sqrt(s), at the end of the run
constexpr double most_off_place_m = 0.0015;          // times s: in height, half of the fall
constexpr double late_s = 0.15, late_window_s = 0.1; // times sqrt(s), after the first impact
constexpr double least_energy = 0.003;               // of the fall's: less is within the noise of the cameras
constexpr std::size_t speed_samples = 2;             // to either side of one of which the speed is wanted

/// Logarithms of the energy that is left, over that of the fall.
struct SeenDrop {
    double early = 0, late = 0;
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
    const double rest = place_at_end(seen->y_m, n - window, seen->y_sd), fall = held - rest;
    if (!std::isfinite(fall) || std::fabs(fall - drop_height_m * s) > most_off_place_m * s)
        return std::nullopt;
    const double flight = std::sqrt(2 * fall / specimen.gravity_m_s2);
    const auto impact = static_cast<std::size_t>((*run.released_s + flight - run.time_s.front()) * run.rate_hz + 0.5);
    const auto logarithm = [&](std::size_t from, std::size_t to) {
        return std::log(energy_left(*seen, rest, fall, specimen.gravity_m_s2, from, std::min(to, n - speed_samples)) +
                        least_energy);
    };
    const SeenDrop out{
        logarithm(impact + speed_samples + 1, impact + static_cast<std::size_t>(2 * flight * run.rate_hz)),
        logarithm(impact + samples(late_s), impact + samples(late_s + late_window_s))};
    return std::isfinite(out.early + out.late) ? std::optional(out) : std::nullopt;
}

/// The median over the repeats: a body that lands on its other corner now and then loses much more.
Estimate median_of(const char* name, std::vector<double> logarithms)
{
    const std::size_t n = logarithms.size();
    double mean = 0, squares = 0;
    for (const double value : logarithms)
        mean += value / static_cast<double>(n);
    for (const double value : logarithms)
        squares += (value - mean) * (value - mean) / static_cast<double>(n - 1);
    std::sort(logarithms.begin(), logarithms.end());
    constexpr double of_median = 1.25, least_sd = 0.01; // over that of the mean, of normal numbers; of one drop
    return {name,
            0,
            (logarithms[(n - 1) / 2] + logarithms[n / 2]) / 2,
            of_median * std::max(std::sqrt(squares), least_sd) / std::sqrt(static_cast<double>(n)),
            {.friction = 0, .geometry_m = 0, .force = 0, .damping = 1}};
}

std::vector<Estimate> drop_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    std::vector<double> early, late;
    for (const MeasuredRun& run : runs)
        if (const auto drop = seen_drop(specimen, run)) {
            early.push_back(drop->early);
            late.push_back(drop->late);
        }
    if (early.size() < 2)
        return {};
    return {median_of("drop.early", std::move(early)), median_of("drop.late", std::move(late))};
}

} // namespace

const TestEstimators& drop_estimators()
{
    static const TestEstimators all = {
        drop_of,
        {{"drop.early", "", "logarithm of the energy after the first impact",
          "friction, dowels, drag, damping that is the common one at this speed", "", true},
         {"drop.late", "", "logarithm of the energy after many impacts",
          "friction, dowels, drag, damping that is the common one at this speed", "", true}}};
    return all;
}

} // namespace stylobate

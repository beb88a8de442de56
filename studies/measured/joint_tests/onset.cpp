#include "studies/measured/joint_tests/onset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <utility>

namespace stylobate {

namespace {

constexpr double window_s = 0.05, before_s = 0.4; // times the root of the body's size
constexpr double clear_mean = 6;                  // standard deviations of a mean
constexpr double not_tried = std::numeric_limits<double>::quiet_NaN();

/// Sums of squares for one start: the best zero and coefficient, and what is left.
struct OnsetTry {
    double left = 0, coefficient = 0, coefficient_sd = 0;
    std::size_t count = 0;
};

OnsetTry try_start(const OnsetData& data, double start, std::size_t from, std::size_t to, bool has_column,
                   const std::function<OnsetMotion(double, std::size_t)>& motion)
{
    double n = 0, y = 0, z = 0, yy = 0, yz = 0, zz = 0;
    OnsetTry tried;
    for (std::size_t i = from; i < to; ++i) {
        if (!std::isfinite(data.values[i]))
            continue;
        const OnsetMotion m = static_cast<double>(i) > start ? motion(start, i) : OnsetMotion{};
        const double value = data.values[i] - m.fixed;
        n += 1;
        y += value;
        yy += value * value;
        z += m.column;
        zz += m.column * m.column;
        yz += value * m.column;
    }
    tried.count = static_cast<std::size_t>(n);
    const double variance = yy - y * y / n, across = yz - y * z / n, spread = zz - z * z / n;
    tried.left = variance;
    if (has_column && spread > 0) {
        tried.coefficient = across / spread;
        tried.coefficient_sd = data.sd / std::sqrt(spread);
        tried.left -= across * across / spread;
    }
    return tried;
}

/// The place of the least of `count` values that vary smoothly: of some of them first, then of all around the least of
/// these. At full scale there are a thousand starts, each with a sum over thousands of samples.
template <class Value>
std::size_t least_of(std::size_t count, const Value& value)
{
    constexpr std::size_t some = 64;
    const std::size_t stride = std::max<std::size_t>(1, count / some);
    const auto least = [&](std::size_t from, std::size_t to, std::size_t by) {
        std::size_t best = from;
        for (std::size_t k = from; k < to; k += by)
            if (value(k) < value(best))
                best = k;
        return best;
    };
    const std::size_t near = least(0, count, stride);
    return least(near > stride ? near - stride : 0, std::min(count, near + stride + 1), 1);
}

} // namespace

OnsetData BoardRun::data_of(std::span<const double> values, double sd) const
{
    const double times = seen.body.time_ratio, rate_hz = seen.run->rate_hz;
    return {values, seen.step_s(), sd, static_cast<std::size_t>(window_s * times * rate_hz),
            static_cast<std::size_t>(before_s * times * rate_hz)};
}

std::optional<BoardRun> board_run(const Specimen& specimen, const MeasuredRun& run)
{
    std::optional<JointRun> seen = joint_run(specimen, run, true);
    if (!seen || run.base_tilt_rad.values.size() != run.time_s.size())
        return std::nullopt;
    BoardRun board{std::move(*seen), 0, run.base_tilt_rad.values,
                   run.base_tilt_rad.noise_sd.value_or(noise_of(run.base_tilt_rad.values))};
    board.side = finite_mean(board.tilt, board.tilt.size() / 2, board.tilt.size()).first > 0 ? -1 : 1;
    for (double& t : board.tilt)
        t *= -board.side;
    return board;
}

std::optional<std::size_t> first_motion(const OnsetData& data)
{
    const std::size_t w = data.window, n = data.values.size();
    const double limit = clear_mean * data.sd / std::sqrt(static_cast<double>(w));
    const auto clear = [&](std::size_t i) {
        const auto [mean, count] = finite_mean(data.values, i, i + w);
        return 2 * static_cast<std::size_t>(count) > w && mean > limit;
    };
    for (std::size_t i = 0; i + 2 * w <= n; ++i)
        if (clear(i) && clear(i + w)) {
            const auto [mean, count] = finite_mean(data.values, 0, i);
            return i > 0 && 2 * static_cast<std::size_t>(count) > i ? std::optional(i + w / 2) : std::nullopt;
        }
    return std::nullopt;
}

std::optional<OnsetFit> fit_onset(const OnsetData& data, std::size_t moved, double most, bool has_column,
                                  const std::function<OnsetMotion(double, std::size_t)>& motion)
{
    constexpr std::size_t fewest = 15;
    const std::size_t from = moved > 2 * data.before ? moved - 2 * data.before : 0;
    const std::size_t until = std::min(data.values.size(), moved + 3 * data.before);
    std::size_t to = moved;
    while (to < until && !(data.values[to] > most))
        ++to;
    if ((to == until && until < data.values.size()) || to < moved + fewest || moved < from + data.before / 2)
        return std::nullopt;
    const std::size_t earliest = moved > data.before ? moved - data.before : 0;
    const std::size_t latest = std::min(moved + data.window / 2, to); // the mean of a window moves before its middle
    std::vector<double> tried(latest - earliest + 1, not_tried);
    const auto left = [&](std::size_t k) {
        if (std::isnan(tried[k]))
            tried[k] = try_start(data, static_cast<double>(earliest + k), from, to, has_column, motion).left;
        return tried[k];
    };
    const std::size_t best = least_of(tried.size(), left);
    if (best == 0 || best + 1 >= tried.size())
        return std::nullopt;
    // a parabola wide enough that the sum of squares has grown by a few of the noise's
    const auto widths = std::views::iota(std::size_t{1}, std::min(best, tried.size() - 1 - best));
    const auto grown = std::ranges::partition_point(widths, [&](std::size_t w) {
        return left(best - w) + left(best + w) - 2 * left(best) < 8 * data.sd * data.sd;
    });
    const auto wide = static_cast<std::size_t>(grown - widths.begin()) + 1;
    const double w = static_cast<double>(wide);
    const double bend =
        (left(best - wide) - 2 * left(best) + left(best + wide)) / (2 * w * w); // of the squared distance
    if (!(bend > 0))
        return std::nullopt;
    OnsetFit fit;
    const double aside = (left(best - wide) - left(best + wide)) / (4 * bend * w);
    fit.start = static_cast<double>(earliest + best) + std::clamp(aside, -w, w);
    const OnsetTry at = try_start(data, fit.start, from, to, has_column, motion);
    const double later = try_start(data, fit.start + 1, from, to, has_column, motion).coefficient;
    fit.scatter = std::sqrt(at.left / static_cast<double>(at.count)) / data.sd;
    fit.start_sd = std::max(1.0, fit.scatter) * data.sd / std::sqrt(bend);
    fit.coefficient = at.coefficient;
    fit.coefficient_sd = std::max(1.0, fit.scatter) * at.coefficient_sd;
    fit.per_start = later - at.coefficient;
    return fit;
}

std::optional<TiltAt> tilt_at(std::span<const double> tilt, double at, std::size_t reach, double noise)
{
    std::vector<double> x, y;
    const auto middle = static_cast<std::size_t>(at);
    for (std::size_t i = middle > reach ? middle - reach : 0; i < std::min(tilt.size(), middle + reach + 1); ++i) {
        x.push_back(static_cast<double>(i) - at);
        y.push_back(tilt[i]);
    }
    const LineFit line = line_fit(x, y);
    if (line.count < 10)
        return std::nullopt;
    return TiltAt{line.at_zero, line.at_zero_sd * noise, line.slope};
}

} // namespace stylobate

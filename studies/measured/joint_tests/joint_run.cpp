#include "studies/measured/joint_tests/joint_run.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

constexpr double start_s = 0.75 * test_start_s; // in which nothing moves yet

std::vector<double> column(const Series& series, std::size_t samples, int block, int blocks)
{
    std::vector<double> values(samples, std::numeric_limits<double>::quiet_NaN());
    const auto width = static_cast<std::size_t>(blocks), b = static_cast<std::size_t>(block);
    if (series.values.size() == samples * width)
        for (std::size_t i = 0; i < samples; ++i)
            values[i] = series.values[i * width + b];
    return values;
}

bool any_finite(std::span<const double> values)
{
    return std::ranges::any_of(values, [](double v) { return std::isfinite(v); });
}

double stated_noise(const Series& series, std::span<const double> values)
{
    return series.noise_sd ? *series.noise_sd : noise_of(values);
}

/// The body's surroundings: the block below, or the table where the lowest block stands on it.
void set_below(const Specimen& specimen, const MeasuredRun& run, JointRun& of)
{
    const std::size_t n = run.time_s.size();
    if (of.body.lower >= 0) {
        of.below_m = column(run.blocks.x_m, n, of.body.lower, specimen.blocks());
        of.below_rad = column(run.blocks.theta_rad, n, of.body.lower, specimen.blocks());
        of.below_sd = of.x_sd;
        of.below_rad_sd = of.theta_sd;
    }
    const bool seen = of.body.lower >= 0 ? any_finite(of.below_m) : run.table.x_m.values.size() == n;
    if (of.body.lower < 0 && seen) {
        of.below_m = run.table.x_m.values;
        of.below_sd = stated_noise(run.table.x_m, of.below_m);
    }
    if (!seen) {
        of.below_m = of.base_m;
        of.below_sd = run.base_displacement_m.noise_sd.value_or(0);
    }
    if (of.body.lower < 0 && run.table.theta_rad.values.size() == n) {
        of.below_rad = run.table.theta_rad.values;
        of.below_rad_sd = stated_noise(run.table.theta_rad, of.below_rad);
    }
    if (!any_finite(of.below_rad)) {
        of.below_rad.assign(n, 0.0);
        of.below_rad_sd = 0;
    }
    const auto [u, l] = std::pair(static_cast<std::size_t>(of.body.upper), static_cast<std::size_t>(of.body.lower));
    const auto early = static_cast<std::size_t>(std::max(start_s * run.rate_hz, 4.0));
    std::vector<double> slip(n), turn(n);
    for (std::size_t i = 0; i < n; ++i) {
        slip[i] = of.x_m[i] - of.below_m[i];
        turn[i] = of.theta_rad[i] - of.below_rad[i];
    }
    const auto [slip_zero, count] = finite_mean(slip, 0, early);
    of.slip_zero_m = slip_zero;
    of.turn_zero_rad = finite_mean(turn, 0, early).first;
    const double planned = specimen.rest_x_m[u] - (of.body.lower >= 0 ? specimen.rest_x_m[l] : 0);
    of.offset_m = seen && count > 0 ? slip_zero - planned : 0;
    of.offset_sd_m = seen && count > 0 ? of.slip_sd() / std::sqrt(count) : specimen.placement_tolerance_m;
}

} // namespace

double JointRun::slip_sd() const
{
    return std::hypot(x_sd, below_sd);
}

double JointRun::turn_sd() const
{
    return std::hypot(theta_sd, below_rad_sd);
}

std::pair<double, double> JointRun::bearing_m(const Specimen& specimen) const
{
    const double below = body.lower >= 0
                             ? specimen.half_width_m[static_cast<std::size_t>(body.lower)]
                             : specimen.base_block_half_width_m.value_or(std::numeric_limits<double>::infinity());
    return {std::min(half_width_m, below + offset_m), std::min(half_width_m, below - offset_m)};
}

std::optional<JointRun> joint_run(const Specimen& specimen, const MeasuredRun& run, bool may_fall)
{
    const std::size_t n = run.time_s.size();
    if (!run.joint || n < 10 || run.rate_hz <= 0 || run.blocks.empty())
        return std::nullopt;
    if (run.collapsed.value_or(false) && !run.fell_at_s() && !may_fall)
        return std::nullopt;
    JointRun of;
    of.run = &run;
    of.body = tested_body(specimen, *run.joint, run.dummies);
    of.weight_n = of.body.mass_kg * specimen.gravity_m_s2;
    of.half_width_m = specimen.half_width_m[static_cast<std::size_t>(of.body.upper)];
    of.x_m = column(run.blocks.x_m, n, of.body.upper, specimen.blocks());
    of.y_m = column(run.blocks.y_m, n, of.body.upper, specimen.blocks());
    of.theta_rad = column(run.blocks.theta_rad, n, of.body.upper, specimen.blocks());
    if (!any_finite(of.x_m) || !any_finite(of.y_m) || !any_finite(of.theta_rad))
        return std::nullopt;
    of.x_sd = stated_noise(run.blocks.x_m, of.x_m);
    of.y_sd = stated_noise(run.blocks.y_m, of.y_m);
    of.theta_sd = stated_noise(run.blocks.theta_rad, of.theta_rad);
    of.base_m = run.base_displacement_m.values;
    if (of.base_m.size() != n)
        of.base_m = run.table.x_m.values.size() == n ? run.table.x_m.values : std::vector<double>(n, 0.0);
    if (run.base_displacement_m.noise_sd.value_or(0) > 0) // measured: its speed is needed too
        of.base_m = smoothed(of.base_m, 7);
    const double zero = finite_mean(of.base_m, 0, static_cast<std::size_t>(std::max(start_s * run.rate_hz, 4.0))).first;
    for (double& x : of.base_m)
        x -= zero; // a sensor's is not known
    of.samples = n;
    if (const auto fell = run.fell_at_s())
        of.samples = static_cast<std::size_t>(std::ranges::lower_bound(run.time_s, *fell) - run.time_s.begin());
    set_below(specimen, run, of);
    return of;
}

double noise_of(std::span<const double> values)
{
    std::vector<double> bends;
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
        if (const double bend = std::fabs(values[i + 1] - 2 * values[i] + values[i - 1]); std::isfinite(bend))
            bends.push_back(bend);
    constexpr double median_of_normal = 0.67449, bend_variance = 6; // of 1, -2, 1
    return bends.empty() ? 0 : upper_median(std::move(bends)) / (median_of_normal * std::sqrt(bend_variance));
}

std::vector<double> smoothed(std::span<const double> values, int m)
{
    std::vector<double> smooth(values.begin(), values.end());
    const double whole = (2.0 * m - 1) * (2.0 * m + 1) * (2.0 * m + 3);
    const auto reach = static_cast<std::size_t>(m);
    for (std::size_t i = reach; i + reach < values.size(); ++i) {
        smooth[i] = 0;
        for (int j = -m; j <= m; ++j)
            smooth[i] += 3 * (3.0 * m * (m + 1) - 1 - 5.0 * j * j) / whole *
                         values[static_cast<std::size_t>(static_cast<long>(i) + j)];
    }
    return smooth;
}

std::vector<std::size_t> turning_points(std::span<const double> values, double least)
{
    std::vector<std::size_t> turns;
    std::size_t low = 0, high = 0;
    int going = 0; // +1 up
    for (std::size_t i = 1; i < values.size(); ++i) {
        if (!std::isfinite(values[i]))
            continue;
        low = values[i] < values[low] ? i : low;
        high = values[i] > values[high] ? i : high;
        if (going >= 0 && values[high] - values[i] > least) {
            if (going > 0)
                turns.push_back(high);
            going = -1;
            low = i;
        } else if (going <= 0 && values[i] - values[low] > least) {
            if (going < 0)
                turns.push_back(low);
            going = 1;
            high = i;
        }
    }
    return turns;
}

std::pair<double, int> finite_mean(std::span<const double> values, std::size_t from, std::size_t to)
{
    double sum = 0;
    int count = 0;
    for (std::size_t i = from; i < std::min(to, values.size()); ++i)
        if (std::isfinite(values[i])) {
            sum += values[i];
            ++count;
        }
    return {count > 0 ? sum / count : 0, count};
}

LineFit line_fit(std::span<const double> x, std::span<const double> values, std::span<const double> weights)
{
    double w = 0, wx = 0, wv = 0;
    LineFit fit;
    const auto weight = [&](std::size_t i) {
        return std::isfinite(x[i]) && std::isfinite(values[i]) ? (weights.empty() ? 1.0 : weights[i]) : 0.0;
    };
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const double of = weight(i); of > 0) {
            w += of;
            wx += of * x[i];
            wv += of * values[i];
            ++fit.count;
        }
    if (fit.count < 3)
        return fit;
    const double middle = wx / w, mean = wv / w;
    double xx = 0, xv = 0, mean_variance = 0, slope_variance = 0, both = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const double of = weight(i); of > 0) {
            const double away = x[i] - middle;
            xx += of * away * away;
            xv += of * away * (values[i] - mean);
            mean_variance += of * of / (w * w);
            slope_variance += of * of * away * away;
            both += of * of * away / w;
        }
    if (!(xx > 0)) {
        fit.count = 0;
        return fit;
    }
    fit.slope = xv / xx;
    fit.at_zero = mean - fit.slope * middle;
    fit.slope_sd = std::sqrt(slope_variance) / xx;
    fit.at_zero_sd = std::sqrt(
        std::max(0.0, mean_variance + middle * middle * fit.slope_sd * fit.slope_sd - 2 * middle * both / xx));
    return fit;
}

} // namespace stylobate

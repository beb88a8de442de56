#include "ensemble/tracking/tracking_targets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stylobate {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
// Before the base has this part of its largest acceleration a structure stands as it was put.
constexpr double quiet_part = 0.1;
// A specimen in fall is not tracked from this long before its collapse was noted, in windows.
constexpr std::size_t fewest_samples = 10;

/// Displacement of the base at the run's samples, on the cubic that belongs to a linear acceleration.
double base_displacement(const Motion& base, double time_s)
{
    const double position = std::clamp(time_s / base.dt_s, 0.0, static_cast<double>(base.acceleration_m_s2.size() - 1));
    const auto i = static_cast<std::size_t>(position);
    const double t = (position - static_cast<double>(i)) * base.dt_s;
    const double a0 = base.acceleration_m_s2[i];
    const double a1 = i + 1 < base.acceleration_m_s2.size() ? base.acceleration_m_s2[i + 1] : a0;
    return base.displacement_m[i] + t * (base.velocity_m_s[i] + t * (a0 / 2 + t / base.dt_s * (a1 - a0) / 6));
}

/// Noise of samples that were taken of a smooth motion: second differences of it are nothing but noise.
double noise_of(const std::vector<double>& values, std::size_t blocks, std::size_t rows)
{
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = blocks; k + blocks < rows * blocks; ++k) {
        const double second = values[k - blocks] - 2 * values[k] + values[k + blocks];
        if (std::isfinite(second)) {
            sum += second * second / 6;
            ++count;
        }
    }
    return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : unknown;
}

/// Least squares of a parabola over the samples within the half width, at every sample: its value and slope there.
void smooth(const std::vector<double>& time, const std::vector<double>& values, std::size_t blocks, double half_width,
            std::vector<double>& value, std::vector<double>& slope)
{
    const std::size_t n = time.size();
    value.assign(values.size(), unknown);
    slope.assign(values.size(), unknown);
    for (std::size_t b = 0; b < blocks; ++b) {
        std::size_t first = 0, last = 0;
        for (std::size_t k = 0; k < n; ++k) {
            while (time[first] < time[k] - half_width)
                ++first;
            while (last < n && time[last] <= time[k] + half_width)
                ++last;
            // moments about the sample, in half widths
            double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, q0 = 0, q1 = 0, q2 = 0;
            for (std::size_t i = first; i < last; ++i) {
                const double q = values[i * blocks + b];
                if (!std::isfinite(q))
                    continue;
                const double t = (time[i] - time[k]) / half_width, t2 = t * t;
                s0 += 1, s1 += t, s2 += t2, s3 += t2 * t, s4 += t2 * t2;
                q0 += q, q1 += q * t, q2 += q * t2;
            }
            if (s0 < 5 || !std::isfinite(values[k * blocks + b]))
                continue;
            const double d = s0 * (s2 * s4 - s3 * s3) - s1 * (s1 * s4 - s3 * s2) + s2 * (s1 * s3 - s2 * s2);
            if (!(d > 1e-9 * s0 * s0 * s0))
                continue;
            value[k * blocks + b] =
                (q0 * (s2 * s4 - s3 * s3) - s1 * (q1 * s4 - s3 * q2) + s2 * (q1 * s3 - s2 * q2)) / d;
            slope[k * blocks + b] =
                (s0 * (q1 * s4 - s3 * q2) - q0 * (s1 * s4 - s3 * s2) + s2 * (s1 * q2 - q1 * s2)) / d / half_width;
        }
    }
}

} // namespace

TrackingScales tracking_scales(double size_m, double gravity_m_s2)
{
    const double time = std::sqrt(size_m / gravity_m_s2) / std::sqrt(0.048 / 9.81); // 1 for drums of 48 mm
    return {0.008 * time, 60 / std::pow(time, 0.53), 0.2 * time, 0.02 * time};
}

SeenRun seen_run(const MeasuredRun& run, const Motion& base, const std::vector<int>& order,
                 const std::vector<double>& plan_x_m, double smoothing_s)
{
    SeenRun seen;
    const std::size_t n = run.time_s.size(), blocks = plan_x_m.size();
    if (run.blocks.x_m.empty() || run.blocks.theta_rad.empty() || n < fewest_samples || base.empty())
        return seen;
    seen.blocks = blocks;
    double peak = 0;
    for (const double a : base.acceleration_m_s2)
        peak = std::max(peak, std::fabs(a));
    std::size_t quiet = 0;
    while (quiet < base.acceleration_m_s2.size() && std::fabs(base.acceleration_m_s2[quiet]) < quiet_part * peak)
        ++quiet;
    seen.quiet_s = static_cast<double>(quiet) * base.dt_s;
    for (const double t : run.time_s) {
        seen.time_s.push_back(t - run.time_s.front());
        seen.base_m.push_back(base_displacement(base, seen.time_s.back()));
    }
    seen.end_s = seen.time_s.back();
    if (const auto fell_s = run.fell_at_s())
        seen.end_s = std::min(seen.end_s, *fell_s - run.time_s.front());

    // in the frame of the base, from where each block stood on the average of the quiet samples
    const std::array<const Series*, coordinate_count> series = {&run.blocks.x_m, &run.blocks.y_m,
                                                                &run.blocks.theta_rad};
    const std::size_t measured = order.size();
    seen.standing_x_m.assign(blocks, unknown);
    for (std::size_t c = 0; c < coordinate_count; ++c) {
        std::vector<double>& q = seen.seen[c];
        q.assign(n * blocks, unknown);
        if (series[c]->empty())
            continue;
        for (std::size_t b = 0; b < measured; ++b) {
            const auto to = static_cast<std::size_t>(order[b]);
            double sum = 0;
            std::size_t count = 0;
            for (std::size_t k = 0; k < n; ++k) {
                double value = series[c]->values[k * measured + b];
                if (c == static_cast<std::size_t>(BlockCoordinate::x))
                    value -= seen.base_m[k];
                q[k * blocks + to] = value;
                if (std::isfinite(value) && (seen.time_s[k] < seen.quiet_s || count < fewest_samples)) {
                    sum += value;
                    ++count;
                }
            }
            if (count == 0 || c == static_cast<std::size_t>(BlockCoordinate::theta))
                continue; // rotations are what they are
            const double stood = sum / static_cast<double>(count);
            for (std::size_t k = 0; k < n; ++k)
                q[k * blocks + to] -= stood;
            if (c == static_cast<std::size_t>(BlockCoordinate::x))
                seen.standing_x_m[to] = stood - plan_x_m[to];
        }
        seen.noise_sd[c] = series[c]->noise_sd.value_or(noise_of(q, blocks, n));
        smooth(seen.time_s, q, blocks, smoothing_s, seen.smooth[c], seen.rate[c]);
    }
    return seen;
}

Targets targets_of(const SeenRun& run)
{
    Targets targets;
    const std::size_t n = run.time_s.size(), blocks = run.blocks;
    targets.blocks = blocks;
    targets.start_s = run.time_s.front();
    targets.spacing_s = (run.time_s.back() - run.time_s.front()) / static_cast<double>(n - 1);
    std::size_t i = 0; // the sample at or before the target
    for (std::size_t k = 0; k < n; ++k) {
        const double t = targets.start_s + static_cast<double>(k) * targets.spacing_s;
        while (i + 2 < n && run.time_s[i + 1] <= t)
            ++i;
        const double d = run.time_s[i + 1] - run.time_s[i];
        const double s = std::clamp((t - run.time_s[i]) / d, 0.0, 1.0);
        const bool gap = d > 3 * targets.spacing_s; // samples were lost
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::size_t m = i * blocks + b;
            const auto line = [&](const std::vector<double>& q) {
                // at a sample its neighbour does not count, known or not
                return gap ? unknown : s <= 0 ? q[m] : s >= 1 ? q[m + blocks] : (1 - s) * q[m] + s * q[m + blocks];
            };
            targets.x_m.push_back(line(run.smooth[0]));
            targets.velocity_m_s.push_back(line(run.rate[0]));
            targets.theta_rad.push_back(line(run.smooth[2]));
            targets.rotation_rad_s.push_back(line(run.rate[2]));
        }
    }
    return targets;
}

std::optional<SeenWindow> window_at(const SeenRun& run, double start_s, double length_s)
{
    const auto row_at = [&](double t) {
        const auto after = std::lower_bound(run.time_s.begin(), run.time_s.end(), t);
        auto row = static_cast<std::size_t>(after - run.time_s.begin());
        if (row > 0 && (row == run.time_s.size() || t - run.time_s[row - 1] < run.time_s[row] - t))
            --row;
        return row;
    };
    SeenWindow w;
    w.window.start_s = start_s;
    for (const double part : {0.5, 1.0}) {
        w.rows.push_back(row_at(start_s + part * length_s));
        w.window.times_s.push_back(run.time_s[w.rows.back()]);
    }
    if (w.window.times_s[0] > start_s && w.rows[0] < w.rows[1])
        return w;
    return std::nullopt;
}

std::vector<SeenWindow> windows_of(const SeenRun& run, double length_s)
{
    std::vector<SeenWindow> windows;
    // (to half a sample, so that rounding does not cost the last one)
    const double slack = 0.5 * (run.time_s.back() - run.time_s.front()) / static_cast<double>(run.time_s.size());
    for (double start = std::max(run.quiet_s, run.time_s.front()); start + length_s <= run.end_s + slack;
         start += length_s)
        if (std::optional<SeenWindow> window = window_at(run, start, length_s))
            windows.push_back(std::move(*window));
    return windows;
}

} // namespace stylobate

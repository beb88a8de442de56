#include "studies/measured/diagnosis/evidence/ride.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace stylobate {

namespace {

// A block rides on the table while what accelerates it is below this part of what makes it slip or rock.
constexpr double rides_below = 0.6;
// Samples from whose median the angle at rest is taken.
constexpr std::size_t first_angles = 40;

std::vector<std::pair<std::size_t, std::size_t>> stretches(const std::vector<char>& good, std::size_t least)
{
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    for (std::size_t i = 0; i < good.size();) {
        std::size_t k = i;
        while (k < good.size() && good[k])
            ++k;
        if (k - i >= least)
            parts.emplace_back(i, k);
        i = std::max(k, i + 1);
    }
    return parts;
}

/// Acceleration of the base [m/s2] below which the lowest block rides on it.
double riding_limit(const Specimen& s, std::size_t lowest)
{
    double half_width = std::numeric_limits<double>::infinity(), top = 0;
    const double bottom = s.rest_y_m[lowest] - s.half_height_m[lowest];
    for (std::size_t i = 0; i < s.rest_y_m.size(); ++i) {
        half_width = std::min(half_width, s.half_width_m[i]);
        top = std::max(top, s.rest_y_m[i] + s.half_height_m[i]);
    }
    return rides_below * s.gravity_m_s2 * std::min(s.friction_nominal.value_or(0.5), 2 * half_width / (top - bottom));
}

/// What is seen of a run, at the spacing of the scales; without the parts in which it rides.
/// @param block the lowest one; the table is taken instead where the cameras see it
Ride seen_ride(const MeasuredRun& run, std::size_t index, const Specimen& s, bool table, std::size_t block,
               const CampaignScales& scales)
{
    const SeenMotion& seen = table ? run.table : run.blocks;
    const double dt = scales.spacing_s;
    const std::size_t stride = table ? 1 : static_cast<std::size_t>(s.blocks());
    const std::size_t column = table ? 0 : block;
    const auto n = static_cast<std::size_t>(std::floor((run.time_s.back() - run.time_s.front()) / dt + 1e-6)) + 1;
    const auto sample = [&](const Series& series) {
        return series.empty() ? std::vector<double>()
                              : resampled(run.time_s, series.values.data() + column, stride, run.time_s.front(), dt, n);
    };
    Ride ride;
    ride.run = index;
    const std::vector<double> u = base_displacement(run);
    ride.base = resampled(run.time_s, u.data(), 1, run.time_s.front(), dt, n);
    ride.rate = scales.rates.apply(1, ride.base);
    ride.acceleration = scales.widths.back().apply(2, ride.base);
    ride.x = sample(seen.x_m);
    ride.y = sample(seen.y_m);
    ride.theta = sample(seen.theta_rad);
    ride.noise_x = seen.x_m.noise_sd.value_or(scales.noise_m);
    ride.noise_y = seen.y_m.noise_sd.value_or(scales.noise_m);
    ride.noise_theta = seen.theta_rad.noise_sd.value_or(scales.noise_rad);
    ride.foot = ride.x;
    ride.noise_foot = ride.noise_x;
    ride.foot_height_m = table ? 0 : s.rest_y_m[block];
    if (!table && !ride.theta.empty()) {
        for (std::size_t i = 0; i < n; ++i)
            ride.foot[i] += s.half_height_m[block] * std::sin(ride.theta[i]);
        ride.noise_foot = std::hypot(ride.noise_x, s.half_height_m[block] * ride.noise_theta);
        ride.foot_height_m -= s.half_height_m[block];
    }
    ride.harmonic = run.kind == "harmonic";
    ride.find_peak();
    return ride;
}

/// (samples) whether the base and what is seen are known there, and a block neither slips nor rocks.
/// @param limit acceleration below which a block rides [m/s2]
std::vector<char> riding(const Ride& ride, bool table, double limit, const CampaignScales& scales)
{
    const LocalCubic& wide = scales.widths.back();
    const std::size_t n = ride.base.size();
    const auto margin = static_cast<std::size_t>(wide.half_width());
    const std::vector<double> leaned = filled(ride.theta);
    const std::vector<double> pushed = wide.apply(2, filled(ride.x)), angle = scales.rates.apply(0, leaned);
    const double rest_angle = rest_angle_of(leaned);
    std::vector<char> good(n, 0);
    for (std::size_t i = margin; i + margin < n; ++i) {
        const bool there = std::isfinite(ride.x[i]) && std::isfinite(ride.base[i]);
        const bool still =
            table ||
            (std::fabs(pushed[i]) < limit &&
             (leaned.empty() || std::fabs(angle[i] - rest_angle) <
                                    std::max(scales.rotation_rad / 3, 4 * ride.noise_theta * scales.rates.noise(0))));
        good[i] = there && still;
    }
    if (table)
        return good;
    // to a side of what moves, the smoothing has seen it
    std::vector<char> inside = good;
    for (std::size_t i = 0; i < n; ++i)
        if (!good[i])
            for (std::size_t k = i < margin ? 0 : i - margin; k < std::min(n, i + margin + 1); ++k)
                inside[k] = 0;
    return inside;
}

} // namespace

std::vector<double> filled(std::vector<double> v)
{
    for (double& x : v)
        x = std::isfinite(x) ? x : 0;
    return v;
}

double rest_angle_of(const std::vector<double>& angle)
{
    if (angle.empty())
        return 0;
    const auto first = static_cast<std::ptrdiff_t>(std::min(angle.size(), first_angles));
    return upper_median({angle.begin(), angle.begin() + first});
}

double mean_of(const std::vector<double>& v, std::size_t from, std::size_t to)
{
    return std::accumulate(v.begin() + static_cast<std::ptrdiff_t>(from), v.begin() + static_cast<std::ptrdiff_t>(to),
                           0.0) /
           static_cast<double>(to - from);
}

std::vector<int> lowest_blocks(const Specimen& s)
{
    std::vector<int> blocks;
    for (const auto& [lower, upper] : s.joints)
        if (lower < 0)
            blocks.push_back(upper);
    return blocks;
}

std::vector<double> base_displacement(const MeasuredRun& run)
{
    if (!run.base_displacement_m.empty())
        return run.base_displacement_m.values;
    const std::vector<double>& a = run.base_acceleration_m_s2.values;
    std::vector<double> u(a.size(), 0.0);
    double v = 0;
    for (std::size_t i = 1; i < a.size(); ++i) {
        const double dt = run.time_s[i] - run.time_s[i - 1];
        u[i] = u[i - 1] + v * dt + dt * dt * (a[i - 1] / 3 + a[i] / 6);
        v += dt * (a[i - 1] + a[i]) / 2;
    }
    return u;
}

Prepared prepare_rides(const Campaign& campaign, const CampaignScales& scales)
{
    const Specimen& s = campaign.specimen;
    Prepared out;
    out.table = std::any_of(campaign.runs.begin(), campaign.runs.end(),
                            [](const MeasuredRun& run) { return !run.table.x_m.empty(); });
    const int block = lowest_blocks(s).front();
    const auto lowest = static_cast<std::size_t>(block);
    out.what = out.table ? "the table" : fmt::format("block {}", block);
    const double limit = riding_limit(s, lowest);
    for (std::size_t index = 0; index < campaign.runs.size(); ++index) {
        const MeasuredRun& run = campaign.runs[index];
        const SeenMotion& seen = out.table ? run.table : run.blocks;
        if (run.time_s.size() < 2 || seen.x_m.empty() || !run.has_base())
            continue;
        Ride ride = seen_ride(run, index, s, out.table, lowest, scales);
        ride.parts = stretches(riding(ride, out.table, limit, scales), shortest_ride);
        if (!ride.parts.empty())
            out.rides.push_back(std::move(ride));
    }
    return out;
}

} // namespace stylobate

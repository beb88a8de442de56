#include "studies/measured/diagnosis/direct/vertical_test.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <numeric>

namespace stylobate {

namespace {

// More than so many standard deviations of noise is leaning.
constexpr double most_leans = 2.5;
// A block that hops is no height of the table: what is farther off counts no more, over the noise.
constexpr double most_noise = 6;
// Frequencies of lines that are sought, times the specimen's time scale; their spacing, times the longest run.
constexpr double lowest_line = 0.4, highest_line = 5, line_spacing = 0.4;
// Neighbours of a line: frequencies within this factor. They have a noise of at least this part of the cameras'.
constexpr double neighbours = 1.4, least_neighbours = 0.7;
// Two motions may share a frequency by chance.
constexpr std::size_t least_motions = 3;

/// What a block does whose smoothing saw nothing but what was seen.
std::vector<double> seen_smooth(const LocalCubic& smoothing, const std::vector<double>& series)
{
    std::vector<double> smooth = smoothing.apply(0, filled(series));
    const auto half = static_cast<std::size_t>(smoothing.half_width());
    std::size_t good = 0; // in a row
    for (std::size_t i = 0; i < series.size(); ++i) {
        good = std::isfinite(series[i]) ? good + 1 : 0;
        if (i >= half && good < 2 * half + 1)
            smooth[i - half] = std::numeric_limits<double>::quiet_NaN();
    }
    for (std::size_t i = 0; i < series.size(); ++i)
        if (i < half || i + half >= series.size())
            smooth[i] = std::numeric_limits<double>::quiet_NaN();
    return smooth;
}

/// Height of the table under the lowest corner of what is seen, against that at rest; NaN where it is not known.
std::vector<double> table_height(const Specimen& s, const MeasuredRun& run, const Ride& ride, const Prepared& prepared,
                                 const CampaignScales& scales, double pitch_rad_s2_m)
{
    std::vector<double> height = ride.y;
    const double missing = std::numeric_limits<double>::quiet_NaN();
    if (const auto fell_s = run.fell_at_s()) // what falls rests on something else
        for (std::size_t i = 0; i < height.size(); ++i)
            if (run.time_s.front() + scales.spacing_s * static_cast<double>(i) > *fell_s - scales.time_s)
                height[i] = missing;
    if (prepared.table)
        return height;
    if (ride.theta.empty()) {
        std::vector<double> riding(height.size(), missing);
        for (const auto& [from, to] : ride.parts)
            std::copy(height.begin() + static_cast<std::ptrdiff_t>(from),
                      height.begin() + static_cast<std::ptrdiff_t>(to),
                      riding.begin() + static_cast<std::ptrdiff_t>(from));
        return riding;
    }
    const auto block = static_cast<std::size_t>(lowest_blocks(s).front());
    const std::vector<double> turned = seen_smooth(scales.rates, ride.theta);
    double rest = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < turned.size() && count < shortest_ride; ++i)
        if (std::isfinite(turned[i])) {
            rest += turned[i];
            ++count;
        }
    rest /= static_cast<double>(std::max<std::size_t>(count, 1));
    for (std::size_t i = 0; i < height.size(); ++i) {
        // on a table that turns, a block is flat that turns with it
        const double open = turned[i] - rest - pitch_rad_s2_m * ride.acceleration[i];
        height[i] -= s.half_height_m[block] * std::cos(turned[i]) + s.half_width_m[block] * std::fabs(std::sin(open));
    }
    return height;
}

/// Powers and amplitudes of the lines of a series, in units of the power that noise of `noise` has in each.
struct Lines {
    std::vector<double> power, amplitude;
};

Lines lines_of(std::vector<double> series, double noise, const std::vector<double>& hz, double dt)
{
    double middle = 0;
    std::vector<double> seen;
    for (const double v : series)
        if (std::isfinite(v))
            seen.push_back(v);
    if (!seen.empty())
        middle = upper_median(std::move(seen));
    // the window begins and ends with what is seen
    std::size_t from = 0, to = series.size();
    while (from < to && !std::isfinite(series[from]))
        ++from;
    while (to > from && !std::isfinite(series[to - 1]))
        --to;
    double sum = 0, squares = 0;
    std::vector<double> window;
    for (std::size_t i = from; i < to; ++i) {
        const double phase = (static_cast<double>(i - from) + 0.5) / static_cast<double>(to - from);
        const double w = std::isfinite(series[i]) ? std::pow(std::sin(std::numbers::pi * phase), 2) : 0;
        window.push_back(w);
        sum += w;
        squares += w * w;
        series[i] = w > 0 ? w * std::clamp(series[i] - middle, -most_noise * noise, most_noise * noise) : 0;
    }
    Lines lines;
    const double mean = sum > 0 ? std::accumulate(series.begin() + static_cast<std::ptrdiff_t>(from),
                                                  series.begin() + static_cast<std::ptrdiff_t>(to), 0.0) /
                                      sum
                                : 0;
    for (const double f : hz) {
        const std::complex<double> turn = std::polar(1.0, -2 * std::numbers::pi * f * dt);
        std::complex<double> at = 1, total = 0;
        for (std::size_t i = from; i < to; ++i, at *= turn)
            total += at * (series[i] - mean * window[i - from]);
        lines.power.push_back(squares > 0 ? std::norm(total) / (squares * noise * noise) : 0);
        lines.amplitude.push_back(sum > 0 ? 2 * std::abs(total) / sum : 0);
    }
    return lines;
}

/// The line that stands out of most motions.
void find_line(const Campaign& campaign, const std::vector<Ride>& rides, const CampaignScales& scales,
               VerticalMotion& out)
{
    double longest = 0;
    for (const Ride& ride : rides)
        longest = std::max(longest, scales.spacing_s * static_cast<double>(ride.y.size()));
    std::vector<double> hz;
    const double highest = std::min(highest_line / scales.time_s, 0.4 / scales.spacing_s);
    for (double f = lowest_line / scales.time_s; f < highest; f += line_spacing / longest)
        hz.push_back(f);
    // repeats of a motion have the harmonics of that motion: they count as one
    std::map<int, std::vector<Lines>> by_motion;
    for (const Ride& ride : rides) {
        std::vector<double> left = ride.y;
        for (std::size_t i = 0; i < left.size(); ++i)
            left[i] -= out.ratio * ride.base[i];
        by_motion[campaign.runs[ride.run].motion_id].push_back(
            lines_of(std::move(left), ride.noise_y, hz, scales.spacing_s));
    }
    if (by_motion.size() < least_motions)
        return;
    std::vector<std::vector<double>> stands_out; // (motions)(hz)
    for (const auto& [motion, repeats] : by_motion) {
        std::vector<double> power(hz.size(), 0);
        for (const Lines& lines : repeats)
            for (std::size_t k = 0; k < hz.size(); ++k)
                power[k] += lines.power[k] / static_cast<double>(repeats.size());
        std::vector<double> over;
        std::size_t from = 0, to = 0;
        for (std::size_t k = 0; k < hz.size(); ++k) {
            while (hz[from] < hz[k] / neighbours)
                ++from;
            while (to < hz.size() && hz[to] < hz[k] * neighbours)
                ++to;
            const double around = upper_median(
                {power.begin() + static_cast<std::ptrdiff_t>(from), power.begin() + static_cast<std::ptrdiff_t>(to)});
            over.push_back(power[k] / std::max(around, least_neighbours));
        }
        stands_out.push_back(std::move(over));
    }
    std::size_t best = 0;
    for (std::size_t k = 0; k < hz.size(); ++k) {
        std::vector<double> all;
        for (const auto& motion : stands_out)
            all.push_back(motion[k]);
        std::sort(all.begin(), all.end());
        const double quartile = all[(all.size() - 1) / 4];
        if (quartile > out.line) {
            out.line = quartile;
            best = k;
        }
    }
    out.line_hz = hz[best];
    const double per = std::pow(2 * std::numbers::pi * hz[best], 2);
    double sum = 0, squares = 0, count = 0;
    for (const auto& [motion, repeats] : by_motion)
        for (const Lines& lines : repeats) {
            const double a = per * lines.amplitude[best];
            sum += a;
            squares += a * a;
            ++count;
        }
    out.line_m_s2 = sum / count;
    out.line_sd_m_s2 = std::sqrt(std::max(0.0, squares / count - out.line_m_s2 * out.line_m_s2) / (count - 1));
}

/// The common motion while everything rides.
void ride_along(const Prepared& prepared, const CampaignScales& scales, VerticalMotion& out)
{
    double square = 0, noise = 0;
    for (const Ride& ride : prepared.rides) {
        if (ride.y.empty())
            continue;
        // what was not seen spoils the smoothing of its neighbours, too
        const std::vector<double> smooth = scales.rates.apply(0, ride.y), rise = scales.widths.back().apply(2, ride.y);
        const std::vector<double> angle = scales.rates.apply(0, filled(ride.theta));
        for (const auto& [from, to] : ride.parts) {
            // a block that leans is lifted by it
            std::vector<std::size_t> upright;
            const double straight = ride.theta.empty() ? 0 : mean_of(angle, from, to);
            for (std::size_t i = from; i < to; ++i)
                if (std::isfinite(smooth[i]) &&
                    (ride.theta.empty() ||
                     std::fabs(angle[i] - straight) < most_leans * ride.noise_theta * scales.rates.noise(0)))
                    upright.push_back(i);
            double mean = 0;
            for (const std::size_t i : upright)
                mean += smooth[i] / static_cast<double>(upright.size());
            for (const std::size_t i : upright) {
                square += std::pow(smooth[i] - mean, 2);
                noise += std::pow(ride.noise_y * scales.rates.noise(0), 2);
                if (std::isfinite(rise[i]))
                    out.peak_m_s2 = std::max(out.peak_m_s2, std::fabs(rise[i]));
                ++out.samples;
            }
        }
    }
    if (out.samples > 0) {
        const auto n = static_cast<double>(out.samples);
        out.rms_over_noise = std::sqrt(std::max(0.0, square / n - noise / n)) / prepared.rides.front().noise_y;
    }
}

} // namespace

VerticalMotion vertical_motion(const Campaign& campaign, const Prepared& prepared, const CampaignScales& scales,
                               double pitch_rad_s2_m)
{
    VerticalMotion out;
    ride_along(prepared, scales, out);
    std::vector<Ride> heights; // with the table's height as y, whole runs long
    for (const Ride& ride : prepared.rides) {
        if (ride.y.empty())
            continue;
        Ride whole = ride;
        whole.y = table_height(campaign.specimen, campaign.runs[ride.run], ride, prepared, scales, pitch_rad_s2_m);
        whole.parts = {{0, whole.y.size()}};
        heights.push_back(std::move(whole));
    }
    if (out.samples == 0 || heights.empty())
        return out;
    const auto apart = static_cast<std::size_t>(scales.rates.half_width());
    std::vector<Ride> sparse = heights; // samples whose errors are their own
    for (Ride& ride : sparse) {
        const std::vector<double> smooth = seen_smooth(scales.rates, ride.y);
        for (std::size_t i = 0; i < smooth.size(); ++i)
            ride.y[i] = i % apart == 0 ? smooth[i] : std::numeric_limits<double>::quiet_NaN();
        ride.noise_y *= scales.rates.noise(0);
    }
    std::erase_if(sparse, [](const Ride& ride) {
        return std::none_of(ride.y.begin(), ride.y.end(), [](double v) { return std::isfinite(v); });
    });
    const RideFit fit = fit_over_runs(
        sparse, 1,
        [](const Ride& r, std::size_t i) {
            return std::pair{r.y[i], r.noise_y};
        },
        [](const Ride& r, std::size_t i, int) { return r.base[i]; });
    out.ratio = fit.size[0];
    out.ratio_sd = fit.sd[0];
    find_line(campaign, heights, scales, out);
    return out;
}

} // namespace stylobate

#include "studies/measured/diagnosis/direct/pitch_test.hpp"

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

// A block that leans by more than this part of what counts as open, and than its noise, does not ride.
constexpr double leans_below = 0.5, leans_noise = 6;
// Lean of the lowest block on soft beds [rad s2/m], 1 sigma: healthy campaigns show up to 1.7e-4.
constexpr double most_softness = 1.5e-4;

/// A sample of a series that this run may lack: then NaN.
double sample_of(const std::vector<double>& series, std::size_t i)
{
    return series.empty() ? std::numeric_limits<double>::quiet_NaN() : series[i];
}

/// Rotations of the blocks of a run, [block][sample]; NaN where a block or one below it has left its bed.
using Rotations = std::vector<std::vector<double>>;

Rotations rotations_of(const MeasuredRun& run, int blocks, const CampaignScales& scales, std::size_t samples)
{
    const double noise = run.blocks.theta_rad.noise_sd.value_or(scales.noise_rad) * scales.rates.noise(0);
    const double most = std::max(leans_below * scales.rotation_rad, leans_noise * noise);
    Rotations out;
    if (run.blocks.theta_rad.empty())
        return Rotations(static_cast<std::size_t>(blocks),
                         std::vector<double>(samples, std::numeric_limits<double>::quiet_NaN()));
    std::vector<char> left(samples, 0);
    for (int b = 0; b < blocks; ++b) {
        std::vector<double> theta =
            resampled(run.time_s, run.blocks.theta_rad.values.data() + b, static_cast<std::size_t>(blocks),
                      run.time_s.front(), scales.spacing_s, samples);
        const std::vector<double> leaned = filled(theta), angle = scales.rates.apply(0, leaned);
        const double rest = rest_angle_of(leaned);
        for (std::size_t i = 0; i < samples; ++i) {
            left[i] = left[i] || std::fabs(angle[i] - rest) > most;
            if (left[i])
                theta[i] = std::numeric_limits<double>::quiet_NaN();
        }
        out.push_back(std::move(theta));
    }
    return out;
}

/// Pitch and softness from the blocks' slopes, by weighted least squares; the softness not below 0, and seldom above
/// its prior.
double pitch_of(const std::vector<double>& slope, const std::vector<double>& weight, const std::vector<double>& lean)
{
    double w = 0, wl = 0, wll = 1 / (most_softness * most_softness), ws = 0, wls = 0;
    for (std::size_t b = 0; b < slope.size(); ++b) {
        w += weight[b];
        wl += weight[b] * lean[b];
        wll += weight[b] * lean[b] * lean[b];
        ws += weight[b] * slope[b];
        wls += weight[b] * lean[b] * slope[b];
    }
    const double determinant = w * wll - wl * wl;
    const double softness = determinant > 1e-12 * w * wll ? (w * wls - wl * ws) / determinant : 0;
    return softness > 0 ? (wll * ws - wl * wls) / determinant : ws / w;
}

/// The pitch of a column, of all runs or without one of them.
class ColumnPitch {
public:
    ColumnPitch(const Campaign& campaign, const CampaignScales& scales, const Prepared& prepared)
        : prepared_(prepared), lean_(lean_of_beds(campaign.specimen))
    {
        for (const Ride& ride : prepared.rides)
            rotations_[ride.run] =
                rotations_of(campaign.runs[ride.run], campaign.specimen.blocks(), scales, ride.base.size());
    }

    PitchFit fit() const
    {
        PitchFit out{true, true, 0, std::numeric_limits<double>::infinity(), 0};
        std::vector<double> slope, weight, lean;
        std::vector<int> blocks;
        for (int b = 0; b < static_cast<int>(lean_.size()); ++b) {
            const RideFit one = slope_of(prepared_.rides, b);
            if (!std::isfinite(one.sd[0]))
                continue;
            blocks.push_back(b);
            slope.push_back(one.size[0]);
            weight.push_back(1 / (one.sd[0] * one.sd[0]));
            lean.push_back(lean_[static_cast<std::size_t>(b)]);
        }
        if (blocks.size() < 2)
            return {true, false, slope.empty() ? 0 : slope[0], out.sd, 0};
        out.slope = pitch_of(slope, weight, lean);
        out.sd = spread(slope, weight, lean, blocks);
        out.gain = 0.5 * std::pow(out.slope / out.sd, 2);
        return out;
    }

private:
    RideFit slope_of(const std::vector<Ride>& rides, int block) const
    {
        return fit_rides(
            rides, 1,
            [&](const Ride& r, std::size_t i) {
                return std::pair{rotations_.at(r.run)[static_cast<std::size_t>(block)][i], r.noise_theta};
            },
            [](const Ride& r, std::size_t i, int) { return r.acceleration[i]; });
    }

    /// By noise, and by what differs from run to run (jackknife).
    double spread(const std::vector<double>& slope, const std::vector<double>& weight, const std::vector<double>& lean,
                  const std::vector<int>& blocks) const
    {
        double noise = 0;
        for (std::size_t b = 0; b < slope.size(); ++b) {
            std::vector<double> moved = slope;
            moved[b] += 1 / std::sqrt(weight[b]);
            noise += std::pow(pitch_of(moved, weight, lean) - pitch_of(slope, weight, lean), 2);
        }
        double sum = 0, squares = 0, n = 0;
        for (const auto& [left_out, rotations] : rotations_) {
            std::vector<Ride> others;
            for (const Ride& ride : prepared_.rides)
                if (ride.run != left_out)
                    others.push_back(ride);
            std::vector<double> without;
            for (const int b : blocks)
                without.push_back(slope_of(others, b).size[0]);
            const double pitch = pitch_of(without, weight, lean);
            sum += pitch;
            squares += pitch * pitch;
            n += 1;
        }
        const double runs = n < 3 ? 0 : std::max(0.0, squares / n - std::pow(sum / n, 2)) * (n - 1);
        return std::sqrt(std::max(noise, runs));
    }

    const Prepared& prepared_;
    std::vector<double> lean_;
    std::map<std::size_t, Rotations> rotations_; ///< of each run
};

} // namespace

std::vector<double> lean_of_beds(const Specimen& s)
{
    // a single column, from bottom to top
    for (std::size_t j = 0; j < s.joints.size(); ++j)
        if (s.joints[j] != std::pair{static_cast<int>(j) - 1, static_cast<int>(j)})
            return {};
    const std::size_t n = s.joints.size();
    if (n != s.mass_kg.size())
        return {};
    std::vector<double> lean;
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
        const double bed = s.rest_y_m[j] - s.half_height_m[j];
        for (std::size_t b = j; b < n; ++b)
            sum += s.mass_kg[b] * (s.rest_y_m[b] - bed);
        lean.push_back(sum);
    }
    for (std::size_t b = n; b-- > 0;)
        lean[b] /= lean[0];
    return lean;
}

PitchFit fit_pitch(const Campaign& campaign, const CampaignScales& scales, const Prepared& prepared)
{
    PitchFit out;
    out.seen =
        std::any_of(prepared.rides.begin(), prepared.rides.end(), [](const Ride& r) { return !r.theta.empty(); });
    if (!out.seen)
        return out;
    if (!prepared.table && lean_of_beds(campaign.specimen).size() > 1)
        if (const PitchFit column = ColumnPitch(campaign, scales, prepared).fit(); column.apart)
            return column;
    const RideFit fit = fit_over_runs(
        prepared.rides, 1,
        [](const Ride& r, std::size_t i) {
            return std::pair{sample_of(r.theta, i), r.noise_theta};
        },
        [](const Ride& r, std::size_t i, int) { return r.acceleration[i]; });
    out.apart = prepared.table;
    out.slope = fit.size[0];
    out.sd = fit.sd[0];
    out.gain = fit.gain[0];
    return out;
}

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

#include "studies/measured/diagnosis/direct/pitch_test.hpp"

#include <map>

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

} // namespace stylobate

#include "studies/measured/diagnosis/direct/direct_tests.hpp"

#include "studies/measured/diagnosis/direct/pitch_test.hpp"
#include "studies/measured/diagnosis/evidence/ride.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

const std::string base_place = "base";

/// Circular frequency of a harmonic ride.
double omega_of(const Ride& ride)
{
    double u2 = 0, v2 = 0;
    const double mean = mean_of(ride.base, 0, ride.base.size());
    for (std::size_t i = 0; i < ride.base.size(); ++i) {
        u2 += std::pow(ride.base[i] - mean, 2);
        v2 += ride.rate[i] * ride.rate[i];
    }
    return u2 > 0 ? std::sqrt(v2 / u2) : 0;
}

/// Harmonic 2 or 3 of a nearly harmonic motion, of the same amplitude, in phase or in quadrature.
double harmonic_term(double u, double quadrature, int order, bool sine)
{
    const double amplitude = std::hypot(u, quadrature);
    if (amplitude < 1e-9)
        return 0;
    const double phase = std::atan2(u, quadrature); // u = A sin(phase)
    return amplitude * (sine ? std::sin(order * phase) : std::cos(order * phase));
}

int distortion_terms(bool polynomial)
{
    return polynomial ? 2 : 4;
}

/// The k-th regressor of a distortion [m]. A polynomial's are U z2 and U (z3 - 3 z / 4), z = u / U with U the run's
/// peak: of a sine those are its harmonics and nothing else but a constant.
double distortion_term(bool polynomial, const Ride& r, double omega, std::size_t i, int k)
{
    if (polynomial) {
        const double z = r.peak > 0 ? (r.base[i] - r.middle) / r.peak : 0;
        return r.peak * (k == 0 ? z * z : z * (z * z - 0.75));
    }
    return r.harmonic && omega > 0 ? harmonic_term(r.base[i] - r.middle, r.rate[i] / omega, 2 + k / 2, k % 2 == 0) : 0;
}

/// From a fit whose last regressors are the terms.
TableDistortion distortion_of(bool polynomial, double gain, const RideFit& fit)
{
    TableDistortion d;
    d.polynomial = polynomial;
    const std::size_t before = fit.size.size() - static_cast<std::size_t>(distortion_terms(polynomial));
    d.size.assign(fit.size.begin() + static_cast<std::ptrdiff_t>(before), fit.size.end());
    bool negative = false; // quadratures have no sign
    for (int order = 2; order < 4; ++order) {
        const std::size_t first = before + static_cast<std::size_t>(polynomial ? order - 2 : 2 * order - 4);
        const std::size_t last = polynomial ? first : first + 1;
        // acceleration over displacement of a harmonic, and its part of the polynomial's term
        const double per = order * order * (polynomial ? (order == 2 ? 0.5 : 0.25) : 1) / gain;
        double size = 0, sd = 0;
        for (std::size_t k = first; k <= last; ++k) {
            size = std::hypot(size, fit.size[k]);
            sd = std::max(sd, fit.sd[k]);
            d.gain += std::isfinite(fit.sd[k]) ? fit.gain[k] : 0;
        }
        if (std::isfinite(sd) && per * size > d.ratio) {
            d.order = order;
            d.ratio = per * size;
            d.sd = per * sd;
            negative = polynomial && fit.size[first] < 0;
        }
    }
    if (negative)
        d.ratio = -d.ratio;
    return d;
}

void test_height(const VerticalMotion& vertical, const std::string& what, const DirectThresholds& limits,
                 DirectResult& out)
{
    if (vertical.samples == 0) {
        out.base_tests.push_back(cannot("vertical_motion", "Heights were not measured."));
        return;
    }
    const bool follows = beyond(vertical.ratio, vertical.ratio_sd, limits.vertical_ratio, limits.sds);
    const bool rings = vertical.line > limits.vertical_line;
    const bool found = vertical.rms_over_noise > limits.vertical || follows || rings;
    std::string how;
    if (follows)
        how = fmt::format(", {:.3f} times the horizontal motion", vertical.ratio);
    else if (rings)
        how = fmt::format(", with {:.2f} Hz in all motions", vertical.line_hz);
    out.base_tests.push_back(told("vertical_motion", "base", vertical.rms_over_noise,
                                  std::numeric_limits<double>::quiet_NaN(), limits.vertical, "of the noise", found,
                                  fmt::format("{} has a vertical motion of {:.2f} times the cameras' noise (rms){}.",
                                              what, vertical.rms_over_noise, how)));
    if (!found)
        return;
    if (follows)
        out.found.push_back(cause_of("vertical_motion", "base", "ratio", "", 0, vertical.ratio, vertical.ratio_sd,
                                     0.5 * std::pow(vertical.ratio / vertical.ratio_sd, 2)));
    else if (vertical.rms_over_noise > limits.vertical) // seen as it is, of which a line may be a part
        out.found.push_back(cause_of("vertical_motion", "base", "peak_m_s2", "m/s2", 0, vertical.peak_m_s2,
                                     0.1 * vertical.peak_m_s2, 100));
    else
        out.found.push_back(cause_of("vertical_motion", "base", "peak_m_s2", "m/s2", 0, vertical.line_m_s2,
                                     vertical.line_sd_m_s2, vertical.line));
}

/// The file's base motion against what is seen: x = c + gain u + (gain x offset) u' + harmonics - height x pitch
struct BaseFit {
    double gain = 1, gain_sd = 0;
    double offset_s = 0, offset_sd = 0;
    TableDistortion distortion;
    double apart_of_noise = 0;  ///< what the fit leaves, over the cameras' noise
    double apart_of_motion = 0; ///< what the fit leaves, over the motion (rms)
};

/// Root mean square of the base motion, each ride about its own mean [m].
double rms_of(const std::vector<Ride>& rides)
{
    double sum = 0, samples = 0;
    for (const Ride& ride : rides)
        for (const auto& [from, to] : ride.parts) {
            const double mean = mean_of(ride.base, from, to);
            for (std::size_t i = from; i < to; ++i)
                sum += std::pow(ride.base[i] - mean, 2);
            samples += static_cast<double>(to - from);
        }
    return std::sqrt(sum / samples);
}

/// What rides show of the base.
class BaseRides {
public:
    /// @param pitch of the table that was found; 0: none [rad s2/m]
    BaseRides(const CampaignScales& scales, double pitch, Prepared& prepared)
        : scales_(scales), pitch_(pitch), rides_(prepared.rides)
    {
    }

    struct Distorted {
        RideFit fit;
        TableDistortion distortion;
    };
    /// Offset, gain and distortion together. Shifts the rides by the offset.
    BaseFit together();
    // of rides that are shifted, with what is left of the offset
    RideFit gain_alone() const
    {
        return fit_over_runs(
            rides_, 2, [this](const Ride& r, std::size_t i) { return seen(r, i); }, base_or_rate);
    }
    Distorted distortion_alone() const { return with_distortion(false); }

private:
    static double base_or_rate(const Ride& r, std::size_t i, int k) { return k == 0 ? r.base[i] : r.rate[i]; }
    /// Without the lean of the table; and its noise.
    std::pair<double, double> seen(const Ride& r, std::size_t i) const
    {
        const double lean = pitch_ != 0 ? -r.foot_height_m * pitch_ * r.acceleration[i] : 0;
        return {r.foot[i] - lean, r.noise_foot};
    }
    /// The distortion in either form: that which the data like better.
    /// @param gain_too the gain is fitted beside it; else it is 1
    Distorted with_distortion(bool gain_too) const;

    const CampaignScales& scales_;
    double pitch_;
    std::vector<Ride>& rides_;
};

BaseRides::Distorted BaseRides::with_distortion(bool gain_too) const
{
    const int others = gain_too ? 2 : 1; // the rate is the last of them
    const auto value = [&](const Ride& r, std::size_t i) {
        const auto [x, noise] = seen(r, i);
        return std::pair{x - (gain_too ? 0 : r.base[i]), noise};
    };
    Distorted best;
    for (const bool polynomial : {true, false}) {
        const auto column = [&](const Ride& r, std::size_t i, int k) {
            return k < others ? base_or_rate(r, i, k + 2 - others)
                              : distortion_term(polynomial, r, r.omega, i, k - others);
        };
        RideFit fit = fit_over_runs(rides_, others + distortion_terms(polynomial), value, column);
        TableDistortion found = distortion_of(polynomial, gain_too ? fit.size[0] : 1, fit);
        // beside a gain the surer one, alone the likelier one (Akaike's criterion)
        const double more_terms = distortion_terms(false) - distortion_terms(true);
        const bool likelier = fit.log_likelihood - more_terms > best.fit.log_likelihood;
        if (polynomial || (gain_too ? found.gain > best.distortion.gain : likelier))
            best = {std::move(fit), std::move(found)};
    }
    return best;
}

BaseFit BaseRides::together()
{
    BaseFit out;
    // Gain and offset alone first: harmonics are those of the base at its own time. The offset is small at last, so
    // that the linear term is all there is to it.
    for (int i = 0; i < 4; ++i) {
        const RideFit first = fit_rides(
            rides_, 2, [this](const Ride& r, std::size_t k) { return seen(r, k); }, base_or_rate);
        const double more = first.size[1] / first.size[0];
        for (Ride& ride : rides_)
            ride.shift(more, scales_);
        out.offset_s += more;
    }
    for (Ride& ride : rides_)
        ride.omega = omega_of(ride);
    const Distorted all = with_distortion(true);
    const RideFit& fit = all.fit;
    out.distortion = all.distortion;
    out.gain = fit.size[0];
    out.gain_sd = fit.sd[0];
    out.offset_sd = fit.sd[1] / out.gain;
    out.offset_s += fit.size[1] / out.gain;
    out.apart_of_noise = fit.scale;
    out.apart_of_motion = fit.scale * rides_.front().noise_foot / (std::fabs(out.gain) * rms_of(rides_));
    return out;
}

bool distorted(const TableDistortion& distortion, const DirectThresholds& limits)
{
    // what rides never reach can be fitted with anything: more than the motion itself is no distortion
    return std::fabs(distortion.ratio) < 1 && beyond(distortion.ratio, distortion.sd, limits.distortion, limits.sds);
}

/// Rides see the middle of the motion only, where a third harmonic looks like a gain: together both are known badly.
/// Where neither is found beside the other, one is taken that explains what is seen by itself and clearly better.
void take_one_alone(const BaseRides& rides, const DirectThresholds& limits, double least_gain, BaseFit& base)
{
    if (distorted(base.distortion, limits) || beyond(base.gain - 1, base.gain_sd, least_gain, limits.sds))
        return;
    const RideFit gain = rides.gain_alone();
    const BaseRides::Distorted distortion = rides.distortion_alone();
    const double nats = distortion.fit.log_likelihood - gain.log_likelihood;
    if (nats > limits.alone && distorted(distortion.distortion, limits)) {
        base.distortion = distortion.distortion;
    } else if (nats < -limits.alone && beyond(gain.size[0] - 1, gain.sd[0], least_gain, limits.sds)) {
        base.gain = gain.size[0];
        base.gain_sd = gain.sd[0];
    }
}

void judge_distortion(const TableDistortion& distortion, const DirectThresholds& limits, DirectResult& out)
{
    const bool found = distorted(distortion, limits);
    out.base_tests.push_back(told("harmonic_distortion", base_place, distortion.ratio, distortion.sd, limits.distortion,
                                  "", found,
                                  fmt::format("Harmonic {} of the table's acceleration is {:.4f} of the fundamental.",
                                              distortion.order, distortion.ratio)));
    if (found) {
        out.found.push_back(cause_of("harmonic_distortion", base_place, "ratio", "", 0, distortion.ratio, distortion.sd,
                                     distortion.gain));
        out.distortion = distortion;
    }
}

/// Of the pitch where there is none: of what was fitted, and of what healthy campaigns show.
double pitch_scatter(const PitchFit& pitch, const DirectThresholds& limits)
{
    const double healthy = (pitch.apart ? limits.pitch_apart_rad_s2_m : limits.pitch_rad_s2_m) / limits.pitch_sds;
    return std::hypot(pitch.sd, healthy);
}

void judge_pitch(const PitchFit& pitch, bool found, const std::string& what, const DirectThresholds& limits,
                 DirectResult& out)
{
    if (!pitch.seen) {
        out.base_tests.push_back(cannot("table_pitch", "Rotations were not measured."));
        return;
    }
    const double scatter = pitch_scatter(pitch, limits);
    out.base_tests.push_back(
        told("table_pitch", base_place, pitch.slope, pitch.sd, limits.pitch_sds * scatter, "rad s2/m", found,
             fmt::format("{} rotates by {:.2e} rad for each m/s2 of the base{}.", what, pitch.slope,
                         pitch.apart && what != "the table" ? ", without the lean of soft beds" : "")));
    if (found)
        out.found.push_back(cause_of("table_pitch", base_place, "rotation_rad_s2_m", "rad s2/m", 0, pitch.slope,
                                     pitch.sd, std::min(pitch.gain, 0.5 * std::pow(pitch.slope / scatter, 2))));
}

void judge_offset(const BaseFit& base, const std::string& what, double threshold_s, double sds, DirectResult& out)
{
    const bool late = beyond(base.offset_s, base.offset_sd, threshold_s, sds);
    out.base_tests.push_back(
        told("time_offset", base_place, base.offset_s, base.offset_sd, threshold_s, "s", late,
             fmt::format("{} is {:.2f} ms {} the base motion of the file.", what, 1e3 * std::fabs(base.offset_s),
                         base.offset_s < 0 ? "behind" : "ahead of")));
    if (!late)
        return;
    out.found.push_back(cause_of("time_offset", base_place, "offset_s", "s", 0, base.offset_s, base.offset_sd,
                                 0.5 * std::pow(base.offset_s / base.offset_sd, 2)));
    out.offset_s = base.offset_s;
}

void judge_gain(const BaseFit& base, const std::string& what, double threshold, double sds, DirectResult& out)
{
    const bool wrong = beyond(base.gain - 1, base.gain_sd, threshold, sds);
    out.base_tests.push_back(
        told("sensor_gain", base_place, base.gain, base.gain_sd, 1 + threshold, "", wrong,
             fmt::format("{} moves {:.4f} times as far as the base motion of the file.", what, base.gain)));
    if (!wrong)
        return;
    out.found.push_back(cause_of("sensor_gain", base_place, "gain", "", 1, base.gain, base.gain_sd,
                                 0.5 * std::pow((base.gain - 1) / base.gain_sd, 2)));
    out.gain = base.gain;
}

void cannot_test_base(const std::string& why, DirectResult& out)
{
    for (const char* name : {"harmonic_distortion", "table_pitch", "vertical_motion", "time_offset", "sensor_gain"})
        out.base_tests.push_back(cannot(name, why));
}

void test_base(const Campaign& campaign, const CampaignScales& scales, const DirectThresholds& limits,
               Prepared& prepared, DirectResult& out)
{
    std::size_t samples = 0;
    for (const Ride& ride : prepared.rides)
        for (const auto& [from, to] : ride.parts)
            samples += to - from;
    if (samples < 4 * shortest_ride) {
        cannot_test_base("No block moves with the table long enough: some tenths of a second of motion are needed "
                         "before rocking or sliding begins.",
                         out);
        return;
    }
    const PitchFit pitch = fit_pitch(campaign, scales, prepared);
    const bool pitches = pitch.seen && std::fabs(pitch.slope) > limits.pitch_sds * pitch_scatter(pitch, limits);
    const double slope = pitches ? pitch.slope : 0;
    BaseRides rides(scales, slope, prepared);
    BaseFit base = rides.together();
    if (!prepared.table && base.apart_of_noise > limits.apart_of_noise &&
        base.apart_of_motion > limits.apart_of_motion) {
        cannot_test_base(prepared.what + " slides where it should move with the table.", out);
        return;
    }
    const double narrower = prepared.table ? limits.with_table : 1;
    take_one_alone(rides, limits, narrower * limits.gain, base);
    judge_distortion(base.distortion, limits, out);
    judge_pitch(pitch, pitches, prepared.what, limits, out);
    test_height(vertical_motion(campaign, prepared, scales, slope), prepared.what, limits, out);
    judge_offset(base, prepared.what, narrower * limits.offset_s, limits.sds, out);
    judge_gain(base, prepared.what, narrower * limits.gain, limits.sds, out);
}

void correct_bases(const Campaign& campaign, const CampaignScales& scales, DirectResult& out)
{
    const bool distorted = out.distortion.ratio != 0;
    for (std::size_t r = 0; r < campaign.runs.size(); ++r) {
        const MeasuredRun& run = campaign.runs[r];
        if (out.corrected_m[r].empty() || !(out.gain != 1 || out.offset_s != 0 || distorted))
            continue;
        Ride whole;
        whole.base = out.corrected_m[r];
        whole.harmonic = run.kind == "harmonic";
        whole.shift(out.offset_s, scales);
        whole.find_peak();
        const std::vector<double>& u = whole.base;
        const double omega = omega_of(whole);
        for (std::size_t i = 0; i < u.size(); ++i) {
            double x = out.gain * u[i];
            if (distorted)
                for (int k = 0; k < distortion_terms(out.distortion.polynomial); ++k)
                    x += out.distortion.size[static_cast<std::size_t>(k)] *
                         distortion_term(out.distortion.polynomial, whole, omega, i, k);
            out.corrected_m[r][i] = x;
        }
    }
    out.base_m = out.corrected_m;
}

/// Sensors and cameras have their own zeros: the base is put where the cameras see the table at first. Where they do
/// not see it, the lowest block stands for it, up to how exactly that was put down.
void align_bases(const Campaign& campaign, DirectResult& out)
{
    const Specimen& s = campaign.specimen;
    const auto block = static_cast<std::size_t>(lowest_blocks(s).front());
    for (std::size_t r = 0; r < campaign.runs.size(); ++r) {
        const MeasuredRun& run = campaign.runs[r];
        const bool table = !run.table.x_m.empty();
        if (out.base_m[r].empty() || (!table && run.blocks.x_m.empty()))
            continue;
        double sum = 0;
        int count = 0;
        for (std::size_t i = 0; i < std::min(first_samples, out.base_m[r].size()); ++i) {
            const double seen = table ? run.table.x_m.values[i]
                                      : run.blocks.x_m.values[i * s.half_width_m.size() + block] - s.rest_x_m[block];
            if (const double apart = seen - out.base_m[r][i]; std::isfinite(apart)) {
                sum += apart;
                ++count;
            }
        }
        if (count > 0)
            for (double& x : out.base_m[r])
                x += sum / count;
    }
}

DirectResult uncorrected(const Campaign& campaign)
{
    DirectResult out;
    for (const MeasuredRun& run : campaign.runs)
        out.corrected_m.push_back(run.has_base() ? base_displacement(run) : std::vector<double>());
    out.base_m = out.corrected_m;
    return out;
}

} // namespace

DirectResult direct_tests(const Campaign& campaign, const CampaignScales& scales, const DirectThresholds& limits)
{
    DirectResult out = uncorrected(campaign);
    Prepared prepared = prepare_rides(campaign, scales);
    test_base(campaign, scales, limits, prepared, out);
    correct_bases(campaign, scales, out);
    test_rest(campaign, scales, limits, out);
    align_bases(campaign, out);
    return out;
}

DirectResult apply_corrections(const Campaign& campaign, const CampaignScales& scales, const DirectResult& shown)
{
    DirectResult out = uncorrected(campaign);
    out.found = shown.found;
    out.gain = shown.gain;
    out.offset_s = shown.offset_s;
    out.distortion = shown.distortion;
    correct_bases(campaign, scales, out);
    align_bases(campaign, out);
    return out;
}

namespace {

constexpr double least_error = 0.02; // of a size against its neutral value

} // namespace

bool beyond(double value, double sd, double threshold, double sds)
{
    return std::fabs(value) > threshold && std::fabs(value) > sds * sd;
}

DataTest told(std::string name, std::string place, double value, double sd, double threshold, std::string unit,
              bool found, const std::string& sentence)
{
    DataTest test;
    test.name = std::move(name);
    test.place = std::move(place);
    test.value = value;
    if (std::isfinite(sd))
        test.sd = sd;
    test.threshold = threshold;
    test.unit = std::move(unit);
    test.outcome = found ? TestOutcome::failed : TestOutcome::passed;
    test.sentence = sentence;
    return test;
}

double probability_of_finding(double p, double before)
{
    if (p <= 0)
        return 1;
    const double chance = p < std::exp(-1) ? -std::exp(1) * p * std::log(p) : 1;
    return before / (before + (1 - before) * chance);
}

DataTest cannot(std::string name, const std::string& why)
{
    DataTest test;
    test.name = std::move(name);
    test.place = "base";
    test.outcome = TestOutcome::not_judged;
    test.sentence = why;
    return test;
}

CauseFit cause_of(const char* mechanism, const std::string& place, const char* parameter, const char* unit,
                  double neutral, double size, double sd, double gain)
{
    CauseFit fit;
    fit.cause = {mechanism, place, parameter, unit, neutral};
    fit.size = size;
    // what the tests leave out (soft contacts, a form of distortion that is not quite theirs) is small, not nothing
    fit.sd = std::hypot(sd, least_error * (size - neutral));
    fit.gain = gain;
    return fit;
}

} // namespace stylobate

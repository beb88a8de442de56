#include "studies/diagnosis/decision/next_test.hpp"

#include "studies/diagnosis/ensemble_fit/virtual_campaign.hpp"
#include "studies/diagnosis/findings/diagnosis_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate {

namespace {

// Campaigns that are simulated with either cause.
constexpr std::uint64_t simulated = 12;
// The outcome 'collapsed' is a share: what it is known by at the least.
constexpr double collapse_noise = 0.1;

struct ProposedMotion {
    std::string text;
    double frequency_hz, amplitude_m_s2;
    int cycles;
};

/// What a run ended with, as numbers: slip of every joint, and how far every joint opened.
std::vector<double> outcome_of(const Specimen& s, const MeasuredRun& run)
{
    const std::size_t n = s.half_width_m.size(), rows = run.blocks.x_m.values.size() / n;
    std::vector<double> out;
    std::size_t last = rows;
    while (last > 0 && !std::isfinite(run.blocks.x_m.values[(last - 1) * n]))
        --last;
    for (const auto& [lower, upper] : s.joints) {
        const auto u = static_cast<std::size_t>(upper);
        const int base = lower; // clang 14 captures no structured binding
        const auto apart = [&](std::size_t i, const Series& series) {
            const double low = base < 0 ? 0 : series.values[i * n + static_cast<std::size_t>(base)];
            return series.values[i * n + u] - low;
        };
        double open = 0;
        for (std::size_t i = 0; i < last; ++i)
            open = std::max(open, std::fabs(apart(i, run.blocks.theta_rad)));
        out.push_back(last > 0 && lower >= 0 ? apart(last - 1, run.blocks.x_m) - apart(0, run.blocks.x_m) : 0);
        out.push_back(open);
    }
    out.push_back(run.collapsed.value_or(false));
    return out;
}

/// Harmonic motions about the pace of the specimen and the acceleration from which anything moves.
std::vector<ProposedMotion> proposed_motions(const Specimen& s, const TrackScales& scales)
{
    double width = std::numeric_limits<double>::infinity();
    for (const double b : s.half_width_m)
        width = std::min(width, b);
    const double height = scales.time_s * scales.time_s * s.gravity_m_s2;
    const double starts = s.gravity_m_s2 * std::min(s.friction_nominal.value_or(0.6), 2 * width / height);
    std::vector<ProposedMotion> motions;
    for (const double pace : {0.25, 0.5, 1.0})
        for (const double over : {0.85, 1.3, 1.8}) {
            ProposedMotion m{"", pace / scales.time_s, over * starts, 8};
            m.text = fmt::format("harmonic, {:.3g} Hz, {:.3g} m/s2, 8 cycles with smooth ends", m.frequency_hz,
                                 m.amplitude_m_s2);
            motions.push_back(m);
        }
    return motions;
}

/// A run of the campaign to be: base and places of the cameras' samples, with the noise that they have.
MeasuredRun run_of(const ProposedMotion& m, std::size_t number, const Specimen& s, const TrackScales& scales)
{
    MeasuredRun run;
    run.name = fmt::format("{:03}", number);
    run.motion_id = static_cast<int>(number);
    const double omega = 2 * std::numbers::pi * m.frequency_hz, length = m.cycles / m.frequency_hz;
    const auto n = static_cast<std::size_t>((length + 2 * scales.time_s) / scales.spacing_s);
    for (std::size_t i = 0; i < n; ++i) {
        const double t = scales.spacing_s * static_cast<double>(i);
        const double edge = std::clamp(std::min(t, length - t) * m.frequency_hz / 2, 0.0, 1.0);
        const double ramp = edge * edge * edge * (10 + edge * (6 * edge - 15));
        run.time_s.push_back(t);
        run.base_displacement_m.values.push_back(
            t < length ? m.amplitude_m_s2 / (omega * omega) * ramp * std::sin(omega * t) : 0);
    }
    run.base_displacement_m.noise_sd = 1e-7;
    run.blocks.x_m = {std::vector<double>(n * s.half_width_m.size(), 0.0), scales.noise_m};
    run.blocks.y_m = run.blocks.x_m;
    run.blocks.theta_rad = {run.blocks.x_m.values, scales.noise_rad};
    return run;
}

/// Mean and variance of every outcome under one of the motions.
struct OutcomeSpread {
    std::vector<double> mean, variance;
};

OutcomeSpread spread_of(const std::vector<Campaign>& campaigns, const Specimen& s, std::size_t run)
{
    OutcomeSpread spread;
    auto& [mean, square] = spread;
    for (const Campaign& c : campaigns) {
        const std::vector<double> o = outcome_of(s, c.runs[run]);
        mean.resize(o.size(), 0);
        square.resize(o.size(), 0);
        for (std::size_t f = 0; f < o.size(); ++f) {
            mean[f] += o[f] / simulated;
            square[f] += o[f] * o[f] / simulated;
        }
    }
    for (std::size_t f = 0; f < mean.size(); ++f)
        square[f] = std::max(0.0, square[f] - mean[f] * mean[f]);
    return spread;
}

/// Difference of two causes in the outcome that separates them best, in standard deviations and noise.
MotionChoice choice_of(const ProposedMotion& motion, const OutcomeSpread& a, const OutcomeSpread& b,
                       const TrackScales& scales)
{
    double separation = 0;
    for (std::size_t f = 0; f < a.mean.size(); ++f) {
        const bool collapse = f + 1 == a.mean.size();
        const double noise = collapse ? collapse_noise : f % 2 == 0 ? scales.noise_m : scales.noise_rad;
        const double sd = std::sqrt((a.variance[f] + b.variance[f]) / 2 + noise * noise);
        separation = std::max(separation, std::fabs(a.mean[f] - b.mean[f]) / sd);
    }
    MotionChoice choice;
    choice.motion = motion.text;
    choice.separation = separation;
    const double falls = std::max(a.mean.back(), b.mean.back());
    if (falls > 0)
        choice.text = fmt::format("falls in {:.0f} % of the simulations", 100 * falls);
    return choice;
}

} // namespace

std::optional<NextTest> next_test(const Campaign& campaign, const TrackScales& scales, const Study& baseline,
                                  const std::vector<JudgedCause>& causes, std::uint64_t seed, const RunOptions& options,
                                  SimulationCount& count, Observer& observer)
{
    std::vector<SizedCause> rivals = model_causes(causes);
    if (rivals.size() < 2)
        return std::nullopt;
    rivals.resize(2);
    const Specimen& s = campaign.specimen;
    const std::vector<ProposedMotion> motions = proposed_motions(s, scales);
    Campaign proposed = campaign;
    proposed.runs.clear();
    for (std::size_t k = 0; k < motions.size(); ++k)
        proposed.runs.push_back(run_of(motions[k], k, s, scales));
    HealthyScatter scatter;
    scatter.contacts = false;
    std::vector<std::vector<OutcomeSpread>> spread(2); // [rival][motion]
    for (std::size_t rival = 0; rival < 2; ++rival) {
        const VirtualCampaigns made = virtual_campaigns(VirtualLaboratory(proposed), baseline, seed, 0, simulated,
                                                        scatter, {{rivals[rival]}}, options, observer);
        count += made.cost;
        if (!made.complete)
            return std::nullopt;
        for (std::size_t k = 0; k < motions.size(); ++k)
            spread[rival].push_back(spread_of(made.campaigns, s, k));
    }
    NextTest test;
    for (std::size_t k = 0; k < motions.size(); ++k)
        test.motions.push_back(choice_of(motions[k], spread[0][k], spread[1][k], scales));
    std::stable_sort(test.motions.begin(), test.motions.end(),
                     [](const MotionChoice& a, const MotionChoice& b) { return *a.separation > *b.separation; });
    test.excitation = test.motions.front().motion;
    test.separates = {rivals[0].cause.mechanism, rivals[1].cause.mechanism};
    const auto named_place = [&](std::size_t k) {
        return rivals[k].cause.mechanism + " " + place_words(rivals[k].cause.place);
    };
    test.text =
        fmt::format("Of {} motions, {} simulations each, it best separates {} from {}: by {:.1f} standard deviations "
                    "of slip, rocking or collapse.",
                    motions.size(), simulated, named_place(0), named_place(1), *test.motions.front().separation);
    return test;
}

} // namespace stylobate

#include "studies/diagnosis/decision/prediction.hpp"

#include "ensemble/numerics/random.hpp"
#include "studies/calibration/calibration_windows.hpp"
#include "studies/diagnosis/decision/virtual_campaign.hpp"
#include "studies/diagnosis/decision/window_evidence.hpp"
#include "studies/diagnosis/findings/diagnosis_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace stylobate {

namespace {

// A residual counts at most so many of its scales: an impact that went the other way is one error, not a hundred.
constexpr double most_residual = 5;
// Times that the intervals are drawn anew.
constexpr std::uint64_t resamples = 2000;
// Realizations of a run whose end is predicted.
constexpr std::uint64_t collapse_ensemble = 24;

bool acts_on_base(const std::string& mechanism)
{
    return mechanism == "sensor_gain" || mechanism == "time_offset" || mechanism == "harmonic_distortion";
}

Campaign of_runs(const Campaign& campaign, const std::vector<std::size_t>& runs)
{
    Campaign part = campaign;
    part.runs.clear();
    for (const std::size_t r : runs)
        part.runs.push_back(campaign.runs[r]);
    return part;
}

/// Sum and count of squared residuals, winsorized, by run.
struct Errors {
    std::vector<double> squares, counts;
    double rms() const
    {
        const double n = std::accumulate(counts.begin(), counts.end(), 0.0);
        return n > 0 ? std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / n) : 0;
    }
};

/// What a study with these causes is off by in every window; nothing if the observer stopped it.
std::optional<WindowResiduals> residuals_of(WindowComparison& comparison, const SpecimenStructure& built,
                                            const Study& study, const std::vector<SizedCause>& causes,
                                            const RunOptions& options, SimulationCount& count, Observer& observer)
{
    ModelVariant variant;
    variant.study = study;
    variant.change = [&](Realization& r, std::size_t) {
        for (const SizedCause& cause : causes)
            apply_cause(cause, built, r);
    };
    std::vector<WindowResiduals> residuals = comparison.residuals({variant}, options, observer);
    count.simulations += comparison.simulations();
    count.window_simulations += comparison.window_simulations();
    count.block_steps += comparison.block_steps();
    if (residuals.empty())
        return std::nullopt;
    return std::move(residuals.front());
}

std::optional<Errors> errors_of(const Campaign& campaign, const Study& study, const std::vector<SizedCause>& causes,
                                const RunOptions& options, SimulationCount& count, Observer& observer)
{
    const SpecimenStructure built = build_specimen(campaign.specimen);
    WindowComparison comparison(campaign, {});
    Errors errors{std::vector<double>(campaign.runs.size(), 0), std::vector<double>(campaign.runs.size(), 0)};
    if (comparison.windows().empty())
        return errors;
    const std::optional<WindowResiduals> residuals =
        residuals_of(comparison, built, study, causes, options, count, observer);
    if (!residuals)
        return std::nullopt;
    for (std::size_t w = 0; w < residuals->size(); ++w)
        for (const double z : (*residuals)[w]) {
            const std::size_t run = comparison.windows()[w].run;
            errors.squares[run] += std::min(z * z, most_residual * most_residual);
            errors.counts[run] += 1;
        }
    return errors;
}

/// How far repeats of one motion are from each other where both have a window, on the same scale.
MaybeReal repeat_floor(const Campaign& campaign, const std::vector<std::size_t>& runs)
{
    const WindowComparison comparison(campaign, {});
    double square = 0, n = 0;
    const auto& windows = comparison.windows();
    for (std::size_t a = 0; a < windows.size(); ++a)
        for (std::size_t b = a + 1; b < windows.size(); ++b) {
            const std::size_t ra = windows[a].run, rb = windows[b].run;
            if (ra == rb || campaign.runs[ra].motion_id != campaign.runs[rb].motion_id ||
                std::find(runs.begin(), runs.end(), ra) == runs.end() ||
                std::fabs(windows[a].start_s - windows[b].start_s) > 2.5 / std::max(1.0, campaign.runs[ra].rate_hz))
                continue;
            const auto &va = comparison.seen(a), &vb = comparison.seen(b);
            for (std::size_t k = 0; k < std::min(va.size(), vb.size()); ++k) {
                const double z = (va[k].value - vb[k].value) / va[k].scale;
                if (!std::isfinite(z))
                    continue;
                square += std::min(z * z, most_residual * most_residual);
                n += 1;
            }
        }
    return n > 0 ? MaybeReal(std::sqrt(square / n)) : std::nullopt;
}

} // namespace

Campaign corrected(const Campaign& campaign, const DirectResult& direct)
{
    Campaign out = campaign;
    const bool changed = std::any_of(direct.found.begin(), direct.found.end(),
                                     [](const CauseFit& fit) { return acts_on_base(fit.cause.mechanism); });
    if (!changed)
        return out;
    for (std::size_t r = 0; r < out.runs.size(); ++r)
        if (!direct.corrected_m[r].empty()) {
            out.runs[r].base_displacement_m.values = direct.corrected_m[r];
            out.runs[r].base_acceleration_m_s2.values.clear();
            out.runs[r].table = {};
        }
    return out;
}

std::vector<SizedCause> model_causes(const std::vector<JudgedCause>& named)
{
    std::vector<SizedCause> causes;
    for (const JudgedCause& j : named)
        if (!acts_on_base(j.fit.cause.mechanism) &&
            !(j.fit.cause.mechanism == "vertical_motion" && j.fit.cause.parameter != "ratio"))
            causes.push_back({j.fit.cause, j.fit.size});
    return causes;
}

std::optional<ModelGain> predictive_gain(const Campaign& campaign, const TrackScales& scales, const Study& baseline,
                                         const std::vector<JudgedCause>& named, std::uint64_t seed,
                                         const RunOptions& options, SimulationCount& count, Observer& observer)
{
    std::set<int> motions;
    for (const MeasuredRun& run : campaign.runs)
        motions.insert(run.motion_id);
    if (motions.size() < 2 || named.empty())
        return std::nullopt;
    std::vector<std::size_t> used, left;
    for (std::size_t r = 0; r < campaign.runs.size(); ++r) {
        const auto at = std::distance(motions.begin(), motions.find(campaign.runs[r].motion_id));
        (at % 2 == 1 ? left : used).push_back(r);
    }
    // sizes by the motions that are used
    const Campaign training = of_runs(campaign, used);
    const DirectResult direct = direct_tests(training, scales);
    const BalanceEvidence balance = balance_evidence(training, scales, direct.base_m);
    std::vector<JudgedCause> sized = named;
    for (JudgedCause& j : sized) {
        const Cause& cause = j.fit.cause;
        if (j.channel == Channel::direct) {
            const auto again = std::find_if(direct.found.begin(), direct.found.end(), [&](const CauseFit& fit) {
                return fit.cause.mechanism == cause.mechanism && fit.cause.place == cause.place;
            });
            j.fit.size = again != direct.found.end() ? again->size : cause.neutral;
        } else if (j.channel == Channel::balance) {
            const CauseFit again = balance.fit ? balance.fit->fit(cause) : CauseFit{};
            j.fit.size = balance.fit && possible(again) ? again.size : cause.neutral;
        } else {
            // the sizes that the named one lies between, judged by the windows of these runs
            const Campaign at = corrected(training, direct);
            double best = cause.neutral, least = std::numeric_limits<double>::infinity();
            for (const double part : {0.0, 0.5, 0.75, 1.0, 1.33}) {
                const double size = cause.neutral + part * (j.fit.size - cause.neutral);
                const auto errors = errors_of(at, baseline, {{cause, size}}, options, count, observer);
                if (!errors)
                    return std::nullopt;
                if (errors->rms() < least) {
                    least = errors->rms();
                    best = size;
                }
            }
            j.fit.size = best;
        }
    }
    // the base of the runs left out, corrected by what the others showed
    const Campaign rest = of_runs(campaign, left);
    DirectResult applied = apply_corrections(rest, scales, direct);
    const auto before = errors_of(rest, baseline, {}, options, count, observer);
    const auto after = errors_of(corrected(rest, applied), baseline, model_causes(sized), options, count, observer);
    if (!before || !after)
        return std::nullopt;
    ModelGain gain;
    for (const std::size_t r : left)
        gain.runs_left_out.push_back(campaign.runs[r].name);
    if (before->rms() == 0) {
        gain.text = "The held-out runs have no windows that could be predicted.";
        return gain;
    }
    gain.error_before = 1;
    gain.error_after = after->rms() / before->rms();
    // drawn anew: runs
    std::vector<double> ratios;
    for (std::uint64_t k = 0; k < resamples; ++k) {
        double sb = 0, nb = 0, sa = 0, na = 0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const auto r =
                static_cast<std::size_t>(uniform01(seed, k, Stream::bootstrap, i) * static_cast<double>(left.size()));
            sb += before->squares[r];
            nb += before->counts[r];
            sa += after->squares[r];
            na += after->counts[r];
        }
        if (nb > 0 && na > 0 && sb > 0)
            ratios.push_back(std::sqrt(sa / na / (sb / nb)));
    }
    std::sort(ratios.begin(), ratios.end());
    if (ratios.size() > 100) {
        gain.low = ratios[static_cast<std::size_t>(0.025 * static_cast<double>(ratios.size()))];
        gain.high = ratios[static_cast<std::size_t>(0.975 * static_cast<double>(ratios.size()))];
    }
    if (const MaybeReal floor = repeat_floor(campaign, left))
        gain.floor = *floor / before->rms();
    gain.text = fmt::format(
        "Error of free windows over noise and a lag of the local motion, root mean square with residuals limited to "
        "{:g}: {:.2f} before, {:.2f} after. Fitted to {} runs, tested on {} runs of other motions.",
        most_residual, before->rms(), after->rms(), used.size(), left.size());

    // which of them fall
    const bool told =
        std::all_of(left.begin(), left.end(), [&](std::size_t r) { return campaign.runs[r].collapsed.has_value(); });
    if (told) {
        CollapsePrediction collapse;
        HealthyScatter scatter;
        scatter.contacts = false;
        const auto shares = [&](const Campaign& of, const std::vector<SizedCause>& causes) {
            std::vector<double> share(of.runs.size(), 0);
            const VirtualCampaigns made =
                virtual_campaigns(of, baseline, seed, 0, collapse_ensemble, scatter, causes, options, observer);
            count.simulations += made.simulations;
            count.block_steps += made.block_steps;
            for (const Campaign& c : made.campaigns)
                for (std::size_t r = 0; r < c.runs.size(); ++r)
                    share[r] += c.runs[r].collapsed.value_or(false) / static_cast<double>(collapse_ensemble);
            return share;
        };
        const std::vector<double> p0 = shares(rest, {}), p1 = shares(corrected(rest, applied), model_causes(sized));
        double b0 = 0, b1 = 0;
        for (std::size_t r = 0; r < rest.runs.size(); ++r) {
            const double fell = *rest.runs[r].collapsed;
            b0 += std::pow(p0[r] - fell, 2) / static_cast<double>(rest.runs.size());
            b1 += std::pow(p1[r] - fell, 2) / static_cast<double>(rest.runs.size());
            collapse.right_before += (p0[r] > 0.5) == (fell > 0.5);
            collapse.right_after += (p1[r] > 0.5) == (fell > 0.5);
        }
        collapse.runs = rest.runs.size();
        collapse.score_before = b0;
        collapse.score_after = b1;
        collapse.text =
            fmt::format("From {} simulations of each whole run, with the scatter of specimens and their placement.",
                        collapse_ensemble);
        gain.collapse = collapse;
    }
    return gain;
}

namespace {

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
    Campaign proposed = campaign;
    proposed.runs.clear();
    for (std::size_t k = 0; k < motions.size(); ++k) {
        const ProposedMotion& m = motions[k];
        MeasuredRun run;
        run.name = fmt::format("{:03}", k);
        run.motion_id = static_cast<int>(k);
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
        proposed.runs.push_back(std::move(run));
    }
    HealthyScatter scatter;
    scatter.contacts = false;
    constexpr std::uint64_t campaigns = 12;
    std::vector<std::vector<std::vector<double>>> mean(2), spread(2); // [rival][motion][outcome]
    for (std::size_t rival = 0; rival < 2; ++rival) {
        const VirtualCampaigns made =
            virtual_campaigns(proposed, baseline, seed, 0, campaigns, scatter, {rivals[rival]}, options, observer);
        count.simulations += made.simulations;
        count.block_steps += made.block_steps;
        if (!made.complete)
            return std::nullopt;
        for (std::size_t k = 0; k < motions.size(); ++k) {
            std::vector<double> sum, square;
            for (const Campaign& c : made.campaigns) {
                const std::vector<double> o = outcome_of(s, c.runs[k]);
                sum.resize(o.size(), 0);
                square.resize(o.size(), 0);
                for (std::size_t f = 0; f < o.size(); ++f) {
                    sum[f] += o[f] / campaigns;
                    square[f] += o[f] * o[f] / campaigns;
                }
            }
            for (std::size_t f = 0; f < sum.size(); ++f)
                square[f] = std::max(0.0, square[f] - sum[f] * sum[f]);
            mean[rival].push_back(sum);
            spread[rival].push_back(square);
        }
    }
    NextTest test;
    for (std::size_t k = 0; k < motions.size(); ++k) {
        double separation = 0;
        for (std::size_t f = 0; f < mean[0][k].size(); ++f) {
            const bool collapse = f + 1 == mean[0][k].size();
            const double noise = collapse ? 0.1 : f % 2 == 0 ? scales.noise_m : scales.noise_rad;
            const double sd = std::sqrt((spread[0][k][f] + spread[1][k][f]) / 2 + noise * noise);
            separation = std::max(separation, std::fabs(mean[0][k][f] - mean[1][k][f]) / sd);
        }
        MotionChoice choice;
        choice.motion = motions[k].text;
        choice.separation = separation;
        const double falls = std::max(mean[0][k].back(), mean[1][k].back());
        if (falls > 0)
            choice.text = fmt::format("falls in {:.0f} % of the simulations", 100 * falls);
        test.motions.push_back(choice);
    }
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
                    motions.size(), campaigns, named_place(0), named_place(1), *test.motions.front().separation);
    return test;
}

} // namespace stylobate

#include "studies/measured/diagnosis/prediction.hpp"

#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/campaigns/virtual_campaign.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace stylobate {

namespace {

// Half of the runs size a cause by the balance of forces where this gains so much [nats], else by free windows.
constexpr double least_force_gain = 3;

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

/// What a study with these causes is off by in every window; nothing if the observer stopped it.
std::optional<WindowResiduals> residuals_of(WindowComparison& comparison, const SpecimenStructure& built,
                                            const Study& study, const std::vector<SizedCause>& causes,
                                            const RunOptions& options, SimulationCount& count, Observer& observer)
{
    std::vector<WindowResiduals> residuals =
        comparison.residuals({with_causes(study, built, causes)}, options, observer);
    count += comparison.cost();
    if (residuals.empty())
        return std::nullopt;
    return std::move(residuals.front());
}

std::optional<RunErrors> errors_of(const Campaign& campaign, const Study& study, const std::vector<SizedCause>& causes,
                                   const RunOptions& options, SimulationCount& count, Observer& observer)
{
    const SpecimenStructure built = build_specimen(campaign.specimen);
    WindowComparison comparison(campaign, {});
    RunErrors errors{std::vector<double>(campaign.runs.size(), 0), std::vector<double>(campaign.runs.size(), 0)};
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

double RunErrors::rms() const
{
    const double n = std::accumulate(counts.begin(), counts.end(), 0.0);
    return n > 0 ? std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / n) : 0;
}

std::optional<std::pair<double, double>> interval_of_ratio(const RunErrors& before, const RunErrors& after,
                                                           std::uint64_t seed)
{
    const std::size_t runs = before.squares.size();
    std::vector<double> ratios;
    for (std::uint64_t k = 0; k < resamples; ++k) {
        double sb = 0, nb = 0, sa = 0, na = 0;
        for (std::size_t i = 0; i < runs; ++i) {
            const auto r =
                static_cast<std::size_t>(uniform01(seed, k, Stream::bootstrap, i) * static_cast<double>(runs));
            sb += before.squares[r];
            nb += before.counts[r];
            sa += after.squares[r];
            na += after.counts[r];
        }
        if (nb > 0 && na > 0 && sb > 0)
            ratios.push_back(std::sqrt(sa / na / (sb / nb)));
    }
    if (ratios.size() <= 100)
        return std::nullopt;
    std::sort(ratios.begin(), ratios.end());
    return std::pair{sorted_quantile(ratios, 0.025, QuantileDefinition::above),
                     sorted_quantile(ratios, 0.975, QuantileDefinition::above)};
}

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
        if (!acts_on_base(j.fit.cause.mechanism) && !unrecorded_vertical(j.fit.cause))
            causes.push_back({j.fit.cause, j.fit.size});
    return causes;
}

namespace {

/// Runs to size the causes by and runs to predict: the motions by turns, in the order of their numbers.
struct Halves {
    std::vector<std::size_t> used, left;
};

/// Nothing where all runs have one motion.
std::optional<Halves> halves_of(const Campaign& campaign)
{
    std::set<int> motions;
    for (const MeasuredRun& run : campaign.runs)
        motions.insert(run.motion_id);
    if (motions.size() < 2)
        return std::nullopt;
    Halves halves;
    for (std::size_t r = 0; r < campaign.runs.size(); ++r) {
        const auto at = std::distance(motions.begin(), motions.find(campaign.runs[r].motion_id));
        (at % 2 == 1 ? halves.left : halves.used).push_back(r);
    }
    return halves;
}

/// What every simulation of a prediction needs.
struct Simulating {
    const Study& baseline;
    std::uint64_t seed;
    const RunOptions& options;
    SimulationCount& count;
    Observer& observer;

    std::optional<RunErrors> errors(const Campaign& campaign, const std::vector<SizedCause>& causes) const
    {
        return errors_of(campaign, baseline, causes, options, count, observer);
    }
};

/// Of the sizes that the named one lies between, the one that the windows of these runs like best; nothing if stopped.
std::optional<double> size_by_windows(const CauseFit& fit, const Campaign& at, const Simulating& simulating)
{
    double best = fit.cause.neutral, least = std::numeric_limits<double>::infinity();
    for (const double part : {0.0, 0.5, 0.75, 1.0, 1.33}) {
        const double size = fit.cause.neutral + part * (fit.size - fit.cause.neutral);
        const auto errors = simulating.errors(at, {{fit.cause, size}});
        if (!errors)
            return std::nullopt;
        if (errors->rms() < least) {
            least = errors->rms();
            best = size;
        }
    }
    return best;
}

/// The named causes with the sizes that these runs alone give them; nothing if stopped.
std::optional<std::vector<JudgedCause>> sized_by(const Campaign& training, const DirectResult& direct,
                                                 const CampaignScales& scales, const std::vector<JudgedCause>& named,
                                                 const Simulating& simulating)
{
    const BalanceEvidence balance = balance_evidence(training, scales, direct.base_m);
    std::vector<JudgedCause> sized = named;
    for (JudgedCause& j : sized) {
        const Cause& cause = j.fit.cause;
        if (j.channel == Channel::direct) {
            const auto again = std::find_if(direct.found.begin(), direct.found.end(), [&](const CauseFit& fit) {
                return fit.cause.mechanism == cause.mechanism && fit.cause.place == cause.place;
            });
            j.fit.size = again != direct.found.end() ? again->size : cause.neutral;
        } else if (const CauseFit again = balance.fit ? balance.fit->fit(cause) : CauseFit{};
                   again.gain > least_force_gain && possible(again)) {
            j.fit.size = again.size;
        } else {
            const std::optional<double> size = size_by_windows(j.fit, corrected(training, direct), simulating);
            if (!size)
                return std::nullopt;
            j.fit.size = *size;
        }
    }
    return sized;
}

/// (runs) the share of simulations that collapse.
std::vector<double> collapse_shares(const Campaign& of, const std::vector<SizedCause>& causes, const Simulating& s)
{
    HealthyScatter scatter;
    scatter.placed_as_seen = true;
    std::vector<double> share(of.runs.size(), 0);
    const VirtualCampaigns made = virtual_campaigns(VirtualLaboratory(of), s.baseline, s.seed, 0, collapse_ensemble,
                                                    scatter, {causes}, s.options, s.observer);
    s.count += made.cost;
    for (const Campaign& c : made.campaigns)
        for (std::size_t r = 0; r < c.runs.size(); ++r)
            share[r] += c.runs[r].collapsed.value_or(false) / static_cast<double>(collapse_ensemble);
    return share;
}

/// Which of the runs left out fall. @pre the outcome of all of them is known
CollapsePrediction predict_collapse(const Campaign& rest, const Campaign& rest_corrected,
                                    const std::vector<SizedCause>& causes, const Simulating& simulating)
{
    CollapsePrediction collapse;
    const std::vector<double> p0 = collapse_shares(rest, {}, simulating),
                              p1 = collapse_shares(rest_corrected, causes, simulating);
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
    collapse.text = fmt::format(
        "From {} simulations of each whole run, with the scatter of specimens, and the blocks where they were put.",
        collapse_ensemble);
    return collapse;
}

} // namespace

std::optional<ModelGain> predictive_gain(const Campaign& campaign, const CampaignScales& scales, const Study& baseline,
                                         const std::vector<JudgedCause>& named, std::uint64_t seed,
                                         const RunOptions& options, SimulationCount& count, Observer& observer)
{
    const std::optional<Halves> halves = halves_of(campaign);
    if (!halves || named.empty())
        return std::nullopt;
    const Simulating simulating{baseline, seed, options, count, observer};
    const Campaign training = of_runs(campaign, halves->used), rest = of_runs(campaign, halves->left);
    const DirectResult direct = direct_tests(training, scales);
    const std::optional<std::vector<JudgedCause>> sized = sized_by(training, direct, scales, named, simulating);
    if (!sized)
        return std::nullopt;
    // the base of the runs left out, corrected by what the others showed
    const Campaign rest_corrected = corrected(rest, apply_corrections(rest, scales, direct));
    const std::vector<SizedCause> causes = model_causes(*sized);
    const auto before = simulating.errors(rest, {});
    const auto after = simulating.errors(rest_corrected, causes);
    if (!before || !after)
        return std::nullopt;
    ModelGain gain;
    for (const MeasuredRun& run : rest.runs)
        gain.runs_left_out.push_back(run.name);
    if (before->rms() == 0) {
        gain.text = "The held-out runs have no windows that could be predicted.";
        return gain;
    }
    gain.error_before = 1;
    gain.error_after = after->rms() / before->rms();
    if (const auto interval = interval_of_ratio(*before, *after, seed)) {
        gain.low = interval->first;
        gain.high = interval->second;
    }
    if (const MaybeReal floor = repeat_floor(campaign, halves->left))
        gain.floor = *floor / before->rms();
    gain.text = fmt::format(
        "Error of free windows over noise and a lag of the local motion, root mean square with residuals limited to "
        "{:g}: {:.2f} before, {:.2f} after. Fitted to {} runs, tested on {} runs of other motions.",
        most_residual, before->rms(), after->rms(), halves->used.size(), halves->left.size());
    if (std::all_of(rest.runs.begin(), rest.runs.end(),
                    [](const MeasuredRun& run) { return run.collapsed.has_value(); }))
        gain.collapse = predict_collapse(rest, rest_corrected, causes, simulating);
    return gain;
}

} // namespace stylobate

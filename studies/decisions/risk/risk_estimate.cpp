#include "studies/decisions/risk/risk.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "io/files/suggest.hpp"
#include "studies/kinds/fragility/fragility_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

/// Whether a curve rises, so that a frequency can be computed from it.
bool has_lognormal(const StateFragility& s)
{
    return has_curve(s) && s.curve.dispersion.value > 0;
}

std::vector<FragilityPoint> curve_points(const StateFragility& s)
{
    std::vector<FragilityPoint> points;
    for (const CurvePoint& at : s.curve.at)
        points.push_back({at.intensity[0], at.probability.value, std::max(at.probability.records.lower, 0.0),
                          std::min(at.probability.records.upper, 1.0)});
    return points;
}

std::vector<FragilityPoint> share_points(const StateFragility& s)
{
    std::vector<FragilityPoint> points;
    for (const StripeShare& stripe : s.stripes->stripes)
        points.push_back(
            {stripe.intensity, stripe.share, std::max(stripe.limits.lower, 0.0), std::min(stripe.limits.upper, 1.0)});
    return points;
}

/// Says of a state whether too much comes from outside.
void judge(StateRisk& risk, double most_outside)
{
    if (const std::optional<std::string> why = why_undetermined(risk.estimate, most_outside)) {
        risk.determined = false;
        risk.note = *why;
    }
}

std::vector<StateRisk> risks_of(const StateFragility& s, const HazardModel& hazard, const RiskOptions& options)
{
    std::vector<StateRisk> risks;
    if (s.data.records == 0) // the data bore no estimate
        return risks;
    FrequencyOptions frequency;
    frequency.level = options.level;
    const bool fits = s.fit.p_value >= fit_significance;
    const bool shares = s.stripes && s.data.points() >= 2;
    const auto add = [&](FragilityForm form) {
        StateRisk risk{s.state.name, s.state.describe, form, risks.empty(), true, "", {}, {}};
        if (form == FragilityForm::lognormal) {
            const bool both = fits && shares;
            risk.estimate = lognormal_frequency(s.data, hazard, frequency, both ? &*s.stripes : nullptr);
            risk.fragility = curve_points(s);
            risk.note = fmt::format("by the lognormal curve, {} (p = {:.2g}){}",
                                    fits ? "of which no lack of fit was found" : "although it does not fit",
                                    s.fit.p_value, both ? ", with an interval that contains that of the shares" : "");
        } else {
            risk.estimate = share_frequency(s.data, *s.stripes, hazard, frequency);
            risk.fragility = share_points(s);
            const std::string shares_of = "by the shares of the stripes";
            risk.note = s.curve.maximum == Maximum::separated
                            ? shares_of + ": the stripes separate, so there is no lognormal curve, and the interval "
                                          "contains any curve between two stripes"
                        : !has_lognormal(s) ? shares_of + ": there is no lognormal curve"
                        : fits              ? shares_of + ", which assume no form of a curve"
                                            : fmt::format("{} instead of the lognormal curve, which does not fit (p = "
                                                                       "{:.2g})",
                                                          shares_of, s.fit.p_value);
        }
        judge(risk, options.most_outside);
        risks.push_back(std::move(risk));
    };
    if (has_lognormal(s) && (fits || !shares))
        add(FragilityForm::lognormal);
    if (shares)
        add(FragilityForm::shares);
    if (has_lognormal(s) && !fits && shares)
        add(FragilityForm::lognormal);
    return risks;
}

void check_determined(const Risk& risk)
{
    if (risk.states.empty())
        throw InputError("no limit state has a curve, or shares at two intensities or more." +
                         (risk.says.empty() ? "" : "\n  " + risk.says.front()));
    const auto chosen = risk.chosen();
    if (std::none_of(chosen.begin(), chosen.end(), [](const StateRisk* s) { return s->determined; })) {
        const StateRisk& s = risk.principal();
        throw InputError(fmt::format("{}: {}\n  Or accept it: --most-outside {:.2g}.", s.state, s.note,
                                     std::max(s.estimate.below + s.estimate.above, s.estimate.beyond_hazard) + 0.01));
    }
}

} // namespace

std::optional<std::string> why_undetermined(const FrequencyEstimate& e, double most_outside)
{
    const double outside = e.below + e.above;
    const auto why = [&](double share, const std::string& where, const std::string& remedy) {
        return fmt::format("{:.0f} % of the frequency would come from {}, more than {:g} %. {}", 100 * share, where,
                           100 * most_outside, remedy);
    };
    if (outside > most_outside && outside >= e.beyond_hazard)
        return why(outside, "intensities outside of the range of the runs",
                   fmt::format("Run the study with {} intensities.", e.below > e.above ? "weaker" : "stronger"));
    if (e.beyond_hazard > most_outside)
        return why(e.beyond_hazard, "intensities outside of the hazard's points",
                   "Give the hazard over a wider range.");
    return std::nullopt;
}

void check_state(const std::optional<std::string>& state, const std::vector<std::string>& names, const std::string& of)
{
    if (!state || std::ranges::find(names, *state) != names.end())
        return;
    const auto meant = nearest_word(*state, names);
    throw InputError(fmt::format("--state {}: is no limit state of {}; it has {}.{}", *state, of,
                                 fmt::join(names, ", "), meant ? fmt::format("\n  Did you mean {}?", *meant) : ""));
}

RiskFacts facts_of(const HazardModel& hazard, const RiskOptions& options)
{
    RiskFacts facts{"", "", hazard, options.level, options.most_outside, options.years, hazard.says};
    if (hazard.fractiles.empty())
        facts.says.emplace_back("The hazard is given without fractiles: its uncertainty is not in the intervals.");
    return facts;
}

Risk risk_of(const Fragility& fragility, const HazardModel& hazard, const RiskOptions& options)
{
    std::vector<const StateFragility*> wanted;
    std::vector<std::string> names;
    for (const StateFragility& s : fragility.states) {
        names.push_back(s.state.name);
        if (!options.state || options.state == s.state.name)
            wanted.push_back(&s);
    }
    check_state(options.state, names, "the study");
    Risk risk{facts_of(hazard, options), {}, {}, 0.95, {}, {}};
    std::vector<std::string> says = fragility.says; // before those of the hazard
    if (fragility.invalid > 0)
        says.push_back(fmt::format("{} invalid realizations are left out.", fragility.invalid));
    risk.says.insert(risk.says.begin(), says.begin(), says.end());
    std::vector<std::vector<StateRisk>> found(wanted.size());
    in_parallel(std::size_t{0}, wanted.size(),
                [&](std::size_t i) { found[i] = risks_of(*wanted[i], hazard, options); });
    for (auto& forms : found)
        for (StateRisk& s : forms)
            risk.states.push_back(std::move(s));
    check_determined(risk);
    return risk;
}

} // namespace stylobate

#include "studies/kinds/survival/combined_past.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/kinds/survival/survival_text.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace stylobate {

namespace {

void check_alike(const StructurePast& first, const StructurePast& other)
{
    const auto refuse = [&](const char* what, const char* todo) {
        throw InputError(fmt::format("{} has {} than {}.\n  {}", other.file, what, first.file, todo));
    };
    if (other.counts.axes().frequency_hz != first.counts.axes().frequency_hz ||
        other.counts.axes().intensity != first.counts.axes().intensity)
        refuse("other axes", "Structures of one site are compared over the same frequencies and PGAs: run them with "
                             "the same [surface].");
    if (other.counts.axes().events != first.counts.axes().events)
        refuse("another number of events", "Run both with the same survival.events.");
    const SurvivalSpec &a = *first.study.survival, &b = *other.study.survival;
    const auto points = [](const SurvivalSpec& spec) {
        return spec.hazard ? std::tuple(spec.hazard->k0_per_year, spec.hazard->k, spec.hazard->intensity_m_s2,
                                        spec.hazard->rate_per_year)
                           : std::tuple(0.0, 0.0, std::vector<double>(), std::vector<double>());
    };
    if (a.prior != b.prior || (a.prior == PastPrior::hazard && points(a) != points(b)))
        refuse("another prior", "One past has one prior: run both with the same survival.prior.");
    if (a.level != b.level)
        refuse("another level", "Run both with the same survival.level.");
    if (a.observed && b.observed && a.observed->mirrored != b.observed->mirrored)
        refuse("another survival.observed.mirrored",
               "The sense of the shaking is that of all structures: it is known or it is not.");
}

/// Whether two studies shake in the same way; how long they go on afterwards may differ.
bool shake_alike(const Study& a, const Study& b)
{
    ExcitationSpec of_b = b.excitation;
    of_b.tail = a.excitation.tail;
    of_b.tail_s = a.excitation.tail_s;
    const auto draws = [](const Study& study) {
        std::vector<Perturbation> all;
        for (const Perturbation& p : study.perturbations)
            if (p.quantity == Quantity::phase || p.quantity == Quantity::pulse_frequency ||
                p.quantity == Quantity::pulse_gamma)
                all.push_back(p);
        return all;
    };
    return a.seed == b.seed && a.realizations == b.realizations && a.sampling == Sampling::independent &&
           b.sampling == Sampling::independent && a.survival->per_motion == b.survival->per_motion &&
           a.excitation == of_b && draws(a) == draws(b);
}

/// The structures must have been through the same motions, and be drawn independently.
void check_motions(const StructurePast& first, const StructurePast& other)
{
    const SurvivalSpec &a = *first.study.survival, &b = *other.study.survival;
    const auto refuse = [&](const std::string& what, const std::string& todo) {
        throw InputError(fmt::format("{} and {} {}.\n  {}", first.file, other.file, what, todo));
    };
    if (!shake_alike(first.study, other.study))
        refuse("have not been through the same motions, on which their joint likelihood depends",
               "Run both with the same [excitation], study.seed, study.realizations, survival.structures_per_motion "
               "and perturbation of phase and pulse, without sampling = \"sobol\".");
    if (a.structure == b.structure)
        refuse(fmt::format("are both structure {} of their site, and draw the same imperfections", a.structure),
               fmt::format("Run one of them again with survival.structure = {}.", a.structure + 1));
}

/// The values of all structures beside each other, of realizations of which all stand.
struct SiteStates {
    StandingStates standing;
    MeasuredState measured;
};

SiteStates site_states(const std::vector<StructurePast>& structures)
{
    SiteStates site;
    std::vector<std::vector<SurvivalCounts::Standing>> of;
    std::size_t width = 0; // of what was measured
    for (const StructurePast& one : structures) {
        of.push_back(one.counts.standing());
        const MeasuredState& m = one.counts.measured();
        site.measured.value.insert(site.measured.value.end(), m.value.begin(), m.value.end());
        site.measured.tolerance.insert(site.measured.tolerance.end(), m.tolerance.begin(), m.tolerance.end());
        site.measured.mirrored = site.measured.mirrored || m.mirrored;
        width += m.value.size();
    }
    // measured values come first, then the counterparts that were not measured
    std::size_t begin = 0, further = width;
    for (std::size_t k = 0; k < structures.size(); ++k) {
        const MeasuredState& m = structures[k].counts.measured();
        const std::size_t own = m.value.size();
        for (std::size_t i = 0; i < own && site.measured.mirrored; ++i) {
            const std::size_t at = m.counterpart.empty() ? i : m.counterpart[i];
            site.measured.counterpart.push_back(at < own ? begin + at : further + at - own);
        }
        begin += own;
        further += of[k].empty() ? 0 : of[k].front().value.size() - own;
    }
    std::vector<std::size_t> at(structures.size(), 0);
    for (const SurvivalCounts::Standing& first : of.front()) {
        bool all = true;
        for (std::size_t k = 0; k < structures.size(); ++k) {
            while (at[k] < of[k].size() && of[k][at[k]].index < first.index)
                ++at[k];
            all = all && at[k] < of[k].size() && of[k][at[k]].index == first.index;
        }
        if (!all)
            continue;
        site.standing.cell.push_back(first.cell);
        for (const bool measured : {true, false})
            for (std::size_t k = 0; k < structures.size(); ++k) {
                const std::vector<double>& value = of[k][at[k]].value;
                const auto own = static_cast<std::ptrdiff_t>(structures[k].counts.measured().value.size());
                site.standing.value.insert(site.standing.value.end(), measured ? value.begin() : value.begin() + own,
                                           measured ? value.begin() + own : value.end());
            }
    }
    return site;
}

} // namespace

CombinedPast combined_past(const std::vector<StructurePast>& structures)
{
    if (structures.size() < 2)
        throw InputError("past needs the results of two structures at least.\n  The past of one is reported by "
                         "`stylobate report` and `stylobate export`.");
    const StructurePast& first = structures.front();
    const SurvivalSpec& spec = *first.study.survival;
    CombinedPast combined;
    combined.dimensions = first.study.structure.dimensions;
    combined.axes = first.counts.axes();
    combined.prior = prior_words(spec, combined.axes.intensity);
    combined.level = spec.level;
    for (std::size_t k = 0; k < structures.size(); ++k) {
        const StructurePast& one = structures[k];
        for (std::size_t before = 0; before < k; ++before)
            check_motions(structures[before], one);
        check_alike(first, one);
        const Survival alone = survival_of(one.study, one.counts);
        if (!alone.judged())
            throw InputError(fmt::format("{} cannot be judged: none of its realizations agrees with the observed "
                                         "state.\n  `stylobate report {}` names the nearest one and what to do.",
                                         one.file, one.file));
        combined.files.push_back(one.file);
        combined.alone.push_back(alone.past->by_events.front());
    }
    const std::size_t motions = first.counts.motions().size();
    const auto share = [&](std::size_t m) -> std::optional<double> {
        std::vector<MotionTally> site;
        for (const StructurePast& one : structures)
            site.push_back(one.counts.motions()[m]);
        if (std::any_of(site.begin(), site.end(), [](const MotionTally& tally) { return tally.valid == 0; }))
            return {};
        return site_share(site);
    };
    for (std::size_t m = 0; m < motions; ++m) {
        combined.agree += share(m).value_or(0) > 0;
        combined.motions += share(m).has_value();
    }
    if (combined.agree == 0)
        throw InputError("no past of these axes agrees with all of the structures: under no motion has each of them a "
                         "realization that agrees.\n  Run more realizations, wider axes or more events; or the "
                         "structures were not shaken by the same events.");
    const std::vector<CellCount> together =
        cell_means(combined.axes.cells(), motions, static_cast<double>(first.study.realizations), share);
    const SiteStates site = site_states(structures);
    std::vector<double> trials;
    for (const CellCount& cell : cell_means(combined.axes.cells(), motions * spec.per_motion, 1e300, [](std::size_t) {
             return std::optional(0.0); // of each realization
         }))
        trials.push_back(cell.trials);
    const MonumentJudgement monuments =
        judge_monuments(combined.axes, trials, site.standing, site.measured, spec, first.study.seed);
    combined.sites = monuments.test;
    combined.coverage = monuments.thresholds.front().coverage;
    combined.together = past_answer(past_likelihood(combined.axes, together, first.study.seed, PastUse::means),
                                    monuments.thresholds, prior_density(spec), spec.level);
    return combined;
}

std::string combined_text(const CombinedPast& c)
{
    Document page(fmt::format("{} structures of one site: under {} of {} motions a structure of each agrees",
                              c.files.size(), c.agree, c.motions));
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < c.files.size(); ++k)
        lines.push_back(
            fmt::format("{}, 1 event: {}", c.files[k], exclusion_words(c.alone[k], c.prior, c.level, c.axes)));
    for (const std::string& line : exclusions_words(c.together.by_events, c.prior, c.level, c.axes))
        lines.push_back("together, " + line);
    lines.push_back(threshold_words(c.together.by_events.front().rule, c.level));
    for (const std::string& line : posterior_words(c.together.posterior, c.axes, c.level))
        lines.push_back(line);
    for (const std::string& line : coverage_words(c.coverage, c.axes))
        lines.push_back("simulated sites: " + line);
    if (c.sites)
        for (const std::string& line : monument_words(*c.sites, c.level, c.axes.events > 1))
            lines.push_back("simulated sites: " + line);
    page.list({lines.begin(), lines.end()});
    return console_text(page) + left_out_text(c.dimensions) + "\n";
}

Json combined_json(const CombinedPast& c)
{
    Json alone = Json::list();
    for (std::size_t k = 0; k < c.files.size(); ++k)
        alone.item(Json::object().member("file", c.files[k]).member("exclusion", exclusion_json(c.alone[k])));
    Json json = Json::object();
    json.member("prior", c.prior)
        .member("left_out", left_out_text(c.dimensions))
        .member("level", c.level)
        .member("structures", alone)
        .member("together_by_events", json_list(c.together.by_events, exclusion_json))
        .member("posterior", posterior_json(c.together.posterior, c.axes));
    if (!c.coverage.empty())
        json.member("exclusion_coverage", coverage_json(c.coverage, c.axes));
    if (c.sites)
        json.member("sites", monuments_json(*c.sites, c.level));
    return json;
}

Figure combined_figure(const CombinedPast& c)
{
    Figure figure;
    figure.title = "Shaking that several structures exclude";
    figure.x_label = "peak ground acceleration [m/s²]";
    figure.y_label = "likelihood / largest likelihood";
    figure.x_log = c.axes.intensity.back() > 4 * c.axes.intensity.front();
    for (std::size_t k = 0; k < c.files.size(); ++k)
        figure.series.push_back(likelihood_series(c.files[k], c.axes.intensity, c.alone[k]));
    figure.series.push_back(likelihood_series("together", c.axes.intensity, c.together.by_events.front()));
    figure.series.push_back(threshold_series(c.axes.intensity, c.together.by_events.front()));
    return figure;
}

} // namespace stylobate

#include "studies/kinds/survival/combined_past.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/kinds/survival/survival_text.hpp"

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
    if (other.axes.frequency_hz != first.axes.frequency_hz || other.axes.intensity != first.axes.intensity)
        refuse("other axes", "Structures of one site are compared over the same frequencies and PGAs: run them with "
                             "the same [surface].");
    if (other.axes.events != first.axes.events)
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
    combined.axes = first.axes;
    combined.prior = prior_words(spec, first.axes.intensity);
    combined.level = spec.level;
    const PriorDensity prior = prior_density(spec);
    std::vector<PastLikelihood> likelihoods;
    for (std::size_t k = 0; k < structures.size(); ++k) {
        const StructurePast& one = structures[k];
        check_alike(first, one);
        if (std::all_of(one.agreeing.begin(), one.agreeing.end(),
                        [](const CellCount& cell) { return cell.successes == 0; }))
            throw InputError(fmt::format("{} cannot be judged: none of its realizations agrees with the observed "
                                         "state.\n  `stylobate report {}` names the nearest one and what to do.",
                                         one.file, one.file));
        combined.files.push_back(one.file);
        // each structure draws by itself, whatever its seed
        likelihoods.push_back(
            past_likelihood(one.axes, one.agreeing, one.study.seed, PastUse::means, std::uint64_t{k} << 32));
        combined.alone.push_back(exclusion(likelihoods.back(), 1, prior, spec.level));
    }
    const PastLikelihood all = product(likelihoods);
    bool some = false;
    for (std::size_t cell = 0; cell < all.value.size(); ++cell)
        some = some || std::all_of(structures.begin(), structures.end(),
                                   [&](const StructurePast& one) { return one.agreeing[cell].successes > 0; });
    if (!some)
        throw InputError("no past of these axes agrees with all of the structures: in no cell has each of them a "
                         "realization that agrees.\n  Run more realizations, wider axes or more events; or the "
                         "structures were not shaken by the same events.");
    for (std::size_t events = 1; events <= all.axes.events; ++events)
        combined.together.push_back(exclusion(all, events, prior, spec.level));
    combined.posterior = past_posterior(all, prior, spec.level);
    return combined;
}

std::string combined_text(const CombinedPast& c)
{
    std::string text = fmt::format("{} structures that were shaken by the same events and responded independently; "
                                   "mean over the frequencies\n",
                                   c.files.size());
    const double end = c.axes.intensity.back();
    for (std::size_t k = 0; k < c.files.size(); ++k)
        text += fmt::format("  {}, 1 event: {}\n", c.files[k], exclusion_words(c.alone[k], c.prior, c.level, end));
    for (std::size_t e = 0; e < c.together.size(); ++e)
        text += fmt::format("  together, {}: {}\n", e == 0 ? "1 event" : fmt::format("{} equal events", e + 1),
                            exclusion_words(c.together[e], c.prior, c.level, end));
    return text + posterior_words(c.posterior, c.axes, c.level);
}

Json combined_json(const CombinedPast& c)
{
    Json alone = Json::list(), together = Json::list();
    for (std::size_t k = 0; k < c.files.size(); ++k)
        alone.item(Json::object().member("file", c.files[k]).member("exclusion", exclusion_json(c.alone[k])));
    for (const Exclusion& e : c.together)
        together.item(exclusion_json(e));
    return Json::object()
        .member("prior", c.prior)
        .member("level", c.level)
        .member("structures", alone)
        .member("together_by_events", together)
        .member("posterior", posterior_json(c.posterior, c.axes));
}

Figure combined_figure(const CombinedPast& c)
{
    Figure figure;
    figure.title = "Shaking that several structures exclude";
    figure.x_label = "peak ground acceleration [m/s²]";
    figure.y_label = "likelihood / largest likelihood";
    figure.x_log = c.axes.intensity.back() > 4 * c.axes.intensity.front();
    const auto add = [&](const std::string& name, const Exclusion& exclusion) {
        double most = 0;
        for (const PastEstimate& at : exclusion.likelihood)
            most = std::max(most, at.value);
        FigureSeries series{name, SeriesKind::line, c.axes.intensity, {}, {}, {}};
        for (const PastEstimate& at : exclusion.likelihood) {
            series.y.push_back(at.value / most);
            series.low.push_back(at.lower / most);
            series.high.push_back(at.upper / most);
        }
        if (most > 0)
            figure.series.push_back(std::move(series));
    };
    for (std::size_t k = 0; k < c.files.size(); ++k)
        add(c.files[k], c.alone[k]);
    add("together", c.together.front());
    const double threshold = c.together.front().threshold;
    figure.series.push_back({fmt::format("threshold {:.3g}", threshold),
                             SeriesKind::line,
                             {c.axes.intensity.front(), c.axes.intensity.back()},
                             {threshold, threshold},
                             {},
                             {}});
    return figure;
}

} // namespace stylobate

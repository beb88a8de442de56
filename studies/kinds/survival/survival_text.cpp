#include "studies/kinds/survival/survival_text.hpp"

#include "studies/experiment/limit_state.hpp"
#include "studies/kinds/survival/survival_picture.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

Json estimate_json(const PastEstimate& e)
{
    return Json::object().member("value", e.value).member("lower", e.lower).member("upper", e.upper);
}

std::string agreeing_words(const Survival& s)
{
    return s.state_measured ? fmt::format("{} of {} valid realizations stand; {} agree with the observed state within "
                                          "its tolerance{}{}",
                                          s.stand, s.valid, s.agree, s.measured.mirrored ? ", or mirrored" : "",
                                          s.moving > 0 ? fmt::format("; {} of these still moved at the end", s.moving)
                                                       : std::string())
                            : fmt::format("{} of {} valid realizations stand; the only observation is that it stands",
                                          s.stand, s.valid);
}

std::string events_word(std::size_t events)
{
    return events == 1 ? "1 event" : fmt::format("{} equal events", events);
}

/// The PGA that one event of a frequency excludes.
std::string frequency_words(const Survival& s, std::size_t f)
{
    const std::size_t ni = s.axes.intensity.size();
    const Exclusion& e = s.by_frequency[f];
    if (std::all_of(s.agreeing.begin() + static_cast<std::ptrdiff_t>(f * ni),
                    s.agreeing.begin() + static_cast<std::ptrdiff_t>((f + 1) * ni),
                    [](std::uint64_t agreeing) { return agreeing == 0; }))
        return "no realization agrees at any PGA";
    if (!e.excludes())
        return "no PGA is excluded as too strong";
    return fmt::format("PGA above {} is excluded by the likelihood, above {} with the prior",
                       estimate_words(e.by_likelihood), estimate_words(e.by_posterior));
}

Json nearest_json(const Survival& s)
{
    return Json::object()
        .member("realization", s.nearest->index)
        .member("distance_in_tolerances", s.nearest->distance)
        .member("value", s.names[s.nearest->worst])
        .member("found", s.nearest->found)
        .member("observed", s.measured.value[s.nearest->worst])
        .member("tolerance", s.measured.tolerance[s.nearest->worst]);
}

} // namespace

std::string survival_text(const Survival& s)
{
    if (s.axes.intensity.empty())
        return {};
    std::string text = "  " + agreeing_words(s) + "\n";
    if (!s.judged()) {
        text += "  the past " + not_judged_words(s) + "\n";
    } else {
        for (std::size_t e = 0; e < s.past->by_events.size(); ++e)
            text += fmt::format("  {}: {}\n", events_word(e + 1),
                                exclusion_words(s.past->by_events[e], s.prior, s.level, s.axes));
        text += "  " + threshold_words(s.past->by_events.front().rule, s.level) + "\n";
        for (std::size_t f = 0; f < s.by_frequency.size(); ++f)
            text += fmt::format("    1 event at {:.3g} Hz: {}\n", s.axes.frequency_hz[f], frequency_words(s, f));
        text += posterior_words(s.past->posterior, s.axes, s.level);
        if (s.alike)
            text += fmt::format("  {}, 1 event: {}\n{}", alike_words(s.built, s.standing_alike),
                                exclusion_words(s.alike->by_events.front(), s.prior, s.level, s.axes),
                                posterior_words(s.alike->posterior, s.axes, s.level));
    }
    for (const std::string& line : coverage_words(s.coverage, s.axes))
        text += "  simulated monuments: " + line + "\n";
    if (s.monuments)
        for (const std::string& line : monument_words(*s.monuments, s.level, s.axes.events > 1))
            text += "  simulated monuments: " + line + "\n";
    if (s.rates)
        for (const std::string& line : rates_words(s))
            text += "  " + line + "\n";
    return text;
}

Json exclusion_json(const Exclusion& e)
{
    return Json::object()
        .member("excludes", e.excludes())
        .member("surely", e.surely())
        .member("threshold", Json::brief(e.rule.part))
        .member("threshold_of", e.rule.absolute ? "likelihood" : "likelihood / largest likelihood")
        .member("calibrated", e.rule.calibrated)
        .member("open_below", e.open_below())
        .member("open_above", e.open_above())
        .member("ratio_at_end_of_axis", estimate_json(e.top_ratio))
        .member("by_likelihood_m_s2", estimate_json(e.by_likelihood))
        .member("by_profile_m_s2", estimate_json(e.by_profile))
        .member("ratio_at_lowest_frequency", estimate_json(e.lowest_frequency))
        .member("ratio_at_highest_frequency", estimate_json(e.highest_frequency))
        .member("by_posterior_m_s2", estimate_json(e.by_posterior))
        .member("by_prior_m_s2", e.by_prior)
        .member("weaker_m_s2", estimate_json(e.weaker));
}

Json coverage_json(const std::vector<ExclusionCoverage>& coverage, const PastAxes& axes)
{
    Json all = Json::list();
    for (std::size_t i = 0; i < coverage.size(); ++i)
        all.item(Json::object()
                     .member("pga_m_s2", axes.intensity[i])
                     .member("monuments", coverage[i].monuments)
                     .member("excluded", coverage[i].excluded)
                     .member("excluded_by_asymptotic_threshold", coverage[i].asymptotic));
    return all;
}

Json posterior_json(const PastPosterior& p, const PastAxes& axes)
{
    const std::size_t ni = axes.intensity.size(), cell = p.best % axes.cells_of_one();
    Json events = Json::list(), frequencies = Json::list();
    for (std::size_t e = 0; e < p.events.size(); ++e)
        events.item(Json::object().member("events", e + 1).member("probability", estimate_json(p.events[e])));
    for (std::size_t f = 0; f < p.frequency.size(); ++f)
        frequencies.item(Json::object()
                             .member("frequency_hz", axes.frequency_hz[f])
                             .member("probability", estimate_json(p.frequency[f])));
    return Json::object()
        .member("most_probable", Json::object()
                                     .member("events", p.best / axes.cells_of_one() + 1)
                                     .member("frequency_hz", axes.frequency_hz[cell / ni])
                                     .member("pga_m_s2", axes.intensity[cell % ni])
                                     .member("probability", estimate_json(p.best_probability)))
        .member("evidence", estimate_json(p.evidence))
        .member("pga_median_m_s2", estimate_json(p.intensity_median))
        .member("pga_credible_from_m_s2", estimate_json(p.intensity_lower))
        .member("pga_credible_to_m_s2", estimate_json(p.intensity_upper))
        .member("events", events)
        .member("frequencies", frequencies);
}

Json monuments_json(const MonumentTest& monuments, double level)
{
    const auto test = [&](const std::vector<double>& u) {
        const Share share = share_of(u.size(), MonumentTest::inside(u, level));
        return Json::object()
            .member("level", level)
            .member("monuments", share.trials)
            .member("contained", share.count)
            .member("lower", share.lower)
            .member("upper", share.upper);
    };
    return Json::object()
        .member("not_judged", monuments.not_judged)
        .member("pga", test(monuments.intensity))
        .member("frequency", test(monuments.frequency))
        .member("events", test(monuments.events));
}

Json survival_json(const Survival& s)
{
    Json json = Json::object();
    json.member("valid", s.valid)
        .member("standing", s.stand)
        .member("agreeing", s.agree)
        .member("agreeing_still_moving", s.moving)
        .member("state_measured", s.state_measured)
        .member("judged", s.judged())
        .member("prior", s.prior)
        .member("level", s.level);
    if (s.nearest)
        json.member("nearest", nearest_json(s));
    if (!s.judged()) {
        json.member("why_not_judged", not_judged_words(s));
    } else {
        Json events = Json::list(), frequencies = Json::list();
        for (const Exclusion& e : s.past->by_events)
            events.item(exclusion_json(e));
        for (const Exclusion& e : s.by_frequency)
            frequencies.item(exclusion_json(e));
        json.member("exclusion_by_events", events)
            .member("exclusion_by_frequency", frequencies)
            .member("posterior", posterior_json(s.past->posterior, s.axes));
        if (s.alike) {
            Json alike = Json::list();
            for (const Exclusion& e : s.alike->by_events)
                alike.item(exclusion_json(e));
            json.member("built_alike", Json::object()
                                           .member("built", s.built)
                                           .member("standing", s.standing_alike)
                                           .member("exclusion_by_events", alike)
                                           .member("posterior", posterior_json(s.alike->posterior, s.axes)));
        }
        if (!s.coverage.empty())
            json.member("exclusion_coverage", coverage_json(s.coverage, s.axes));
    }
    if (s.monuments)
        json.member("monuments", monuments_json(*s.monuments, s.level));
    if (s.rates)
        json.member("rates", Json::object()
                                 .member("years", s.years)
                                 .member("sigma_ln", s.sigma_ln)
                                 .member("collapse_rate_per_year", estimate_json(s.rates->collapse_rate))
                                 .member("stands_probability", estimate_json(s.rates->stands))
                                 .member("factor_median", estimate_json(s.rates->factor_median))
                                 .member("factor_credible_from", estimate_json(s.rates->factor_lower))
                                 .member("factor_credible_to", estimate_json(s.rates->factor_upper))
                                 .member("alike_factor_median", estimate_json(s.rates->alike_median))
                                 .member("alike_factor_credible_from", estimate_json(s.rates->alike_lower))
                                 .member("alike_factor_credible_to", estimate_json(s.rates->alike_upper)));
    return json;
}

void survival_section(const Survival& s, PageWriter& writer)
{
    HtmlPage& page = writer.page;
    page.section("The past of the structure");
    page.paragraph(agreeing_words(s) + ".");
    writer.picture(
        s.state_measured ? "The share of the realizations that end in the observed state, for each number of events. "
                           "Lines: probability of standing 5, 50 and 95 %."
                         : "The share of the realizations that stand, for each number of events.",
        [&](const std::filesystem::path& png) {
            plot_likelihood(s, s.state_measured ? "Likelihood of the observed state" : "Probability of standing", png);
        });
    if (!s.judged()) {
        page.box("warn", "Not judged", "The past " + not_judged_words(s) + ".");
    } else {
        page.heading("Excluded shaking");
        std::vector<Html> items;
        for (std::size_t e = 0; e < s.past->by_events.size(); ++e)
            items.emplace_back(events_word(e + 1) + ": " +
                               exclusion_words(s.past->by_events[e], s.prior, s.level, s.axes) + ".");
        if (s.alike)
            items.emplace_back(alike_words(s.built, s.standing_alike) + ", 1 event: " +
                               exclusion_words(s.alike->by_events.front(), s.prior, s.level, s.axes) + ".");
        items.emplace_back(threshold_words(s.past->by_events.front().rule, s.level) + ".");
        for (const std::string& line : coverage_words(s.coverage, s.axes))
            items.emplace_back("Simulated monuments: " + line + ".");
        page.list(items);
        page.figure(figure_svg(exclusion_figure(s)),
                    "The likelihood over the PGA, as a part of its largest value; bands: 95 % intervals of the counts. "
                    "The threshold is the ratio below which a PGA is excluded.");
        HtmlTable table{"rlr",
                        {"frequency [Hz]", "PGA [m/s²]", "probability [%]"},
                        {},
                        "What one event of each frequency excludes, and posterior probability of the frequency"};
        for (std::size_t f = 0; f < s.by_frequency.size(); ++f) {
            const PastEstimate& p = s.past->posterior.frequency[f];
            table.rows.push_back({fmt::format("{:.3g}", s.axes.frequency_hz[f]), frequency_words(s, f),
                                  estimate_words({100 * p.value, 100 * p.lower, 100 * p.upper})});
        }
        if (!table.rows.empty())
            page.table(table);
        page.heading("The most probable past");
        page.block(posterior_words(s.past->posterior, s.axes, s.level));
        if (s.alike)
            page.block("  " + alike_words(s.built, s.standing_alike) + ":\n" +
                       posterior_words(s.alike->posterior, s.axes, s.level));
    }
    if (s.monuments) {
        page.heading("Test on simulated monuments");
        std::vector<Html> items;
        for (const std::string& line : monument_words(*s.monuments, s.level, s.axes.events > 1))
            items.emplace_back(line + ".");
        page.list(items);
    }
    if (s.rates) {
        page.heading("The rates of the hazard curve");
        std::vector<Html> items;
        for (const std::string& line : rates_words(s))
            items.emplace_back(line + ".");
        page.list(items);
        page.figure(figure_svg(rates_figure(s)), "Density of the factor on all rates, before and after.");
    }
}

} // namespace stylobate

#include "studies/kinds/survival/survival_text.hpp"

#include "io/files/suggest.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace stylobate {

namespace {

std::string pga_words(double value)
{
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : std::isnan(value) ? "–" : "none";
}

std::string percent_words(const PastEstimate& e)
{
    return fmt::format("{:.3g} % ({:.3g} to {:.3g})", 100 * e.value, 100 * e.lower, 100 * e.upper);
}

} // namespace

std::string estimate_words(const PastEstimate& e)
{
    return fmt::format("{} ({} to {})", pga_words(e.value), pga_words(e.lower), pga_words(e.upper));
}

std::string not_judged_words(const Survival& s)
{
    std::string text = fmt::format("cannot be judged: none of the {} realizations that stand agrees with the observed "
                                   "state, which is not a likelihood of 0",
                                   s.stand);
    if (s.nearest) {
        const std::size_t ni = s.axes.intensity.size(), cell = s.nearest->cell % s.axes.cells_of_one();
        text += fmt::format(
            ". The nearest is realization {} ({} event{} of {:.3g} Hz, {:.3g} m/s2), {:.3g} tolerances away: {} is "
            "{:.3g}, observed {:.3g} +- {:.3g}",
            s.nearest->index, s.nearest->cell / s.axes.cells_of_one() + 1,
            s.nearest->cell < s.axes.cells_of_one() ? "" : "s", s.axes.frequency_hz[cell / ni],
            s.axes.intensity[cell % ni], s.nearest->distance, s.names[s.nearest->worst], s.nearest->found,
            s.measured.value[s.nearest->worst], s.measured.tolerance[s.nearest->worst]);
    }
    return text + ". Run more realizations, more events or wider axes; give the tolerance with which the original "
                  "state is known; check friction and imperfections of the model; or give only the joints that were "
                  "measured well (survival.observed.joints)";
}

std::string exclusion_words(const Exclusion& e, const std::string& prior, double level, const PastAxes& axes)
{
    const std::string weaker =
        e.weaker.value > 0 ? fmt::format("; PGA below {} m/s2 is excluded by the likelihood: it is too weak for the "
                                         "state",
                                         estimate_words(e.weaker))
                           : std::string();
    std::string text;
    const std::vector<double>& f = axes.frequency_hz;
    const auto open = [&](double frequency, const char* end, const PastEstimate& ratio) {
        text += fmt::format("{}at {:.3g} Hz, the {} end of the axis, the likelihood is still {} of its largest value",
                            text.empty() ? "no PGA is excluded for shaking of any frequency: " : ", and ", frequency,
                            end, estimate_words(ratio));
    };
    if (e.open_below())
        open(f.front(), "lower", e.lowest_frequency);
    if (e.open_above())
        open(f.back(), "upper", e.highest_frequency);
    if (!text.empty())
        text += fmt::format(". Among frequencies from {:.3g} to {:.3g} Hz: ", f.front(), f.back());
    if (!e.excludes())
        return text +
               fmt::format("no PGA up to {:.3g} m/s2 can be excluded as too strong: there the likelihood is still {} "
                           "of its largest value; exclusion needs less than {:.3g}{}",
                           axes.intensity.back(), estimate_words(e.top_ratio), e.rule.part.back(),
                           e.rule.absolute ? " itself" : "") +
               weaker;
    text += fmt::format("excluded at {:g} %: PGA above {} m/s2 by the likelihood", 100 * level,
                        estimate_words(e.by_likelihood));
    if (f.size() > 1 && e.open_from < 1)
        text += fmt::format(", its mean with a prior flat in ln f from {:.3g} to {:.3g} Hz; above {} by its largest "
                            "value over the frequencies",
                            f.front(), f.back(), estimate_words(e.by_profile));
    text += fmt::format("; above {} with the prior {}, whose own quantile is {:.3g}", estimate_words(e.by_posterior),
                        prior, e.by_prior);
    text += weaker;
    if (!e.surely())
        text += fmt::format("; in {} of {} draws of the counts nothing is excluded: run more realizations",
                            e.drawn - e.drawn_with_limit, e.drawn);
    return text;
}

std::vector<std::string> exclusions_words(const std::vector<Exclusion>& by_events, const std::string& prior,
                                          double level, const PastAxes& axes)
{
    std::vector<std::string> lines;
    for (std::size_t e = 0; e < by_events.size(); ++e)
        lines.push_back(fmt::format("{}: {}", e == 0 ? "1 event" : fmt::format("{} equal events", e + 1),
                                    exclusion_words(by_events[e], prior, level, axes)));
    return lines;
}

std::string threshold_words(const ExclusionRule& rule, double level)
{
    if (rule.absolute)
        return fmt::format("excluded is shaking under which a structure stands with a probability below {:.3g}",
                           1 - level);
    const auto [least, most] = std::minmax_element(rule.part.begin(), rule.part.end());
    if (!rule.calibrated)
        return fmt::format("excluded is shaking whose likelihood is below {:.3g} of the largest one, which holds for "
                           "many observations (Wilks) and was not calibrated for this one",
                           *most);
    return fmt::format("excluded is shaking whose likelihood is below {:.2g} to {:.2g} of the largest one, by the PGA: "
                       "calibrated on simulated monuments",
                       *least, *most);
}

std::vector<std::string> coverage_words(const std::vector<ExclusionCoverage>& coverage, const PastAxes& axes)
{
    std::size_t all = 0, wrong = 0, asymptotic = 0, worst = 0;
    const auto share = [](const ExclusionCoverage& at, std::size_t ExclusionCoverage::*part) {
        return share_of(at.monuments, at.*part);
    };
    for (std::size_t i = 0; i < coverage.size(); ++i) {
        all += coverage[i].monuments;
        wrong += coverage[i].excluded;
        asymptotic += coverage[i].asymptotic;
        if (coverage[i].monuments > 0 &&
            (coverage[worst].monuments == 0 || share(coverage[i], &ExclusionCoverage::excluded).probability >
                                                   share(coverage[worst], &ExclusionCoverage::excluded).probability))
            worst = i;
    }
    if (all == 0)
        return {};
    const auto percent = [](const Share& s) { return percent_words({s.probability, s.lower, s.upper}); };
    const Share at_worst = share(coverage[worst], &ExclusionCoverage::excluded);
    return {fmt::format("the true PGA is excluded in {} of {}, {}; most often at {:.3g} m/s2, {}; by the threshold for "
                        "many observations it would be in {}",
                        wrong, all, percent(share_of(all, wrong)), axes.intensity[worst], percent(at_worst),
                        percent(share_of(all, asymptotic)))};
}

std::string alike_words(std::uint64_t built, std::uint64_t standing)
{
    return fmt::format("given that {} of {} that were built alike stand{}", standing, built,
                       standing > 1 ? ", this one among them" : "");
}

std::vector<std::string> posterior_words(const PastPosterior& p, const PastAxes& axes, double level)
{
    const std::size_t ni = axes.intensity.size(), cell = p.best % axes.cells_of_one();
    std::vector<std::string> lines = {
        fmt::format("most probable past: {} of {:.3g} Hz, {:.3g} m/s2: probability of this cell {}",
                    counted(p.best / axes.cells_of_one() + 1, "event"), axes.frequency_hz[cell / ni],
                    axes.intensity[cell % ni], percent_words(p.best_probability)),
        fmt::format("PGA of the past: median {} m/s2; {:g} % credible interval: {} to {}",
                    estimate_words(p.intensity_median), 100 * level, estimate_words(p.intensity_lower),
                    estimate_words(p.intensity_upper)),
        fmt::format("evidence (mean likelihood under the prior; its ratio compares studies of other motions): {}",
                    estimate_words(p.evidence))};
    const auto shares = [&](const char* what, const std::vector<PastEstimate>& of, const auto& name) {
        std::string line;
        for (std::size_t i = 0; i < of.size(); ++i)
            line += fmt::format("{}{} {}", i == 0 ? "" : ", ", name(i), percent_words(of[i]));
        if (of.size() > 1)
            lines.push_back(what + line);
    };
    shares("probability of the frequencies: ", p.frequency,
           [&](std::size_t i) { return fmt::format("{:.3g} Hz", axes.frequency_hz[i]); });
    shares("probability of the number of events: ", p.events, [](std::size_t i) { return fmt::format("{}:", i + 1); });
    return lines;
}

std::vector<std::string> monument_words(const MonumentTest& test, double level, bool events)
{
    std::vector<std::string> lines;
    const auto add = [&](const char* what, const std::vector<double>& u) {
        std::string line;
        for (const double each : {0.5, level}) {
            const Share share = share_of(u.size(), MonumentTest::inside(u, each));
            line += fmt::format("{}{:g} % intervals of {} contain the true value in {} of {}, {:.3g} % ({:.3g} to "
                                "{:.3g})",
                                line.empty() ? "" : "; ", 100 * each, what, share.count, share.trials,
                                100 * share.probability, 100 * share.lower, 100 * share.upper);
        }
        lines.push_back(line);
    };
    if (!test.intensity.empty()) {
        add("PGA", test.intensity);
        add("frequency", test.frequency);
        if (events)
            add("the number of events", test.events);
    }
    if (test.not_judged > 0 || test.intensity.empty())
        lines.push_back(fmt::format("{} simulated monuments cannot be judged: no other realization agrees with them",
                                    test.not_judged));
    return lines;
}

std::vector<std::string> rates_words(const Survival& s)
{
    const HazardUpdate& r = *s.rates;
    std::vector<std::string> lines = {
        fmt::format("under the hazard curve as given it collapses at a rate of {} per year, and stands for {:g} years "
                    "with a probability of {}",
                    estimate_words(r.collapse_rate), s.years, percent_words(r.stands)),
        fmt::format("factor on all rates, given that it stands and was chosen before its fate was known: median {}; "
                    "{:g} % credible interval: {} to {} (prior: lognormal, median 1, sigma {:g}, from {:.3g} to "
                    "{:.3g})",
                    estimate_words(r.factor_median), 100 * s.level, estimate_words(r.factor_lower),
                    estimate_words(r.factor_upper), s.sigma_ln, r.prior_lower, r.prior_upper)};
    if (s.built > 1)
        lines.push_back(fmt::format("factor on all rates, {}: median {}; {:g} % credible interval: {} to {}",
                                    alike_words(s.built, s.standing_alike), estimate_words(r.alike_median),
                                    100 * s.level, estimate_words(r.alike_lower), estimate_words(r.alike_upper)));
    else
        lines.push_back("a structure that is considered because it still stands, while others fell, says less of the "
                        "rates: give survival.built and survival.standing");
    if (r.beyond.upper > 0.1)
        lines.push_back(fmt::format("{} of the rate of collapse comes from PGA beyond {:.3g} m/s2, where the "
                                    "probability is taken as at the end of the axis: extend the axis",
                                    percent_words(r.beyond), s.axes.intensity.back()));
    if (s.hazard_points && r.beyond_hazard.upper > 0.1)
        lines.push_back(fmt::format("{} of the rate of collapse comes from PGA outside of the points of the hazard "
                                    "curve, {:.3g} to {:.3g} m/s2, where its power laws are continued: give it over a "
                                    "wider range",
                                    percent_words(r.beyond_hazard), s.hazard_points->from, s.hazard_points->to));
    if (r.at_begin.value > 0)
        lines.push_back(fmt::format("at the beginning of the axis {} collapse already, and weaker shaking is counted "
                                    "as harmless: the rate is too small; begin the axis lower",
                                    percent_words(r.at_begin)));
    return lines;
}

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
        json.member("exclusion_by_events", json_list(s.past->by_events, exclusion_json))
            .member("exclusion_by_frequency", json_list(s.by_frequency, exclusion_json))
            .member("posterior", posterior_json(s.past->posterior, s.axes));
        if (s.alike)
            json.member("built_alike", Json::object()
                                           .member("built", s.built)
                                           .member("standing", s.standing_alike)
                                           .member("exclusion_by_events", json_list(s.alike->by_events, exclusion_json))
                                           .member("posterior", posterior_json(s.alike->posterior, s.axes)));
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

namespace {

/// With a capital and a full stop.
std::string sentence(std::string text)
{
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text + ".";
}

std::vector<Html> sentences(const std::vector<std::string>& lines)
{
    std::vector<Html> items;
    for (const std::string& line : lines)
        items.emplace_back(sentence(line));
    return items;
}

} // namespace

Answer survival_answer(const Survival& s)
{
    if (!s.judged())
        return {"The past of the structure is not judged.", "The past " + not_judged_words(s) + "."};
    const PastPosterior& p = s.past->posterior;
    return {fmt::format("The PGA of the past was {:.3g} to {:.3g} m/s² ({:g} % credible interval).",
                        p.intensity_lower.value, p.intensity_upper.value, 100 * s.level),
            fmt::format("Median {:.3g} m/s². {}.", p.intensity_median.value, agreeing_words(s))};
}

void survival_section(const Survival& s, PageWriter& writer)
{
    Document& page = writer.page;
    page.section("The past of the structure");
    page.paragraph(sentence(agreeing_words(s)));
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
        std::vector<std::string> lines = exclusions_words(s.past->by_events, s.prior, s.level, s.axes);
        if (s.alike)
            lines.push_back(alike_words(s.built, s.standing_alike) +
                            ", 1 event: " + exclusion_words(s.alike->by_events.front(), s.prior, s.level, s.axes));
        lines.push_back(threshold_words(s.past->by_events.front().rule, s.level));
        for (const std::string& line : coverage_words(s.coverage, s.axes))
            lines.push_back("simulated monuments: " + line);
        page.list(sentences(lines));
        page.figure(
            figure_svg(exclusion_figure(s)),
            "The likelihood over the PGA, as a part of its largest value; bands: 95 % intervals of the counts. "
            "The threshold is the ratio below which a PGA is excluded. The legend switches the numbers of events "
            "on and off.");
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
        page.list(sentences(posterior_words(s.past->posterior, s.axes, s.level)));
        if (s.alike) {
            page.paragraph(sentence(alike_words(s.built, s.standing_alike)));
            page.list(sentences(posterior_words(s.alike->posterior, s.axes, s.level)));
        }
    }
    if (s.monuments) {
        page.heading("Test on simulated monuments");
        page.list(sentences(monument_words(*s.monuments, s.level, s.axes.events > 1)));
    }
    if (s.rates) {
        page.heading("The rates of the hazard curve");
        page.list(sentences(rates_words(s)));
        page.figure(figure_svg(rates_figure(s)), "Density of the factor on all rates, before and after.");
    }
}

std::string survival_text(const Survival& s)
{
    if (s.axes.intensity.empty())
        return {};
    Document page;
    PageWriter writer{page, [](const std::string&, const auto&) {}};
    survival_section(s, writer);
    return console_text(page);
}

} // namespace stylobate

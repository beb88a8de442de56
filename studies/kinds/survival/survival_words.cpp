/// The sentences of a survival study.

#include "studies/experiment/limit_state.hpp"
#include "studies/kinds/survival/survival_text.hpp"

#include <fmt/format.h>

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

std::string exclusion_words(const Exclusion& e, const std::string& prior, double level, double axis_end)
{
    const std::string weaker =
        e.weaker.value > 0 ? fmt::format("; PGA below {} m/s2 is excluded by the likelihood ratio: it is too weak for "
                                         "the state",
                                         estimate_words(e.weaker))
                           : std::string();
    if (!e.excludes())
        return fmt::format(
                   "no PGA up to {:.3g} m/s2 can be excluded as too strong: there the likelihood is still {} of "
                   "its largest value; exclusion needs less than {:.3g}",
                   axis_end, estimate_words(e.top_ratio), e.threshold) +
               weaker;
    std::string text = fmt::format(
        "excluded at {:g} %: PGA above {} m/s2 by the likelihood ratio; above {} with the prior {}, whose own quantile "
        "is {:.3g}",
        100 * level, estimate_words(e.by_likelihood), estimate_words(e.by_posterior), prior, e.by_prior);
    text += weaker;
    if (!e.surely())
        text += fmt::format("; in {} of {} draws of the counts nothing is excluded: run more realizations",
                            e.drawn - e.drawn_with_limit, e.drawn);
    return text;
}

std::string posterior_words(const PastPosterior& p, const PastAxes& axes, double level)
{
    const std::size_t ni = axes.intensity.size(), cell = p.best % axes.cells_of_one();
    std::string text = fmt::format(
        "  most probable past: {} event{} of {:.3g} Hz, {:.3g} m/s2: probability of this cell {}\n"
        "  PGA of the past: median {} m/s2; {:g} % credible interval: {} to {}\n",
        p.best / axes.cells_of_one() + 1, p.best < axes.cells_of_one() ? "" : "s", axes.frequency_hz[cell / ni],
        axes.intensity[cell % ni], percent_words(p.best_probability), estimate_words(p.intensity_median), 100 * level,
        estimate_words(p.intensity_lower), estimate_words(p.intensity_upper));
    text +=
        fmt::format("  evidence (mean likelihood under the prior; its ratio compares studies of other motions): {}\n",
                    estimate_words(p.evidence));
    if (p.frequency.size() > 1) {
        text += "  probability of the frequencies:";
        for (std::size_t f = 0; f < p.frequency.size(); ++f)
            text +=
                fmt::format("{} {:.3g} Hz {}", f == 0 ? "" : ",", axes.frequency_hz[f], percent_words(p.frequency[f]));
        text += "\n";
    }
    for (std::size_t e = 0; e < p.events.size() && p.events.size() > 1; ++e)
        text += fmt::format("  probability of {} event{}: {}\n", e + 1, e == 0 ? "" : "s", percent_words(p.events[e]));
    return text;
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
        fmt::format("factor on all rates, given that it stands: median {}; {:g} % credible interval: {} to {} "
                    "(prior: lognormal, median 1, sigma {:g}, from {:.3g} to {:.3g})",
                    estimate_words(r.factor_median), 100 * s.level, estimate_words(r.factor_lower),
                    estimate_words(r.factor_upper), s.sigma_ln, r.prior_lower, r.prior_upper)};
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

} // namespace stylobate

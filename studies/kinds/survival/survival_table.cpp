#include "studies/kinds/survival/survival_text.hpp"

#include "io/tables/table.hpp"
#include "studies/experiment/limit_state.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace {

void set(Table& table, const std::string& name, const PastEstimate& estimate)
{
    table.set(name, estimate.value);
    table.set(name + "_lower", estimate.lower);
    table.set(name + "_upper", estimate.upper);
}

IntervalArray intervals(const std::vector<PastEstimate>& estimates)
{
    IntervalArray array;
    for (const PastEstimate& e : estimates)
        array.add(e.value, e.lower, e.upper);
    return array;
}

void add_exclusions(Table& table, const std::string& name, const std::vector<Exclusion>& exclusions)
{
    std::vector<PastEstimate> by_likelihood, by_profile, by_posterior, top, weaker, lowest, highest;
    IntervalArray likelihood;
    std::vector<double> part;
    std::size_t ni = 0;
    for (const Exclusion& e : exclusions) {
        by_likelihood.push_back(e.by_likelihood);
        by_posterior.push_back(e.by_posterior);
        top.push_back(e.top_ratio);
        weaker.push_back(e.weaker);
        by_profile.push_back(e.by_profile);
        lowest.push_back(e.lowest_frequency);
        highest.push_back(e.highest_frequency);
        part.insert(part.end(), e.rule.part.begin(), e.rule.part.end());
        ni = e.likelihood.size();
        for (const PastEstimate& at : e.likelihood)
            likelihood.add(at.value, at.lower, at.upper);
    }
    const Table::Shape shape = {exclusions.size()};
    table.add(name + "_likelihood", likelihood, {exclusions.size(), ni});
    table.add(name + "_top_ratio", intervals(top), shape);
    table.add(name + "_excluded_by_likelihood_m_s2", intervals(by_likelihood), shape);
    table.add(name + "_excluded_by_posterior_m_s2", intervals(by_posterior), shape);
    table.add(name + "_excluded_below_m_s2", intervals(weaker), shape);
    table.add(name + "_threshold", part, {exclusions.size(), ni});
    if (name == "frequency")
        return;
    table.add(name + "_excluded_by_profile_m_s2", intervals(by_profile), shape);
    table.add(name + "_lowest_frequency_ratio", intervals(lowest), shape);
    table.add(name + "_highest_frequency_ratio", intervals(highest), shape);
}

} // namespace

Table survival_table(const Survival& s)
{
    Table table("survival");
    const Table::Shape cells = {s.axes.events, s.axes.frequency_hz.size(), s.axes.intensity.size()};
    table.set("prior", s.prior);
    table.set("level", s.level);
    table.set("judged", std::uint64_t{s.judged()});
    table.add("frequency_hz", s.axes.frequency_hz, {s.axes.frequency_hz.size()}, "Hz");
    table.add("pga_m_s2", s.axes.intensity, {s.axes.intensity.size()}, "m/s2");
    table.add("trials", s.trials, cells);
    table.add("standing", s.standing, cells);
    table.add("agreeing", s.agreeing, cells);
    IntervalArray likelihood;
    for (std::size_t c = 0; c < s.trials.size(); ++c) {
        const Share share = share_of(s.trials[c], s.agreeing[c]);
        likelihood.add(share.probability, share.lower, share.upper);
    }
    table.add("likelihood", likelihood, cells);
    if (s.nearest) {
        table.set("nearest_realization", s.nearest->index);
        table.set("nearest_distance", s.nearest->distance);
    }
    if (s.judged()) {
        table.set("threshold_of_likelihood_itself", std::uint64_t{s.past->by_events.front().rule.absolute});
        table.set("prior_quantile_m_s2", s.past->by_events.front().by_prior);
        add_exclusions(table, "events", s.past->by_events);
        if (s.alike)
            add_exclusions(table, "alike", s.alike->by_events);
        if (!s.by_frequency.empty())
            add_exclusions(table, "frequency", s.by_frequency);
        table.add("posterior", s.past->posterior.cells, cells);
        table.add("events_probability", intervals(s.past->posterior.events), {s.axes.events});
        table.add("frequency_probability", intervals(s.past->posterior.frequency), {s.axes.frequency_hz.size()});
        set(table, "evidence", s.past->posterior.evidence);
        set(table, "pga_median_m_s2", s.past->posterior.intensity_median);
        set(table, "pga_credible_from_m_s2", s.past->posterior.intensity_lower);
        set(table, "pga_credible_to_m_s2", s.past->posterior.intensity_upper);
    }
    if (!s.coverage.empty()) {
        std::vector<std::uint64_t> monuments, excluded, asymptotic;
        for (const ExclusionCoverage& at : s.coverage) {
            monuments.push_back(at.monuments);
            excluded.push_back(at.excluded);
            asymptotic.push_back(at.asymptotic);
        }
        table.add("coverage_monuments", monuments, {monuments.size()});
        table.add("coverage_excluded", excluded, {monuments.size()});
        table.add("coverage_excluded_by_asymptotic_threshold", asymptotic, {monuments.size()});
    }
    if (s.monuments) {
        table.set("monuments_not_judged", std::uint64_t{s.monuments->not_judged});
        const Table::Shape shape = {s.monuments->intensity.size()};
        if (!s.monuments->intensity.empty()) {
            table.add("monument_pga_place", s.monuments->intensity, shape);
            table.add("monument_frequency_place", s.monuments->frequency, shape);
            table.add("monument_events_place", s.monuments->events, shape);
        }
    }
    if (s.rates) {
        table.set("stands_for_years", s.years);
        table.set("sigma_ln", s.sigma_ln);
        set(table, "collapse_rate_per_year", s.rates->collapse_rate);
        set(table, "stands_probability", s.rates->stands);
        set(table, "rate_share_beyond_axis", s.rates->beyond);
        set(table, "rate_share_beyond_hazard", s.rates->beyond_hazard);
        set(table, "collapse_at_begin_of_axis", s.rates->at_begin);
        set(table, "factor_median", s.rates->factor_median);
        set(table, "factor_credible_from", s.rates->factor_lower);
        set(table, "factor_credible_to", s.rates->factor_upper);
        if (s.built > 1) {
            set(table, "alike_factor_median", s.rates->alike_median);
            set(table, "alike_factor_credible_from", s.rates->alike_lower);
            set(table, "alike_factor_credible_to", s.rates->alike_upper);
        }
    }
    return table;
}

std::string survival_csv(const Survival& s)
{
    std::string text = "events,frequency_hz,pga_m_s2,trials,standing,agreeing,likelihood,lower,upper,posterior\n";
    const std::size_t ni = s.axes.intensity.size(), of_one = s.axes.cells_of_one();
    for (std::size_t c = 0; c < s.agreeing.size(); ++c) {
        const Share share = share_of(s.trials[c], s.agreeing[c]);
        CsvRow row(text);
        row << c / of_one + 1 << s.axes.frequency_hz[c % of_one / ni] << s.axes.intensity[c % ni] << share.trials
            << s.standing[c] << share.count << share.probability << share.lower << share.upper;
        if (s.judged())
            row << s.past->posterior.cells[c];
        else
            row << "";
    }
    return text;
}

} // namespace stylobate

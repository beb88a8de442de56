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
    const auto over = [&](PastEstimate Exclusion::*estimate) {
        IntervalArray array;
        for (const Exclusion& e : exclusions)
            array.add((e.*estimate).value, (e.*estimate).lower, (e.*estimate).upper);
        return array;
    };
    IntervalArray likelihood;
    std::vector<double> part;
    for (const Exclusion& e : exclusions) {
        part.insert(part.end(), e.rule.part.begin(), e.rule.part.end());
        for (const PastEstimate& at : e.likelihood)
            likelihood.add(at.value, at.lower, at.upper);
    }
    const Table::Shape shape = {exclusions.size()}, places = {exclusions.size(), exclusions.front().likelihood.size()};
    table.add(name + "_likelihood", likelihood, places);
    table.add(name + "_top_ratio", over(&Exclusion::top_ratio), shape);
    table.add(name + "_excluded_by_likelihood_m_s2", over(&Exclusion::by_likelihood), shape);
    table.add(name + "_excluded_by_posterior_m_s2", over(&Exclusion::by_posterior), shape);
    table.add(name + "_excluded_below_m_s2", over(&Exclusion::weaker), shape);
    table.add(name + "_threshold", part, places);
    if (name == "frequency")
        return;
    table.add(name + "_excluded_by_profile_m_s2", over(&Exclusion::by_profile), shape);
    table.add(name + "_lowest_frequency_ratio", over(&Exclusion::lowest_frequency), shape);
    table.add(name + "_highest_frequency_ratio", over(&Exclusion::highest_frequency), shape);
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
        const auto add = [&](const char* name, std::size_t ExclusionCoverage::*count) {
            std::vector<std::uint64_t> counts;
            for (const ExclusionCoverage& at : s.coverage)
                counts.push_back(at.*count);
            table.add(name, counts, {counts.size()});
        };
        add("coverage_monuments", &ExclusionCoverage::monuments);
        add("coverage_excluded", &ExclusionCoverage::excluded);
        add("coverage_excluded_by_asymptotic_threshold", &ExclusionCoverage::asymptotic);
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

#include "studies/decisions/risk/risk_text.hpp"

#include "studies/experiment/conventions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

std::string part_text(double part)
{
    return std::isnan(part) ? "–" : fmt::format("{:.0f} %", 100 * part);
}

std::string table_text(const Risk& risk)
{
    std::string text = fmt::format("  {:<16} {:<10} {:<34}", "limit state", "fragility", "a year");
    for (const double years : risk.years)
        text += fmt::format(" {:<26}", fmt::format("in {:g} years", years));
    text += fmt::format(" {:<26} uncertainty due to fragility\n", mean_hazard_head(risk));
    for (const StateRisk* s : risk.chosen()) {
        text += fmt::format("  {:<16} {:<10} ", s->state, to_string(s->form));
        if (!s->determined) {
            text +=
                fmt::format("not determined; {} a year for any curve that rises\n", bounds_text(s->estimate.bounds));
            continue;
        }
        text += fmt::format("{:<34}", frequency_text(s->estimate.frequency));
        for (const double years : risk.years)
            text += fmt::format(" {:<26}", over_text(s->estimate.frequency, years));
        text +=
            fmt::format(" {:<26} {}\n", mean_hazard_text(risk, *s), part_text(s->estimate.frequency.fragility_part));
    }
    return text;
}

/// What the runs do not exclude where none reached the state: the only place that says so.
std::string unseen_text(const FrequencyEstimate& e)
{
    return e.unseen > 0
               ? fmt::format("  not excluded at intensities where no run reached it, and in no interval: {:.2g} "
                             "a year\n",
                             e.unseen)
               : std::string();
}

/// Where the frequency of the principal limit state comes from.
std::string parts_text(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    const FrequencyEstimate& e = s.estimate;
    if (!s.determined)
        return {};
    if (!(e.frequency.value > 0))
        return unseen_text(e);
    std::string text = fmt::format("Intensities that contribute to '{}', {} in {}:\n", s.state,
                                   short_measure(risk.hazard.measure), measure_unit(risk.hazard.measure));
    for (const FrequencyPart& part : e.parts)
        if (const double share = part.frequency.value / e.frequency.value; share >= 0.005)
            text += fmt::format("  {:<22} {:>4.0f} %   {} a year\n", range_text(part), 100 * share,
                                frequency_text(part.frequency));
    text += fmt::format("  from outside of the range of the runs: {:.2g} % below, {:.2g} % above; from outside of the "
                        "hazard's points: {:.2g} %\n",
                        100 * e.below, 100 * e.above, 100 * e.beyond_hazard);
    text += fmt::format("  any curve that rises, {}: {} a year\n",
                        s.form == FragilityForm::lognormal ? "and agrees with the fitted one within that range"
                                                           : "through the shares of the stripes",
                        bounds_text(e.bounds));
    return text + unseen_text(e);
}

std::string sequence_text(const SequenceRisk& s)
{
    const auto percent = [](const SequenceNumber& n) { return percent_text(n.value, n.limits); };
    std::string text = fmt::format("{} histories of {:g} years; {:.3g} earthquakes a year above {:.3g}, {} in all, at "
                                   "most {} in one history; {} runs\n",
                                   s.histories, s.years, s.events_a_year, s.threshold, s.events, s.most_events, s.runs);
    text += fmt::format("  fallen, damage carried along:      {}\n", percent(s.carried_share));
    text += fmt::format("  fallen, new in every earthquake:   {}\n", percent(s.fresh_share));
    text += fmt::format("  difference, paired:                {}\n", percent(s.difference));
    text += std::isfinite(s.ratio.limits.upper)
                ? fmt::format("  ratio, paired:                     {:.3g} ({:.3g} to {:.3g})\n", s.ratio.value,
                              s.ratio.limits.lower, s.ratio.limits.upper)
                : std::string("  ratio, paired:                     not determined: too few histories with a fall\n");
    text +=
        fmt::format("  by the fragility, new in each:     {}\n",
                    std::isnan(s.closed_form) ? "not determined" : percent_text(s.closed_form, s.closed_form_limits));
    text += fmt::format("  threshold: {}\n", s.threshold_says);
    if (s.checked > 0)
        text +=
            fmt::format("  with earthquakes down to {:.3g} in {} histories: {} fall that had stood, {} stand that had "
                        "fallen; difference {}{}\n",
                        s.checked_threshold, s.checked, s.then_fell, s.then_stood, percent(s.check_difference),
                        s.check_difference.limits.lower > 0 ? ": weaker earthquakes count, lower the threshold" : "");
    else
        text += "  the threshold is not checked: below it there are too many earthquakes\n";
    if (s.invalid > 0)
        text += fmt::format("  {} histories are left out: a realization was invalid\n", s.invalid);
    return text;
}

Json json_of(const RiskNumber& n)
{
    return Json::object()
        .member("value", n.value)
        .member("lower", n.total.lower)
        .member("upper", n.total.upper)
        .member("fragility_lower", n.fragility.lower)
        .member("fragility_upper", n.fragility.upper)
        .member("hazard_lower", n.hazard.lower)
        .member("hazard_upper", n.hazard.upper)
        .member("fragility_part", n.fragility_part);
}

Json json_of(const SequenceNumber& n)
{
    return Json::object().member("value", n.value).member("lower", n.limits.lower).member("upper", n.limits.upper);
}

Json json_of(const SequenceRisk& s)
{
    return Json::object()
        .member("years", s.years)
        .member("level", s.level)
        .member("histories", s.histories)
        .member("threshold", s.threshold)
        .member("events_1_year", s.events_a_year)
        .member("events", s.events)
        .member("histories_with_two_events", s.with_two)
        .member("fallen_carried", s.carried)
        .member("fallen_fresh", s.fresh)
        .member("fallen_both", s.both)
        .member("invalid", s.invalid)
        .member("runs", s.runs)
        .member("steps", s.steps)
        .member("carried", json_of(s.carried_share))
        .member("fresh", json_of(s.fresh_share))
        .member("difference", json_of(s.difference))
        .member("ratio", json_of(s.ratio))
        .member("closed_form", json_of(SequenceNumber{s.closed_form, s.closed_form_limits}))
        .member("checked", s.checked)
        .member("checked_threshold", s.checked_threshold)
        .member("then_fell", s.then_fell)
        .member("then_stood", s.then_stood)
        .member("check_difference", json_of(s.check_difference));
}

Json json_of(const StateRisk& s, const Risk& risk)
{
    const FrequencyEstimate& e = s.estimate;
    Json json = Json::object();
    json.member("state", s.state)
        .member("form", to_string(s.form))
        .member("chosen", s.chosen)
        .member("determined", s.determined)
        .member("note", s.note)
        .member("below", e.below)
        .member("above", e.above)
        .member("beyond_hazard", e.beyond_hazard)
        .member("lowest_1_year", e.bounds.lower)
        .member("highest_1_year", e.bounds.upper)
        .member("unseen_1_year", e.unseen);
    if (!s.determined)
        return json;
    json.member("frequency_1_year", json_of(e.frequency));
    Json over = Json::list(), parts = Json::list();
    Json by_mean = Json::list();
    for (const double years : risk.years) {
        Json one = Json::object(), mean = Json::object();
        one.member("years", years).member("probability", json_of(probability_over(e.frequency, years)));
        over.item(one);
        mean.member("years", years).member("probability", probability_over(e.by_mean_hazard, years));
        by_mean.item(mean);
    }
    Json mean_hazard = Json::object();
    mean_hazard.member("frequency_1_year", e.by_mean_hazard).member("over_years", by_mean);
    for (const FrequencyPart& part : e.parts) {
        Json one = Json::object();
        one.member("from", part.from).member("to", part.to).member("frequency_1_year", json_of(part.frequency));
        parts.item(one);
    }
    return json.member("over_years", over).member("mean_hazard", mean_hazard).member("disaggregation", parts);
}

} // namespace

std::string percent_text(double value, const Limits& limits)
{
    return fmt::format("{:.3g} % ({:.3g} to {:.3g})", 100 * value, 100 * limits.lower, 100 * limits.upper);
}

std::string over_text(const RiskNumber& frequency, double years)
{
    const RiskNumber p = probability_over(frequency, years);
    return percent_text(p.value, p.total);
}

std::string mean_hazard_head(const Risk& risk)
{
    return fmt::format("in {:g} years, mean hazard", risk.years.back());
}

std::string mean_hazard_text(const Risk& risk, const StateRisk& state)
{
    const double frequency = state.estimate.by_mean_hazard;
    return std::isnan(frequency) ? "–" : fmt::format("{:.3g} %", 100 * probability_over(frequency, risk.years.back()));
}

std::string hazard_text(const HazardModel& hazard)
{
    return hazard.site.empty() ? hazard.source : hazard.source + " at " + hazard.site;
}

std::string bounds_text(const Limits& bounds)
{
    const std::string low = fmt::format("{:.2g}", bounds.lower), high = fmt::format("{:.2g}", bounds.upper);
    return !std::isfinite(bounds.upper) ? "at least " + low : low == high ? low : low + " to " + high;
}

std::string frequency_text(const RiskNumber& number)
{
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", number.value, number.total.lower, number.total.upper);
}

std::string form_text(const Risk& risk, const StateRisk& state)
{
    std::string text = state.note;
    for (const StateRisk& other : risk.states)
        if (other.state == state.state && !other.chosen && other.determined)
            text +=
                fmt::format("; by {} it would be {} a year",
                            other.form == FragilityForm::shares ? "the shares of the stripes" : "the lognormal curve",
                            frequency_text(other.estimate.frequency));
    return text;
}

std::string range_text(const FrequencyPart& part)
{
    return part.from == 0        ? fmt::format("below {:.3g}", part.to)
           : std::isinf(part.to) ? fmt::format("above {:.3g}", part.from)
                                 : fmt::format("from {:.3g} to {:.3g}", part.from, part.to);
}

std::string risk_text(const Risk& risk)
{
    std::string text = fmt::format("{}: limit states of {} by the hazard {}, {:g} % intervals\n", risk.title,
                                   risk.fragility_file, hazard_text(risk.hazard), 100 * risk.level);
    text += "Each earthquake meets the structure as new; years are of a Poisson process.\n";
    if (const std::string conventions = conventions_text_of(risk.study_text); !conventions.empty())
        text += "conventions: " + conventions + "\n";
    if (!risk.hazard.fractiles.empty())
        text += "Values are by the best estimate of the hazard; the mean hazard is the mean over its fractiles.\n";
    text += table_text(risk) + parts_text(risk);
    for (const StateRisk* s : risk.chosen())
        text += fmt::format("{}: {}\n", s->state, form_text(risk, *s));
    if (risk.sequences)
        text += sequence_text(*risk.sequences);
    for (const std::string& remark : risk.says)
        text += "note: " + remark + "\n";
    return text;
}

Json risk_json(const Risk& risk)
{
    Json states = Json::list();
    for (const StateRisk& s : risk.states)
        states.item(json_of(s, risk));
    Json json = Json::object();
    json.member("fragility", risk.fragility_file)
        .member("hazard", risk.hazard.source)
        .member("site", risk.hazard.site)
        .member("measure", risk.hazard.measure)
        .member("level", risk.level)
        .member("conventions", conventions_text_of(risk.study_text))
        .member("states", states)
        .member("notes", Json::list(risk.says));
    if (risk.sequences)
        json.member("sequences", json_of(*risk.sequences));
    return json;
}

} // namespace stylobate

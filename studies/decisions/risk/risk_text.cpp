#include "studies/decisions/risk/risk_text.hpp"

#include "studies/experiment/conventions.hpp"
#include "studies/kinds/fragility/fragility.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

/// Pads the cells but the last one: the first is wider.
std::string padded(const std::vector<std::string>& cells)
{
    std::string text = fmt::format("{:<34}", cells.front());
    for (std::size_t i = 1; i + 1 < cells.size(); ++i)
        text += fmt::format(" {:<26}", cells[i]);
    return text + " " + cells.back() + "\n";
}

std::string table_text(const Risk& risk)
{
    std::string text = fmt::format("  {:<16} {:<10} ", "limit state", "fragility") + padded(risk_heads(risk));
    for (const StateRisk* s : risk.chosen())
        text += fmt::format("  {:<16} {:<10} ", s->state, to_string(s->form)) +
                (s->determined ? padded(risk_cells(risk, *s))
                               : fmt::format("not determined; {} a year for any curve that rises\n",
                                             bounds_text(s->estimate.bounds)));
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
    text += fmt::format("  by the fragility, new in each:     {}\n",
                        std::isnan(s.closed_form.value) ? "not determined" : percent(s.closed_form));
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

Json sequences_json(const SequenceRisk& s)
{
    return json_of(s, {"years",
                       "level",
                       "histories",
                       "threshold",
                       "events_1_year",
                       "events",
                       "histories_with_two_events",
                       "fallen_carried",
                       "fallen_fresh",
                       "fallen_both",
                       "invalid",
                       "runs",
                       "steps",
                       {"carried", "carried_share"},
                       {"fresh", "fresh_share"},
                       "difference",
                       "ratio",
                       "closed_form",
                       "checked",
                       "checked_threshold",
                       "then_fell",
                       "then_stood",
                       "check_difference"});
}

Json part_json(const FrequencyPart& part)
{
    return json_of(part, {"from", "to", {"frequency_1_year", "annual_frequency"}});
}

Json state_json(const StateRisk& s, const Risk& risk)
{
    Json json = json_of(s, {"state",
                            "form",
                            "chosen",
                            "determined",
                            "note",
                            {"below", "share_below"},
                            {"above", "share_above"},
                            {"beyond_hazard", "share_beyond_hazard"},
                            {"lowest_1_year", "lowest_annual_frequency"},
                            {"highest_1_year", "highest_annual_frequency"},
                            {"unseen_1_year", "unseen_annual_frequency"}});
    if (!s.determined)
        return json;
    const auto over_years = [&](const auto& frequency) {
        return json_list(risk.years, [&](double years) {
            Json over = Json::object();
            over.member("years", years);
            add_member(over, "probability", probability_over(frequency, years));
            return over;
        });
    };
    const FrequencyEstimate& e = s.estimate;
    return json.member("frequency_1_year", json_of(e.frequency))
        .member("over_years", over_years(e.frequency))
        .member("mean_hazard", Json::object()
                                   .member("frequency_1_year", e.by_mean_hazard)
                                   .member("over_years", over_years(e.by_mean_hazard)))
        .member("disaggregation", json_list(e.parts, part_json));
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

std::vector<std::string> risk_heads(const Risk& risk)
{
    std::vector<std::string> heads{"a year"};
    for (const double years : risk.years)
        heads.push_back(fmt::format("in {:g} years", years));
    heads.push_back(fmt::format("in {:g} years, mean hazard", risk.years.back()));
    heads.emplace_back("uncertainty due to fragility");
    return heads;
}

std::vector<std::string> risk_cells(const Risk& risk, const StateRisk& state)
{
    const auto percent = [](const char* format, double share) {
        return std::isnan(share) ? "–" : fmt::format(fmt::runtime(format), 100 * share);
    };
    const FrequencyEstimate& e = state.estimate;
    std::vector<std::string> cells{frequency_text(e.frequency)};
    for (const double years : risk.years)
        cells.push_back(over_text(e.frequency, years));
    cells.push_back(percent("{:.3g} %", probability_over(e.by_mean_hazard, risk.years.back())));
    cells.push_back(percent("{:.0f} %", e.frequency.fragility_part));
    return cells;
}

std::string hazard_text(const HazardModel& hazard)
{
    return hazard.site ? hazard.source + " at " + *hazard.site : hazard.source;
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
    text += std::string(as_new_text) + "\n";
    if (const std::optional<std::string> conventions = conventions_text_of(risk.study_text))
        text += "conventions: " + *conventions + "\n";
    if (const std::optional<std::string> left_out = left_out_text_of(risk.study_text))
        text += *left_out + "\n";
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
    Json json = Json::object();
    json.member("fragility", risk.fragility_file)
        .member("hazard", risk.hazard.source)
        .member("site", risk.hazard.site.value_or(""))
        .member("measure", risk.hazard.measure)
        .member("level", risk.level)
        .member("conventions", conventions_text_of(risk.study_text).value_or(""))
        .member("left_out", left_out_text_of(risk.study_text).value_or(""))
        .member("states", json_list(risk.states, [&](const StateRisk& s) { return state_json(s, risk); }))
        .member("notes", Json::list(risk.says));
    if (risk.sequences)
        json.member("sequences", sequences_json(*risk.sequences));
    return json;
}

namespace {

/// A part of the squared width without which the interval is less than 14 % narrower.
constexpr double small_part = 0.25;

/// The intensities between which the middle 80 % of a frequency lie, by whole parts.
std::pair<double, double> middle_of(const FrequencyEstimate& estimate)
{
    double sum = 0, below = 0;
    for (const FrequencyPart& part : estimate.parts)
        sum += part.frequency.value;
    std::pair<double, double> range{0, estimate.parts.back().to};
    for (const FrequencyPart& part : estimate.parts) {
        const double next = below + part.frequency.value / sum;
        if (below <= 0.1 && next > 0.1)
            range.first = part.from;
        if (below < 0.9 && next >= 0.9)
            range.second = part.to;
        below = next;
    }
    return range;
}

} // namespace

std::string risk_answer(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    if (!s.determined)
        return fmt::format("How often the limit state '{}' is reached is not determined: {} times a year. {}",
                           s.meaning, bounds_text(s.estimate.bounds), s.note);
    const double years = risk.years.back();
    const RiskNumber p = probability_over(s.estimate.frequency, years);
    if (!(s.estimate.frequency.value > 0))
        return fmt::format("No run of the study reached the limit state '{}'. By shaking as strong as the strongest of "
                           "the runs, or stronger, its probability in {:g} years is at most {:.3g} % ({:g} % interval "
                           "from 0).",
                           s.meaning, years, 100 * p.total.upper, 100 * risk.level);
    const std::string text =
        fmt::format("In {:g} years the limit state '{}' is reached with a probability of {:.3g} % ({:.3g} to {:.3g}; "
                    "{:g} % interval), on average once in {:.4g} years.",
                    years, s.meaning, 100 * p.value, 100 * p.total.lower, 100 * p.total.upper, 100 * risk.level,
                    1 / s.estimate.frequency.value);
    if (std::isnan(s.estimate.by_mean_hazard))
        return text;
    return text + fmt::format(" By the mean hazard, the mean over its fractiles, the probability is {:.3g} %.",
                              100 * probability_over(s.estimate.by_mean_hazard, years));
}

std::string risk_answer_title(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    if (!s.determined)
        return s.meaning + ": not determined";
    const double years = risk.years.back();
    const Limits p = probability_over(s.estimate.frequency, years).total;
    return fmt::format("Probability in {:g} years: {:.3g} to {:.3g} % ({:g} % interval)", years, 100 * p.lower,
                       100 * p.upper, 100 * risk.level);
}

std::string risk_grounds(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    if (!s.determined || !(s.estimate.frequency.value > 0))
        return {};
    const auto [low, high] = middle_of(s.estimate);
    const std::string unit = measure_unit(risk.hazard.measure);
    std::string text = fmt::format("At least 80 % of the risk comes from {}{}. ", short_measure(risk.hazard.measure),
                                   low > 0 && std::isinf(high) ? fmt::format(" above {:.2g} {}", low, unit)
                                   : low > 0          ? fmt::format(" between {:.2g} and {:.2g} {}", low, high, unit)
                                   : std::isinf(high) ? std::string(" at all intensities")
                                                      : fmt::format(" below {:.2g} {}", high, unit));
    const double part = s.estimate.frequency.fragility_part;
    if (risk.hazard.fractiles.empty())
        return text + "The interval is that of the fragility alone, since the hazard states no uncertainty.";
    if (!std::isfinite(part))
        return text + "The interval has no finite width, so its parts are not known; more motions in the study may "
                      "give one.";
    text += fmt::format("Of the uncertainty (the interval's squared width) {:.0f} % is due to the hazard and {:.0f} % "
                        "due to the fragility. ",
                        100 * (1 - part), 100 * part);
    if (part > 1 - small_part)
        return text + "More motions in the study would narrow it; a better hazard curve hardly would.";
    if (part < small_part)
        return text + "A better hazard curve would narrow it; more motions hardly would.";
    return text + "A better hazard curve and more motions in the study would both narrow it.";
}

} // namespace stylobate

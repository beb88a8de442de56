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

namespace {

/// "Probability in 100 years: 1.31 to 9.84 % (90 % interval)"; where it is not determined, the limit state.
std::string answer_title(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    if (!s.determined)
        return s.meaning + ": not determined";
    const double years = risk.years.back();
    const Limits p = probability_over(s.estimate.frequency, years).total;
    return fmt::format("Probability in {:g} years: {:.3g} to {:.3g} % ({:g} % interval)", years, 100 * p.lower,
                       100 * p.upper, 100 * risk.level);
}

/// Cells of a limit state: its frequency, probabilities, and the part of the interval that is of the fragility.
std::vector<Html> state_row(const Risk& risk, const StateRisk& state)
{
    const FrequencyEstimate& e = state.estimate;
    std::vector<Html> row{state.state, to_string(state.form)};
    if (state.determined) {
        const auto percent = [](const char* format, double share) {
            return std::isnan(share) ? "–" : fmt::format(fmt::runtime(format), 100 * share);
        };
        row.emplace_back(frequency_text(e.frequency));
        for (const double years : risk.years)
            row.emplace_back(over_text(e.frequency, years));
        row.emplace_back(percent("{:.3g} %", probability_over(e.by_mean_hazard, risk.years.back())));
        row.emplace_back(percent("{:.0f} %", e.frequency.fragility_part));
    } else {
        row.emplace_back("not determined");
        row.resize(risk.years.size() + 5);
    }
    row.emplace_back(state.meaning);
    return row;
}

/// Why a state has its form of the fragility, what the other one would give, and what bounds there are.
std::string form_text(const Risk& risk, const StateRisk& state)
{
    std::string text = state.note;
    for (const StateRisk& other : risk.states)
        if (other.state == state.state && !other.chosen && other.determined)
            text +=
                fmt::format("; by {} it would be {} a year",
                            other.form == FragilityForm::shares ? "the shares of the stripes" : "the lognormal curve",
                            frequency_text(other.estimate.frequency));
    return state.determined
               ? text
               : fmt::format("{} a year by any curve that rises. {}", bounds_text(state.estimate.bounds), text);
}

/// "from 0.5 to 0.6", "below 0.5", "above 3".
std::string range_text(const FrequencyPart& part)
{
    return part.from == 0        ? fmt::format("below {:.3g}", part.to)
           : std::isinf(part.to) ? fmt::format("above {:.3g}", part.from)
                                 : fmt::format("from {:.3g} to {:.3g}", part.from, part.to);
}

void add_sequences(const SequenceRisk& s, Document& page)
{
    page.section("Damage carried from earthquake to earthquake");
    const auto percent = [](const SequenceNumber& n) { return percent_text(n.value, n.limits); };
    page.facts(
        {{"Histories",
          fmt::format("{} of {:g} years{}; {} runs", s.histories, s.years,
                      s.invalid > 0 ? fmt::format(", {} left out: a realization was invalid", s.invalid) : "", s.runs)},
         {"Earthquakes", fmt::format("{:.3g} a year above {:.3g}, {} in all, at most {} in one history",
                                     s.events_a_year, s.threshold, s.events, s.most_events)},
         {"Fallen, damage carried along", percent(s.carried_share)},
         {"Fallen, new in every earthquake", percent(s.fresh_share)},
         {"Difference, paired", percent(s.difference)},
         {"Ratio, paired", std::isfinite(s.ratio.limits.upper) ? fmt::format("{:.3g} ({:.3g} to {:.3g})", s.ratio.value,
                                                                             s.ratio.limits.lower, s.ratio.limits.upper)
                                                               : "not determined: too few histories with a fall"},
         {"By the fragility, new in each", std::isnan(s.closed_form.value) ? "not determined" : percent(s.closed_form)},
         {"Threshold", s.threshold_says},
         {"With weaker earthquakes too",
          s.checked == 0
              ? "not checked: below the threshold there are too many earthquakes"
              : fmt::format("down to {:.3g}, in {} histories: {} fall that had stood, {} stand that "
                            "had fallen; difference {}{}",
                            s.checked_threshold, s.checked, s.then_fell, s.then_stood, percent(s.check_difference),
                            s.check_difference.limits.lower > 0 ? ": weaker earthquakes count, lower the threshold"
                                                                : "")}});
}

} // namespace

void add_answer(const Risk& risk, Document& page)
{
    const StateRisk& s = risk.principal();
    page.section("The answer");
    page.box(s.determined ? "main" : "warn", answer_title(risk), risk_answer(risk));
    if (const std::string grounds = risk_grounds(risk); !grounds.empty())
        page.paragraph(grounds);
    if (s.determined && s.estimate.unseen > 0) // the only place that says so
        page.note(fmt::format("Not excluded at intensities where no run reached it, and in no interval: {:.2g} a year.",
                              s.estimate.unseen));
    if (const std::optional<std::string> conventions = conventions_text_of(risk.study_text))
        page.paragraph("Conventions: " + *conventions + ".");
    add_left_out_of(page, risk.study_text);
}

void add_result(const Risk& risk, Document& page)
{
    page.section("Result");
    HtmlTable table{"lll", {"limit state", "fragility", "a year"}, {}, ""};
    for (const double years : risk.years)
        table.head.emplace_back(fmt::format("in {:g} years", years));
    table.head.emplace_back(fmt::format("in {:g} years, mean hazard", risk.years.back()));
    table.head.emplace_back("due to fragility");
    table.align += std::string(risk.years.size(), 'l') + "rrl";
    table.head.emplace_back("meaning");
    for (const StateRisk* s : risk.chosen())
        table.rows.push_back(state_row(risk, *s));
    page.table(table);
    std::string note = fmt::format("In brackets: {:g} % intervals, of the fragility (its motions)", 100 * risk.level);
    if (!risk.hazard.fractiles.empty())
        note += " and of the hazard (its fractiles) together. Due to fragility: its part of the squared width on a "
                "logarithmic scale. Values are by the best estimate of the hazard; the mean hazard is the mean of its "
                "curves over their fractiles";
    page.note(note + ". " + as_new_text);
}

void add_parts(const Risk& risk, Document& page)
{
    const StateRisk& s = risk.principal();
    const FrequencyEstimate& e = s.estimate;
    if (!s.determined || !(e.frequency.value > 0))
        return;
    page.section("Contributing intensities");
    HtmlTable table{"lrl", {describe_measure(risk.hazard.measure), "share", "a year"}, {}, s.state + ": " + s.meaning};
    for (const FrequencyPart& part : e.parts)
        table.rows.push_back({range_text(part), fmt::format("{:.1f} %", 100 * part.frequency.value / e.frequency.value),
                              part.frequency.value > 0 ? frequency_text(part.frequency) : "no run reached it"});
    page.table(table);
    page.note(fmt::format("From outside of the range of the runs: {:.2g} % below, {:.2g} % above; from outside of the "
                          "hazard's points: {:.2g} %. Any curve that rises{} gives {} a year.",
                          100 * e.below, 100 * e.above, 100 * e.beyond_hazard,
                          s.form == FragilityForm::lognormal ? " and agrees with the fitted one within that range"
                                                             : " through the shares of the stripes",
                          bounds_text(e.bounds)));
}

void add_notes(const Risk& risk, Document& page)
{
    if (risk.sequences)
        add_sequences(*risk.sequences, page);
    page.section("Notes");
    std::vector<Html> notes;
    for (const StateRisk* s : risk.chosen())
        notes.emplace_back(s->state + ": " + form_text(risk, *s));
    notes.insert(notes.end(), risk.says.begin(), risk.says.end());
    page.list(notes);
}

std::string risk_text(const Risk& risk)
{
    Document document(
        fmt::format("Risk: {}, fragility of {}, hazard {}", risk.title, risk.fragility_file, hazard_text(risk.hazard)));
    add_answer(risk, document);
    add_result(risk, document);
    add_parts(risk, document);
    add_notes(risk, document);
    return console_text(document);
}

} // namespace stylobate

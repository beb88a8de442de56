#include "studies/kinds/fragility/fragility_text.hpp"

#include "io/files/suggest.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : std::isnan(value) ? "–" : value > 0 ? "∞" : "-∞";
}

std::string interval(const Limits& limits)
{
    if (std::isnan(limits.lower) && std::isnan(limits.upper))
        return "no interval";
    return fmt::format("{} to {}", number(limits.lower), number(limits.upper));
}

/// "m/s²"
std::string page_unit(const std::string& measure)
{
    const std::string unit = measure_unit(measure);
    return unit == "m/s2" ? "m/s²" : unit;
}

std::string percent(double share)
{
    return fmt::format("{:.3g} %", 100 * share);
}

/// A part of the scatter: "76 % (73 to 79)"; of too few motions without an interval.
std::string level_text(const DispersionShare& share, std::size_t records)
{
    if (records < least_records && std::isfinite(share.share))
        return fmt::format("{:.0f} %", 100 * share.share);
    if (!share.determined())
        return "not determined";
    const Limits& limits = share.share_limits;
    return limits.upper == 0
               ? "0 % (no two runs differed)"
               : fmt::format("{:.0f} % ({:.0f} to {:.0f})", 100 * share.share, 100 * limits.lower, 100 * limits.upper);
}

Json limits_json(const CurveEstimate& e)
{
    return Json::object()
        .member("value", e.value)
        .member("lower", e.records.lower)
        .member("upper", e.records.upper)
        .member("lower_if_runs_were_independent", e.profile_runs.lower)
        .member("upper_if_runs_were_independent", e.profile_runs.upper);
}

std::string percent_interval(const Limits& limits)
{
    return std::isnan(limits.lower) ? "without interval"
                                    : fmt::format("{} to {}", percent(limits.lower), percent(limits.upper));
}

/// What a reader must know of a state besides its numbers.
struct Remark {
    std::string sentence; ///< which may be true of other states too
    std::string detail;   ///< of this one; or nothing
};

std::vector<Remark> remarks(const StateFragility& s)
{
    std::vector<Remark> all;
    if (has_curve(s) && s.fit.p_value < fit_significance)
        all.push_back({"The lognormal curve does not fit: use the shares of the stripes instead.",
                       fmt::format("p = {:.2g}", s.fit.p_value)});
    if (s.stripes && s.stripes->p_monotone < 0.05)
        all.push_back(
            {"Stronger shaking was less damaging somewhere, so that no curve that rises describes the shares.",
             fmt::format("p = {:.2g}", s.stripes->p_monotone)});
    for (const std::string& sentence : s.curve.says)
        all.push_back({sentence, ""});
    if (s.moving > 0)
        all.push_back({fmt::format("{} of {} realizations stand and still moved at the end. Their residual "
                                   "displacements are not known, so they are not counted.",
                                   s.moving, s.curve.trials + static_cast<double>(s.moving)),
                       ""});
    if (s.resurrected > 0)
        all.push_back({"Some structures that reached the limit state did not reach it under a stronger scaling of the "
                       "same motion.",
                       fmt::format("{} of {}", s.resurrected, s.reached_ever)});
    return all;
}

/// Names of limit states, each with a remark in brackets.
using Concerned = std::vector<std::pair<std::string, std::string>>;

Html concerned_text(const Concerned& states, std::size_t all)
{
    if (states.size() == all && all > 1 && std::ranges::all_of(states, [](const auto& s) { return s.second.empty(); }))
        return "all limit states";
    Html text;
    for (std::size_t i = 0; i < states.size(); ++i) {
        text += i == 0 ? "" : i + 1 == states.size() ? " and " : ", ";
        text += code(states[i].first);
        if (!states[i].second.empty())
            text += " (" + states[i].second + ")";
    }
    return text;
}

/// Each remark once, with the limit states that it concerns.
std::vector<Html> limits_of_curves(const Fragility& f)
{
    std::vector<std::pair<std::string, Concerned>> said;
    for (const StateFragility& s : f.states)
        for (const Remark& remark : remarks(s)) {
            auto found = std::ranges::find(said, remark.sentence, &std::pair<std::string, Concerned>::first);
            if (found == said.end())
                found = said.insert(said.end(), {remark.sentence, {}});
            found->second.emplace_back(s.state.name, remark.detail);
        }
    std::vector<Html> items;
    for (const auto& [sentence, states] : said) {
        items.emplace_back(sentence + " This concerns ");
        items.back() += concerned_text(states, f.states.size());
        items.back() += ".";
    }
    return items;
}

std::string share_text(const DispersionShares& shares)
{
    std::string text;
    for (std::size_t l = 0; l < dispersion_levels; ++l) {
        const DispersionShare& share = shares.levels[l];
        if (share.known)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(static_cast<DispersionLevel>(l)),
                                level_text(share, shares.records));
    }
    return text;
}

} // namespace

Answer fragility_answer(const Fragility& f)
{
    const StateFragility* s = principal_state(f);
    if (!s)
        return {"There are no curves.", f.says.empty() ? "No realization is valid." : f.says.front()};
    const std::string of = "At " + short_measure(f.measure), unit = " " + page_unit(f.measure);
    const std::string by = design_text(f) + ".";
    if (!has_curve(*s)) {
        const auto median = median_text(s->curve.median.records);
        return {median ? fmt::format("{} {}{} half of the structures fall.", of, *median, unit)
                       : std::string("At which intensity half of the structures fall is not determined."),
                fmt::format("{} of {} realizations fell, over all intensities. No curve could be fitted. {}",
                            s->curve.reached, s->curve.trials, by)};
    }
    const Limits &median = s->curve.median.records, &dispersion = s->curve.dispersion.records;
    const auto known = [](const Limits& limits) { return limits.lower > 0 && std::isfinite(limits.upper); };
    const std::string spread = fmt::format("Dispersion {}{}. ", number(s->curve.dispersion.value),
                                           known(dispersion) ? " (" + interval(dispersion) + ")" : std::string());
    if (!known(median))
        return {fmt::format("{} {}{} half of the structures fall: a best estimate without an interval.", of,
                            number(s->curve.median.value), unit),
                spread + by};
    return {fmt::format("{} {}{} half of the structures fall (95 % interval).", of, interval(median), unit),
            fmt::format("Best estimate {}{}. {}{} The intervals are clustered by motion.",
                        number(s->curve.median.value), unit, spread, by)};
}

std::string design_text(const Fragility& f)
{
    return fmt::format("{}{}, {} under each", counted(f.motions, "motion"),
                       f.different < f.motions ? fmt::format(" ({} different)", f.different) : "",
                       counted(f.structures, "structure"));
}

namespace {

HtmlTable states_table(const Fragility& f)
{
    const std::string unit = page_unit(f.measure);
    HtmlTable table{"nrrrrrl",
                    {"name", "reached", unit.empty() ? "median" : "median [" + unit + "]", "95 %", "dispersion", "95 %",
                     "limit state"},
                    {},
                    ""};
    for (const StateFragility& s : f.states) {
        std::vector<Html> row = {s.state.name, fmt::format("{} of {}", s.curve.reached, s.curve.trials)};
        if (has_curve(s))
            row.insert(row.end(), {number(s.curve.median.value), interval(s.curve.median.records),
                                   number(s.curve.dispersion.value), interval(s.curve.dispersion.records)});
        else
            row.insert(row.end(), {"no curve", median_text(s.curve.median.records).value_or(""), "", ""});
        row.emplace_back(s.state.describe);
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// Where the scatter of the collapse comes from, and which measure has the least.
void scatter_facts(const Fragility& f, Document& page)
{
    std::vector<std::pair<std::string, Html>> facts;
    for (const StateFragility& s : f.states)
        if (s.state.kind == DamageState::Kind::collapse && s.shares)
            facts.emplace_back("Scatter of " + s.state.name + " at a given intensity", share_text(*s.shares));
    if (!f.measures.empty() && std::isfinite(f.measures.front().dispersion)) {
        const RankedMeasure& best = f.measures.front();
        facts.emplace_back("Best intensity measure for the collapse",
                           fmt::format("{}, dispersion {} ({})", describe_measure(best.name), number(best.dispersion),
                                       interval(best.dispersion_limits)));
    }
    if (!facts.empty())
        page.facts(facts);
}

/// What the console shows, and the first part of the page.
void add_fragility(const Fragility& f, Document& page)
{
    page.paragraph(fmt::format("{}. Intensity: {}. {}", design_text(f), describe_measure(f.measure),
                               f.different < least_records ? "There are no intervals, as the motions are too few."
                                                           : "Intervals (95 %) are clustered by motion."));
    for (const std::string& line : f.says)
        page.box("warn", "Note", line);
    page.table(states_table(f));
    scatter_facts(f, page);
    if (const std::vector<Html> items = limits_of_curves(f); !items.empty()) {
        page.heading("Limits of the curves");
        page.list(items);
    }
    if (f.sequence.empty())
        return;
    page.heading("Sequences of shakings");
    HtmlTable table{"rrrr", {"shaking", "fallen by its end", "expected if undamaged", "difference, 95 %"}, {}, ""};
    for (const SequenceShare& s : f.sequence)
        table.rows.push_back(
            {fmt::format("{}", s.shaking), percent(s.fallen), percent(s.fresh), percent_interval(s.beyond)});
    page.table(table);
}

} // namespace

std::string fragility_text(const Fragility& f)
{
    Document page;
    add_fragility(f, page);
    return console_text(page);
}

namespace {

Json with_limits(const char* name, double value, const Limits& limits)
{
    return Json::object().member(name, value).member("lower", limits.lower).member("upper", limits.upper);
}

Json state_json(const StateFragility& s)
{
    Json state = Json::object();
    state.member("name", s.state.name)
        .member("limit_state", s.state.describe)
        .member("trials", s.curve.trials)
        .member("reached", s.curve.reached)
        .member("curve", has_curve(s))
        .member("median", limits_json(s.curve.median)); // without a curve, of any that does not fall
    if (has_curve(s))
        state.member("dispersion", limits_json(s.curve.dispersion)).member("lack_of_fit_p", s.fit.p_value);
    if (s.stripes)
        state.member("monotone_p", s.stripes->p_monotone)
            .member("stripes", json_list(s.stripes->stripes,
                                         [](const StripeShare& share) {
                                             return Json::object()
                                                 .member("intensity", share.intensity)
                                                 .member("trials", share.trials)
                                                 .member("reached", share.reached)
                                                 .member("lower", share.limits.lower)
                                                 .member("upper", share.limits.upper);
                                         }))
            .member("resurrected", s.resurrected)
            .member("reached_ever", s.reached_ever);
    if (s.shares) {
        Json shares = Json::object();
        for (std::size_t l = 0; l < dispersion_levels; ++l)
            if (const DispersionShare& share = s.shares->levels[l]; share.known)
                shares.member(to_string(static_cast<DispersionLevel>(l)),
                              with_limits("share", share.share, share.share_limits));
        state.member("scatter", shares);
    }
    return state.member("says", json_list(remarks(s), [](const Remark& remark) {
                            return remark.detail.empty() ? remark.sentence
                                                         : remark.sentence + " (" + remark.detail + ")";
                        }));
}

Json measure_json(const RankedMeasure& m)
{
    return Json::object()
        .member("measure", m.name)
        .member("dispersion", m.dispersion)
        .member("dispersion_lower", m.dispersion_limits.lower)
        .member("dispersion_upper", m.dispersion_limits.upper)
        .member("gain_nats", m.gain)
        .member("behind_lower_nats", m.behind.lower)
        .member("behind_upper_nats", m.behind.upper)
        .member("sufficient", m.sufficient)
        .member("features", json_list(m.sufficiency, [](const Sufficiency& feature) {
                    return with_limits("coefficient", feature.coefficient, feature.limits)
                        .member("feature", feature.feature)
                        .member("p", feature.p_value);
                }));
}

} // namespace

Json fragility_json(const Fragility& f)
{
    return Json::object()
        .member("measure", f.measure)
        .member("motions", f.motions)
        .member("different_motions", f.different)
        .member("structures", f.structures)
        .member("states", json_list(f.states, state_json))
        .member("measures", json_list(f.measures, measure_json))
        .member("sequence", json_list(f.sequence,
                                      [](const SequenceShare& s) {
                                          return Json::object()
                                              .member("shaking", s.shaking)
                                              .member("fallen", s.fallen)
                                              .member("as_new", s.fresh)
                                              .member("difference_lower", s.beyond.lower)
                                              .member("difference_upper", s.beyond.upper);
                                      }))
        .member("says", Json::list(f.says));
}

void fragility_section(const Fragility& f, Document& page)
{
    page.section("Fragility");
    if (!f.states.empty())
        page.figure(figure_svg(fragility_figure(f)),
                    "The legend switches limit states on and off. Lines with bands: lognormal curves by maximum "
                    "likelihood with their 95 % bands. Points with bars: shares of the stripes with their intervals. "
                    "Where the lognormal curve does not fit (p below 0.05), and where there is none, a line through "
                    "the points is the best curve that does not decrease.");
    add_fragility(f, page);
    if (!f.sequence.empty())
        page.note("Means of the stripes. Expected if undamaged: 1 - (1 - p)^k with the share p of the first shaking. "
                  "The difference is the combined effect of accumulated damage and of the selection of the survivors.");
    if (f.different >= least_records)
        page.note("Runs of one motion are not independent: intervals that assume independence would be too narrow.");
    page.heading("Variance components");
    HtmlTable shares{"lrrrr", {"limit state", "motion", "imperfections", "contacts", "chaos"}, {}, ""};
    for (const StateFragility& s : f.states)
        if (s.shares) {
            std::vector<Html> row = {s.state.describe};
            for (const DispersionShare& share : s.shares->levels)
                row.push_back(share.known ? level_text(share, s.shares->records)
                                          : std::string("in the column on its left"));
            shares.rows.push_back(std::move(row));
        }
    page.table(shares);
    page.note(
        "Shares of the variance of the outcome (reached or not) at a given intensity, over all intensities of the "
        "study: motion, structure, contacts, and the difference between two structures that differ by a nanometre.");
    if (f.measures.empty())
        return;
    page.heading("Intensity measures ranked by information on the collapse");
    HtmlTable ranks{
        "lrrrrl", {"measure", "dispersion", "95 %", "information", "behind the best", "still depends on"}, {}, ""};
    for (const RankedMeasure& m : f.measures) {
        if (!std::isfinite(m.gain)) {
            ranks.rows.push_back({describe_measure(m.name), "no curve", "", "", "", ""});
            continue;
        }
        std::string beside;
        const double level = 0.05 / static_cast<double>(std::max<std::size_t>(m.sufficiency.size(), 1));
        for (const Sufficiency& feature : m.sufficiency)
            if (feature.p_value < level)
                beside += (beside.empty() ? "" : ", ") + describe_measure(feature.feature);
        ranks.rows.push_back({describe_measure(m.name), number(m.dispersion), interval(m.dispersion_limits),
                              fmt::format("{:.3f}", m.gain), interval(m.behind), beside.empty() ? "–" : beside});
    }
    page.table(ranks);
    page.note("Information: gain in log likelihood over the mean share, in nats per realization (one nat: 2.7 times as "
              "probable). Behind the best: the difference with its 95 % interval, clustered by motion. The "
              "outcome still depends on a feature of the motions that shifts the curve of the measure significantly "
              "(5 %, corrected for all features).");
}

} // namespace stylobate

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
std::vector<std::string> remarks(const StateFragility& s)
{
    std::vector<std::string> all = s.curve.says;
    if (s.moving > 0)
        all.push_back(fmt::format("Counted: {} of {} realizations. The other {} stand and still moved at the end, and "
                                  "their residuals are not known.",
                                  s.curve.trials, s.curve.trials + static_cast<double>(s.moving), s.moving));
    if (has_curve(s) && s.fit.p_value < fit_significance)
        all.push_back(s.fit.says);
    if (s.stripes && s.stripes->p_monotone < 0.05)
        all.push_back(s.stripes->says);
    if (s.resurrected > 0)
        all.push_back(fmt::format(
            "{} of {} structures that reached it were spared by a stronger scaling of the same record ({}).",
            s.resurrected, s.reached_ever,
            percent(static_cast<double>(s.resurrected) / static_cast<double>(s.reached_ever))));
    return all;
}

/// Names of limit states, and a remark of each in brackets; "" where there is none.
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

/// What a reader of the page must know besides the numbers: each sentence once, with the limit states that it concerns.
std::vector<Html> limits_of_curves(const Fragility& f)
{
    Concerned unfit, falling, spared;
    std::vector<std::pair<std::string, Concerned>> alike;
    const auto say = [&](const StateFragility& s, const std::string& sentence) {
        auto found = std::ranges::find(alike, sentence, &std::pair<std::string, Concerned>::first);
        if (found == alike.end())
            found = alike.insert(alike.end(), {sentence, {}});
        found->second.emplace_back(s.state.name, "");
    };
    for (const StateFragility& s : f.states) {
        if (has_curve(s) && s.fit.p_value < fit_significance)
            unfit.emplace_back(s.state.name, fmt::format("p = {:.2g}", s.fit.p_value));
        if (s.stripes && s.stripes->p_monotone < 0.05)
            falling.emplace_back(s.state.name, fmt::format("p = {:.2g}", s.stripes->p_monotone));
        if (s.resurrected > 0)
            spared.emplace_back(s.state.name, fmt::format("{} of {}", s.resurrected, s.reached_ever));
        for (const std::string& sentence : s.curve.says)
            say(s, sentence);
        if (s.moving > 0)
            say(s, fmt::format("{} of {} realizations stand and still moved at the end. Their residual displacements "
                               "are not known, so they are not counted.",
                               s.moving, s.curve.trials + static_cast<double>(s.moving)));
    }
    std::vector<Html> items;
    const auto item = [&](const std::string& sentence, const Concerned& states) {
        if (states.empty())
            return;
        Html text = sentence + " This concerns ";
        text += concerned_text(states, f.states.size());
        items.push_back(text += ".");
    };
    item("The lognormal curve does not fit: use the shares of the stripes instead.", unfit);
    item("Stronger shaking was less damaging somewhere, so that no curve that rises describes the shares.", falling);
    for (const auto& [sentence, states] : alike)
        item(sentence, states);
    item("Some structures that reached the limit state did not reach it under a stronger scaling of the same motion.",
         spared);
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

std::string fragility_text(const Fragility& f)
{
    std::string text = fmt::format("  {}; intensity: {}; {}\n", design_text(f), describe_measure(f.measure),
                                   f.different < least_records ? "no intervals, as the motions are too few"
                                                               : "in brackets: 95 % intervals, clustered by motion");
    for (const StateFragility& s : f.states) {
        text += fmt::format("  {:<16} {:>6} of {}", s.state.name, s.curve.reached, s.curve.trials);
        if (has_curve(s))
            text += fmt::format("; median {} ({}), dispersion {} ({})", number(s.curve.median.value),
                                interval(s.curve.median.records), number(s.curve.dispersion.value),
                                interval(s.curve.dispersion.records));
        else if (const auto median = median_text(s.curve.median.records))
            text += "; no curve, median " + *median;
        text += "\n";
        for (const std::string& remark : remarks(s))
            text += fmt::format("      {}\n", remark);
        if (s.state.kind == DamageState::Kind::collapse && s.shares)
            text += fmt::format("      scatter at a given intensity: {}\n", share_text(*s.shares));
    }
    if (!f.measures.empty() && std::isfinite(f.measures.front().dispersion)) {
        const RankedMeasure& best = f.measures.front();
        text += fmt::format("  best intensity measure for the collapse: {}; dispersion {} ({})\n",
                            describe_measure(best.name), number(best.dispersion), interval(best.dispersion_limits));
    }
    for (const SequenceShare& s : f.sequence)
        text += fmt::format("  fallen by the end of shaking {}: {} of all stripes; expected for undamaged structures: "
                            "{}; difference {}\n",
                            s.shaking, percent(s.fallen), percent(s.fresh), percent_interval(s.beyond));
    for (const std::string& line : f.says)
        text += "  " + line + "\n";
    return text;
}

namespace {

Json state_json(const StateFragility& s)
{
    Json state = Json::object();
    state.member("name", s.state.name)
        .member("limit_state", s.state.describe)
        .member("trials", s.curve.trials)
        .member("reached", s.curve.reached)
        .member("curve", has_curve(s));
    if (has_curve(s))
        state.member("median", limits_json(s.curve.median))
            .member("dispersion", limits_json(s.curve.dispersion))
            .member("lack_of_fit_p", s.fit.p_value);
    else // of any curve that does not fall
        state.member("median", limits_json(s.curve.median));
    if (s.stripes) {
        state.member("monotone_p", s.stripes->p_monotone);
        Json stripes = Json::list();
        for (const StripeShare& share : s.stripes->stripes)
            stripes.item(Json::object()
                             .member("intensity", share.intensity)
                             .member("trials", share.trials)
                             .member("reached", share.reached)
                             .member("lower", share.limits.lower)
                             .member("upper", share.limits.upper));
        state.member("stripes", stripes);
        state.member("resurrected", s.resurrected).member("reached_ever", s.reached_ever);
    }
    if (s.shares) {
        Json shares = Json::object();
        for (std::size_t l = 0; l < dispersion_levels; ++l)
            if (const DispersionShare& share = s.shares->levels[l]; share.known)
                shares.member(to_string(static_cast<DispersionLevel>(l)),
                              Json::object()
                                  .member("share", share.share)
                                  .member("lower", share.share_limits.lower)
                                  .member("upper", share.share_limits.upper));
        state.member("scatter", shares);
    }
    return state.member("says", Json::list(remarks(s)));
}

Json measure_json(const RankedMeasure& m)
{
    Json features = Json::list();
    for (const Sufficiency& feature : m.sufficiency)
        features.item(Json::object()
                          .member("feature", feature.feature)
                          .member("coefficient", feature.coefficient)
                          .member("lower", feature.limits.lower)
                          .member("upper", feature.limits.upper)
                          .member("p", feature.p_value));
    return Json::object()
        .member("measure", m.name)
        .member("dispersion", m.dispersion)
        .member("dispersion_lower", m.dispersion_limits.lower)
        .member("dispersion_upper", m.dispersion_limits.upper)
        .member("gain_nats", m.gain)
        .member("behind_lower_nats", m.behind.lower)
        .member("behind_upper_nats", m.behind.upper)
        .member("sufficient", m.sufficient)
        .member("features", features);
}

} // namespace

Json fragility_json(const Fragility& f)
{
    Json states = Json::list(), measures = Json::list();
    for (const StateFragility& s : f.states)
        states.item(state_json(s));
    for (const RankedMeasure& m : f.measures)
        measures.item(measure_json(m));
    Json sequence = Json::list();
    for (const SequenceShare& s : f.sequence)
        sequence.item(Json::object()
                          .member("shaking", s.shaking)
                          .member("fallen", s.fallen)
                          .member("as_new", s.fresh)
                          .member("difference_lower", s.beyond.lower)
                          .member("difference_upper", s.beyond.upper));
    return Json::object()
        .member("measure", f.measure)
        .member("motions", f.motions)
        .member("different_motions", f.different)
        .member("structures", f.structures)
        .member("states", states)
        .member("measures", measures)
        .member("sequence", sequence)
        .member("says", Json::list(f.says));
}

namespace {

void sequence_section(const Fragility& f, Document& page)
{
    if (!f.sequence.empty()) {
        page.heading("Sequences of shakings");
        HtmlTable table_of{
            "rrrr", {"shaking", "fallen by its end", "expected if undamaged", "difference, 95 %"}, {}, ""};
        for (const SequenceShare& s : f.sequence)
            table_of.rows.push_back(
                {fmt::format("{}", s.shaking), percent(s.fallen), percent(s.fresh), percent_interval(s.beyond)});
        page.table(table_of);
        page.note("Means of the stripes. Expected if undamaged: 1 - (1 - p)^k with the share p of the first shaking. "
                  "The difference is the combined effect of accumulated damage and of the selection of the survivors.");
    }
}

} // namespace

void fragility_section(const Fragility& f, Document& page)
{
    page.section("Fragility");
    page.paragraph(fmt::format(
        "{}. Intensity: {}. Each curve is a lognormal fit by maximum likelihood. {}", design_text(f),
        describe_measure(f.measure),
        f.different < least_records
            ? "There are no intervals, as the motions are too few."
            : "Intervals (95 %) are clustered by motion: runs of one motion are not independent, and intervals that "
              "assume independence would be too narrow."));
    for (const std::string& line : f.says)
        page.box("warn", "Note", line);
    if (!f.states.empty())
        page.figure(figure_svg(fragility_figure(f)),
                    "The legend switches limit states on and off. Lines with bands: lognormal curves with their 95 % "
                    "bands. Points with bars: shares of the stripes with their intervals. Where the lognormal curve "
                    "does not fit (p below 0.05), and where there is none, a line through the points is the best curve "
                    "that does not decrease.");
    const std::string unit = page_unit(f.measure);
    HtmlTable table{"lnrrrrr",
                    {"limit state", "name", "reached", unit.empty() ? "median" : "median [" + unit + "]", "95 %",
                     "dispersion", "95 %"},
                    {},
                    ""};
    for (const StateFragility& s : f.states) {
        std::vector<Html> row = {s.state.describe, code(s.state.name),
                                 fmt::format("{} of {}", s.curve.reached, s.curve.trials)};
        if (has_curve(s))
            row.insert(row.end(), {number(s.curve.median.value), interval(s.curve.median.records),
                                   number(s.curve.dispersion.value), interval(s.curve.dispersion.records)});
        else
            row.insert(row.end(), {"no curve", median_text(s.curve.median.records).value_or(""), "", ""});
        table.rows.push_back(std::move(row));
    }
    page.table(table);
    if (const std::vector<Html> items = limits_of_curves(f); !items.empty()) {
        page.heading("Limits of the curves");
        page.list(items);
    }
    sequence_section(f, page);
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

#include "studies/decisions/risk/risk_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {

namespace {

std::string change_text(const ChangeNumber& n)
{
    return fmt::format("{:+.3g} ({:+.3g} to {:+.3g})", n.value, n.total.lower, n.total.upper);
}

/// Of probabilities, in percentage points.
std::string points_text(const ChangeNumber& n)
{
    return fmt::format("{:+.3g} ({:+.3g} to {:+.3g}) percentage points", 100 * n.value, 100 * n.total.lower,
                       100 * n.total.upper);
}

std::string ratio_text(const ChangeNumber& n)
{
    return n.value > 0 && std::isfinite(n.total.upper)
               ? fmt::format("{:.3g} ({:.3g} to {:.3g})", n.value, n.total.lower, n.total.upper)
               : std::string("not determined");
}

/// What a reader must know of a state besides its numbers.
std::vector<std::string> remarks(const RiskChange& change, const VariantChange& variant, const StateChange& s)
{
    std::vector<std::string> all;
    if (s.determined && (s.change.base.unseen > 0 || s.change.variant.unseen > 0))
        all.push_back(fmt::format("Not excluded at intensities where no run reached it, and in no interval: {:.2g} a "
                                  "year in {}, {:.2g} with {}.",
                                  s.change.base.unseen, change.base_name, s.change.variant.unseen, variant.name));
    if (!s.note.empty())
        all.push_back(s.note);
    return all;
}

std::string intervals_text(const RiskChange& change)
{
    return fmt::format("Both structures meet the same {} motions. Intervals are of the motions{}; a motion is drawn "
                       "with all its realizations of both structures, so that the pairs are kept. Frequencies are by "
                       "the shares of the stripes in both structures.",
                       change.motions, change.hazard.fractiles.empty() ? "" : " and the hazard");
}

/// Without what each part of the interval is of.
Json limits_json(const RiskNumber& n)
{
    return json_of(n, {"value", "lower", "upper"});
}

Json state_json(const StateChange& s, const std::vector<double>& years)
{
    Json json = json_of(s, {"state", {"limit_state", "meaning"}, "determined", "verdict", "note"});
    if (!s.determined)
        return json;
    const RiskNumber &base = s.change.base.frequency, &other = s.change.variant.frequency;
    json.member("base_1_year", limits_json(base)).member("variant_1_year", limits_json(other));
    add_members(json, s,
                {{"change_1_year", "change"},
                 "ratio",
                 {"base_unseen_1_year", "base_unseen_annual_frequency"},
                 {"variant_unseen_1_year", "variant_unseen_annual_frequency"}});
    Json over = Json::list();
    for (std::size_t i = 0; i < years.size(); ++i)
        over.item(Json::object()
                      .member("years", years[i])
                      .member("base", limits_json(probability_over(base, years[i])))
                      .member("variant", limits_json(probability_over(other, years[i])))
                      .member("change", json_of(s.change.probability[i])));
    return json.member("over_years", over);
}

} // namespace

Json risk_json(const RiskChange& change)
{
    const auto variant_json = [&](const VariantChange& variant) {
        return Json::object()
            .member("name", variant.name)
            .member("results", variant.results)
            .member("states",
                    json_list(variant.states, [&](const StateChange& s) { return state_json(s, change.years); }));
    };
    return Json::object()
        .member("comparison", change.comparison_file)
        .member("base", change.base_name)
        .member("hazard", change.hazard.source)
        .member("site", change.hazard.site.value_or(""))
        .member("measure", change.hazard.measure)
        .member("level", change.level)
        .member("motions", change.motions)
        .member("variants", json_list(change.variants, variant_json))
        .member("notes", Json::list(change.says));
}

std::string risk_change_answer(const RiskChange& change, const VariantChange& variant)
{
    const StateChange& s = variant.principal();
    if (!s.determined)
        return fmt::format("What {} changes of the limit state '{}' is not determined. {}", variant.name, s.meaning,
                           s.note);
    const double years = change.years.back();
    const std::string verdict = s.verdict();
    return fmt::format("In {:g} years the limit state '{}' is reached with a probability of {} in {} and of {} with "
                       "{}: a change of {} ({:g} % interval). {}",
                       years, s.meaning, over_text(s.change.base.frequency, years), change.base_name,
                       over_text(s.change.variant.frequency, years), variant.name,
                       points_text(s.change.probability.back()), 100 * change.level,
                       verdict == "undecided" ? "The sign of the change is undecided."
                                              : "The risk is " + verdict + ".");
}

namespace {

/// "dowels: -6 to -1 percentage points in 100 years (90 % interval)"
std::string change_title(const RiskChange& change, const VariantChange& variant)
{
    const StateChange& s = variant.principal();
    if (!s.determined)
        return variant.name + ": not determined";
    const Limits p = s.change.probability.back().total;
    return fmt::format("{}: {:+.3g} to {:+.3g} percentage points in {:g} years ({:g} % interval)", variant.name,
                       100 * p.lower, 100 * p.upper, change.years.back(), 100 * change.level);
}

} // namespace

namespace {

void add_answer(const RiskChange& change, Document& page)
{
    page.section("The answer");
    for (const VariantChange& variant : change.variants) {
        const StateChange& s = variant.principal();
        const std::string verdict = s.verdict();
        page.box(verdict == (s.damage ? "lower" : "higher")   ? "good"
                 : verdict == (s.damage ? "higher" : "lower") ? "bad"
                                                              : "warn",
                 change_title(change, variant), risk_change_answer(change, variant));
    }
}

/// A row a year, and one for each number of years.
void add_state(const RiskChange& change, const StateChange& s, HtmlTable& table)
{
    if (!s.determined) {
        table.rows.push_back({s.state, "", "", "", "", "", s.verdict(), s.meaning});
        return;
    }
    const RiskNumber &base = s.change.base.frequency, &other = s.change.variant.frequency;
    table.rows.push_back({s.state, "a year", frequency_text(base), frequency_text(other),
                          change_text(s.change.frequency), ratio_text(s.change.ratio), s.verdict(), s.meaning});
    for (std::size_t i = 0; i < change.years.size(); ++i)
        table.rows.push_back({"", fmt::format("in {:g} years", change.years[i]), over_text(base, change.years[i]),
                              over_text(other, change.years[i]), points_text(s.change.probability[i])});
}

void add_result(const RiskChange& change, Document& page)
{
    page.section("Result");
    page.paragraph(intervals_text(change) + " " + as_new_text);
    for (const VariantChange& variant : change.variants) {
        HtmlTable table{"llllllll",
                        {"limit state", "", change.base_name, variant.name, "change", "ratio", "risk", "meaning"},
                        {},
                        variant.name};
        for (const StateChange& s : variant.states)
            add_state(change, s, table);
        page.table(table);
    }
}

void add_notes(const RiskChange& change, Document& page)
{
    std::vector<Html> notes;
    for (const VariantChange& variant : change.variants)
        for (const StateChange& s : variant.states)
            for (const std::string& remark : remarks(change, variant, s))
                notes.emplace_back(fmt::format("{}, {}: {}", variant.name, s.state, remark));
    notes.insert(notes.end(), change.says.begin(), change.says.end());
    if (notes.empty())
        return;
    page.section("Notes");
    page.list(notes);
}

} // namespace

std::string risk_text(const RiskChange& change)
{
    Document document(fmt::format("Change of risk: {}, comparison {}, hazard {}", change.title, change.comparison_file,
                                  hazard_text(change.hazard)));
    add_answer(change, document);
    add_result(change, document);
    add_notes(change, document);
    return console_text(document);
}

Document risk_page(const RiskChange& change, const std::string& file, const std::optional<std::string>& title)
{
    Document page(title.value_or("Change of risk: " + change.title),
                  fmt::format("Comparison {}, hazard {}. Made by stylobate {}.", change.comparison_file,
                              hazard_text(change.hazard), change.code_version));
    add_answer(change, page);
    add_result(change, page);
    add_change_figures(change, page);
    add_notes(change, page);
    page.section("Reproduction");
    page.facts({{"This estimate", std::filesystem::path(file).filename().string()},
                {"Comparison", change.comparison_file},
                {"Hazard", change.hazard.source}});
    return page;
}

} // namespace stylobate

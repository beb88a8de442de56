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

std::string state_text(const RiskChange& change, const VariantChange& variant, const StateChange& s)
{
    const RiskNumber &base = s.change.base.frequency, &other = s.change.variant.frequency;
    std::string text = fmt::format("  {} ({}): {}\n", s.state, s.meaning, s.verdict());
    if (s.determined)
        text += fmt::format("    {:<13} {} {}; {} {}; change {}; ratio {}\n", "a year:", change.base_name,
                            frequency_text(base), variant.name, frequency_text(other), change_text(s.change.frequency),
                            ratio_text(s.change.ratio));
    for (std::size_t i = 0; s.determined && i < change.years.size(); ++i)
        text += fmt::format("    {:<13} {} {}; {} {}; change {}\n", fmt::format("in {:g} years:", change.years[i]),
                            change.base_name, over_text(base, change.years[i]), variant.name,
                            over_text(other, change.years[i]), points_text(s.change.probability[i]));
    for (const std::string& remark : remarks(change, variant, s))
        text += "    " + remark + "\n";
    return text;
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

std::string risk_text(const RiskChange& change)
{
    std::string text = fmt::format("{}: change of risk by {} and the hazard {}, {:g} % intervals\n", change.title,
                                   change.comparison_file, hazard_text(change.hazard), 100 * change.level);
    text += intervals_text(change) + "\n" + as_new_text + "\n";
    for (const VariantChange& variant : change.variants) {
        text += variant.name + "\n";
        for (const StateChange& s : variant.states)
            text += state_text(change, variant, s);
    }
    for (const std::string& remark : change.says)
        text += "note: " + remark + "\n";
    return text;
}

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

Document risk_page(const RiskChange& change, const std::string& file, const std::optional<std::string>& title)
{
    Document page(title.value_or("Change of risk: " + change.title),
                  fmt::format("Comparison {}, hazard {}. Made by stylobate {}.", change.comparison_file,
                              hazard_text(change.hazard), change.code_version));
    page.section("The answer");
    for (const VariantChange& variant : change.variants) {
        const StateChange& s = variant.principal();
        const std::string verdict = s.verdict();
        page.box(verdict == (s.damage ? "lower" : "higher")   ? "good"
                 : verdict == (s.damage ? "higher" : "lower") ? "bad"
                                                              : "warn",
                 change_title(change, variant), risk_change_answer(change, variant));
    }
    page.section("Result");
    page.paragraph(intervals_text(change) + " " + as_new_text);
    for (const VariantChange& variant : change.variants) {
        HtmlTable table{"llll",
                        {"limit state", "a year, " + change.base_name, "a year, " + variant.name, "change a year"},
                        {},
                        variant.name};
        for (const double years : change.years) {
            table.align += "l";
            table.head.emplace_back(fmt::format("change in {:g} years", years));
        }
        table.align += "l";
        table.head.emplace_back("risk");
        for (const StateChange& s : variant.states) {
            std::vector<Html> row{s.meaning};
            if (s.determined) {
                row.emplace_back(frequency_text(s.change.base.frequency));
                row.emplace_back(frequency_text(s.change.variant.frequency));
                row.emplace_back(change_text(s.change.frequency));
                for (const ChangeNumber& p : s.change.probability)
                    row.emplace_back(points_text(p));
            }
            row.resize(table.head.size() - 1);
            row.emplace_back(s.verdict());
            table.rows.push_back(std::move(row));
        }
        page.table(table);
    }
    add_change_figures(change, page);
    std::vector<Html> notes;
    for (const VariantChange& variant : change.variants)
        for (const StateChange& s : variant.states)
            for (const std::string& remark : remarks(change, variant, s))
                notes.emplace_back(fmt::format("{}, {}: {}", variant.name, s.state, remark));
    notes.insert(notes.end(), change.says.begin(), change.says.end());
    if (!notes.empty()) {
        page.section("Notes");
        page.list(notes);
    }
    page.section("Reproduction");
    page.facts({{"This estimate", std::filesystem::path(file).filename().string()},
                {"Comparison", change.comparison_file},
                {"Hazard", change.hazard.source}});
    return page;
}

} // namespace stylobate

#include "studies/decisions/compare/comparison_text.hpp"

#include "io/files/suggest.hpp"
#include "studies/experiment/conventions.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

/// A line of the table of all places.
struct ComparisonRow {
    const VariantComparison& variant;
    const LimitComparison& limit;
    const PlaceComparison& at;
    std::string place;
};

template <class F>
void visit_fields(std::type_identity<ComparisonRow>, F&& f)
{
    f("variant", [](const ComparisonRow& r) { return r.variant.name; });
    f("limit_state", [](const ComparisonRow& r) { return r.limit.name; });
    f("place", &ComparisonRow::place);
    f("", [](const ComparisonRow& r) -> const PlaceComparison& { return r.at; });
    f("verdict", [](const ComparisonRow& r) { return to_string(r.limit.verdict(r.at)); });
}

namespace {

Json place_json(const LimitComparison& limit, const PlaceComparison& place)
{
    Json json = Json::object();
    json.member("pairs", place.counts.pairs());
    add_members(json, place.counts).member("base", json_of(place.base)).member("variant", json_of(place.variant));
    add_members(json, place,
                {"difference", {"lower", "difference_lower"}, {"upper", "difference_upper"}, "unpaired_realizations"})
        .member("saving", place.saving());
    return add_members(json, place, {"p", "p_adjusted"})
        .member("verdict", to_string(limit.verdict(place)))
        .member("largest_difference", place.largest());
}

Json cells_json(const Comparison& comparison, const LimitComparison& limit)
{
    Json list = Json::list();
    for (std::size_t cell = 0; cell < limit.cells.size(); ++cell) {
        Json json = place_json(limit, limit.cells[cell]);
        json.member("cell", cell);
        if (comparison.cells() > 0)
            json.member(comparison.row_quantity().key, comparison.rows()[cell / comparison.pga_m_s2.size()])
                .member("pga_m_s2", comparison.pga_m_s2[cell % comparison.pga_m_s2.size()]);
        if (!comparison.intensity.empty())
            json.member("intensity", comparison.intensity[cell]);
        list.item(json);
    }
    return list;
}

Json third_json(const PairedDifference& third)
{
    return json_of(third, {{"difference", "value"}, "lower", "upper"});
}

Json dependence_json(const InputDependence& input)
{
    Json json = json_of(input, {{"quantity", "on"}, "z", "p", "p_adjusted"});
    return json.member("between_low", input.found.between[0])
        .member("between_high", input.found.between[1])
        .member("thirds", json_list(input.found.thirds, third_json));
}

Json capacity_json(const CapacityRow& row)
{
    return Json::object()
        .member("place", row.place)
        .member("ratio", row.ratio.value)
        .member("lower", row.ratio.lower)
        .member("upper", row.ratio.upper)
        .member("steps", row.ratio.grid)
        .member("at_least", row.ratio.at_least)
        .member("at_most", row.ratio.at_most);
}

Json input_json(const CommonInput& input)
{
    return json_of(input, {{"quantity", "inputs"}, {"numbers", "input_numbers"}, {"draws", "input_draws"}});
}

Json variant_json(const Comparison& comparison, const VariantComparison& variant)
{
    Json limits = Json::object();
    for (const LimitComparison& limit : variant.limits)
        limits.member(limit.name,
                      Json::object()
                          .member("describe", limit.describe)
                          .member("unknown_pairs", variant.unknown(limit))
                          .member("overall", place_json(limit, limit.overall))
                          .member("worse_cells", json_of(limit.named(comparison.rate, true)))
                          .member("better_cells", json_of(limit.named(comparison.rate, false)))
                          .member("capacity_ratios", json_list(capacity_rows(comparison, limit), capacity_json))
                          .member("cells", cells_json(comparison, limit)));
    Json json = json_of(variant, {"name", "results", "pairs", "invalid_base", "invalid_variant", "dropped_pairs"});
    json.member("common", json_list(variant.inputs, input_json))
        .member("depends_on", json_list(variant.depends, dependence_json));
    return add_members(json, variant, {"notes"}).member("limit_states", limits);
}

/// "friction: same numbers; drum_offset: same quantiles".
std::string inputs_text(const VariantComparison& variant)
{
    std::string text;
    for (const CommonInput& input : variant.inputs)
        text += fmt::format("{}{}{}: {}", text.empty() ? "" : "; ", input.name,
                            input.numbers > 1 ? fmt::format(" ({})", input.numbers) : "", to_string(input.draws));
    return text;
}

/// "dowels: the probability of collapse changes by -10.2 to +5.8 percentage points (95 % interval)"
std::string answer_title(const Comparison& comparison, const VariantComparison& variant)
{
    const LimitComparison& limit = variant.limits.front();
    if (limit.overall.counts.pairs() == 0)
        return variant.name;
    return fmt::format("{}: the probability of {} changes by {} ({:g} % interval)", variant.name, limit.name,
                       points_text(limit.overall), 100 * comparison.level);
}

Html verdict_tag(const LimitComparison& limit, const PlaceComparison& place)
{
    switch (limit.verdict(place)) {
    case ChangeVerdict::better:
        return tag("good", "better");
    case ChangeVerdict::worse:
        return tag("bad", "worse");
    default:
        return verdict_text(limit, place);
    }
}

} // namespace

std::string verdict_text(const LimitComparison& limit, const PlaceComparison& place)
{
    const ChangeVerdict verdict = limit.verdict(place);
    return verdict == ChangeVerdict::open ? "undecided: " + points_text(place) : to_string(verdict);
}

std::string points_text(const PlaceComparison& place)
{
    const auto points = [](double share) {
        return std::abs(share) < 0.00095 ? fmt::format("{:+.1g}", 100 * share) : fmt::format("{:+.1f}", 100 * share);
    };
    return points(place.lower) + " to " + points(place.upper) + " percentage points";
}

std::string share_text(const Share& share)
{
    return fmt::format("{:.3f} ({:.3f} to {:.3f})", share.probability, share.lower, share.upper);
}

std::string difference_text(const PlaceComparison& place)
{
    return fmt::format("{:+.4f} ({:+.4f} to {:+.4f})", place.difference, place.lower, place.upper);
}

std::string capacity_text(const CapacityRatio& ratio)
{
    if (std::isnan(ratio.value))
        return "not in this range";
    const char* bound = ratio.at_least && ratio.at_most ? "not bounded by this range, in it "
                        : ratio.at_least                ? "at least "
                        : ratio.at_most                 ? "at most "
                                                        : "";
    return fmt::format("{}{:.2f} ({:.2f} to {:.2f}; steps x {:.2f})", bound, ratio.value, ratio.lower, ratio.upper,
                       ratio.grid);
}

std::string adjustment_text(const Comparison& comparison)
{
    return comparison.adjustment == "holm"
               ? fmt::format("Holm, any false name in at most {:g} %", 100 * comparison.rate)
               : fmt::format("Benjamini-Hochberg, false names at most {:g} %", 100 * comparison.rate);
}

std::string common_text(const Comparison& comparison)
{
    return comparison.motions > 0
               ? fmt::format("The same {} motions and the same structures under each; the groups of pairs are the "
                             "motions.",
                             comparison.motions)
               : std::string("The same realizations under the same shaking; pairs are independent of each other.");
}

Json comparison_json(const Comparison& comparison)
{
    Json json = json_of(comparison, {{"kind", "study_kind"}, "base", "base_results"});
    json.member("conventions", conventions_text_of(comparison.base_toml).value_or(""))
        .member("left_out", left_out_text_of(comparison.base_toml).value_or(""))
        .member("level", comparison.level)
        .member("common", common_text(comparison));
    add_members(json, comparison, {"adjustment", "false_names", "motions", "measure"});
    if (comparison.adaptive_budget > 0)
        json.member("adaptive", json_of(comparison, {{"budget", "adaptive_budget"},
                                                     {"margin", "adaptive_margin"},
                                                     {"rounds", "adaptive_rounds"}}));
    return json.member("variants", json_list(comparison.variants, [&](const VariantComparison& variant) {
                           return variant_json(comparison, variant);
                       }));
}

Table comparison_rows(const Comparison& comparison)
{
    std::vector<ComparisonRow> rows;
    for (const VariantComparison& each : comparison.variants)
        for (const LimitComparison& limit : each.limits) {
            rows.push_back({each, limit, limit.overall, "all"});
            for (std::size_t cell = 0; limit.cells.size() > 1 && cell < limit.cells.size(); ++cell)
                rows.push_back({each, limit, limit.cells[cell], comparison.place(cell)});
        }
    Table table("comparison");
    add_rows(table, rows);
    return table;
}

namespace {

/// Where the pairs come from: "over the 64 cells of the study".
std::string over_all(const Comparison& c)
{
    if (c.motions > 0)
        return fmt::format("over {}{}", counted(c.motions, "motion"),
                           c.places() > 1 ? fmt::format(" at {} intensities", c.places()) : "");
    return c.places() > 1 ? fmt::format("over the {} cells of the study, each with the same weight", c.places())
                          : "under the study's shaking";
}

std::string interval_text(const PairedDifference& d)
{
    return fmt::format("{:.3f} ({:.3f} to {:.3f})", d.value, d.lower, d.upper);
}

bool depends(const Comparison& c, const InputDependence& input)
{
    return input.p_adjusted <= c.rate;
}

enum class Sign { none, less, more };
template <class Interval>
Sign sign_of(const Interval& interval)
{
    return interval.upper < 0 ? Sign::less : interval.lower > 0 ? Sign::more : Sign::none;
}

/// The third of a quantity in words: "friction below 0.65".
std::string third_text(const InputDependence& input, std::size_t third)
{
    const auto& between = input.found.between;
    switch (third) {
    case 0:
        return fmt::format("{} below {:.3g}", input.input, between[0]);
    case 1:
        return fmt::format("{} from {:.3g} to {:.3g}", input.input, between[0], between[1]);
    default:
        return fmt::format("{} above {:.3g}", input.input, between[1]);
    }
}

/// The cells in which it harms, or helps, with the number of them and the one of the largest difference; nullopt where
/// none is named.
std::optional<std::string> cells_text(const Comparison& c, const VariantComparison& variant, bool worse)
{
    const LimitComparison& limit = variant.limits.front();
    if (c.places() == 1 || !limit.damage)
        return std::nullopt;
    const std::vector<std::size_t> cells = limit.named(c.rate, worse); // the largest difference first
    if (cells.empty())
        return std::nullopt;
    const PlaceComparison& most = limit.cells[cells.front()];
    return fmt::format("It {} in {} of {} {} ({}), most at {}: {:.3f} instead of {:.3f}, difference {}.",
                       worse ? "harms" : "helps", cells.size(), limit.cells.size(),
                       c.motions > 0 ? "intensities" : "cells", adjustment_text(c), c.place(cells.front()),
                       most.variant.probability, most.base.probability, difference_text(most));
}

/// How many pairs, or motions, would show the difference that was found: the distance of the interval's limit from it
/// falls with the root of their number. @pre the interval contains 0
std::string more_pairs_text(const Comparison& c, const PlaceComparison& all)
{
    const char* what = c.motions > 0 ? "motions" : "pairs";
    if (all.difference == 0)
        return fmt::format("More {} would exclude smaller differences; the one that was found is 0.", what);
    const auto number = static_cast<double>(c.motions > 0 ? c.motions : all.counts.pairs());
    const double reach = all.difference < 0 ? all.upper - all.difference : all.difference - all.lower;
    const double needed = std::max(number + 1, number * std::pow(reach / all.difference, 2));
    const double step = std::pow(10, std::max(0.0, std::floor(std::log10(needed)) - 1)); // two digits, upwards
    return fmt::format("More {}: were the difference the one that was found, about {:.0f} instead of {:.0f} would "
                       "show it.",
                       what, std::ceil(needed / step - 1e-6) * step, number);
}

} // namespace

std::string answer_text(const Comparison& c, const VariantComparison& variant)
{
    const LimitComparison& limit = variant.limits.front();
    const PlaceComparison& all = limit.overall;
    if (all.counts.pairs() == 0)
        return fmt::format("With {} nothing can be said: no pair of realizations is valid in both studies.",
                           variant.name);
    std::string text = fmt::format(
        "With {} the probability of {} is {:.3f} instead of {:.3f} {}: a difference of {} at {:g} %. ", variant.name,
        limit.name, all.variant.probability, all.base.probability, over_all(c), difference_text(all), 100 * c.level);
    switch (limit.verdict(all)) {
    case ChangeVerdict::better:
    case ChangeVerdict::less:
        return text + (limit.damage ? "It helps." : "It is less.");
    case ChangeVerdict::worse:
    case ChangeVerdict::more:
        return text + (limit.damage ? "It harms." : "It is more.");
    default:
        return text + (all.largest() < 1 ? "Undecided: " + points_text(all) + "."
                                         : std::string("Undecided: no difference is excluded."));
    }
}

std::optional<std::string> harm_text(const Comparison& c, const VariantComparison& variant)
{
    return cells_text(c, variant, true);
}

std::vector<std::string> what_would_change_it(const Comparison& c, const VariantComparison& variant)
{
    const LimitComparison& limit = variant.limits.front();
    const PlaceComparison& overall = limit.overall;
    if (overall.counts.pairs() == 0)
        return {"Pairs that are valid in both studies; there is none."};
    const Sign answer = sign_of(overall);
    std::vector<std::string> all;
    for (const InputDependence& input : variant.depends) {
        if (!depends(c, input))
            continue;
        for (std::size_t third = 0; third < input.found.thirds.size(); ++third) {
            const PairedDifference& d = input.found.thirds[third];
            if (const Sign sign = sign_of(d); sign != answer)
                all.push_back(fmt::format("{}: {} {}.", third_text(input, third),
                                          sign == Sign::none     ? "no difference is shown,"
                                          : answer == Sign::none ? "a difference is shown,"
                                                                 : "the difference has the other sign,",
                                          interval_text(d)));
        }
    }
    for (const bool worse : {true, false}) // cells that are not as the answer is
        if (const std::optional<std::string> cells = cells_text(c, variant, worse);
            cells && answer != (worse ? Sign::more : Sign::less))
            all.push_back(*cells);
    if (answer == Sign::none)
        all.push_back(more_pairs_text(c, overall));
    if (all.empty())
        all.push_back(variant.depends.empty() ? "Nothing that was examined: no test by drawn quantity was made."
                                              : "None of the drawn quantities is shown to change it.");
    return all;
}

std::string comparison_title(const Comparison& c)
{
    return "Comparison with " + (c.title.empty() ? c.base_name : c.title);
}

void add_answer(const Comparison& c, Document& page)
{
    page.section("The answer");
    for (const VariantComparison& variant : c.variants) {
        const LimitComparison& limit = variant.limits.front();
        const ChangeVerdict verdict = limit.verdict(limit.overall);
        page.box(verdict == ChangeVerdict::better  ? "good"
                 : verdict == ChangeVerdict::worse ? "bad"
                                                   : "warn",
                 answer_title(c, variant), answer_text(c, variant));
        if (const std::optional<std::string> harm = harm_text(c, variant))
            page.note(variant.name + ": " + *harm);
    }
    if (c.adaptive_budget > 0)
        page.note(fmt::format("Adaptive: at most {} pairs of each variant, in {} rounds, until collapse is decided or "
                              "smaller than {:g}; intervals are valid wherever a cell has stopped.",
                              c.adaptive_budget, c.adaptive_rounds, c.adaptive_margin));
    if (const std::optional<std::string> conventions = conventions_text_of(c.base_toml))
        page.note(fmt::format("Conventions of {}: {}.", c.base_name, *conventions));
    add_left_out_of(page, c.base_toml);
}

void add_dependence(const Comparison& c, Document& page)
{
    page.section("What the answer depends on");
    if (c.motions > 0)
        page.paragraph("Pairs share motions here, so no test by drawn quantity was made. How much the answer depends "
                       "on the motions is in the width of its intervals, which take motions, and not pairs, as "
                       "independent.");
    else if (c.adaptive_budget > 0)
        page.paragraph("No test by drawn quantity was made: an adaptive comparison chooses the number of pairs of a "
                       "cell by their outcomes.");
    else if (std::ranges::all_of(c.variants, [](const auto& variant) { return variant.depends.empty(); }))
        page.paragraph("No test by drawn quantity was made: none varies among the pairs of the base.");
    else
        page.paragraph(fmt::format(
            "Differences of the first limit state in the lower, middle and upper third of each drawn quantity, means "
            "over the cells. A quantity counts where the adjusted p-value of its rank test is at most {:g}.",
            c.rate));
    for (const VariantComparison& variant : c.variants) {
        HtmlTable table{
            "lrrrr", {"quantity: its middle third", "below it", "in it", "above it", "adjusted p"}, {}, variant.name};
        for (const InputDependence& input : variant.depends) {
            std::vector<Html>& row = table.rows.emplace_back(std::vector<Html>{third_text(input, 1)});
            for (const PairedDifference& third : input.found.thirds)
                row.emplace_back(interval_text(third));
            row.emplace_back(fmt::format("{:.2g}", input.p_adjusted));
        }
        if (!table.rows.empty())
            page.table(table);
        page.heading("What would change it: " + variant.name);
        const std::vector<std::string> changes = what_would_change_it(c, variant);
        page.list({changes.begin(), changes.end()});
    }
}

namespace {

/// A row of the table of all limit states.
std::vector<Html> limit_row(const VariantComparison& variant, const LimitComparison& limit)
{
    const PlaceComparison& all = limit.overall;
    if (all.counts.pairs() == 0)
        return {limit.name, "no pair"};
    std::string meaning = limit.describe;
    if (const std::uint64_t unknown = variant.unknown(limit); unknown > 0)
        meaning += fmt::format(" ({} left out: still moving at the end)", counted(unknown, "pair"));
    return {limit.name,
            share_text(all.base),
            share_text(all.variant),
            difference_text(all),
            verdict_tag(limit, all),
            fmt::format("{}", all.counts.base_only),
            fmt::format("{}", all.counts.variant_only),
            std::isfinite(all.unpaired) ? fmt::format("a factor of {:.2g}", all.saving()) : "unknown",
            meaning};
}

/// Of the first limit state, a column for each variant; without rows where there are no capacities.
HtmlTable capacity_table(const Comparison& c)
{
    HtmlTable table{"l", {"shaking"}, {}, {}};
    table.caption = fmt::format("Capacity ({} at {}) over that of the base", capacity_measure(c),
                                c.variants.front().limits.front().name);
    for (const VariantComparison& variant : c.variants) {
        const std::vector<CapacityRow> rows = capacity_rows(c, variant.limits.front());
        table.align += "r";
        table.head.emplace_back(variant.name);
        table.rows.resize(rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (table.rows[i].empty())
                table.rows[i].emplace_back(rows[i].place);
            table.rows[i].emplace_back(capacity_text(rows[i].ratio));
        }
    }
    return table;
}

} // namespace

void add_changes(const Comparison& c, Document& page)
{
    page.section("What changes");
    page.paragraph(
        fmt::format("{} Differences are variant minus base ({}), with paired intervals at {:g} %. Base alone "
                    "and variant alone: pairs of which this one alone reached the limit state.",
                    common_text(c), c.base_name, 100 * c.level));
    for (const VariantComparison& variant : c.variants) {
        HtmlTable table{"lrrrlrrrl",
                        {"limit state", "base", variant.name, "difference", "verdict", "base alone", "variant alone",
                         "saved by pairing", "meaning"},
                        {},
                        fmt::format("{}: {}", variant.name, counted(variant.pairs, "pair"))};
        if (variant.dropped > 0)
            table.caption += fmt::format(", {} dropped ({} invalid in the base, {} in the variant)", variant.dropped,
                                         variant.invalid_base, variant.invalid_variant);
        for (const LimitComparison& limit : variant.limits)
            table.rows.push_back(limit_row(variant, limit));
        page.table(table);
    }
    if (const HtmlTable capacities = capacity_table(c); !capacities.rows.empty())
        page.table(capacities);
}

void add_named(const Comparison& c, Document& page, std::size_t most)
{
    if (c.places() == 1)
        return;
    page.section("Where it changes");
    page.paragraph("Cells that are named by the exact test of their discordant pairs, over all cells of a limit "
                   "state: " +
                   adjustment_text(c) + ".");
    for (const VariantComparison& variant : c.variants) {
        std::vector<std::string> none; // limit states of which no cell is named
        for (const LimitComparison& limit : variant.limits) {
            const std::vector<std::size_t> more = limit.named(c.rate, true), less = limit.named(c.rate, false);
            HtmlTable table{"lrrrr", {"place", "base", variant.name, "difference", "adjusted p"}, {}, ""};
            table.caption = fmt::format("{}: {} {} in {} and {} in {} of {} cells", variant.name, limit.name,
                                        limit.damage ? "worse" : "more", more.size(), limit.damage ? "better" : "less",
                                        less.size(), limit.cells.size());
            for (const std::vector<std::size_t>& cells : {more, less}) {
                for (std::size_t i = 0; i < std::min(cells.size(), most); ++i) {
                    const PlaceComparison& cell = limit.cells[cells[i]];
                    table.rows.push_back({c.place(cells[i]), fmt::format("{:.3f}", cell.base.probability),
                                          fmt::format("{:.3f}", cell.variant.probability), difference_text(cell),
                                          fmt::format("{:.2g}", cell.p_adjusted)});
                }
                if (cells.size() > most)
                    table.rows.push_back({fmt::format("and {} more", cells.size() - most)});
            }
            if (table.rows.empty())
                none.push_back(limit.name);
            else
                page.table(table);
        }
        if (!none.empty())
            page.note(fmt::format("{}: no cell is named of {}.", variant.name, fmt::join(none, ", ")));
    }
}

void add_common(const Comparison& c, Document& page)
{
    page.section("What is common");
    std::vector<std::pair<std::string, Html>> draws;
    for (const VariantComparison& variant : c.variants)
        if (!variant.inputs.empty())
            draws.emplace_back("Draws of " + variant.name, inputs_text(variant));
    if (!draws.empty())
        page.facts(draws);
    for (const VariantComparison& variant : c.variants)
        for (const std::string& note : variant.notes)
            page.note(variant.name + ": " + note);
}

std::string comparison_text(const Comparison& comparison)
{
    constexpr std::size_t most_named = 10; // the file and the page have all
    Document document(comparison_title(comparison));
    add_answer(comparison, document);
    add_dependence(comparison, document);
    add_changes(comparison, document);
    add_named(comparison, document, most_named);
    add_common(comparison, document);
    return console_text(document);
}

} // namespace stylobate

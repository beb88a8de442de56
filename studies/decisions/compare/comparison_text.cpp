#include "studies/decisions/compare/comparison_text.hpp"

#include "io/files/suggest.hpp"
#include "studies/experiment/conventions.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

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

constexpr std::size_t most_named = 10; ///< cells in a line of text

/// Cells of one direction: their number, and the largest differences.
std::string named_text(const Comparison& comparison, const LimitComparison& limit, bool worse)
{
    const std::vector<std::size_t> cells = limit.named(comparison.rate, worse);
    if (cells.empty())
        return {};
    const char* what = limit.damage ? (worse ? "worse" : "better") : worse ? "more" : "less";
    std::string text = fmt::format("    {} in {} of {} cells ({}):\n", what, cells.size(), limit.cells.size(),
                                   adjustment_text(comparison));
    for (std::size_t i = 0; i < std::min(cells.size(), most_named); ++i) {
        const PlaceComparison& place = limit.cells[cells[i]];
        text += fmt::format("      {}: {}, adjusted p = {:.2g}\n", comparison.place(cells[i]), difference_text(place),
                            place.p_adjusted);
    }
    if (cells.size() > most_named)
        text += fmt::format("      and {} more\n", cells.size() - most_named);
    return text;
}

Json place_json(const LimitComparison& limit, const PlaceComparison& place)
{
    Json json = Json::object();
    json.member("pairs", place.counts.pairs());
    add_members(json, place.counts)
        .member("base", json_of(place.base))
        .member("variant", json_of(place.variant))
        .member("difference", place.difference)
        .member("lower", place.lower)
        .member("upper", place.upper)
        .member("unpaired_realizations", place.unpaired)
        .member("saving", place.saving())
        .member("p", place.p)
        .member("p_adjusted", place.p_adjusted)
        .member("verdict", to_string(limit.verdict(place)))
        .member("largest_difference", place.largest());
    return json;
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

/// Of the first limit state, over the frequencies.
std::string capacities_text(const Comparison& comparison, const VariantComparison& variant)
{
    std::string text;
    for (const CapacityRow& row : capacity_rows(comparison, variant.limits.front()))
        text += fmt::format("{}{} {}", text.empty() ? "" : "; ", row.place, capacity_text(row.ratio));
    return text.empty() ? text
                        : fmt::format("  capacity ({} at {}) over that of the base: {}\n", capacity_measure(comparison),
                                      variant.limits.front().name, text);
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

std::string variant_text(const Comparison& comparison, const VariantComparison& variant)
{
    std::string text = fmt::format("{}: {} {}", variant.name, variant.pairs, variant.pairs == 1 ? "pair" : "pairs");
    if (variant.dropped > 0)
        text += fmt::format(", {} dropped ({} invalid in the base, {} in the variant)", variant.dropped,
                            variant.invalid_base, variant.invalid_variant);
    text += "\n";
    if (!variant.inputs.empty())
        text += "  draws: " + inputs_text(variant) + "\n";
    for (const std::string& note : variant.notes)
        text += "  " + note + "\n";
    if (variant.pairs == 0)
        return text + "  no pair of realizations is valid in both studies: nothing can be said\n";
    for (const LimitComparison& limit : variant.limits) {
        const PlaceComparison& all = limit.overall;
        text += fmt::format("  {}: {} to {}, difference {}: {}\n", limit.name, share_text(all.base),
                            share_text(all.variant), difference_text(all), verdict_text(limit, all));
        text += fmt::format("    {} discordant pairs ({} base alone, {} variant alone); {}\n", all.counts.discordant(),
                            all.counts.base_only, all.counts.variant_only, saving_text(all));
        if (const std::uint64_t unknown = variant.unknown(limit); unknown > 0)
            text += fmt::format("    of {} pairs: in the other {} a structure still moved at the end\n",
                                all.counts.pairs(), unknown);
        if (limit.cells.size() > 1)
            text += named_text(comparison, limit, true) + named_text(comparison, limit, false);
    }
    text += capacities_text(comparison, variant);
    for (const std::string& dependence : dependence_texts(comparison, variant))
        text += "  depends on " + dependence + "\n";
    return text;
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

std::string saving_text(const PlaceComparison& place)
{
    if (!std::isfinite(place.unpaired))
        return "what pairing saved is not known";
    return place.saving() < 1.05 ? fmt::format("pairing saved nothing (a factor of {:.1f})", place.saving())
                                 : fmt::format("pairing saved a factor of {:.2g}", place.saving());
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

std::string comparison_text(const Comparison& comparison)
{
    std::string text = fmt::format("base {}; intervals at {:g} %. {}\n", comparison.base_name, 100 * comparison.level,
                                   common_text(comparison));
    if (const std::optional<std::string> conventions = conventions_text_of(comparison.base_toml))
        text += "conventions of the base: " + *conventions + "\n";
    if (const std::optional<std::string> left_out = left_out_text_of(comparison.base_toml))
        text += *left_out + "\n";
    if (comparison.adaptive_budget > 0)
        text += fmt::format("adaptive: at most {} pairs of each variant, in {} rounds, until collapse is decided or "
                            "smaller than {:g}; intervals are valid wherever a cell has stopped\n",
                            comparison.adaptive_budget, comparison.adaptive_rounds, comparison.adaptive_margin);
    for (const VariantComparison& variant : comparison.variants)
        text += variant_text(comparison, variant);
    return text;
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

std::vector<std::string> dependence_texts(const Comparison& c, const VariantComparison& variant)
{
    std::vector<std::string> all;
    for (const InputDependence& input : variant.depends)
        if (depends(c, input))
            all.push_back(fmt::format("{}: the difference is {} at {}, and {} at {} (adjusted p = {:.2g}).",
                                      input.input, interval_text(input.found.thirds[0]), third_text(input, 0),
                                      interval_text(input.found.thirds[2]), third_text(input, 2), input.p_adjusted));
    return all;
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

} // namespace stylobate

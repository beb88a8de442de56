#include "studies/decisions/compare/comparison_text.hpp"

#include "studies/decisions/compare/comparison_answer.hpp"
#include "studies/experiment/conventions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t most_named = 10; ///< cells in a line of text

std::string share_text(const Share& share)
{
    return fmt::format("{:.3f} ({:.3f} to {:.3f})", share.probability, share.lower, share.upper);
}

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

Json share_json(const Share& share)
{
    return Json::object()
        .member("trials", share.trials)
        .member("count", share.count)
        .member("probability", share.probability)
        .member("lower", share.lower)
        .member("upper", share.upper);
}

Json place_json(const LimitComparison& limit, const PlaceComparison& place)
{
    Json json = Json::object();
    json.member("pairs", place.counts.pairs())
        .member("both", place.counts.both)
        .member("base_only", place.counts.base_only)
        .member("variant_only", place.counts.variant_only)
        .member("neither", place.counts.neither)
        .member("base", share_json(place.base))
        .member("variant", share_json(place.variant))
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
        if (!comparison.frequency_hz.empty())
            json.member("frequency_hz", comparison.frequency_hz[cell / comparison.pga_m_s2.size()])
                .member("pga_m_s2", comparison.pga_m_s2[cell % comparison.pga_m_s2.size()]);
        if (!comparison.intensity.empty())
            json.member("intensity", comparison.intensity[cell]);
        list.item(json);
    }
    return list;
}

Json named_json(const Comparison& comparison, const LimitComparison& limit, bool worse)
{
    Json list = Json::list();
    for (const std::size_t cell : limit.named(comparison.rate, worse))
        list.item_as_is(fmt::format("{}", cell));
    return list;
}

Json dependence_json(const InputDependence& input)
{
    Json thirds = Json::list();
    for (const PairedDifference& third : input.found.thirds)
        thirds.item(
            Json::object().member("difference", third.value).member("lower", third.lower).member("upper", third.upper));
    return Json::object()
        .member("quantity", input.input)
        .member("z", input.found.z)
        .member("p", input.found.p)
        .member("p_adjusted", input.p_adjusted)
        .member("between_low", input.found.between[0])
        .member("between_high", input.found.between[1])
        .member("thirds", thirds);
}

Json capacity_json(const Comparison& comparison, const LimitComparison& limit)
{
    Json rows = Json::list();
    for (const CapacityRow& row : capacity_rows(comparison, limit))
        rows.item(Json::object()
                      .member("place", row.place)
                      .member("ratio", row.ratio.value)
                      .member("lower", row.ratio.lower)
                      .member("upper", row.ratio.upper)
                      .member("steps", row.ratio.grid)
                      .member("at_least", row.ratio.at_least)
                      .member("at_most", row.ratio.at_most));
    return rows;
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
    Json inputs = Json::list();
    for (const CommonInput& input : variant.inputs)
        inputs.item(Json::object()
                        .member("quantity", input.name)
                        .member("numbers", input.numbers)
                        .member("draws", to_string(input.draws)));
    Json limits = Json::object();
    for (const LimitComparison& limit : variant.limits)
        limits.member(limit.name, Json::object()
                                      .member("describe", limit.describe)
                                      .member("unknown_pairs", variant.unknown(limit))
                                      .member("overall", place_json(limit, limit.overall))
                                      .member("worse_cells", named_json(comparison, limit, true))
                                      .member("better_cells", named_json(comparison, limit, false))
                                      .member("capacity_ratios", capacity_json(comparison, limit))
                                      .member("cells", cells_json(comparison, limit)));
    Json depends = Json::list();
    for (const InputDependence& input : variant.depends)
        depends.item(dependence_json(input));
    Json json = Json::object();
    json.member("name", variant.name)
        .member("results", variant.results)
        .member("pairs", variant.pairs)
        .member("invalid_base", variant.invalid_base)
        .member("invalid_variant", variant.invalid_variant)
        .member("dropped_pairs", variant.dropped)
        .member("common", inputs)
        .member("depends_on", depends)
        .member("notes", Json::list(variant.notes))
        .member("limit_states", limits);
    return json;
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

std::string inputs_text(const VariantComparison& variant)
{
    std::string text;
    for (const CommonInput& input : variant.inputs)
        text += fmt::format("{}{}{}: {}", text.empty() ? "" : "; ", input.name,
                            input.numbers > 1 ? fmt::format(" ({})", input.numbers) : "", to_string(input.draws));
    return text;
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
    if (const std::string conventions = conventions_text_of(comparison.base_toml); !conventions.empty())
        text += "conventions of the base: " + conventions + "\n";
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
    Json variants = Json::list();
    for (const VariantComparison& variant : comparison.variants)
        variants.item(variant_json(comparison, variant));
    Json json = Json::object();
    json.member("kind", comparison.kind)
        .member("base", comparison.base_name)
        .member("base_results", comparison.base_results)
        .member("conventions", conventions_text_of(comparison.base_toml))
        .member("level", comparison.level)
        .member("common", common_text(comparison))
        .member("adjustment", comparison.adjustment)
        .member("false_names", comparison.rate)
        .member("motions", comparison.motions)
        .member("measure", comparison.measure);
    if (comparison.adaptive_budget > 0)
        json.member("adaptive", Json::object()
                                    .member("budget", comparison.adaptive_budget)
                                    .member("margin", comparison.adaptive_margin)
                                    .member("rounds", comparison.adaptive_rounds));
    return json.member("variants", variants);
}

Table comparison_rows(const Comparison& comparison)
{
    std::vector<std::string> variants, limits, places, verdicts;
    std::vector<std::uint64_t> both, base_only, variant_only, neither;
    IntervalArray base, variant, difference;
    std::vector<double> unpaired, p, adjusted;
    const auto add = [&](const VariantComparison& of, const LimitComparison& limit, const PlaceComparison& place,
                         const std::string& name) {
        variants.push_back(of.name);
        limits.push_back(limit.name);
        places.push_back(name);
        verdicts.emplace_back(to_string(limit.verdict(place)));
        both.push_back(place.counts.both);
        base_only.push_back(place.counts.base_only);
        variant_only.push_back(place.counts.variant_only);
        neither.push_back(place.counts.neither);
        base.add(place.base.probability, place.base.lower, place.base.upper);
        variant.add(place.variant.probability, place.variant.lower, place.variant.upper);
        difference.add(place.difference, place.lower, place.upper);
        unpaired.push_back(place.unpaired);
        p.push_back(place.p);
        adjusted.push_back(place.p_adjusted);
    };
    for (const VariantComparison& each : comparison.variants)
        for (const LimitComparison& limit : each.limits) {
            add(each, limit, limit.overall, "all");
            for (std::size_t cell = 0; limit.cells.size() > 1 && cell < limit.cells.size(); ++cell)
                add(each, limit, limit.cells[cell], comparison.place(cell));
        }
    const std::size_t n = variants.size();
    Table table("comparison");
    table.add("variant", variants);
    table.add("limit_state", limits);
    table.add("place", places);
    table.add("both", both);
    table.add("base_only", base_only);
    table.add("variant_only", variant_only);
    table.add("neither", neither);
    table.add("base_probability", base, {n});
    table.add("variant_probability", variant, {n});
    table.add("difference", difference, {n});
    table.add("unpaired_realizations", unpaired);
    table.add("p", p);
    table.add("p_adjusted", adjusted);
    table.add("verdict", verdicts);
    return table;
}

} // namespace stylobate

#include "studies/decisions/risk/risk.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

PairedStripes pairs_of(const Comparison& comparison, const LimitComparison& limit)
{
    const std::size_t stripes = comparison.intensity.size(), motions = limit.by_motion.size() / stripes;
    PairedStripes pairs;
    pairs.intensity = comparison.intensity;
    for (std::size_t g = 0; g < motions; ++g)
        for (std::size_t j = 0; j < stripes; ++j) {
            const PairedCounts& counts = limit.by_motion[j * motions + g];
            pairs.trials.push_back(static_cast<double>(counts.pairs()));
            pairs.base.push_back(static_cast<double>(counts.base()));
            pairs.variant.push_back(static_cast<double>(counts.variant()));
        }
    return pairs;
}

bool has_pairs_everywhere(const LimitComparison& limit)
{
    return std::ranges::all_of(limit.cells, [](const PlaceComparison& cell) { return cell.counts.pairs() > 0; });
}

StateChange change_of(const Comparison& comparison, const LimitComparison& limit, const HazardModel& hazard,
                      const RiskOptions& options)
{
    StateChange found;
    found.state = limit.name;
    found.meaning = limit.describe;
    found.damage = limit.damage;
    for (const PlaceComparison& cell : limit.cells) {
        found.base_share.push_back(cell.base.probability);
        found.variant_share.push_back(cell.variant.probability);
    }
    found.change.probability.resize(options.years.size());
    if (!has_pairs_everywhere(limit)) {
        found.determined = false;
        found.note = "At an intensity no pair of realizations is valid in both studies.";
        return found;
    }
    ChangeOptions wanted;
    wanted.level = options.level;
    wanted.years = options.years;
    found.change = frequency_change(pairs_of(comparison, limit), hazard, wanted);
    for (const auto& [name, of] : {std::pair{"base", &found.change.base}, {"variant", &found.change.variant}})
        if (const std::optional<std::string> why = why_undetermined(*of, options.most_outside);
            why && found.determined) {
            found.determined = false;
            found.note = fmt::format("{}: {}", name, *why);
        }
    if (found.determined && found.change.few)
        found.note = "Few motions show a change: the limits allow for a further motion that has the largest one.";
    return found;
}

} // namespace

void check_has_risk(const Comparison& comparison, const std::string& file)
{
    if (comparison.kind != "fragility")
        throw InputError(file, 0,
                         fmt::format("is a comparison of studies of kind '{}'; a risk is of fragility studies.\n  "
                                     "Compare studies of kind fragility: `stylobate new fragility` writes one.",
                                     comparison.kind));
    if (comparison.intensity.size() < 2)
        throw InputError(file, 0,
                         comparison.intensity.empty()
                             ? "compares clouds, which have no stripes.\n  Compare studies with fragility.method = "
                               "\"stripes\"."
                             : "compares studies with one intensity, which is no curve.\n  Run the studies with "
                               "several intensities (fragility.intensity.count).");
    for (const VariantComparison& variant : comparison.variants)
        for (const LimitComparison& limit : variant.limits)
            if (limit.by_motion.empty())
                throw InputError(file, 0,
                                 "was written without the pairs of each motion, by an earlier version.\n  Compare "
                                 "the results again: stylobate compare BASE.h5 VARIANT.h5 -o COMPARISON.h5.");
}

RiskChange risk_change_of(const Comparison& comparison, const std::string& file, const HazardModel& hazard,
                          const RiskOptions& options)
{
    check_has_risk(comparison, file);
    RiskChange change{facts_of(hazard, options), {}, {}, {}, 0, {}};
    change.title = comparison.title.empty() ? comparison.base_name : comparison.title;
    change.base_name = comparison.base_name;
    change.intensity = comparison.intensity;
    change.motions = comparison.motions;
    for (const VariantComparison& variant : comparison.variants) {
        VariantChange of{variant.name, variant.results, {}};
        std::vector<const LimitComparison*> wanted;
        std::vector<std::string> names;
        for (const LimitComparison& limit : variant.limits) {
            names.push_back(limit.name);
            if (!options.state || options.state == limit.name)
                wanted.push_back(&limit);
        }
        check_state(options.state, names, file + " with " + variant.name);
        of.states.resize(wanted.size());
        in_parallel(std::size_t{0}, wanted.size(),
                    [&](std::size_t i) { of.states[i] = change_of(comparison, *wanted[i], hazard, options); });
        for (const LimitComparison* limit : wanted)
            if (const std::uint64_t unknown = variant.unknown(*limit); unknown > 0)
                change.says.push_back(fmt::format("{}, {}: {} of {} pairs are left out: a structure still moved at the "
                                                  "end.",
                                                  variant.name, limit->name, unknown, variant.pairs));
        if (variant.dropped > 0)
            change.says.push_back(
                fmt::format("{}: {} pairs are left out, invalid in either study.", variant.name, variant.dropped));
        change.variants.push_back(std::move(of));
    }
    if (const std::optional<std::string> left_out = left_out_text_of(comparison.base_toml))
        change.says.push_back(*left_out);
    const auto none = [](const VariantChange& v) {
        return std::ranges::none_of(v.states, [](const StateChange& s) { return s.determined; });
    };
    if (std::ranges::all_of(change.variants, none)) {
        const StateChange& s = change.variants.front().principal();
        throw InputError(fmt::format("{}: {}: {}\n  Or accept it: --most-outside 1.", file, s.state, s.note));
    }
    return change;
}

} // namespace stylobate

#include "studies/decisions/compare/pairing.hpp"

#include "ensemble/estimators/fragility/record_share.hpp"
#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/estimators/paired/paired_tests.hpp"
#include "ensemble/numerics/interval.hpp"
#include "studies/decisions/compare/drawn_quantities.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

using Reached = std::uint64_t (PairedCounts::*)() const;

PairedCounts sum_of(std::span<const PairedCounts> counts)
{
    PairedCounts all;
    for (const PairedCounts& one : counts)
        all += one;
    return all;
}

/// Level of the sides' own intervals: at the quantile of the looks where there are any.
double side_level(const PairLayout& layout)
{
    return layout.looks ? std::erf(layout.looks->quantile() / std::sqrt(2.0)) : layout.level;
}

/// A side's own probability: by Jeffreys, or by the motions.
Share share_of_side(std::span<const PairedCounts> groups, Reached reached, const PairLayout& layout)
{
    const PairedCounts all = sum_of(groups);
    const std::uint64_t trials = all.pairs(), count = (all.*reached)();
    Share share = share_of(trials, count);
    if (layout.groups > 0) {
        std::vector<RecordCount> records;
        for (const PairedCounts& group : groups)
            records.push_back({static_cast<double>(group.pairs()), static_cast<double>((group.*reached)())});
        const Limits limits = record_share_limits(records, layout.level);
        share.lower = limits.lower;
        share.upper = limits.upper;
    } else {
        const BinomialInterval limits = jeffreys(trials, count, side_level(layout));
        share.lower = limits.lower;
        share.upper = limits.upper;
    }
    return share;
}

/// The mean over cells of equal weight, with the interval of as many trials as have its variance if the cells were
/// alike.
Share mean_share(std::span<const PairedCounts> cells, Reached reached, const PairLayout& layout)
{
    double number = 0, mean = 0, inverse = 0;
    for (const PairedCounts& cell : cells)
        if (cell.pairs() > 0) {
            number += 1;
            mean += static_cast<double>((cell.*reached)()) / static_cast<double>(cell.pairs());
            inverse += 1 / static_cast<double>(cell.pairs());
        }
    const PairedCounts all = sum_of(cells);
    Share share = share_of(all.pairs(), (all.*reached)());
    if (number == 0)
        return share;
    share.probability = mean / number;
    const auto trials = static_cast<std::uint64_t>(std::llround(number * number / inverse));
    const auto count = static_cast<std::uint64_t>(std::llround(share.probability * static_cast<double>(trials)));
    const BinomialInterval limits = jeffreys(trials, std::min(count, trials), side_level(layout));
    share.lower = limits.lower;
    share.upper = limits.upper;
    return share;
}

void take(PlaceComparison& place, const PairedDifference& found)
{
    place.difference = found.value;
    place.lower = found.lower;
    place.upper = found.upper;
}

PairedDifference at_a_look(const PairedCounts& counts, const RepeatedLooks& looks)
{
    return score_interval(static_cast<double>(counts.pairs()), static_cast<double>(counts.base_only),
                          static_cast<double>(counts.variant_only), looks.quantile());
}

/// By McNemar's statistic, valid at whichever look the cell has stopped.
double p_at_a_look(const PlaceComparison& place, const PairLayout& layout)
{
    const auto b = static_cast<double>(place.counts.variant_only), c = static_cast<double>(place.counts.base_only);
    return b + c > 0 ? layout.looks->p_value(std::abs(b - c) / std::sqrt(b + c)) : 1;
}

} // namespace

PairLayout pair_layout(const Study& study, const MotionTable& motions, double level)
{
    PairLayout layout{.per_cell = study.realizations, .level = level};
    if (study.surface)
        layout.cells = static_cast<std::size_t>(study.surface->cells());
    if (study.fragility) {
        layout.cells = static_cast<std::size_t>(study.fragility->stripes());
        layout.motions = motion_groups(study, motions);
        layout.groups = layout.motions.groups;
    }
    if (!study.surface && !study.fragility)
        layout.per_cell = study.originals();
    return layout;
}

std::vector<PairedCounts> count_pairs(const StudySide& base, const StudySide& variant, std::size_t base_limit,
                                      std::size_t variant_limit, const PairLayout& layout)
{
    const std::size_t groups = std::max<std::size_t>(1, layout.groups);
    std::vector<PairedCounts> counts(layout.cells * groups);
    for (std::uint64_t index = 0; index < base.size(); ++index)
        if (layout.has(index) && base.has(index) && variant.has(index) && base.known(index, base_limit) &&
            variant.known(index, variant_limit))
            counts[layout.cell(index) * groups + layout.group(index)].add(base.reached(index, base_limit),
                                                                          variant.reached(index, variant_limit));
    return counts;
}

PlaceComparison compare_place(std::span<const PairedCounts> groups, const PairLayout& layout)
{
    PlaceComparison place;
    place.counts = sum_of(groups);
    place.base = share_of_side(groups, &PairedCounts::base, layout);
    place.variant = share_of_side(groups, &PairedCounts::variant, layout);
    const bool grouped = layout.groups > 0;
    const PairedDifference found = grouped ? grouped_difference(groups, layout.level)
                                   : layout.looks && place.counts.pairs() > 0
                                       ? at_a_look(place.counts, *layout.looks)
                                       : paired_difference(place.counts, layout.level);
    take(place, found);
    place.unpaired =
        static_cast<double>(place.counts.pairs()) * (grouped ? pairing_gain_of_groups(groups) : pairing_gain(groups));
    place.p = grouped ? sign_flip_p(groups) : layout.looks ? p_at_a_look(place, layout) : mcnemar_p(place.counts);
    place.p_adjusted = place.p;
    return place;
}

PlaceComparison compare_overall(std::span<const PairedCounts> counts, const PairLayout& layout)
{
    if (layout.groups > 0) {
        std::vector<PairedCounts> groups(layout.groups);
        for (std::size_t i = 0; i < counts.size(); ++i)
            groups[i % layout.groups] += counts[i];
        return compare_place(groups, layout);
    }
    if (layout.cells == 1)
        return compare_place(counts, layout);
    PlaceComparison place;
    place.counts = sum_of(counts);
    place.base = mean_share(counts, &PairedCounts::base, layout);
    place.variant = mean_share(counts, &PairedCounts::variant, layout);
    const PairedDifference found = layout.looks ? weighted_difference(counts, {}, layout.looks->quantile())
                                                : stratified_difference(counts, layout.level);
    take(place, found);
    place.unpaired = static_cast<double>(place.counts.pairs()) * pairing_gain(counts);
    // in standard errors, from the interval
    place.p = layout.looks ? layout.looks->p_value(std::abs(found.value) / found.half_width() * found.quantile)
                           : mcnemar_p(place.counts);
    place.p_adjusted = place.p;
    return place;
}

VariantComparison compare_sides(const StudySide& base, const std::vector<std::string>& base_inputs,
                                const StudySide& variant, const std::vector<std::string>& variant_inputs,
                                const PairLayout& layout)
{
    VariantComparison found;
    for (std::uint64_t index = 0; index < base.size(); ++index) {
        if (!layout.has(index) || !base.has(index) || !variant.has(index))
            continue;
        found.invalid_base += !base.valid(index);
        found.invalid_variant += !variant.valid(index);
        ++(base.valid(index) && variant.valid(index) ? found.pairs : found.dropped);
    }
    found.inputs = common_inputs(base.draws(), base_inputs, variant.draws(), variant_inputs);
    const std::size_t groups = std::max<std::size_t>(1, layout.groups);
    for (std::size_t i = 0; i < base.limits().size(); ++i) {
        const LimitDefinition& definition = base.limits()[i];
        const auto same = std::ranges::find(variant.limits(), definition.name, &LimitDefinition::name);
        if (same == variant.limits().end()) // of epistyles that one of the two has not
            continue;
        const std::vector<PairedCounts> counts =
            count_pairs(base, variant, i, static_cast<std::size_t>(same - variant.limits().begin()), layout);
        LimitComparison limit{definition.name, definition.describe, definition.damage, {}, {}, {}};
        std::vector<double> p;
        for (std::size_t cell = 0; cell < layout.cells; ++cell) {
            limit.cells.push_back(compare_place(std::span(counts).subspan(cell * groups, groups), layout));
            p.push_back(limit.cells.back().p);
        }
        const std::vector<double> adjusted = layout.groups > 0 ? holm(p) : benjamini_hochberg(p);
        for (std::size_t cell = 0; cell < layout.cells; ++cell)
            limit.cells[cell].p_adjusted = adjusted[cell];
        limit.overall = compare_overall(counts, layout);
        if (layout.groups > 0)
            limit.by_motion = counts;
        found.limits.push_back(std::move(limit));
    }
    return found;
}

} // namespace stylobate

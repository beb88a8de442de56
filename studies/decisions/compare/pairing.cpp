#include "studies/decisions/compare/pairing.hpp"

#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/estimators/paired/paired_tests.hpp"
#include "ensemble/numerics/interval.hpp"
#include "studies/kinds/fragility/damage.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

std::vector<LimitDefinition> damage_definitions(const Study& study, const ResultHeader& header)
{
    std::vector<LimitDefinition> all;
    const double width = base_width_m(study.structure);
    const std::uint64_t stripes = study.design().columns;
    for (const DamageState& state : damage_states(study))
        all.push_back(
            {state.name, state.describe, true, [&study, &header, state, width, stripes](const ResultRow& row) {
                 return reached(state, row.outcome, width,
                                next_shaking_s(study, header.motions, row.cell / stripes, state.shaking));
             }});
    std::stable_partition(all.begin(), all.end(), [](const LimitDefinition& one) { return one.name == "collapse"; });
    return all;
}

/// The limit states of a study: those of surfaces (limit_state.hpp), or the damage states of a fragility study.
/// @param study, header must outlive what is returned
std::vector<LimitDefinition> limit_definitions(const Study& study, const ResultHeader& header)
{
    if (study.design().motions)
        return damage_definitions(study, header);
    std::vector<LimitDefinition> all;
    for (std::size_t i = 0; i < limit_state_names().size(); ++i) {
        const auto limit = static_cast<LimitState>(i);
        if ((limit == LimitState::total && study.outcome.follow != Follow::rest) ||
            (limit == LimitState::unseated && study.structure.epistyles.empty()))
            continue;
        all.push_back({limit_state_names()[i], describe(limit),
                       limit != LimitState::rocked && limit != LimitState::slid && limit != LimitState::moving,
                       [limit](const ResultRow& row) { return reached(limit, row.outcome); }});
    }
    return all;
}

} // namespace

StudySide::StudySide(const Study& study, const ResultHeader& header)
    : limits_(limit_definitions(study, header)), state_(study.originals()), per_cell_(study.realizations),
      drawn_per_cell_(std::max<std::uint64_t>(1, most_draws / study.cells()))
{
    assert(limits_.size() <= most_limits && "limit states have a bit each");
}

void StudySide::add(const ResultRow& row)
{
    if (row.index >= state_.size()) // a replica
        return;
    std::uint64_t state = present;
    if (row.outcome.state == State::invalid)
        state |= invalid;
    else
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            const std::optional<bool> reached = limits_[i].reached(row);
            state |= static_cast<std::uint64_t>(reached.value_or(false)) << i;
            state |= static_cast<std::uint64_t>(!reached) << (most_limits + i);
        }
    state_[row.index] = state;
    if (row.index % per_cell_ < drawn_per_cell_)
        draws_.push_back({row.index, row.inputs});
}

std::vector<StudySide::Draws> StudySide::draws() const
{
    std::vector<Draws> sorted = draws_;
    std::sort(sorted.begin(), sorted.end(), [](const Draws& a, const Draws& b) { return a.index < b.index; });
    return sorted;
}

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
    const StudyDesign design = study.design();
    if (study.surface)
        layout.cells = design.cells;
    if (design.motions) {
        layout.cells = design.columns;
        layout.motions = motion_groups(study, motions);
        layout.groups = layout.motions.groups;
    }
    if (!study.surface && !design.motions)
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

namespace {

/// "friction" of "friction[3]".
std::string quantity_of(const std::string& input)
{
    return input.substr(0, input.find('['));
}

/// How two numbers of the same realizations are related.
CommonDraws relation(std::vector<std::pair<double, double>> values)
{
    if (std::all_of(values.begin(), values.end(), [](const auto& value) {
            return std::bit_cast<std::uint64_t>(value.first) == std::bit_cast<std::uint64_t>(value.second);
        }))
        return CommonDraws::same;
    std::sort(values.begin(), values.end());
    for (std::size_t i = 1; i < values.size(); ++i)
        if (values[i].second < values[i - 1].second)
            return CommonDraws::other;
    return CommonDraws::quantiles;
}

class Inputs {
public:
    void add(const std::string& input, CommonDraws draws)
    {
        const std::string name = quantity_of(input);
        for (CommonInput& each : list)
            if (each.name == name && each.draws == draws) {
                ++each.numbers;
                return;
            }
        list.push_back({name, draws, 1});
    }
    std::vector<CommonInput> list;
};

} // namespace

std::vector<CommonInput> common_inputs(const std::vector<StudySide::Draws>& base,
                                       const std::vector<std::string>& base_names,
                                       const std::vector<StudySide::Draws>& variant,
                                       const std::vector<std::string>& variant_names)
{
    Inputs inputs;
    for (std::size_t i = 0; i < base_names.size(); ++i) {
        const auto same = std::find(variant_names.begin(), variant_names.end(), base_names[i]);
        if (same == variant_names.end()) {
            inputs.add(base_names[i], CommonDraws::base_only);
            continue;
        }
        const auto k = static_cast<std::size_t>(same - variant_names.begin());
        std::vector<std::pair<double, double>> values;
        for (auto a = base.begin(), b = variant.begin(); a != base.end() && b != variant.end();) {
            if (a->index == b->index)
                values.emplace_back(a->inputs[i], b->inputs[k]);
            const bool next_a = a->index <= b->index, next_b = b->index <= a->index;
            a += next_a;
            b += next_b;
        }
        inputs.add(base_names[i], relation(std::move(values)));
    }
    for (const std::string& name : variant_names)
        if (std::find(base_names.begin(), base_names.end(), name) == base_names.end())
            inputs.add(name, CommonDraws::variant_only);
    return inputs.list;
}

namespace {

/// A quantity, and which of the inputs it is.
struct DrawnQuantity {
    std::string name;
    std::vector<std::size_t> inputs;
};

std::vector<DrawnQuantity> quantities_of(const std::vector<std::string>& inputs)
{
    std::vector<DrawnQuantity> all;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const std::string name = quantity_of(inputs[i]);
        auto at = std::ranges::find(all, name, &DrawnQuantity::name);
        if (at == all.end())
            at = all.insert(all.end(), {name, {}});
        at->inputs.push_back(i);
    }
    return all;
}

} // namespace

std::vector<InputDependence> input_dependences(const ResultReader& rows, const StudySide& base,
                                               const StudySide& variant, std::size_t base_limit,
                                               std::size_t variant_limit, const PairLayout& layout)
{
    std::vector<InputDependence> all;
    if (layout.groups > 0)
        return all;
    const std::uint64_t of_each_cell = std::max<std::uint64_t>(2, most_dependence_pairs / layout.cells);
    const std::vector<DrawnQuantity> quantities = quantities_of(rows.header().input_names);
    std::vector<PairedTrial> trials;
    std::vector<std::vector<double>> values(quantities.size());
    rows.for_each_row([&](const ResultRow& row) {
        const std::uint64_t index = row.index;
        if (index >= base.size() || !layout.has(index) || index % layout.per_cell >= of_each_cell || !base.has(index) ||
            !variant.has(index) || !base.known(index, base_limit) || !variant.known(index, variant_limit))
            return;
        trials.push_back({layout.cell(index), base.reached(index, base_limit), variant.reached(index, variant_limit)});
        for (std::size_t q = 0; q < quantities.size(); ++q) {
            double sum = 0;
            for (const std::size_t i : quantities[q].inputs)
                sum += row.inputs[i];
            values[q].push_back(sum / static_cast<double>(quantities[q].inputs.size()));
        }
    });
    if (trials.size() < 3)
        return all;
    std::vector<double> p;
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        const auto [least, most] = std::ranges::minmax(values[q]);
        if (!std::isfinite(least) || !std::isfinite(most) || least == most)
            continue;
        all.push_back({quantities[q].name, dependence_on(trials, values[q], layout.level), 1});
        p.push_back(all.back().found.p);
    }
    const std::vector<double> adjusted = holm(p);
    for (std::size_t k = 0; k < all.size(); ++k)
        all[k].p_adjusted = adjusted[k];
    std::ranges::stable_sort(all, {}, [](const InputDependence& one) { return one.found.p; });
    return all;
}

} // namespace stylobate

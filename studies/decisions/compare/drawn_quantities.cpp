#include "studies/decisions/compare/drawn_quantities.hpp"

#include "ensemble/estimators/paired/paired_tests.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace stylobate {

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

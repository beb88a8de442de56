#include "studies/decisions/compare/common_draws.hpp"

#include <algorithm>
#include <bit>
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

} // namespace stylobate

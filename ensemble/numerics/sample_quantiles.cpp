#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace stylobate {

double sorted_quantile(std::span<const double> ascending, double p, QuantileDefinition definition)
{
    assert(!ascending.empty() && p >= 0 && p <= 1);
    const auto n = static_cast<double>(ascending.size());
    if (definition == QuantileDefinition::above)
        return ascending[std::min(static_cast<std::size_t>(p * n), ascending.size() - 1)];
    const double place =
        definition == QuantileDefinition::linear ? p * (n - 1) : std::clamp(p * (n + 1) - 1, 0.0, n - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, ascending.size() - 1);
    const double part = place - static_cast<double>(below);
    if (part == 0 || ascending[below] == ascending[above]) // infinite ones too; + 0 makes no negative zero
        return ascending[below] + 0.0;
    return ascending[below] + part * (ascending[above] - ascending[below]);
}

double sorted_median(std::span<const double> ascending)
{
    assert(!ascending.empty());
    const double low = ascending[(ascending.size() - 1) / 2], high = ascending[ascending.size() / 2];
    return low == high ? low : (low + high) / 2;
}

double upper_median(std::vector<double> values)
{
    assert(!values.empty());
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace stylobate

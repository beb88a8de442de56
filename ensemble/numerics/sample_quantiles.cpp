#include "ensemble/numerics/sample_quantiles.hpp"

#include "ensemble/numerics/interval.hpp"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

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

namespace {

constexpr double tail = 0.025;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

Estimated estimated_mean(const std::vector<double>& values)
{
    Estimated mean{0, nan, -infinity, infinity};
    double sum = 0;
    for (const double v : values)
        if (!std::isnan(v)) {
            ++mean.count;
            sum += v;
        }
    if (mean.count == 0)
        return mean;
    const auto n = static_cast<double>(mean.count);
    mean.value = sum / n;
    if (mean.count < 2)
        return mean;
    double squares = 0;
    for (const double v : values)
        if (!std::isnan(v))
            squares += (v - mean.value) * (v - mean.value);
    const double half = student_quantile(1 - tail, n - 1) * std::sqrt(squares / (n - 1) / n);
    mean.lower = mean.value - half;
    mean.upper = mean.value + half;
    return mean;
}

Estimated estimated_median(std::vector<double> values)
{
    Estimated median{values.size(), nan, -infinity, infinity};
    if (values.empty())
        return median;
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    median.value = sorted_median(values);
    // the k-th from below and from above, the largest k with P(fewer than k values below the median) <= tail
    const boost::math::binomial fair(static_cast<double>(n), 0.5);
    std::size_t k = 0;
    while (boost::math::cdf(fair, static_cast<double>(k)) <= tail)
        ++k;
    if (k > 0) {
        median.lower = values[k - 1];
        median.upper = values[n - k];
    }
    return median;
}

} // namespace stylobate

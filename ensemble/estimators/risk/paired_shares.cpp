#include "ensemble/estimators/risk/paired_shares.hpp"

#include "ensemble/numerics/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

PairedEstimate paired_difference(const PairedCounts& c, double level)
{
    const auto n = static_cast<double>(c.trials()), first = static_cast<double>(c.first),
               second = static_cast<double>(c.second);
    if (!(n > 0))
        return {std::nan(""), {-1, 1}};
    const double p = (first + 1) / (n + 2), q = (second + 1) / (n + 2), z = normal_quantile((1 + level) / 2);
    const double reach = z * std::sqrt((p + q - (p - q) * (p - q)) / (n + 2));
    return {(first - second) / n, {std::max(p - q - reach, -1.0), std::min(p - q + reach, 1.0)}};
}

PairedEstimate paired_ratio(const PairedCounts& c, double level)
{
    const auto first = static_cast<double>(c.both + c.first), second = static_cast<double>(c.both + c.second);
    if (c.both + c.first == 0 || c.both + c.second == 0)
        return {first / second, {0, std::numeric_limits<double>::infinity()}};
    const double reach =
        normal_quantile((1 + level) / 2) * std::sqrt((static_cast<double>(c.first + c.second) + 1) / (first * second));
    const double ratio = first / second;
    return {ratio, {ratio * std::exp(-reach), ratio * std::exp(reach)}};
}

} // namespace stylobate

#include "ensemble/estimators/paired/capacity_ratio.hpp"

#include "ensemble/estimators/paired/paired_difference.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

std::vector<double> trapezoids(std::span<const double> intensities)
{
    std::vector<double> weights(intensities.size(), 0);
    for (std::size_t i = 0; i + 1 < intensities.size(); ++i) {
        const double half = std::log(intensities[i + 1] / intensities[i]) / 2;
        weights[i] += half;
        weights[i + 1] += half;
    }
    return weights;
}

double share(std::uint64_t reached, const PairedCounts& of)
{
    return of.pairs() > 0 ? static_cast<double>(reached) / static_cast<double>(of.pairs()) : 0;
}

/// The logarithm of the ratio, from the differences' weighted sum.
struct LogRatio {
    double value, lower, upper;
};

/// Over the motions: each has its own sum of w_i d_i.
LogRatio over_groups(std::span<const double> weights, std::span<const PairedCounts> counts, std::size_t groups,
                     double level)
{
    std::vector<double> sums;
    for (std::size_t g = 0; g < groups; ++g) {
        double sum = 0;
        bool whole = true; // a motion without pairs at one of the intensities has no sum
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const PairedCounts& c = counts[i * groups + g];
            const auto n = static_cast<double>(c.pairs());
            whole = whole && n > 0;
            if (whole)
                sum -= weights[i] * (static_cast<double>(c.variant_only) - static_cast<double>(c.base_only)) / n;
        }
        if (whole)
            sums.push_back(sum);
    }
    const auto n = static_cast<double>(sums.size());
    double mean = 0, squares = 0;
    for (const double s : sums)
        mean += s / n;
    for (const double s : sums)
        squares += (s - mean) * (s - mean);
    if (n == 0)
        mean = std::numeric_limits<double>::quiet_NaN();
    if (n < 2)
        return {mean, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    const double half = two_sided_student(level, n - 1) * std::sqrt(squares / (n * (n - 1)));
    return {mean, mean - half, mean + half};
}

} // namespace

CapacityRatio capacity_ratio(std::span<const double> intensities, std::span<const PairedCounts> counts,
                             std::size_t groups, double level)
{
    assert(counts.size() == intensities.size() * std::max<std::size_t>(1, groups));
    const std::vector<double> weights = trapezoids(intensities);
    std::vector<PairedCounts> at(intensities.size());
    for (std::size_t i = 0; i < counts.size(); ++i)
        at[i / std::max<std::size_t>(1, groups)] += counts[i];
    PairedCounts all;
    double range = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        all += at[i];
        range += weights[i];
    }
    CapacityRatio ratio{.value = std::numeric_limits<double>::quiet_NaN(),
                        .lower = 0,
                        .upper = std::numeric_limits<double>::infinity()};
    const auto separated = [&](std::uint64_t reached) { return reached > 0 && reached < all.pairs(); };
    if (!separated(all.base()) && !separated(all.variant()) && all.base() == all.variant())
        return ratio;
    LogRatio log{};
    if (groups > 0) {
        log = over_groups(weights, counts, groups, level);
    } else {
        const PairedDifference d = weighted_difference(at, weights, two_sided_normal(level));
        log = {-range * d.value, -range * d.upper, -range * d.lower};
    }
    double off = 0;
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
        off += std::log(intensities[i + 1] / intensities[i]) / 2 *
               (std::fabs(share(at[i + 1].base(), at[i + 1]) - share(at[i].base(), at[i])) +
                std::fabs(share(at[i + 1].variant(), at[i + 1]) - share(at[i].variant(), at[i])));
    ratio.grid = std::exp(off);
    ratio.value = std::exp(log.value);
    ratio.lower = std::exp(log.lower);
    ratio.upper = std::exp(log.upper);
    for (const PairedCounts& end : {at.front(), at.back()}) {
        const PairedDifference d = paired_difference(end, level);
        ratio.at_least = ratio.at_least || d.upper < 0;
        ratio.at_most = ratio.at_most || d.lower > 0;
    }
    return ratio;
}

} // namespace stylobate

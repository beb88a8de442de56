#include "ensemble/estimators/paired/paired_difference.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

struct GroupSums {
    double groups = 0, pairs = 0;
};
template <class Groups>
GroupSums sums_of(const Groups& groups)
{
    GroupSums sums;
    for (const PairedCounts& group : groups)
        if (group.pairs() > 0) {
            sums.groups += 1;
            sums.pairs += static_cast<double>(group.pairs());
        }
    return sums;
}

/// The variance between groups over that of independent trials, within its bounds.
double bounded_effect(double between, double independent, const GroupSums& sums)
{
    const double most = std::max(1.0, sums.pairs / sums.groups);
    if (!(independent > 0))
        return most;
    return std::clamp(sums.groups / (sums.groups - 1) * between / independent, most > 1 ? 0.5 : 1.0, most);
}

} // namespace

PairedRatio paired_ratio(const PairedCounts& counts, double level)
{
    const auto base = static_cast<double>(counts.base()), variant = static_cast<double>(counts.variant());
    const double ratio = variant / base;
    if (!(base > 0 && variant > 0))
        return {ratio, 0, std::numeric_limits<double>::infinity()};
    const double reach = std::exp(two_sided_normal(level) *
                                  std::sqrt((static_cast<double>(counts.discordant()) + 1) / (base * variant)));
    return {ratio, ratio / reach, ratio * reach};
}

double two_sided_normal(double level)
{
    return quantile(boost::math::normal_distribution<double>(), (1 + level) / 2);
}

PairedDifference score_interval(double pairs, double base_only, double variant_only, double z)
{
    const double n = pairs, b = variant_only, c = base_only;
    PairedDifference found{(b - c) / n, -1, 1, 1, z};
    // how many standard errors the counts are from a difference d
    const auto score = [&](double d) {
        const double linear = (2 * n - b + c) * d - b - c, constant = c * d * (1 - d);
        const double root = std::sqrt(std::max(0.0, linear * linear + 8 * n * constant));
        const double q10 = (root - linear) / (4 * n);
        return (b - c - n * d) / std::sqrt(std::max(n * (2 * q10 + d * (1 - d)), std::numeric_limits<double>::min()));
    };
    const auto solve = [&](double target, double low, double high) {
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2;
            (score(middle) > target ? low : high) = middle;
        }
        return (low + high) / 2;
    };
    found.lower = found.value <= -1 ? -1 : solve(z, -1, found.value);
    found.upper = found.value >= 1 ? 1 : solve(-z, found.value, 1);
    return found;
}

double two_sided_student(double level, double freedom)
{
    return quantile(boost::math::students_t_distribution<double>(freedom), (1 + level) / 2);
}

PairedDifference paired_difference(const PairedCounts& counts, double level)
{
    const double z = two_sided_normal(level);
    if (counts.pairs() == 0)
        return {std::numeric_limits<double>::quiet_NaN(), -1, 1, 1, z};
    return score_interval(static_cast<double>(counts.pairs()), static_cast<double>(counts.base_only),
                          static_cast<double>(counts.variant_only), z);
}

PairedDifference grouped_difference(std::span<const PairedCounts> groups, double level)
{
    PairedCounts all;
    for (const PairedCounts& group : groups)
        all += group;
    const GroupSums sums = sums_of(groups);
    if (sums.groups == sums.pairs) // each pair is a group, or there is none
        return paired_difference(all, level);
    const double n = sums.pairs, b = static_cast<double>(all.variant_only), c = static_cast<double>(all.base_only);
    const double d = (b - c) / n;
    if (sums.groups < 2)
        return {d, -1, 1, n, std::numeric_limits<double>::infinity()};
    double between = 0;
    for (const PairedCounts& group : groups) {
        const double excess = static_cast<double>(group.variant_only) - static_cast<double>(group.base_only) -
                              static_cast<double>(group.pairs()) * d;
        between += excess * excess;
    }
    const double effect = bounded_effect(between, n * ((b + c) / n - d * d), sums);
    PairedDifference found =
        score_interval(n / effect, c / effect, b / effect, two_sided_student(level, sums.groups - 1));
    found.value = d;
    found.design_effect = effect;
    return found;
}

PairedDifference weighted_difference(std::span<const PairedCounts> strata, std::span<const double> weights, double z)
{
    double sum = 0, d = 0, q = 0, variance = 0, inverse = 0;
    bool single = false; // a cell with one pair gives no variance
    for (std::size_t i = 0; i < strata.size(); ++i) {
        const PairedCounts& cell = strata[i];
        const auto n = static_cast<double>(cell.pairs());
        if (n == 0)
            continue;
        const double weight = weights.empty() ? 1 : weights[i];
        sum += weight;
        inverse += weight * weight / n;
        single = single || n == 1;
        const double share = static_cast<double>(cell.discordant()) / n;
        const double own = (static_cast<double>(cell.variant_only) - static_cast<double>(cell.base_only)) / n;
        d += weight * own;
        q += weight * share;
        variance += weight * weight * (share - own * own) / std::max(n - 1, 1.0);
    }
    if (sum == 0)
        return {std::numeric_limits<double>::quiet_NaN(), -1, 1, 1, z};
    d /= sum;
    q /= sum;
    variance /= sum * sum;
    // the pairs of equal cells with the same mean of 1 / n; cells that are all or nothing seem to have no variance, and
    // the gain of strata is bounded as a design effect is
    const double pairs = sum * sum / inverse;
    const double n = variance > 0 && !single ? std::min((q - d * d) / variance, 2 * pairs) : pairs;
    PairedDifference found = score_interval(n, n * (q - d) / 2, n * (q + d) / 2, z);
    found.value = d;
    return found;
}

PairedDifference stratified_difference(std::span<const PairedCounts> strata, double level)
{
    return weighted_difference(strata, {}, two_sided_normal(level));
}

double pairing_gain(std::span<const PairedCounts> strata)
{
    double alone = 0, paired = 0;
    for (const PairedCounts& cell : strata) {
        const auto n = static_cast<double>(cell.pairs());
        if (n < 2) // gives no variance
            continue;
        const double base = static_cast<double>(cell.base()) / n, variant = static_cast<double>(cell.variant()) / n;
        const double d = variant - base;
        alone += (base * (1 - base) + variant * (1 - variant)) / (n - 1);
        paired += (static_cast<double>(cell.discordant()) / n - d * d) / (n - 1);
    }
    return paired > 0 ? alone / paired : std::numeric_limits<double>::quiet_NaN();
}

double pairing_gain_of_groups(std::span<const PairedCounts> groups)
{
    PairedCounts all;
    for (const PairedCounts& group : groups)
        all += group;
    double alone = 0, paired = 0;
    for (const PairedCounts& group : groups) {
        const double part = static_cast<double>(group.pairs()) / static_cast<double>(all.pairs());
        const double base = static_cast<double>(group.base()) - part * static_cast<double>(all.base());
        const double variant = static_cast<double>(group.variant()) - part * static_cast<double>(all.variant());
        alone += base * base + variant * variant;
        paired += (variant - base) * (variant - base);
    }
    return paired > 0 ? alone / paired : std::numeric_limits<double>::quiet_NaN();
}

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

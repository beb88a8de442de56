#include "ensemble/estimators/paired/paired_difference.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

/// Limits of a share by Wilson's score, of a real number of trials.
struct Wilson {
    double lower, upper;
};
Wilson wilson(double share, double trials, double z)
{
    const double z2 = z * z, middle = (share + z2 / (2 * trials)) / (1 + z2 / trials);
    const double half = z / (1 + z2 / trials) * std::sqrt(share * (1 - share) / trials + z2 / (4 * trials * trials));
    return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

/// The half width of Newcombe's interval.
double newcombe_half(double p, double q, double trials_p, double trials_q, double z)
{
    const Wilson a = wilson(p, trials_p, z), b = wilson(q, trials_q, z);
    return (std::hypot(q - b.lower, a.upper - p) + std::hypot(b.upper - q, p - a.lower)) / 2;
}

double two_sided_student(double level, double freedom)
{
    return quantile(boost::math::students_t_distribution<double>(freedom), (1 + level) / 2);
}

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

PairedDifference stratified_at(std::span<const PairedCounts> strata, double z)
{
    double cells = 0, d = 0, q = 0, variance = 0, inverse = 0;
    bool single = false; // a cell with one pair gives no variance
    for (const PairedCounts& cell : strata) {
        const auto n = static_cast<double>(cell.pairs());
        if (n == 0)
            continue;
        cells += 1;
        inverse += 1 / n;
        single = single || n == 1;
        const double share = static_cast<double>(cell.discordant()) / n;
        const double own = (static_cast<double>(cell.variant_only) - static_cast<double>(cell.base_only)) / n;
        d += own;
        q += share;
        variance += (share - own * own) / std::max(n - 1, 1.0);
    }
    if (cells == 0)
        return {std::numeric_limits<double>::quiet_NaN(), -1, 1, 1, z};
    d /= cells;
    q /= cells;
    variance /= cells * cells;
    // the pairs of equal cells with the same mean of 1 / n; cells that are all or nothing seem to have no variance, and
    // the gain of strata is bounded as a design effect is
    const double pairs = cells * cells / inverse;
    const double n = variance > 0 && !single ? std::min((q - d * d) / variance, 2 * pairs) : pairs;
    PairedDifference found = score_interval(n, n * (q - d) / 2, n * (q + d) / 2, z);
    found.value = d;
    return found;
}

PairedDifference stratified_difference(std::span<const PairedCounts> strata, double level)
{
    return stratified_at(strata, two_sided_normal(level));
}

double unpaired_realizations(double base, double variant, double half_width, double z, double base_effect,
                             double variant_effect)
{
    double low = 0, high = 1; // its logarithm in base 2
    const auto half = [&](double log_n) {
        const double n = std::exp2(log_n);
        return newcombe_half(base, variant, n / base_effect, n / variant_effect, z);
    };
    while (half(high) > half_width && high < 200)
        high *= 2;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (half(middle) > half_width ? low : high) = middle;
    }
    return std::exp2((low + high) / 2);
}

double share_effect(std::span<const PairedCounts> groups, std::uint64_t (PairedCounts::*reached)() const)
{
    const GroupSums sums = sums_of(groups);
    if (sums.groups < 2 || sums.groups == sums.pairs)
        return 1;
    double all = 0, between = 0;
    for (const PairedCounts& group : groups)
        all += static_cast<double>((group.*reached)());
    const double share = all / sums.pairs;
    for (const PairedCounts& group : groups) {
        const double excess = static_cast<double>((group.*reached)()) - static_cast<double>(group.pairs()) * share;
        between += excess * excess;
    }
    return bounded_effect(between, sums.pairs * share * (1 - share), sums);
}

double strata_effect(std::span<const PairedCounts> strata, std::uint64_t (PairedCounts::*reached)() const)
{
    double cells = 0, mean = 0, variance = 0, all = 0;
    bool single = false;
    for (const PairedCounts& cell : strata) {
        const auto n = static_cast<double>(cell.pairs());
        if (n == 0)
            continue;
        const double share = static_cast<double>((cell.*reached)()) / n;
        cells += 1;
        all += n;
        single = single || n == 1;
        mean += share;
        variance += share * (1 - share) / std::max(n - 1, 1.0);
    }
    mean /= cells;
    const double without = mean * (1 - mean) / all;
    return without > 0 && !single ? std::max(variance / (cells * cells) / without, 0.01) : 1.0;
}

} // namespace stylobate

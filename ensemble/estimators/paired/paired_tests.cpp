#include "ensemble/estimators/paired/paired_tests.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace stylobate {

namespace {

constexpr double most_steps = 1e8;

/// P(sum of the sizes with random signs >= at), from the distribution of the sum of those with a plus.
double tail_of(const std::vector<std::uint64_t>& sizes, std::int64_t at)
{
    const std::uint64_t all = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
    std::vector<double> probability(all + 1);
    probability[0] = 1;
    std::uint64_t reach = 0;
    for (const std::uint64_t size : sizes) {
        reach += size;
        for (std::uint64_t sum = reach + 1; sum-- > 0;)
            probability[sum] = 0.5 * (probability[sum] + (sum >= size ? probability[sum - size] : 0));
    }
    // a sum S of signed sizes has plus sizes (S + all) / 2
    const std::int64_t twice = at + static_cast<std::int64_t>(all);
    double tail = 0;
    for (std::int64_t plus = std::max<std::int64_t>(0, (twice + 1) / 2); plus <= static_cast<std::int64_t>(all); ++plus)
        tail += probability[static_cast<std::size_t>(plus)];
    return std::min(1.0, tail);
}

std::vector<std::size_t> order_of(const std::vector<double>& p)
{
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    return order;
}

} // namespace

double mcnemar_p(const PairedCounts& counts)
{
    const auto n = static_cast<double>(counts.discordant());
    if (n == 0)
        return 1;
    const auto fewer = static_cast<double>(std::min(counts.base_only, counts.variant_only));
    return std::min(1.0, 2 * cdf(boost::math::binomial_distribution<double>(n, 0.5), fewer));
}

double sign_flip_p(std::span<const PairedCounts> groups)
{
    PairedCounts all;
    std::vector<std::uint64_t> sizes;
    std::int64_t sum = 0;
    bool single = true;
    for (const PairedCounts& group : groups) {
        all += group;
        const std::int64_t x =
            static_cast<std::int64_t>(group.variant_only) - static_cast<std::int64_t>(group.base_only);
        sum += x;
        if (x != 0)
            sizes.push_back(static_cast<std::uint64_t>(std::abs(x)));
        single = single && group.pairs() <= 1;
    }
    if (single)
        return mcnemar_p(all);
    if (sizes.empty())
        return 1;
    const double total = static_cast<double>(std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0}));
    if (static_cast<double>(sizes.size()) * total > most_steps) {
        double variance = 0;
        for (const std::uint64_t size : sizes)
            variance += static_cast<double>(size) * static_cast<double>(size);
        const double z = std::max(0.0, std::abs(static_cast<double>(sum)) - 1) / std::sqrt(variance);
        return std::min(1.0, 2 * cdf(complement(boost::math::normal_distribution<double>(), z)));
    }
    return std::min(1.0, 2 * tail_of(sizes, std::abs(sum)));
}

std::vector<double> benjamini_hochberg(const std::vector<double>& p)
{
    const std::vector<std::size_t> order = order_of(p);
    std::vector<double> adjusted(p.size());
    double least = 1;
    for (std::size_t rank = p.size(); rank-- > 0;) {
        least = std::min(least, p[order[rank]] * static_cast<double>(p.size()) / static_cast<double>(rank + 1));
        adjusted[order[rank]] = least;
    }
    return adjusted;
}

std::vector<double> holm(const std::vector<double>& p)
{
    const std::vector<std::size_t> order = order_of(p);
    std::vector<double> adjusted(p.size());
    double most = 0;
    for (std::size_t rank = 0; rank < p.size(); ++rank) {
        most = std::max(most, std::min(1.0, p[order[rank]] * static_cast<double>(p.size() - rank)));
        adjusted[order[rank]] = most;
    }
    return adjusted;
}

namespace {

/// Ranks from 1, ties with their mean rank.
std::vector<double> ranks_of(const std::vector<double>& values)
{
    std::vector<std::size_t> order(values.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
        while (end < order.size() && values[order[end]] == values[order[first]])
            ++end;
        for (std::size_t i = first; i < end; ++i)
            ranks[order[i]] = static_cast<double>(first + end + 1) / 2;
    }
    return ranks;
}

struct RankSum {
    double sum = 0, variance = 0;
};

RankSum rank_sum(const std::vector<double>& values, const std::vector<double>& y)
{
    const auto n = static_cast<double>(y.size());
    double mean = 0;
    for (const double one : y)
        mean += one / n;
    const double middle = (n + 1) / 2; // the mean of the ranks
    const std::vector<double> ranks = ranks_of(values);
    double sum = 0, ranks2 = 0, y2 = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        sum += (ranks[i] - middle) * y[i];
        ranks2 += (ranks[i] - middle) * (ranks[i] - middle);
        y2 += (y[i] - mean) * (y[i] - mean);
    }
    return {sum, ranks2 * y2 / (n - 1)};
}

} // namespace

Dependence dependence_on(std::span<const PairedTrial> trials, std::span<const double> values, double level)
{
    Dependence found;
    std::size_t strata = 0;
    for (const PairedTrial& trial : trials)
        strata = std::max(strata, trial.stratum + 1);

    std::vector<std::vector<double>> value_of(strata), y_of(strata);
    for (std::size_t i = 0; i < trials.size(); ++i) {
        value_of[trials[i].stratum].push_back(values[i]);
        y_of[trials[i].stratum].push_back(static_cast<double>(trials[i].variant) - static_cast<double>(trials[i].base));
    }
    RankSum all;
    for (std::size_t s = 0; s < strata; ++s)
        if (y_of[s].size() > 1) {
            const RankSum of = rank_sum(value_of[s], y_of[s]);
            all.sum += of.sum;
            all.variance += of.variance;
        }
    if (all.variance > 0) {
        found.z = all.sum / std::sqrt(all.variance);
        found.p = 2 * cdf(complement(boost::math::normal_distribution<double>(), std::fabs(found.z)));
    }

    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < 2; ++k)
        found.between[k] = sorted_quantile(sorted, static_cast<double>(k + 1) / 3, QuantileDefinition::linear);
    std::array<std::vector<PairedCounts>, 3> counts;
    for (std::vector<PairedCounts>& of : counts)
        of.resize(strata);
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const std::size_t third = values[i] <= found.between[0] ? 0 : values[i] <= found.between[1] ? 1 : 2;
        counts[third][trials[i].stratum].add(trials[i].base, trials[i].variant);
    }
    for (std::size_t k = 0; k < 3; ++k)
        found.thirds[k] = stratified_difference(counts[k], level);
    return found;
}

} // namespace stylobate

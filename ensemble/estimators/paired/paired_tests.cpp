#include "ensemble/estimators/paired/paired_tests.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

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

} // namespace stylobate

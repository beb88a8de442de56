#include "ensemble/estimators/paired/dependence.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace stylobate {

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

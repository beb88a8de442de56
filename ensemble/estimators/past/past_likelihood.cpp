#include "ensemble/estimators/past/past_likelihood.hpp"

#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <boost/math/distributions/beta.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace stylobate {

namespace {

/// The probabilities at the middles of `past_draws` parts of equal probability.
double part_of(std::size_t b)
{
    return (static_cast<double>(b) + 0.5) / static_cast<double>(past_draws);
}

/// The quantiles of the posterior there. Where both kinds of outcomes have come: with p = sin2(t) its density over t is
/// sin(t)^(2 (k + c) - 1) cos(t)^(2 (n - k + c) - 1), which has no poles and a width of 1 / (2 sqrt(n)); it is summed
/// by the trapezoidal rule over ten of these to either side of its middle. (Boost's quantiles take fifty times as
/// long.)
std::vector<double> quantiles_of(const CellCount& count, double c)
{
    if (count.successes == 0 || count.successes == count.trials) {
        const boost::math::beta_distribution<double> posterior(count.successes + c, count.trials - count.successes + c);
        std::vector<double> values;
        for (std::size_t b = 0; b < past_draws; ++b)
            values.push_back(quantile(posterior, part_of(b)));
        return values;
    }
    constexpr std::size_t points = 2001;
    const double k = count.successes, n = count.trials;
    const double middle = std::asin(std::sqrt((k + 0.5) / (n + 1))), reach = 5 / std::sqrt(n + 1);
    const double from = std::max(0.0, middle - reach), to = std::min(std::numbers::pi / 2, middle + reach);
    const double step = (to - from) / static_cast<double>(points - 1);
    const auto log_density = [&](double t) {
        return (2 * (k + c) - 1) * std::log(std::sin(t)) + (2 * (n - k + c) - 1) * std::log(std::cos(t));
    };
    const double largest = log_density(middle);
    std::vector<double> sum(points, 0);
    double before = std::exp(log_density(from) - largest);
    for (std::size_t i = 1; i < points; ++i) {
        const double density = std::exp(log_density(std::min(from + step * static_cast<double>(i), to)) - largest);
        sum[i] = sum[i - 1] + 0.5 * (before + density);
        before = density;
    }
    std::vector<double> values;
    std::size_t i = 1;
    for (std::size_t b = 0; b < past_draws; ++b) {
        const double wanted = part_of(b) * sum.back();
        while (i + 1 < points && sum[i] < wanted)
            ++i;
        const double t = from + step * (static_cast<double>(i - 1) + (wanted - sum[i - 1]) / (sum[i] - sum[i - 1]));
        values.push_back(std::sin(t) * std::sin(t));
    }
    return values;
}

} // namespace

void PastLikelihood::each(const std::function<void(std::span<const double>)>& f) const
{
    f(value);
    for (const std::vector<double>& draw : drawn)
        f(draw);
}

double prior_count(const PastAxes& axes, PastUse use)
{
    return use == PastUse::cells ? 0.5 : 0.5 / static_cast<double>(axes.frequency_hz.size());
}

PastLikelihood past_likelihood(const PastAxes& axes, std::span<const CellCount> counts, std::uint64_t seed, PastUse use,
                               std::uint64_t index)
{
    assert(counts.size() == axes.cells() && "a count for each cell");
    PastLikelihood likelihood{axes, {}, {past_draws, std::vector<double>(counts.size())}};
    std::map<std::pair<double, double>, std::vector<double>> known;
    const double c = prior_count(axes, use);
    std::vector<std::size_t> order(past_draws);
    for (std::size_t cell = 0; cell < counts.size(); ++cell) {
        const CellCount& count = counts[cell];
        const double shown = use == PastUse::rates && count.trials > 0 ? 0 : c;
        likelihood.value.push_back((count.successes + shown) / (count.trials + 2 * shown));
        auto [at, is_new] = known.try_emplace({count.trials, count.successes});
        if (is_new)
            at->second = quantiles_of(count, c);
        std::iota(order.begin(), order.end(), std::size_t{0});
        for (std::size_t b = past_draws - 1; b > 0; --b) { // Fisher and Yates
            const double u = uniform01(seed, index + cell, Stream::past, b);
            std::swap(order[b], order[static_cast<std::size_t>(u * static_cast<double>(b + 1))]);
        }
        for (std::size_t b = 0; b < past_draws; ++b)
            likelihood.drawn[b][cell] = at->second[order[b]];
    }
    return likelihood;
}

PastEstimate past_estimate(const PastLikelihood& likelihood, const std::function<double(std::span<const double>)>& f)
{
    constexpr double most_shift = 0.5, reach = 1.959963984540054;
    PastEstimate estimate{f(likelihood.value), 0, 0};
    std::vector<double> drawn;
    for (const std::vector<double>& draw : likelihood.drawn)
        drawn.push_back(f(draw));
    std::sort(drawn.begin(), drawn.end());
    const auto from = std::lower_bound(drawn.begin(), drawn.end(), estimate.value),
               to = std::upper_bound(from, drawn.end(), estimate.value);
    const double below = (static_cast<double>(from - drawn.begin()) + 0.5 * static_cast<double>(to - from) + 0.5) /
                         static_cast<double>(drawn.size() + 1);
    const double shift = std::clamp(to_normal(below), -most_shift, most_shift);
    const auto limit = [&](double z) {
        const double p = normal_below(2 * shift + z);
        // values of the sample, not between them: one beyond the axis is infinite
        return sorted_quantile(drawn, p, QuantileDefinition::above);
    };
    estimate.lower = std::min(limit(-reach), estimate.value);
    estimate.upper = std::max(limit(reach), estimate.value);
    return estimate;
}

namespace {

/// C(n, k); 0 where k > n.
double choose(std::uint64_t n, std::uint64_t k)
{
    if (k > n)
        return 0;
    double value = 1;
    for (std::uint64_t i = 0; i < k; ++i)
        value *= static_cast<double>(n - i) / static_cast<double>(i + 1);
    return value;
}

double part_of(std::uint32_t count, std::uint32_t all)
{
    return static_cast<double>(count) / static_cast<double>(all);
}

} // namespace

double agreeing_share(const MotionTally& tally)
{
    assert(tally.valid > 0 && "a share of something");
    return part_of(tally.agree, tally.valid);
}

double built_share(const MotionTally& tally, std::uint64_t built, std::uint64_t standing)
{
    assert(tally.valid >= built && standing >= 1 && standing <= built && "N can be drawn from the structures");
    if (tally.agree == 0)
        return 0;
    return agreeing_share(tally) * choose(tally.stand - 1, standing - 1) *
           choose(tally.valid - tally.stand, built - standing) / choose(tally.valid - 1, built - 1);
}

double all_stand_share(const MotionTally& tally, std::uint64_t m)
{
    assert(tally.valid >= m && "m can be drawn from the structures");
    return choose(tally.stand, m) / choose(tally.valid, m);
}

double site_share(std::span<const MotionTally> site)
{
    double as_is = 1, mirrored = 1, both = 1;
    for (const MotionTally& one : site) {
        as_is *= part_of(one.as_is, one.valid);
        mirrored *= part_of(one.mirrored, one.valid);
        both *= part_of(one.as_is + one.mirrored - one.agree, one.valid);
    }
    return as_is + mirrored - both;
}

CellCount effective_count(std::span<const double> shares, double most)
{
    const auto motions = static_cast<double>(shares.size());
    double sum = 0, squares = 0;
    for (const double share : shares) {
        sum += share;
        squares += share * share;
    }
    if (squares == sum) // all of them are 0 or 1
        return {motions, sum};
    const double mean = sum / motions, variance = squares / motions - mean * mean;
    // rounding of equal shares aside
    const double trials = variance > 1e-12 * mean ? std::min(mean * (1 - mean) * motions / variance, most) : most;
    return {trials, mean * trials};
}

} // namespace stylobate

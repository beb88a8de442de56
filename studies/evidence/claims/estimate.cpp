#include "studies/evidence/claims/estimate.hpp"

#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/log_gamma.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate::claims {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool counts(const Observation& o, const Measure& measure)
{
    return !measure.given || o.has(*measure.given, measure.within_cycles);
}

/// The largest k for which fewer than k heads in n fair throws have at most the probability `tail`; 0 if there is none.
std::size_t rank_of_tail(std::size_t n, double tail)
{
    const auto log_factorial = [](std::size_t i) { return log_gamma(static_cast<double>(i) + 1); };
    double sum = 0; // of the chances of fewer than k heads
    std::size_t k = 0;
    while (k < n) {
        sum += std::exp(log_factorial(n) - log_factorial(k) - log_factorial(n - k) -
                        static_cast<double>(n) * std::numbers::ln2);
        if (sum > tail)
            break;
        ++k;
    }
    return k;
}

} // namespace

Estimate probability(const std::vector<Observation>& cell, const Measure& measure, double level)
{
    std::uint64_t trials = 0, successes = 0;
    for (const Observation& o : cell)
        if (counts(o, measure)) {
            ++trials;
            successes += o.has(measure.event, measure.within_cycles);
        }
    if (trials == 0)
        return {};
    const BinomialInterval interval = jeffreys(trials, successes, level);
    return {static_cast<double>(successes) / static_cast<double>(trials), interval.lower, interval.upper,
            static_cast<std::size_t>(trials)};
}

Estimate minority(const std::vector<Observation>& cell, const Measure& measure, double level)
{
    const Estimate p = probability(cell, measure, level);
    if (!p.known())
        return p;
    const double at_ends = std::min(std::min(p.lower, 1 - p.lower), std::min(p.upper, 1 - p.upper));
    const double peak = p.lower <= 0.5 && p.upper >= 0.5
                            ? 0.5
                            : std::max(std::min(p.lower, 1 - p.lower), std::min(p.upper, 1 - p.upper));
    return {std::min(p.value, 1 - p.value), at_ends, peak, p.realizations};
}

Estimate median(const std::vector<Observation>& cell, const Measure& measure, double level)
{
    std::vector<double> values;
    for (const Observation& o : cell) {
        const double value = o.amount[static_cast<std::size_t>(measure.amount)];
        if (counts(o, measure) && !std::isnan(value))
            values.push_back(value);
    }
    const std::size_t n = values.size(), k = rank_of_tail(n, (1 - level) / 2);
    if (k == 0)
        return {};
    std::sort(values.begin(), values.end());
    return {sorted_median(values), values[k - 1], values[n - k], n};
}

Estimate onset(const Sample& sample, std::size_t frequency, const Measure& measure, double level)
{
    const std::vector<double>& pga = sample.pga_m_s2;
    std::vector<double> value, lower, upper;
    Estimate result;
    for (std::size_t j = 0; j < pga.size(); ++j) {
        const Estimate p = probability(sample.cell(frequency, j), measure, level);
        if (!p.known())
            return {};
        result.realizations += p.realizations;
        value.push_back(p.value);
        lower.push_back(p.lower);
        upper.push_back(p.upper);
    }
    const auto first = [](const std::vector<double>& curve) {
        return static_cast<std::size_t>(std::find_if(curve.begin(), curve.end(), [](double p) { return p >= 0.5; }) -
                                        curve.begin());
    };
    const auto crossing = [&](const std::vector<double>& curve, std::size_t j) {
        if (j == 0 || j == curve.size())
            return j == 0 ? pga.front() : infinity;
        const double share = (0.5 - curve[j - 1]) / (curve[j] - curve[j - 1]);
        return pga[j - 1] * std::pow(pga[j] / pga[j - 1], share);
    };
    const std::size_t at = first(value), possible = first(upper), certain = first(lower);
    result.value = crossing(value, at);
    result.lower = possible == 0 ? 0 : pga[possible - 1];
    result.upper = certain == pga.size() ? infinity : pga[certain];
    const auto open = [&](std::size_t j) { return value[j] > 0.05 && value[j] < 0.95; };
    if (measure.between_steps && at > 0 && at < pga.size() && (open(at - 1) || open(at))) {
        result.lower = possible == 0 ? 0 : crossing(upper, possible);
        result.upper = crossing(lower, certain);
    }
    return result;
}

Estimate estimate(const Sample& sample, std::size_t frequency, std::size_t pga, const Measure& measure, double level)
{
    switch (measure.kind) {
    case Measure::Kind::probability:
        return probability(sample.cell(frequency, pga), measure, level);
    case Measure::Kind::minority:
        return minority(sample.cell(frequency, pga), measure, level);
    case Measure::Kind::median:
        return median(sample.cell(frequency, pga), measure, level);
    case Measure::Kind::onset:
        break;
    }
    return onset(sample, frequency, measure, level);
}

} // namespace stylobate::claims

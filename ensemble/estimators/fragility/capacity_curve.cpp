#include "ensemble/estimators/fragility/capacity_curve.hpp"

#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/quantiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace stylobate {
namespace {

struct Normal {
    double mean = 0, deviation = 1;
    bool found = false;
};

/// The normal distribution of ln capacity from intervals, by expectation and maximization: each record contributes the
/// conditional mean and mean square within its interval.
Normal normal_from(std::span<const RecordCapacity> capacities, std::size_t without)
{
    std::vector<std::pair<double, double>> intervals;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t g = 0; g < capacities.size(); ++g) {
        if (g == without)
            continue;
        intervals.emplace_back(std::log(capacities[g].below), std::log(capacities[g].at));
        for (const double end : {intervals.back().first, intervals.back().second})
            if (std::isfinite(end)) {
                low = std::min(low, end);
                high = std::max(high, end);
            }
    }
    Normal normal;
    // one intensity between all of them, or none at all: a jump there, or anywhere, fits best
    double greatest_below = -std::numeric_limits<double>::infinity(), least_at = -greatest_below;
    for (const auto& [below, at] : intervals) {
        greatest_below = std::max(greatest_below, below);
        least_at = std::min(least_at, at);
    }
    if (!(high > low) || greatest_below < least_at)
        return normal;
    normal.mean = (low + high) / 2;
    normal.deviation = (high - low) / 2;
    for (int iteration = 0; iteration < 20000; ++iteration) {
        double sum = 0, squares = 0;
        for (const auto& [below, at] : intervals) {
            const double a = (below - normal.mean) / normal.deviation, b = (at - normal.mean) / normal.deviation;
            const LinkValue from = link_at(Link::probit, a), to = link_at(Link::probit, b);
            // the nearer tail keeps its accuracy
            const double mass = std::max(1e-300, a > 0 ? from.above - to.above : to.below - from.below);
            const double slope = (from.density - to.density) / mass;
            const double bend =
                ((std::isfinite(a) ? a * from.density : 0) - (std::isfinite(b) ? b * to.density : 0)) / mass;
            sum += normal.mean + normal.deviation * slope;
            squares += normal.deviation * normal.deviation * (1 + bend) + 2 * normal.mean * normal.deviation * slope +
                       normal.mean * normal.mean;
        }
        const double n = static_cast<double>(intervals.size());
        const double mean = sum / n, deviation = std::sqrt(std::max(0.0, squares / n - mean * mean));
        const double moved = std::abs(mean - normal.mean) + std::abs(deviation - normal.deviation);
        normal.mean = mean;
        normal.deviation = deviation;
        if (!(deviation > 1e-6 * (high - low)) || !(deviation < 1e3 * (high - low)))
            return normal;
        if (moved < 1e-11 * (high - low)) {
            normal.found = true;
            return normal;
        }
    }
    return normal;
}

} // namespace

std::vector<RecordCapacity> record_capacities(std::span<const FragilityRun> runs)
{
    const FragilityData data = grouped(runs);
    if (data.measures != 1)
        throw InputError(fmt::format("fragility: a capacity needs one intensity measure, not {}.", data.measures));
    std::map<std::uint32_t, RecordCapacity> names;
    for (const FragilityRun& run : runs)
        names[run.record].record = run.record;
    std::vector<RecordCapacity> capacities;
    for (const auto& [name, start] : names) {
        RecordCapacity capacity = start;
        for (const FragilityRow& row : data.of_record(capacities.size())) {
            const double intensity = data.intensity[row.point];
            const bool reached = 2 * row.reached > row.trials;
            if (std::isfinite(capacity.at))
                capacity.resurrected = capacity.resurrected || !reached;
            else if (reached)
                capacity.at = intensity;
            else
                capacity.below = intensity;
        }
        capacities.push_back(capacity);
    }
    return capacities;
}

CapacityCurve capacity_curve(std::span<const RecordCapacity> capacities, double level)
{
    if (capacities.size() < 2)
        throw InputError("fragility: a curve from capacities needs at least two records.");
    CapacityCurve curve;
    curve.records = capacities.size();
    for (const RecordCapacity& capacity : capacities) {
        curve.resurrected += capacity.resurrected ? 1 : 0;
        curve.unreached += std::isinf(capacity.at) ? 1 : 0;
    }
    if (curve.resurrected > 0)
        curve.says.push_back(fmt::format("{} of {} records reached the limit state, but not at a stronger shaking: the "
                                         "curve from the lowest intensities ignores this.",
                                         curve.resurrected, curve.records));
    const Normal normal = normal_from(capacities, curve.records);
    curve.found = normal.found;
    if (!normal.found) {
        curve.says.push_back("The capacities do not bound a dispersion: one intensity lies between all of them, or too "
                             "few records reached the limit state. Run more intensities.");
        return curve;
    }
    curve.median = std::exp(normal.mean);
    curve.dispersion = normal.deviation;
    std::vector<std::pair<double, double>> without;
    for (std::size_t g = 0; g < curve.records && curve.records >= least_records; ++g) {
        const Normal rest = normal_from(capacities, g);
        if (!rest.found)
            break;
        without.emplace_back(rest.mean, std::log(rest.deviation));
    }
    if (without.size() < curve.records) {
        curve.says.push_back(fmt::format("{} records, or a curve that depends on a single record, give no interval: "
                                         "this curve must not be used alone.",
                                         curve.records));
        return curve;
    }
    const double n = static_cast<double>(curve.records);
    const double t = student_quantile((1 + level) / 2, n - 1);
    const auto limits = [&](double value, auto part) {
        double mean = 0, square = 0;
        for (const auto& each : without)
            mean += each.*part / n;
        for (const auto& each : without)
            square += (each.*part - mean) * (each.*part - mean);
        const double unbiased = n * value - (n - 1) * mean, reach = t * std::sqrt((n - 1) / n * square);
        return Limits{std::exp(std::min(value, unbiased - reach)), std::exp(std::max(value, unbiased + reach))};
    };
    curve.median_limits = limits(normal.mean, &std::pair<double, double>::first);
    curve.dispersion_limits = limits(std::log(normal.deviation), &std::pair<double, double>::second);
    return curve;
}

} // namespace stylobate

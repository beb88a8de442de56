#include "ensemble/estimators/risk/hazard_quantile.hpp"

#include "ensemble/numerics/quantiles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace stylobate {

HazardCurve best_curve(const HazardModel& hazard)
{
    return {hazard.intensity, hazard.frequency};
}

namespace {

/// A curve at the intensities of the hazard; two curves that do not increase may be continued to one that does.
HazardCurve curve_of(const HazardModel& hazard, std::vector<double> frequency)
{
    for (std::size_t i = 1; i < frequency.size(); ++i)
        frequency[i] = std::min(frequency[i], frequency[i - 1]);
    if (!(frequency.back() < *(frequency.end() - 2)))
        frequency.back() *= 1 - 1e-12;
    return {hazard.intensity, frequency};
}

} // namespace

HazardCurve quantile_curve(const HazardModel& hazard, double probability)
{
    const auto& fractiles = hazard.fractiles;
    assert(fractiles.size() >= 2);
    // the two fractiles that are nearest around the probability, or the last two on its side
    const auto above = std::find_if(fractiles.begin() + 1, fractiles.end() - 1,
                                    [probability](const HazardFractile& f) { return f.probability >= probability; });
    const HazardFractile &high = *above, &low = *(above - 1);
    const double z = normal_quantile(probability), from = normal_quantile(low.probability);
    const double part = (z - from) / (normal_quantile(high.probability) - from);
    std::vector<double> frequency;
    for (std::size_t i = 0; i < hazard.intensity.size(); ++i)
        frequency.push_back(low.frequency[i] * std::pow(high.frequency[i] / low.frequency[i], part));
    return curve_of(hazard, std::move(frequency));
}

HazardCurve mean_curve(const HazardModel& hazard)
{
    const auto& fractiles = hazard.fractiles;
    assert(fractiles.size() >= 2);
    std::vector<double> frequency(hazard.intensity.size(), 0);
    for (std::size_t f = 0; f + 1 < fractiles.size(); ++f) {
        const HazardFractile &low = fractiles[f], &high = fractiles[f + 1];
        const double z1 = normal_quantile(low.probability), z2 = normal_quantile(high.probability);
        const bool first = f == 0, last = f + 2 == fractiles.size(); // these go on to the end
        for (std::size_t i = 0; i < frequency.size(); ++i) {
            const double b = std::log(high.frequency[i] / low.frequency[i]) / (z2 - z1);
            const double below = first ? 0 : std::erfc((b - z1) / std::numbers::sqrt2) / 2;
            const double up_to = last ? 1 : std::erfc((b - z2) / std::numbers::sqrt2) / 2;
            frequency[i] += low.frequency[i] * std::exp(b * (b / 2 - z1)) * (up_to - below);
        }
    }
    return curve_of(hazard, std::move(frequency));
}

} // namespace stylobate

#include "ensemble/estimators/risk/hazard_quantile.hpp"

#include "ensemble/numerics/quantiles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

HazardCurve best_curve(const HazardModel& hazard)
{
    return {hazard.intensity, hazard.frequency};
}

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
    for (std::size_t i = 0; i < hazard.intensity.size(); ++i) {
        const double at = low.frequency[i] * std::pow(high.frequency[i] / low.frequency[i], part);
        // two curves that do not increase may be continued to one that does
        frequency.push_back(frequency.empty() ? at : std::min(at, frequency.back()));
    }
    if (!(frequency.back() < *(frequency.end() - 2)))
        frequency.back() *= 1 - 1e-12;
    return {hazard.intensity, frequency};
}

} // namespace stylobate

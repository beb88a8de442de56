#include "studies/decisions/compare/capacity_rows.hpp"

#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

namespace stylobate {

std::vector<CapacityRow> capacity_rows(const Comparison& comparison, const LimitComparison& limit)
{
    if (!limit.damage || comparison.adaptive_budget > 0)
        return {};
    std::vector<CapacityRow> rows;
    if (comparison.intensity.size() > 1 && !limit.by_motion.empty())
        rows.push_back({"all stripes",
                        capacity_ratio(comparison.intensity, limit.by_motion, comparison.motions, comparison.level)});
    const std::size_t n = comparison.pga_m_s2.size();
    if (n < 2)
        return rows;
    for (std::size_t f = 0; f < comparison.frequency_hz.size(); ++f) {
        std::vector<PairedCounts> counts;
        for (const PlaceComparison& place : std::span(limit.cells).subspan(f * n, n))
            counts.push_back(place.counts);
        rows.push_back({fmt::format("{:.3g} Hz", comparison.frequency_hz[f]),
                        capacity_ratio(comparison.pga_m_s2, counts, 0, comparison.level)});
    }
    return rows;
}

std::string capacity_measure(const Comparison& comparison)
{
    return comparison.measure.empty() ? "PGA" : short_measure(comparison.measure);
}

std::string capacity_text(const CapacityRatio& ratio)
{
    if (std::isnan(ratio.value))
        return "not in this range";
    const char* bound = ratio.at_least && ratio.at_most ? "not bounded by this range, in it "
                        : ratio.at_least                ? "at least "
                        : ratio.at_most                 ? "at most "
                                                        : "";
    return fmt::format("{}{:.2f} ({:.2f} to {:.2f}; steps x {:.2f})", bound, ratio.value, ratio.lower, ratio.upper,
                       ratio.grid);
}

} // namespace stylobate

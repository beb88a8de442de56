#include "studies/decisions/compare/comparison.hpp"

#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace stylobate {

const char* to_string(ChangeVerdict verdict)
{
    constexpr const char* words[] = {"better", "worse", "less", "more", "open"};
    return words[static_cast<std::size_t>(verdict)];
}

const char* to_string(CommonDraws draws)
{
    return FieldWords<CommonDraws>::words[static_cast<std::size_t>(draws)];
}

double PlaceComparison::largest() const
{
    return std::max(std::abs(lower), std::abs(upper));
}

ChangeVerdict LimitComparison::verdict(const PlaceComparison& place) const
{
    if (place.upper < 0)
        return damage ? ChangeVerdict::better : ChangeVerdict::less;
    if (place.lower > 0)
        return damage ? ChangeVerdict::worse : ChangeVerdict::more;
    return ChangeVerdict::open;
}

std::vector<std::size_t> LimitComparison::named(double rate, bool worse) const
{
    std::vector<std::size_t> found;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
        if (cells[cell].p_adjusted <= rate && (cells[cell].difference > 0) == worse)
            found.push_back(cell);
    std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(cells[a].difference) > std::abs(cells[b].difference);
    });
    return found;
}

std::size_t Comparison::cells() const
{
    if (!frequency_hz.empty())
        return frequency_hz.size() * pga_m_s2.size();
    return std::max<std::size_t>(1, intensity.size());
}

std::string Comparison::place(std::size_t cell) const
{
    if (!frequency_hz.empty())
        return fmt::format("{:.3g} Hz, {:.3g} m/s2", frequency_hz[cell / pga_m_s2.size()],
                           pga_m_s2[cell % pga_m_s2.size()]);
    return intensity.empty()
               ? "all"
               : fmt::format("{} {:.3g} {}", short_measure(measure), intensity[cell], measure_unit(measure));
}

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

} // namespace stylobate

#include "studies/surface.hpp"

#include "ensemble/interval.hpp"

#include <fmt/format.h>

#include <limits>

namespace stylobate {

SurfaceCounts::SurfaceCounts(std::vector<double> frequency_hz, std::vector<double> pga_m_s2)
{
    const std::size_t cells = frequency_hz.size() * pga_m_s2.size();
    table_.frequency_hz = std::move(frequency_hz);
    table_.pga_m_s2 = std::move(pga_m_s2);
    table_.trials.resize(cells);
    table_.collapses.resize(cells);
}

void SurfaceCounts::add(const ResultRow& row)
{
    if (row.outcome.state == State::invalid || row.cell >= table_.trials.size())
        return;
    ++table_.trials[row.cell];
    table_.collapses[row.cell] += row.outcome.state == State::collapsed;
}

SurfaceTable SurfaceCounts::table() const
{
    SurfaceTable table = table_;
    table.interval = fmt::format("jeffreys {}", surface_level);
    for (std::size_t i = 0; i < table.trials.size(); ++i) {
        const auto n = static_cast<double>(table.trials[i]);
        table.probability.push_back(table.trials[i] > 0 ? static_cast<double>(table.collapses[i]) / n
                                                        : std::numeric_limits<double>::quiet_NaN());
        const BinomialInterval interval = jeffreys(table.trials[i], table.collapses[i], surface_level);
        table.lower.push_back(interval.lower);
        table.upper.push_back(interval.upper);
    }
    return table;
}

} // namespace stylobate

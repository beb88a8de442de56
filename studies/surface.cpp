#include "studies/surface.hpp"

namespace stylobate {

SurfaceCounts::SurfaceCounts(std::vector<double> frequency_hz, std::vector<double> pga_m_s2, LimitState limit)
    : limit_(limit)
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
    table_.collapses[row.cell] += reached(limit_, row.outcome);
}

SurfaceTable SurfaceCounts::table() const
{
    SurfaceTable table = table_;
    table.interval = interval_name();
    for (std::size_t i = 0; i < table.trials.size(); ++i) {
        const Share share = share_of(table.trials[i], table.collapses[i]);
        table.probability.push_back(share.probability);
        table.lower.push_back(share.lower);
        table.upper.push_back(share.upper);
    }
    return table;
}

} // namespace stylobate

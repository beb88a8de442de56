#include "studies/kinds/surface/surface.hpp"

namespace stylobate {

namespace {

/// Counts with their probabilities and intervals.
SurfaceTable with_shares(SurfaceTable table)
{
    table.interval = interval_name();
    for (std::size_t i = 0; i < table.trials.size(); ++i) {
        const Share share = share_of(table.trials[i], table.collapses[i]);
        table.probability.push_back(share.probability);
        table.lower.push_back(share.lower);
        table.upper.push_back(share.upper);
    }
    return table;
}

} // namespace

SurfaceCounts::SurfaceCounts(std::vector<double> frequency_hz, std::vector<double> pga_m_s2, LimitState limit)
    : limit_(limit)
{
    const std::size_t cells = frequency_hz.size() * pga_m_s2.size();
    table_.frequency_hz = std::move(frequency_hz);
    table_.pga_m_s2 = std::move(pga_m_s2);
    table_.trials.resize(cells);
    table_.collapses.resize(cells);
}

SurfaceCounts::SurfaceCounts(const SurfaceTable& counted)
{
    table_.frequency_hz = counted.frequency_hz;
    table_.pga_m_s2 = counted.pga_m_s2;
    table_.trials = counted.trials;
    table_.collapses = counted.collapses;
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
    return with_shares(table_);
}

SurfaceTable surface_of(const ResultHeader& header, const Tally& tally, LimitState limit)
{
    SurfaceTable table;
    table.frequency_hz = header.frequency_hz;
    table.pga_m_s2 = header.pga_m_s2;
    table.trials = tally.trials;
    for (std::size_t cell = 0; cell < tally.cells(); ++cell)
        table.collapses.push_back(tally.reached[cell * tally.limit_states + static_cast<std::size_t>(limit)]);
    return with_shares(table);
}

} // namespace stylobate

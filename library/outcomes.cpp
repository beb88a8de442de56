#include "library/outcomes.hpp"

#include <stdexcept>

namespace stylobate::api {

namespace {

Estimate estimate(const stylobate::IntervalArray& array, std::size_t i)
{
    return {array.value[i], array.lower[i], array.upper[i]};
}

} // namespace

Outcome outcome_of(const stylobate::ResultRow& row)
{
    const stylobate::Outcome& o = row.outcome;
    Outcome out;
    out.index = row.index;
    out.cell = row.cell;
    out.frequency_hz = row.frequency_hz;
    out.pga_m_s2 = row.pga_m_s2;
#define STYLOBATE_OUTCOME(type, name, ...) out.name = static_cast<type>(o.name);
#define STYLOBATE_OUTCOME_AS(public_type, public_name, type, name, ...)                                                \
    out.public_name = static_cast<public_type>(o.name);
#include "stylobate/outcome_fields.inc"
    out.fall_time_s = o.fall_time_s;
    out.inputs = row.inputs;
    return out;
}

Share share_of(const stylobate::Share& share)
{
    return {share.trials, share.count, share.probability, share.lower, share.upper};
}

Surface surface_of(const stylobate::SurfaceTable& table, const std::string& limit_state)
{
    return {limit_state,     table.interval,    table.frequency_hz, table.pga_m_s2, table.trials,
            table.collapses, table.probability, table.lower,        table.upper};
}

Cell Surface::cell(std::size_t frequency, std::size_t pga) const
{
    if (frequency >= frequency_hz.size() || pga >= pga_m_s2.size())
        throw std::out_of_range("the surface has no such cell");
    const std::size_t i = frequency * pga_m_s2.size() + pga;
    return {frequency_hz[frequency], pga_m_s2[pga], trials[i], reached[i], probability[i], lower[i], upper[i]};
}

Fragility fragility_of(const stylobate::FragilityTable& table)
{
    Fragility fragility{table.measure, table.grid, table.stripe, {}};
    for (std::size_t s = 0; s < table.states.size(); ++s) {
        FragilityCurve curve;
        curve.limit_state = table.states[s];
        curve.meaning = table.meanings[s];
        curve.trials = table.trials[s];
        curve.reached = table.reached[s];
        curve.median = estimate(table.median, s);
        curve.dispersion = estimate(table.dispersion, s);
        for (std::size_t i = 0; i < table.grid.size(); ++i)
            curve.probability.push_back(estimate(table.curve, s * table.grid.size() + i));
        for (std::size_t i = 0; i < table.stripe.size(); ++i)
            curve.share.push_back(estimate(table.share, s * table.stripe.size() + i));
        fragility.curves.push_back(std::move(curve));
    }
    return fragility;
}

} // namespace stylobate::api

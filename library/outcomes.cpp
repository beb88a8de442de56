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
    out.state = static_cast<State>(o.state);
    out.invalid_reason = static_cast<InvalidReason>(o.invalid_reason);
    out.collapse_time_s = o.collapse_time_s;
    out.first_fallen_block = o.first_collapse_block;
    out.fallen_blocks = o.fallen_blocks;
    out.at_rest = o.at_rest != 0;
    out.unseated_block = o.unseated_block;
    out.unseating_time_s = o.unseating_time_s;
    out.total_collapse_time_s = o.total_collapse_time_s;
    out.peak_top_displacement_m = o.peak_top_displacement_m;
    out.residual_top_displacement_m = o.residual_top_displacement_m;
    out.top_path_m = o.top_path_m;
    out.total_sliding_m = o.total_sliding_m;
    out.sliding_path_m = o.sliding_path_m;
    out.residual_sliding_m = o.residual_sliding_m;
    out.residual_dislocation = o.residual_dislocation;
    out.total_rocking_rad = o.total_rocking_rad;
    out.rocking_path_rad = o.rocking_path_rad;
    out.max_relative_rotation_rad = o.max_relative_rotation_rad;
    out.energy_kinetic_j = o.energy_kinetic_j;
    out.energy_potential_j = o.energy_potential_j;
    out.energy_spring_j = o.energy_spring_j;
    out.energy_friction_j = o.energy_friction_j;
    out.energy_damping_j = o.energy_damping_j;
    out.energy_base_work_j = o.energy_base_work_j;
    out.energy_residual = o.energy_residual;
    out.end_time_s = o.end_time_s;
    out.step_s = o.step_s;
    out.steps = o.steps;
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

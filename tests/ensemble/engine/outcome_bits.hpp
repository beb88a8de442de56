#pragma once
/// What "the same outcome" means in tests: every number of it, as bits.

#include "ensemble/model/outcome.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace stylobate {

/// Every number of an outcome, as bits.
inline std::vector<std::uint64_t> outcome_bits(const Outcome& o)
{
    std::vector<std::uint64_t> bits{static_cast<std::uint64_t>(o.state),
                                    static_cast<std::uint64_t>(o.invalid_reason),
                                    static_cast<std::uint64_t>(o.first_collapse_block),
                                    static_cast<std::uint64_t>(o.fallen_blocks),
                                    static_cast<std::uint64_t>(o.unseated_block),
                                    static_cast<std::uint64_t>(o.at_rest),
                                    o.steps};
    for (const double value : {o.collapse_time_s,
                               o.peak_top_displacement_m,
                               o.residual_top_displacement_m,
                               o.total_sliding_m,
                               o.total_rocking_rad,
                               o.sliding_path_m,
                               o.max_relative_rotation_rad,
                               o.energy_kinetic_j,
                               o.energy_potential_j,
                               o.energy_spring_j,
                               o.energy_friction_j,
                               o.energy_damping_j,
                               o.energy_base_work_j,
                               o.energy_residual,
                               o.end_time_s,
                               o.step_s,
                               o.unseating_time_s,
                               o.total_collapse_time_s,
                               o.top_path_m,
                               o.residual_sliding_m,
                               o.residual_dislocation,
                               o.rocking_path_rad})
        bits.push_back(std::bit_cast<std::uint64_t>(value));
    for (const double time : o.fall_time_s)
        bits.push_back(std::bit_cast<std::uint64_t>(time));
    return bits;
}

} // namespace stylobate

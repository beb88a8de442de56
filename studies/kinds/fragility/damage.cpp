#include "studies/kinds/fragility/damage.hpp"

#include "ensemble/model/nominal.hpp"

#include <fmt/format.h>

namespace stylobate {

std::vector<DamageState> damage_states(const Study& study)
{
    using Kind = DamageState::Kind;
    std::vector<DamageState> states;
    for (const double limit : study.fragility->peak_limits)
        states.push_back({Kind::peak, limit, fmt::format("peak_{:g}", limit),
                          fmt::format("the top moves by more than {:g} of the width", limit)});
    for (const double limit : study.fragility->residual_limits)
        states.push_back({Kind::residual, limit, fmt::format("residual_{:g}", limit),
                          fmt::format("a joint stays dislocated by more than {:g} of its width", limit)});
    if (!study.structure.epistyles.empty())
        states.push_back({Kind::unseated, 0, "unseated", "an epistyle loses a seat, or a block falls"});
    for (int k = 1; k < study.fragility->shakings; ++k)
        states.push_back({Kind::collapse, 0, fmt::format("collapse_by_{}", k),
                          fmt::format("a block falls by the end of shaking {}", k), k});
    states.push_back({Kind::collapse, 0, "collapse", "a block falls"});
    if (study.outcome.follow == Follow::rest)
        states.push_back({Kind::total, 0, "total", "every column and every epistyle falls"});
    return states;
}

double base_width_m(const StructureSpec& structure)
{
    return structure.columns.front().drums.front().width_m;
}

double next_shaking_s(const Study& study, const MotionTable& motions, std::size_t motion, int shaking)
{
    const auto shakings = static_cast<std::size_t>(study.fragility->shakings);
    if (shaking == 0 || static_cast<std::size_t>(shaking) == shakings)
        return std::numeric_limits<double>::infinity();
    return motions.shaking_end_s.at(motion * shakings + static_cast<std::size_t>(shaking) - 1) + shaking_pause_s(study);
}

std::optional<bool> reached(const DamageState& state, const Outcome& outcome, double base_width_m, double until_s)
{
    const bool collapsed = outcome.state == State::collapsed;
    switch (state.kind) {
    case DamageState::Kind::peak:
        return collapsed || outcome.peak_top_displacement_m > state.limit * base_width_m;
    case DamageState::Kind::residual:
        if (collapsed)
            return true;
        return outcome.at_rest == 0 ? std::nullopt : std::optional(outcome.residual_dislocation > state.limit);
    case DamageState::Kind::unseated:
        return collapsed || outcome.unseating_time_s >= 0;
    case DamageState::Kind::collapse:
        return collapsed && outcome.collapse_time_s <= until_s;
    case DamageState::Kind::total:
        return outcome.total_collapse_time_s >= 0;
    }
    return false;
}

} // namespace stylobate

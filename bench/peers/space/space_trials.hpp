#pragma once
/// Trials of drums in space. Each gives errors: relative ones against the rigid value, or how far something has gone
/// that a rigid drum does not do, as a part of a length that is named.

#include "bench/peers/space/space_engine.hpp"

#include <string>
#include <vector>

namespace stylobate::peers {

struct SpaceTrial {
    std::string name;
    std::vector<std::string> columns;                                              ///< of what each error is
    std::function<std::vector<double>(const SpaceContender&, double dial)> errors; ///< NaN: no result
};

const std::vector<SpaceTrial>& space_trials();

/// Six drums on an equal fixed one: what is timed, and what creeps and is shaken.
SpaceScene space_column();

/// Processor time for one simulated second of a scene under a steady push [s].
double space_cost_s(const SpaceContender& contender, const SpaceScene& scene, double dial);

/// The direction [rad] in which one drum leans, alone or on an equal one, at half of what overturns it; the time until
/// it is upright [s].
double space_quarter_period_s(const SpaceContender& contender, double dial, bool on_plane, double azimuth_rad);

} // namespace stylobate::peers

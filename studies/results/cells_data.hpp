#pragma once
/// The cells of a surface as data for the script of its page.

#include "studies/experiment/limit_state.hpp"
#include "studies/results/results.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// The limit states that the page of a study counts: the total collapse only where realizations are followed beyond
/// their first fall, unseated epistyles only where there are epistyles.
std::vector<LimitState> counted_limits(const Study& study);

/// JSON for page/cells.js: the axes, and where their values lie in the frame of the map; of each cell the trials, and
/// how many of them reached each limit state; probabilities with their intervals. Where the results have rows, also
/// the final states, which block fell first, and the times of the first falls. An adaptive surface has the collapse
/// alone: its cells have as many realizations as the collapse needs.
/// @param table of the collapse   @pre the run is complete
std::string cells_json(const SurfaceTable& table, const Results& results);

} // namespace stylobate

#pragma once
/// Outcomes of the realizations in each cell of a surface, for its page.

#include "io/store/result_store.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// JSON for the map of the page (studies/report/page/cells.js): axes, counts, probabilities with their intervals; where
/// there are rows, also how often each state was reached, which block fell first, and when.
/// @param table of the study   @param trials rows that are trials; none: nothing is known of single realizations
/// @param file of the results, for the command that runs one again
std::string cells_json(const SurfaceTable& table, const std::vector<ResultRow>& trials,
                       const std::vector<std::string>& block_names, const std::string& file);

} // namespace stylobate

#pragma once
/// Counts of limit states as lines for a terminal and as JSON.

#include "studies/experiment/limit_state.hpp"
#include "studies/report/json.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// Outcomes of the valid realizations, over all cells.
/// @param names of the blocks   @param to_rest whether realizations are followed beyond the first fall
/// @param of which realizations are counted: "of one event: "
std::string limits_text(const LimitCounts& counts, const std::vector<std::string>& names, bool to_rest,
                        const std::string& of = "");

/// @param fair whether all cells have equally many realizations; else the shares among all mean nothing and are left
/// out
Json limits_json(const LimitCounts& counts, const std::vector<std::string>& names, bool to_rest, bool fair);

/// The blocks that fell first in some realization, those that did so most often before the others.
std::vector<std::size_t> first_fallen(const LimitCounts& counts);

} // namespace stylobate

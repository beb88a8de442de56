#pragma once
/// Counts of limit states as lines for a terminal and as JSON.

#include "studies/experiment/limit_state.hpp"
#include "studies/report/json.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Outcomes of the valid realizations, over all cells.
/// @param names of the blocks   @param to_rest whether realizations are followed beyond the first fall
/// @param of what they are (`counted_words`)
std::string limits_text(const LimitCounts& counts, const std::vector<std::string>& names, bool to_rest,
                        const std::optional<std::string>& of);

/// Which realizations the outcomes of a study are of where it has others too: "of one event", "without
/// replicas". nullopt: of all realizations.
std::optional<std::string> counted_words(const Study& study);

/// @param fair whether all cells have equally many realizations; else the shares among all mean nothing and are left
/// out
Json limits_json(const LimitCounts& counts, const std::vector<std::string>& names, bool to_rest, bool fair);

/// The blocks that fell first in some realization, those that did so most often before the others.
std::vector<std::size_t> first_fallen(const LimitCounts& counts);

} // namespace stylobate

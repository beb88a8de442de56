#pragma once
/// A comparison that runs pairs where the difference is undecided.

#include "studies/decisions/compare/compare_studies.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct AdaptiveChoice {
    std::uint64_t budget = 0; ///< pairs of each variant, at most
    double margin = 0.05;     ///< a difference that does not matter
};

/// @throws InputError if the study is no surface, or if the budget is too small for every cell's first look
void check_adaptive(const Study& base, const std::string& name, const AdaptiveChoice& choice);

/// Runs the studies round by round (paired_allocation.hpp), by the collapse; their files stay ones to be continued.
/// What a file has more than a round asks for is left out, so that the result depends on the studies and the choice
/// alone.
/// @param names of the studies, the base first   @returns nothing if the observer has asked to stop
std::optional<Comparison> compare_adaptively(const StudyRuns& studies, const std::vector<std::string>& names,
                                             const AdaptiveChoice& choice, double level, const RunOptions& options,
                                             Observer& observer);

} // namespace stylobate

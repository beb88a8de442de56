#pragma once
/// Which drawn numbers two studies have in common, found in the numbers themselves: a draw is keyed by seed, index,
/// stream and element, so that it does not depend on what else a study draws; its value depends on the distribution.

#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/study_side.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// By quantity, and of a quantity by relation. A number is the same if all pairs have the same bits; it is the same
/// quantile if the order of the realizations is the same.
/// @param names of the inputs: "friction[3]"
std::vector<CommonInput> common_inputs(const std::vector<StudySide::Draws>& base,
                                       const std::vector<std::string>& base_names,
                                       const std::vector<StudySide::Draws>& variant,
                                       const std::vector<std::string>& variant_names);

} // namespace stylobate

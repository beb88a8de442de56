#pragma once
/// The drawn quantities of two studies (friction, stiffness, a phase): which draws both have in common, and on which
/// the gain of a variant depends.
///
/// A draw is keyed by seed, index, stream and element, so that it does not depend on what else a study draws; its value
/// depends on the distribution. What is common is found in the numbers themselves.

#include "io/store/result_store.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/pairing.hpp"
#include "studies/decisions/compare/study_side.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace stylobate {

/// What two studies have in common, by quantity, and of a quantity by relation. A number is the same if all pairs have
/// the same bits; it is the same quantile if the order of the realizations is the same.
/// @param names of the inputs: "friction[3]"
std::vector<CommonInput> common_inputs(const std::vector<StudySide::Draws>& base,
                                       const std::vector<std::string>& base_names,
                                       const std::vector<StudySide::Draws>& variant,
                                       const std::vector<std::string>& variant_names);

/// Pairs that are looked at, at most: the first ones of each cell.
inline constexpr std::uint64_t most_dependence_pairs = 4'000'000;

/// The quantities of the base that vary, the one with the smallest p-value first. None where pairs share motions (a
/// fragility study): the test wants independent pairs.
/// @param rows of the base   @param base_limit, variant_limit the limit state among those of each side
std::vector<InputDependence> input_dependences(const ResultReader& rows, const StudySide& base,
                                               const StudySide& variant, std::size_t base_limit,
                                               std::size_t variant_limit, const PairLayout& layout);

} // namespace stylobate

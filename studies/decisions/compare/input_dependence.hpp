#pragma once
/// On which drawn quantities the gain of a variant depends: friction, stiffness, a phase.

#include "io/store/result_store.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/pairing.hpp"
#include "studies/decisions/compare/study_side.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

/// Pairs that are looked at, at most: the first ones of each cell.
inline constexpr std::uint64_t most_dependence_pairs = 4'000'000;

/// The quantities of the base that vary, the one with the smallest p-value first. None where pairs share motions (a
/// fragility study): the test wants independent pairs.
/// @param rows of the base   @param base_limit, variant_limit the limit state among those of each side
std::vector<InputDependence> input_dependences(const ResultReader& rows, const StudySide& base,
                                               const StudySide& variant, std::size_t base_limit,
                                               std::size_t variant_limit, const PairLayout& layout);

} // namespace stylobate

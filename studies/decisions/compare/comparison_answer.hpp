#pragma once
/// What a comparison comes to, for a reader who decides about a monument: the answer in a sentence, what it depends on,
/// and what would change it.

#include "studies/decisions/compare/comparison.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// "With dowels the probability of collapse is 0.231 instead of 0.274 over the 64 cells of the study: a
/// difference of -0.043 [-0.060, -0.027] at 95 %. It helps." Of the first limit state.
std::string answer_text(const Comparison& comparison, const VariantComparison& variant);

/// Where it harms, with the number of cells and the worst one; empty where no cell is named.
std::string harm_text(const Comparison& comparison, const VariantComparison& variant);

/// One sentence for each quantity on which the gain depends: "Friction: the difference is -0.08 [-0.10, -0.06] where it
/// is below 0.65, and -0.01 [-0.03, 0.01] where it is above 0.71 (adjusted p = 1e-5)." Those of an adjusted p-value of
/// at most the comparison's rate of false names.
std::vector<std::string> dependence_texts(const Comparison& comparison, const VariantComparison& variant);

/// What would change the answer: the other sign, or no difference shown, in a third of a quantity; cells in which it
/// harms though it helps over all, or the other way round; what more pairs would decide. At least one sentence.
std::vector<std::string> what_would_change_it(const Comparison& comparison, const VariantComparison& variant);

} // namespace stylobate

#pragma once
/// The pictures of a comparison.

#include "studies/decisions/compare/comparison.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

/// Of a surface: maps of the difference, one for each variant, with the cells that are named worse or better in full
/// colours, and the lines of the base's probability. Of a fragility study: the shares of base and variants by stripe.
/// @param limit name of the limit state; empty: the first one
/// @param title empty: by the comparison
/// @throws InputError if there is no such limit state, if there is nothing to draw (one cell), and as the plots do
void comparison_picture(const Comparison& comparison, const std::string& limit, const std::string& title,
                        const std::filesystem::path& file);

/// The limit state of that name in each variant. @param limit empty: the first one
/// @throws InputError with those that there are
const LimitComparison& limit_of(const VariantComparison& variant, const std::string& limit);

} // namespace stylobate

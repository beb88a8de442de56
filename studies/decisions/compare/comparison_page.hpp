#pragma once
/// A comparison as a page and as pictures.

#include "studies/decisions/compare/comparison.hpp"
#include "studies/report/html.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// For a reader who decides: the answer in a sentence with its interval, the structure, what the answer depends on and
/// what would change it; then what changes, where it harms, what is common, the studies and the commands. Where the map
/// cannot be drawn the page has a message.
/// @param file for names   @param title empty: by the base
/// @param warnings receives a line for a picture that could not be drawn
HtmlPage comparison_page(const Comparison& comparison, const std::string& file, const std::string& title,
                         std::vector<std::string>& warnings);

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

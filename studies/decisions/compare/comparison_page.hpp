#pragma once
/// A comparison as a page.

#include "studies/decisions/compare/comparison.hpp"
#include "studies/report/html.hpp"

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

} // namespace stylobate

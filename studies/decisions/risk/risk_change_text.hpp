#pragma once
/// A risk estimate of a comparison in words, as JSON, as a page and as a picture.

#include "studies/decisions/risk/risk.hpp"
#include "studies/report/html.hpp"
#include "studies/report/json.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

/// Lines for a terminal: of each variant and limit state the frequency and the probabilities of both structures, and
/// their change.
std::string risk_change_text(const RiskChange& change);
Json risk_change_json(const RiskChange& change);

/// "In 100 years the limit state 'a block falls' is reached with a probability of 11 % (5 to 24) in column and of 8 %
/// (4 to 18) with dowels: a change of -3 (-6 to -1) percentage points, 90 % interval. The risk is lower."
std::string risk_change_answer(const RiskChange& change, const VariantChange& variant);

/// @param file of the estimate, for its name   @param title instead of the comparison's; empty: that one
HtmlPage risk_change_page(const RiskChange& change, const std::string& file, const std::string& title);

/// Shares of the stripes of base and variants, and the change of the probability over the last of the years.
/// @param state a limit state; empty: the principal one   @throws InputError if it is none, or is not determined
void plot_risk_change(const RiskChange& change, const std::string& state, const std::string& title,
                      const std::filesystem::path& picture);

} // namespace stylobate

#pragma once
/// A risk estimate as a page and as a picture: the hazard, the fragility, and where the frequency comes from, above
/// each other.

#include "studies/decisions/risk/risk.hpp"
#include "studies/report/figure.hpp"
#include "studies/report/html.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// The three parts of one limit state, over the same intensities.
std::vector<Figure> risk_figures(const Risk& risk, const StateRisk& state);

/// @param file of the estimate, for its name   @param title instead of the study's; empty: that one
HtmlPage risk_page(const Risk& risk, const std::string& file, const std::string& title);

/// @param state a limit state; empty: the principal one   @throws InputError if it is none, or if it cannot be drawn
void plot_risk(const Risk& risk, const std::string& state, const std::string& title,
               const std::filesystem::path& picture);

} // namespace stylobate

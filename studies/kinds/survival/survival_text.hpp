#pragma once
/// A survival study as lines for a terminal, as JSON, as tables, as pictures and as sections of a page.

#include "io/plots/figure.hpp"
#include "io/tables/table.hpp"
#include "studies/kinds/kind.hpp"
#include "studies/kinds/survival/survival.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// The section of the page as a console shows it; "" of an incomplete run.
std::string survival_text(const Survival& survival);
Json survival_json(const Survival& survival);
/// The PGA of the past, with its credible interval.
Answer survival_answer(const Survival& survival);
void survival_section(const Survival& survival, PageWriter& writer);

/// Why nothing can be concluded, and what to do. @pre not judged
std::string not_judged_words(const Survival& survival);
/// "5.31 (5.1 to 5.52)"; beyond the axis: "none".
std::string estimate_words(const PastEstimate& estimate);
/// An exclusion as sentences without the last full stop; and those of pasts of 1, 2, ... events, with their numbers.
std::string exclusion_words(const Exclusion& exclusion, const std::string& prior, double level, const PastAxes& axes);
std::vector<std::string> exclusions_words(const std::vector<Exclusion>& by_events, const std::string& prior,
                                          double level, const PastAxes& axes);
/// Of which likelihood shaking is excluded.
std::string threshold_words(const ExclusionRule& rule, double level);
/// How often a true PGA is excluded; none where nothing was calibrated.
std::vector<std::string> coverage_words(const std::vector<ExclusionCoverage>& coverage, const PastAxes& axes);
/// "given that 2 of 6 that were built alike stand, this one among them"
std::string alike_words(std::uint64_t built, std::uint64_t standing);
/// How often the credible intervals contain the true value.
Json monuments_json(const MonumentTest& monuments, double level);
Json coverage_json(const std::vector<ExclusionCoverage>& coverage, const PastAxes& axes);
Json exclusion_json(const Exclusion& exclusion);
Json posterior_json(const PastPosterior& posterior, const PastAxes& axes);
/// The most probable past, and the credible intervals.
std::vector<std::string> posterior_words(const PastPosterior& posterior, const PastAxes& axes, double level);
/// @param events whether their number is unknown
std::vector<std::string> monument_words(const MonumentTest& test, double level, bool events);
/// @pre there are rates
std::vector<std::string> rates_words(const Survival& survival);

/// The table /survival of a results file.
Table survival_table(const Survival& survival);
/// The cells as CSV.
std::string survival_csv(const Survival& survival);

/// Maps of the likelihood, one for each number of events (at most six), with the probability of standing as lines.
void plot_likelihood(const Survival& survival, const std::string& title, const std::filesystem::path& png);
/// The likelihood over the intensity, as a part of its largest value.
FigureSeries likelihood_series(const std::string& name, const std::vector<double>& intensity,
                               const Exclusion& exclusion);
/// Below which an intensity is excluded, in the same unit.
FigureSeries threshold_series(const std::vector<double>& intensity, const Exclusion& exclusion);
/// The likelihood over the intensity and its threshold. @pre judged
Figure exclusion_figure(const Survival& survival);
/// Density of the factor on all rates over its logarithm, before and after. @pre there are rates
Figure rates_figure(const Survival& survival);

} // namespace stylobate

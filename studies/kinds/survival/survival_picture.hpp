#pragma once
/// The pictures of a survival study.

#include "studies/kinds/survival/survival.hpp"
#include "studies/report/figure.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

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
/// Lines and bands of a figure, by gnuplot.
void plot_curves(const Figure& figure, const std::string& title, const std::filesystem::path& png);

} // namespace stylobate

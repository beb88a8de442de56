#pragma once
/// The picture of a sensitivity study: for each outcome, bars of the factors' indices with their intervals.

#include "io/tables/sensitivity_table.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

/// Of Sobol's method the first and the total index, and the total one of single outcomes where something is drawn that
/// is no factor; of Morris' mu* and rms. What is not determined has no bar.
///
/// @throws InputError if the table is empty, and as `run_gnuplot` does
void plot_sensitivity(const SensitivityTable& table, const std::string& title, const std::filesystem::path& png);

} // namespace stylobate

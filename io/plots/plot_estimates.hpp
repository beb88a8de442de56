#pragma once
/// A picture of shares with their intervals over an intensity, several series beside each other.

#include "io/tables/kind_tables.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

struct ShareSeries {
    std::string name;
    std::vector<double> x, share, lower, upper; ///< as many of each
};

struct SharePicture {
    std::string title, subtitle;
    std::string x_label, y_label;
    std::vector<ShareSeries> series; ///< at most seven
};

/// Points with error bars, joined by lines; series are moved a little apart where they share their x.
/// @throws InputError if there is no point, if there are too many series, if gnuplot is missing or fails, or if the
///         picture cannot be written
void plot_shares(const SharePicture& picture, const std::filesystem::path& png);

// The picture of a rare event: how the chains came down to its probability, and what each repeat found.

/// The thresholds of one repeat's levels, and the probabilities to exceed them.
struct RareChain {
    std::vector<double> threshold_m, probability;
};
RareChain rare_chain(const RareTable& table, std::size_t repeat);

/// Draws (1800 x 1350 pixels), on one logarithmic axis of the probability: on the left a line for each repeat over the
/// thresholds of its levels, each with the product of the shares that have gone on to it; on the right the probability
/// of collapse that each repeat found, their mean and its interval. A repeat that came to no collapse has no point
/// there; the subtitle counts them. An end of the interval that is not above 0 is drawn at the foot of the axis;
/// without an interval the mean stands alone.
///
/// @throws InputError if the table is empty, if gnuplot is missing or fails, or if the picture cannot be written
void plot_rare(const RareTable& table, const std::string& title, const std::filesystem::path& png);

// The picture of a sensitivity study: for each outcome, bars of the factors' indices with their intervals.

/// Of Sobol's method the first and the total index, and the total one of single outcomes where something is drawn that
/// is no factor; of Morris' mu* and rms. What is not determined has no bar.
///
/// @throws InputError if the table is empty, and as `run_gnuplot` does
void plot_sensitivity(const SensitivityTable& table, const std::string& title, const std::filesystem::path& png);

} // namespace stylobate

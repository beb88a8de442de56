#pragma once
/// The picture of a rare event: how the chains came down to its probability, and what each repeat found.

#include "io/tables/rare_table.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

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

} // namespace stylobate

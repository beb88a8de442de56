#pragma once
/// The figures of a rare event: how the chains came down to its probability, and what each repeat found.

#include "io/plots/figure.hpp"
#include "io/tables/kind_tables.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// The thresholds of one repeat's levels, and the probabilities to exceed them: the products of the shares that have
/// gone on to each.
struct RareChain {
    std::vector<double> threshold_m, probability;
};
RareChain rare_chain(const RareTable& table, std::size_t repeat);

/// The chains of all repeats; and the probability of collapse of each repeat, with their mean and its interval.
/// A repeat that came to no collapse has no point.
std::vector<Figure> rare_figures(const RareTable& table);

/// Both as a picture. @throws InputError if the table is empty, and as `write_picture` does
void plot_rare(const RareTable& table, const std::string& title, const std::filesystem::path& file);

} // namespace stylobate

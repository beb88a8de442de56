#pragma once
/// The pictures that the results of every kind have: one realization over time, and the order of falls.

#include "kernels/isa.hpp"
#include "studies/results/results.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

struct Followed {
    Trajectory trajectory;
    std::vector<double> fall_time_s; ///< (blocks)
};

/// The trajectory that the file holds, or else the realization run again.
/// @throws InputError if there is no such realization
Followed trajectory_of(const Results& results, Isa isa, std::uint64_t index);

/// One realization over time: from the file's trajectory, or else run again.
/// @param title empty: by the results, the realization and what became of it
/// @throws InputError if there is no such realization, and as `plot_strip` does
void strip_picture(const Results& results, Isa isa, std::uint64_t index, const std::string& title,
                   const std::filesystem::path& file);

/// Which blocks fall, in which order and when.
/// @param cell of a surface; -1: all realizations
/// @param title empty: by the results and the cell
/// @throws InputError if there is no such cell, if the run is not complete, and as `plot_order` does
void order_picture(const Results& results, long long cell, const std::string& title, const std::filesystem::path& file);

} // namespace stylobate

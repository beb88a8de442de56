#pragma once
/// The picture of fragility slices: the probability of a limit state against PGA at given frequencies.

#include "io/store/result_store.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// Draws one curve with its interval (as a band, and as bars at the cells) for each of the surface's frequencies that
/// are nearest to the ones asked for, on the axis' scale; a frequency that is nearest to two of them is drawn once.
///
/// @param frequencies_hz at most 6; empty: up to three rows spread evenly over the axis
/// @param limit what the probability is one of: "collapse"
/// @throws InputError if more are asked for, if one is beyond the axis, and as `plot_surface` does
void plot_slice(const SurfaceTable& surface, const std::vector<double>& frequencies_hz, const std::string& limit,
                const std::string& title, const std::filesystem::path& png);

/// The rows that `plot_slice` draws, ascending.
std::vector<std::size_t> slice_rows(const SurfaceTable& surface, const std::vector<double>& frequencies_hz);

} // namespace stylobate

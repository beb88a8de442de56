#pragma once
/// The picture of one realization of a structure in space.

#include "ensemble/model/trajectory.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// Draws snapshots to one scale, in the frame of the base and from one oblique view, the time under each and below it
/// the plan with the orbit of the top so far (1800 pixels wide, as high as it needs); below them the elevations from
/// the front and from the side and the plan at the last sample; below these, over time, the displacements of the top
/// and of the base along x and along z, with marks at the snapshots and a line at each fall. Blocks that have fallen by
/// then have red outlines. The top and its displacement are those of `plot_strip`, which calls this function; so are
/// the parameters and the errors.
void plot_strip_in_space(const Trajectory& trajectory, const std::vector<double>& fall_time_s, const std::string& title,
                         const std::filesystem::path& png, std::size_t snapshots);

/// As `snapshot_samples`.
std::vector<std::size_t> snapshot_samples_in_space(const Trajectory& trajectory, std::size_t snapshots);

} // namespace stylobate

#pragma once
/// The picture of one realization: the structure at chosen times, its falls, and its displacements.

#include "ensemble/planar/fastening.hpp"
#include "io/store/result_store.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

inline constexpr std::size_t usual_snapshots = 8;

/// Draws a strip of snapshots (1800 pixels wide, 1350 high or more), blocks to scale in the frame of the base, the base
/// beneath them and the time under each: a column in one row, what is wide in several rows. Fixed blocks are darker,
/// epistyles blue, those that have fallen by then outlined in red. Below, over time: the number of fallen blocks if any
/// falls; the displacement of the top, against the base; that of the base, with marks at the snapshots. The top is the
/// centre of the last block that is free, and its displacement is counted from its place in the reference stack, as in
/// `Outcome::peak_top_displacement_m`. Lengths are in mm, or in m where they are large.
///
/// Only samples before the first one that is not finite are drawn. A recorded block whose role is ground, or whose top
/// lies at or below y = 0, is drawn as the base.
///
/// @param fall_time_s of each block, -1 = never, as in `Outcome`; empty: not known
/// @param snapshots 2 to 16; fewer are drawn if there are fewer samples
/// @param fastenings of a structure in the plane, which are drawn as lines; a rod from the edge of its base
/// A structure in space is drawn as `plot_strip_in_space` describes.
///
/// @throws InputError if the trajectory is empty, its arrays do not fit each other or a size is not positive, if the
///         fall times are not as many as the blocks, if `snapshots` is out of range, or
///         if the picture cannot be written
void plot_strip(const Trajectory& trajectory, const std::vector<double>& fall_time_s, const std::string& title,
                const std::filesystem::path& png, std::size_t snapshots = usual_snapshots,
                const std::vector<Fastening>& fastenings = {});

/// The samples that the strip shows, ascending: the first, the last, and in each stretch between (short where the
/// column moves much, long where it does little) the one at which the column is farthest from its start.
std::vector<std::size_t> snapshot_samples(const Trajectory& trajectory, std::size_t snapshots);

} // namespace stylobate

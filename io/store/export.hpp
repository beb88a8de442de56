#pragma once
/// Results in the formats of other programs: comma-separated values, and a trajectory for ParaView.

#include "io/store/result_store.hpp"

#include <filesystem>
#include <vector>

namespace stylobate {

/// Writes `realizations.csv` (one line per row, every field of `ResultRow` and `Outcome`; drawn values in the columns
/// "input_...", fall times in "fall_time_s[i]"), `blocks.csv` (the name of block i) and, if the surface has axes,
/// `surface.csv` (one line per cell, row by row) into `folder`, which is made if its parent exists. Numbers
/// are the shortest decimals with the same double, "nan" and "inf" where they are not finite; a time that never came is
/// "nan", a block that is none -1. Each file appears whole, and nothing is touched if the input is refused.
///
/// @param more columns with a value for each row, that follow the cell's; none: an empty table
/// @throws InputError if the folder cannot be made or written, if a row has another number of inputs or of fall times
///         than the header, or if the surface's arrays do not fit its axes
void write_csv(const std::filesystem::path& folder, const ResultHeader& header, const std::vector<ResultRow>& rows,
               const SurfaceTable& surface, const Table& more = Table("realizations"));

/// Writes the tables of a result that keeps no rows: `counts.csv` instead of `realizations.csv`, one line per cell: its
/// trials, its invalid realizations, how many reached each limit state, and how often each block fell first
/// ("first_fallen[i]"), or several at the same step ("first_together").
void write_counts_csv(const std::filesystem::path& folder, const ResultHeader& header, const Tally& tally,
                      const SurfaceTable& surface);

/// Writes a trajectory as one line per time: time_s, the base (base_x_m; in space also base_y_m and base_z_m), then the
/// channels of the pose of each block i from the bottom, as x_m[i]. Where the blocks stand at rest and their sizes
/// follow, as rest_x_m[i], the same in every line.
///
/// @throws InputError if the file cannot be written, or if the trajectory's arrays do not fit each other
void write_trajectory_csv(const std::filesystem::path& file, const Trajectory& trajectory);

/// Writes NAME.pvd and NAME_00000.vtp, NAME_00001.vtp and so on into a new folder, all of them or none.
///
/// Each VTP has the blocks in layout order and then the base, as polygons [m] in the laboratory frame: the displacement
/// of the base is added to the places of the blocks. The base is drawn as a slab below y = 0. A structure in the plane
/// has one polygon for each block, in the plane z = 0, counter-clockwise from the lower left corner. One in space has
/// the faces of each block: bottom, top, and the sides, each counter-clockwise as seen from outside; a drum has 24
/// sides, whose edges lie on its surface. Data of each polygon: `block_id` (the base: -1), `rotation` [rad] (in the
/// plane counter-clockwise; in space the angle of the rotation from upright), in space `tilt` [rad], the angle of the
/// block's axis from the vertical, and `velocity` of the centre (in space: of the middle of the body) [m/s] in the
/// laboratory frame, the central difference of the samples (one-sided at both ends). A trajectory has no contacts:
/// forces and openings of joints are left out.
///
/// @param name without an ending, for the names of the files
/// @throws InputError if the arrays of the trajectory do not fit each other, if it has no times, or if the folder holds
///         files or cannot be written
void write_vtk(const std::filesystem::path& folder, const std::string& name, const Trajectory& trajectory);

} // namespace stylobate

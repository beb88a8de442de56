#pragma once
/// The base motion of `excitation.kind = "table"`: samples as they stand, nothing corrected.

#include "ensemble/model/motion.hpp"
#include "io/records/record.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

/// Reads a file of columns with one line of names above: time_s, and acceleration_m_s2 or displacement_m; other columns
/// are left alone. The unit is part of the name and may be another (time_ms, acceleration_g, displacement_mm). Blanks,
/// tabs, commas or semicolons between them; lines that begin with # are comments. Times are uniform.
///
/// The motion begins at rest with the first sample. An acceleration is linear between its samples; where there is none,
/// it is that of the cubic spline through the displacements, counted from the first one. Where there are both, or where
/// a run of a measured campaign is named, it is the motion that goes best with all (`measured_motion.hpp`).
///
/// Accelerations up to 1000 m/s2 are taken from a column of them (a base that is hit), up to 50 m/s2 from the others.
///
/// @param pga `any`: of any acceleration
/// @param run of a measured campaign (an HDF5 file, a folder, its TOML file); empty: the file is one of columns
/// @throws InputError if it cannot be read, lacks the columns or the run, has times that are not uniform, too few
///         samples, does not move, or is faster than that
Motion read_base_table(const std::filesystem::path& file, const std::string& run = {}, PgaRange pga = PgaRange::usual);

} // namespace stylobate

#pragma once
/// Measured campaigns in files: HDF5, or a folder of CSV files with one TOML beside them. See FORMAT.md.

#include "ensemble/model/campaign.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

/// Reads a campaign and checks it (`check_campaign`): what contradicts itself is refused, what is doubtful is in
/// `findings`. Any data set may be absent; whatever number type and unit it was written in, it is SI here.
///
/// @param path an HDF5 file, a folder with campaign.toml, or that TOML file
/// @throws InputError, naming file, run and data set
Campaign read_campaign(const std::filesystem::path& path);

/// A sequence goes on in another file: adds its tests of single joints after those that are there, and what was
/// measured of the specimen at rest. Shake runs of that file are left out, and reported.
/// @throws InputError, naming both files and what differs, if it is of another specimen, or has no test
void add_tests_of(const Campaign& more, Campaign& campaign);

/// "crc32 1a2b3c4d" of a file, or of a folder's files.
std::string fingerprint(const std::filesystem::path& path);

// Tables of measured outcomes: one line of a CSV file for each test, columns by name. See FORMAT.md.

/// Reads a table with a column for the outcome (`fell`, `collapsed`, `overturned` or `toppled`: 1
/// or 0, yes or no, true or false, fell or stood) and columns for the motion: `motion_file`; `amplitude_m` and
/// `frequency_hz`; `pga_m_s2` (or `pga_g`) and `pgv_over_pga_s`, or `pgv_m_s`. `motion_id` and `repeat` are counted
/// from equal motions where they are absent. Rows without an outcome and columns of other names are omitted and
/// reported.
///
/// @throws InputError, naming file, line, column and value
OutcomeTable read_outcomes(const std::filesystem::path& file);

} // namespace stylobate

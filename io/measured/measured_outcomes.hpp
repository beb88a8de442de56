#pragma once
/// Tables of measured outcomes: one line of a CSV file for each test, columns by name. See FORMAT.md.

#include "ensemble/model/campaign.hpp"

#include <filesystem>

namespace stylobate {

/// Reads a table with a column for the outcome (`fell`, `collapsed`, `overturned` or `toppled`: 1
/// or 0, yes or no, true or false, fell or stood) and columns for the motion: `motion_file`; `amplitude_m` and
/// `frequency_hz`; `pga_m_s2` (or `pga_g`) and `pgv_over_pga_s`, or `pgv_m_s`. `motion_id` and `repeat` are counted
/// from equal motions where they are absent. Rows without an outcome and columns of other names are omitted and
/// reported.
///
/// @throws InputError, naming file, line, column and value
OutcomeTable read_outcomes(const std::filesystem::path& file);

} // namespace stylobate

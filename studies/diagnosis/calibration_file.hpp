#pragma once
/// A calibration as an HDF5 file; `io/FORMAT.md` says what is in it.

#include "studies/diagnosis/calibration.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// What `stylobate info` tells of one.
struct CalibrationSummary {
    std::string measured;  ///< the file that it began from
    std::string evidence;  ///< "histories" or "outcomes"
    std::string best_form; ///< contact form
    std::string code_version;
    std::uint64_t parameter_sets = 0;
    std::vector<std::string> keys; ///< what was fitted, of the best form
    std::vector<double> value, low, high;
};

/// Nothing if the file is none.   @throws InputError if it is one, but damaged
std::optional<CalibrationSummary> read_calibration_summary(const std::filesystem::path& file);

/// Writes a calibration over a file.
/// @param start the study that it began from   @throws InputError if it cannot be written
void write_calibration(const Calibration& calibration, const Study& start, const std::string& code_version,
                       const std::filesystem::path& file);

} // namespace stylobate

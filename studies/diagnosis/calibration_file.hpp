#pragma once
/// A calibration as an HDF5 file; `io/FORMAT.md` says what is in it.

#include "studies/diagnosis/calibration.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

/// Writes a calibration over a file.
/// @param start the study that it began from   @throws InputError if it cannot be written
void write_calibration(const Calibration& calibration, const Study& start, const std::string& code_version,
                       const std::filesystem::path& file);

} // namespace stylobate

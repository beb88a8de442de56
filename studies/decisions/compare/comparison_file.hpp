#pragma once
/// A comparison as an HDF5 file; `io/FORMAT.md` describes its content.

#include "studies/decisions/compare/comparison.hpp"

#include <filesystem>

namespace stylobate {

/// Writes it whole or not at all; the same comparison gives the same bytes.
/// @throws InputError if it cannot be written
void write_comparison(const Comparison& comparison, const std::filesystem::path& file);

/// @throws InputError if the file is none, of another format version, or damaged
Comparison read_comparison(const std::filesystem::path& file);

} // namespace stylobate

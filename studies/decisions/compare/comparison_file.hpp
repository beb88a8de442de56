#pragma once
/// A comparison as an HDF5 file; `io/FORMAT.md` describes its content.

#include "io/tables/table.hpp"
#include "studies/decisions/compare/comparison.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// Writes it whole or not at all; the same comparison gives the same bytes.
/// @throws InputError if it cannot be written
void write_comparison(const Comparison& comparison, const std::filesystem::path& file);

/// @throws InputError if the file is none, of another format version, or damaged
Comparison read_comparison(const std::filesystem::path& file);

/// What the file has between its seal and its end.
std::vector<Table> tables_of(const Comparison& comparison);
/// @param file  for messages
/// @throws InputError "FILE: is damaged" where the tables are not those of a comparison
Comparison comparison_from(const std::vector<Table>& tables, const std::string& file);

} // namespace stylobate

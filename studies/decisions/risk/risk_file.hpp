#pragma once
/// A risk estimate as a sealed HDF5 file; `io/FORMAT.md` describes its content.

#include "io/tables/table.hpp"
#include "studies/decisions/risk/risk.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Writes it whole or not at all; the same estimate gives the same bytes.
/// @throws InputError if it cannot be written
void write_risk(const Risk& risk, const std::filesystem::path& file);

/// @throws InputError if the file is none, of another format version, truncated or damaged
Risk read_risk(const std::filesystem::path& file);

/// What the file has between its seal and its end.
std::vector<Table> tables_of(const Risk& risk);
/// @param file  for messages
/// @throws InputError "FILE: is damaged" where the tables are not those of a risk estimate
Risk risk_from(const std::vector<Table>& tables, const std::string& file);

/// The tables as comma-separated values: names of files and their texts.
std::vector<std::pair<std::string, std::string>> risk_csv(const Risk& risk);

} // namespace stylobate

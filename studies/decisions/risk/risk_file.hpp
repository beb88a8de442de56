#pragma once
/// Risk estimates, and those of comparisons, as sealed HDF5 files; `io/FORMAT.md` describes their content.

#include "io/tables/table.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/decisions/risk/risk_change.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Writes a file whole or not at all; equal estimates give equal bytes. @throws InputError if it cannot be written
/// @{
void write_risk(const Risk& risk, const std::filesystem::path& file);
void write_risk_change(const RiskChange& change, const std::filesystem::path& file);
/// @}

/// @throws InputError if the file is none, of another format version, truncated or damaged
/// @{
Risk read_risk(const std::filesystem::path& file);
RiskChange read_risk_change(const std::filesystem::path& file);
/// @}

/// What a file has between its seal and its end.
/// @{
std::vector<Table> tables_of(const Risk& risk);
std::vector<Table> tables_of(const RiskChange& change);
/// @}
/// @param file for messages   @throws InputError "FILE: is damaged" where the tables are not those of such an estimate
/// @{
Risk risk_from(const std::vector<Table>& tables, const std::string& file);
RiskChange risk_change_from(const std::vector<Table>& tables, const std::string& file);
/// @}

/// The tables as comma-separated values: names of files and their texts.
/// @{
std::vector<std::pair<std::string, std::string>> risk_csv(const Risk& risk);
std::vector<std::pair<std::string, std::string>> risk_change_csv(const RiskChange& change);
/// @}

} // namespace stylobate

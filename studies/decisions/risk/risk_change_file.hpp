#pragma once
/// The file of a risk estimate of a comparison.

#include "io/tables/table.hpp"
#include "studies/decisions/risk/risk_change.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Writes it whole or not at all; the same estimate gives the same bytes. @throws InputError if it cannot be written
void write_risk_change(const RiskChange& change, const std::filesystem::path& file);

/// @throws InputError if the file is none, of another format version, truncated or damaged
RiskChange read_risk_change(const std::filesystem::path& file);

/// What the file has between its seal and its end.
std::vector<Table> tables_of(const RiskChange& change);
/// @param file for messages   @throws InputError "FILE: is damaged" where the tables are none of such an estimate
RiskChange risk_change_from(const std::vector<Table>& tables, const std::string& file);

/// The tables as comma-separated values: names of files and their texts.
std::vector<std::pair<std::string, std::string>> risk_change_csv(const RiskChange& change);

} // namespace stylobate

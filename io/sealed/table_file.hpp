#pragma once
/// Tables as a sealed file.

#include "io/sealed/sealed_file.hpp"
#include "io/tables/table.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// Writes the tables as groups of the file. @throws InputError as `write_sealed_file`
void write_table_file(const std::filesystem::path& file, const SealedFormat& format, const std::string& code_version,
                      const std::vector<Table>& tables);

/// Reads what was written: the tables by name, in the order of their characters.
/// @throws InputError as `read_sealed_file`
std::vector<Table> read_table_file(const std::filesystem::path& file, const SealedFormat& format);

} // namespace stylobate

#pragma once
/// Tables in an HDF5 file of their own, with a seal: for what is computed from results and is none itself.

#include "io/tables/table.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// The format of such a file.
struct TableFormat {
    const char* format;           ///< attribute of the root: "stylobate-comparison"
    const char* kind;             ///< "comparison"
    std::uint64_t version;        ///< that is written
    std::uint64_t oldest_version; ///< that is read
};

/// Writes the tables as groups of the file, whole or not at all; the same tables give the same bytes.
/// @throws InputError if it cannot be written
void write_table_file(const std::filesystem::path& file, const TableFormat& format, const std::string& code_version,
                      const std::vector<Table>& tables);

/// Reads what was written: the tables by name, in the order of their characters.
/// @throws InputError if the file is none of this format, of another version, truncated or damaged
std::vector<Table> read_table_file(const std::filesystem::path& file, const TableFormat& format);

} // namespace stylobate

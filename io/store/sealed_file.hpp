#pragma once
/// HDF5 files with a seal, written whole or not at all: for what is computed from results and is none itself.

#include "io/tables/table.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace stylobate {

/// The format of such a file.
struct SealedFormat {
    const char* format;           ///< attribute of the root: "stylobate-comparison"
    const char* kind;             ///< "comparison"
    std::uint64_t version;        ///< that is written
    std::uint64_t oldest_version; ///< that is read
    const char* again;            ///< how to make it again: "make it anew"
};

/// Writes the attributes of the format and what the table holds; equal content gives equal bytes.
/// @throws InputError if it cannot be written
void write_sealed_file(const std::filesystem::path& file, const SealedFormat& format, const std::string& code_version,
                       const Table& content);

struct SealedContent {
    Table content;         ///< its tables by name, in the order of their characters
    std::uint64_t version; ///< of the file
};

/// Verifies the seal and the format.
/// @throws InputError if the file is none of this format, of another version, truncated or damaged
SealedContent read_sealed_file(const std::filesystem::path& file, const SealedFormat& format);

} // namespace stylobate

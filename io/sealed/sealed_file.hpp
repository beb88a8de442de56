#pragma once
/// HDF5 files with a seal, written whole or not at all: for what is computed from results and is none itself.

#include "io/files/hdf5.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
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

/// Writes the attributes of the format and what `content` adds; the same content gives the same bytes.
/// @throws InputError if it cannot be written
void write_sealed_file(const std::filesystem::path& file, const SealedFormat& format, const std::string& code_version,
                       const std::function<void(hid_t root)>& content);

/// Verifies the seal and the format.
/// @param content takes what the file has; it may throw `hdf5::Error` for what is damaged
/// @throws InputError if the file is none of this format, of another version, truncated or damaged
void read_sealed_file(const std::filesystem::path& file, const SealedFormat& format,
                      const std::function<void(hid_t root, std::uint64_t version)>& content);

} // namespace stylobate

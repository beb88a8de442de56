#pragma once
/// The seal of a results file: its first bytes, in front of the HDF5 part. It holds a checksum over every byte that
/// does not change while rows are written, so that damage is found before the HDF5 library meets it. And other HDF5
/// files with a seal, for what is computed from results and is none itself.

#include "io/files/file_handle.hpp"
#include "io/tables/table.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stylobate {

/// Bytes of the file that hold rows: they have checksums of their own.
struct Extent {
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    bool operator==(const Extent&) const = default;
};

/// CRC-32 of zlib, continued from `before`.
std::uint32_t crc32_of(std::span<const std::byte> bytes, std::uint32_t before = 0);

/// Room for the seal of a file with a number of extents: a power of two from 512, as HDF5 wants its user block [bytes].
std::uint64_t seal_bytes(std::size_t extents);
/// In the order of their offsets, neighbours joined.
std::vector<Extent> joined(std::vector<Extent> extents);

/// Checks the whole file outside `extents` (joined), and writes the seal.
/// @param block the result of `seal_bytes` when the file was created
/// @param version of its format; not given: that of a planar study, which other sealed files have too
void write_seal(FileHandle& file, std::uint64_t block, const std::vector<Extent>& extents,
                std::optional<std::uint64_t> version = std::nullopt);

/// Checks and seals a file that goes on behind its end, with bytes that the seal does not cover (`RowJournal`).
void write_open_seal(FileHandle& file, std::uint64_t block, std::optional<std::uint64_t> version = std::nullopt);

/// What a seal says.
struct Seal {
    std::vector<Extent> extents; ///< of a file that may go on behind its end a single one of no size, there
    std::uint64_t version = 0;   ///< of the file's format: one that this program reads
};

/// Verifies the seal.
/// @param name of the file, for messages
/// @throws InputError if the file is none of ours, of another format version, truncated or damaged
Seal check_seal(const FileHandle& file, const std::string& name);

/// The format of a file of one kind that is written whole or not at all.
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

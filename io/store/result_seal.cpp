#include "io/store/result_seal.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/result_layout.hpp"
#include "io/tables/table_hdf5.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <system_error>
#include <zlib.h>

namespace stylobate {
namespace {

/// The start of the block; the extents follow, then zeros, then the block's own CRC-32 in its last four bytes.
struct SealHead {
    std::array<char, 16> magic;
    std::uint32_t version;
    std::uint32_t block;     ///< bytes, the CRC-32 at its end included
    std::uint64_t file_size; ///< bytes
    std::uint32_t extents;
    std::uint32_t crc; ///< of the file from the end of the block, without the extents
};
static_assert(sizeof(SealHead) == 40);
static_assert(sizeof(Extent) == 16);
static_assert(std::endian::native == std::endian::little,
              "the file is little-endian and is written without conversion");

constexpr std::array<char, 16> magic = {'s', 't', 'y', 'l', 'o', 'b', 'a',  't',
                                        'e', ' ', 's', 'e', 'a', 'l', '\n', '\0'};
constexpr std::array<unsigned char, 8> hdf5_signature = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
constexpr std::uint64_t smallest_block = 512;
constexpr std::uint64_t largest_block = 1 << 20;
constexpr char damaged[] =
    "is damaged: its checksum is wrong. Use a backup copy, or run the study again into another file.";

std::uint32_t crc_outside(const FileHandle& file, std::uint64_t from, std::uint64_t end,
                          const std::vector<Extent>& extents)
{
    constexpr std::uint64_t most = std::uint64_t{1} << 18;
    std::vector<std::byte> buffer(std::min(most, end - std::min(from, end)));
    std::uint32_t crc = 0;
    const auto add = [&](std::uint64_t to) {
        while (from < to) {
            const auto part = std::span(buffer).first(std::min<std::uint64_t>(buffer.size(), to - from));
            file.read(from, part);
            crc = crc32_of(part, crc);
            from += part.size();
        }
    };
    for (const Extent& extent : extents) {
        add(extent.offset);
        from = extent.offset + extent.size;
    }
    add(end);
    return crc;
}

} // namespace

std::uint32_t crc32_of(std::span<const std::byte> bytes, std::uint32_t before)
{
    return static_cast<std::uint32_t>(
        ::crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

std::uint64_t seal_bytes(std::size_t extents)
{
    return std::max(smallest_block, std::bit_ceil(sizeof(SealHead) + extents * sizeof(Extent) + sizeof(std::uint32_t)));
}

std::vector<Extent> joined(std::vector<Extent> extents)
{
    std::sort(extents.begin(), extents.end(), [](const Extent& a, const Extent& b) { return a.offset < b.offset; });
    std::vector<Extent> result;
    for (const Extent& extent : extents)
        if (!result.empty() && result.back().offset + result.back().size == extent.offset)
            result.back().size += extent.size;
        else
            result.push_back(extent);
    return result;
}

void write_seal(FileHandle& file, std::uint64_t block, const std::vector<Extent>& extents,
                std::optional<std::uint64_t> version)
{
    const std::uint64_t size = file.size();
    const SealHead head = {magic,
                           static_cast<std::uint32_t>(version.value_or(result_format_version)),
                           static_cast<std::uint32_t>(block),
                           size,
                           static_cast<std::uint32_t>(extents.size()),
                           crc_outside(file, block, size, extents)};
    std::vector<std::byte> bytes(block);
    std::memcpy(bytes.data(), &head, sizeof head);
    std::ranges::copy(std::as_bytes(std::span(extents)), bytes.begin() + sizeof head);
    const std::uint32_t crc = crc32_of(std::span(bytes).first(block - sizeof crc));
    std::memcpy(bytes.data() + block - sizeof crc, &crc, sizeof crc);
    file.write(0, bytes);
}

void write_open_seal(FileHandle& file, std::uint64_t block, std::optional<std::uint64_t> version)
{
    write_seal(file, block, {{file.size(), 0}}, version);
}

Seal check_seal(const FileHandle& file, const std::string& name)
{
    const auto refuse = [&](const std::string& text) { throw InputError(name, 0, text); };

    const std::uint64_t size = file.size();
    std::array<std::byte, sizeof(SealHead)> start = {};
    file.read(0, std::span(start).first(std::min<std::uint64_t>(size, start.size())));
    if (size == 0)
        refuse("is empty; a results file of stylobate is needed");
    if (std::memcmp(start.data(), hdf5_signature.data(), hdf5_signature.size()) == 0)
        refuse(
            "is an HDF5 file, but not a results file as stylobate writes it (another program made it or rewrote it)");
    if (std::memcmp(start.data(), magic.data(), magic.size()) != 0)
        refuse("is not a results file of stylobate");
    SealHead head = {};
    std::memcpy(&head, start.data(), sizeof head);
    if (size < smallest_block)
        refuse("is truncated");
    if (!std::has_single_bit(head.block) || head.block < smallest_block || head.block > largest_block)
        refuse(damaged);
    if (size < head.block)
        refuse("is truncated");

    std::vector<std::byte> block(head.block);
    file.read(0, block);
    std::uint32_t crc = 0;
    std::memcpy(&crc, block.data() + block.size() - sizeof crc, sizeof crc);
    if (crc != crc32_of(std::span(block).first(block.size() - sizeof crc)))
        refuse(damaged);
    if (head.version != result_format_version && head.version != spatial_result_format_version)
        refuse("is of format version " + std::to_string(head.version) + "; this program reads versions " +
               std::to_string(result_format_version) + " and " + std::to_string(spatial_result_format_version) +
               ". Read it with the version that wrote it, or run its study again into another file.");
    if (size < head.file_size)
        refuse("is truncated: " + std::to_string(size) + " bytes of " + std::to_string(head.file_size));
    if (head.extents > (head.block - sizeof head - sizeof crc) / sizeof(Extent))
        refuse(damaged);

    std::vector<Extent> extents(head.extents);
    const auto list = std::as_writable_bytes(std::span(extents));
    std::ranges::copy(std::span(block).subspan(sizeof head, list.size()), list.begin());
    const bool open = extents.size() == 1 && extents[0] == Extent{head.file_size, 0};
    if (size > head.file_size && !open)
        refuse(damaged);
    std::uint64_t from = head.block;
    for (const Extent& extent : extents) {
        if (extent.offset < from || extent.offset > size || extent.size > size - extent.offset)
            refuse(damaged);
        from = extent.offset + extent.size;
    }
    if (crc_outside(file, head.block, head.file_size, extents) != head.crc)
        refuse(damaged);
    return {std::move(extents), head.version};
}

void write_sealed_file(const std::filesystem::path& file, const SealedFormat& format, const std::string& code_version,
                       const Table& content)
{
    AtomicFile target(file);
    try {
        const std::uint64_t block = seal_bytes(0);
        hdf5::Handle made = hdf5::create_file(target.temporary(), block);
        hdf5::write_text(made.id(), "format", format.format);
        hdf5::write_number(made.id(), "format_version", H5T_STD_U32LE, format.version);
        hdf5::write_text(made.id(), "kind", format.kind);
        hdf5::write_text(made.id(), "code_version", code_version);
        write_content(made.id(), content);
        made.close();
        FileHandle handle = FileHandle::open(target.temporary(), true);
        write_seal(handle, block, {});
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("cannot be written: ") + error.what());
    } catch (const std::system_error& error) {
        throw InputError(file.string(), 0, "cannot be written: " + error.code().message());
    }
    target.commit();
}

SealedContent read_sealed_file(const std::filesystem::path& file, const SealedFormat& format)
{
    const FileHandle handle = FileHandle::open(file, false);
    check_seal(handle, file.string());
    try {
        const hdf5::Handle open = hdf5::open_file(file, false);
        if (hdf5::read_text(open.id(), "format") != format.format)
            throw InputError(file.string(), 0, fmt::format("contains no {}", format.kind));
        const std::uint64_t version = hdf5::read_number(open.id(), "format_version");
        if (version < format.oldest_version || version > format.version)
            throw InputError(file.string(), 0,
                             fmt::format("is a {} of format version {}; this program reads versions {} to {}. Read it "
                                         "with the version that wrote it, or {}.",
                                         format.kind, version, format.oldest_version, format.version, format.again));
        return {read_content(open.id(), format.kind, file.string()), version};
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0,
                         fmt::format("is damaged: {}. Use a backup copy, or {}.", error.what(), format.again));
    }
}

} // namespace stylobate

#include "io/store/sealed_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/file_handle.hpp"
#include "io/store/result_seal.hpp"
#include "io/tables/table_hdf5.hpp"

#include <fmt/format.h>

#include <system_error>

namespace stylobate {

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

#include "studies/diagnosis/findings/diagnosis_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/file_handle.hpp"
#include "io/files/hdf5.hpp"
#include "io/store/result_seal.hpp"
#include "studies/diagnosis/findings/diagnosis_fields.hpp"
#include "studies/windows/field_table.hpp"

#include <system_error>

/// The diagnosis itself is a table of one item, the root.
namespace stylobate {
namespace {

constexpr char format_name[] = "stylobate-diagnosis";
constexpr std::uint64_t format_version = 3;       // 3: windows in motion; 2: spans in figures
constexpr std::uint64_t least_format_version = 2; // that is read

struct OpenDiagnosis {
    FileHandle handle;
    hdf5::Handle hdf5;
};

[[noreturn]] void refuse_damaged(const std::filesystem::path& file, const std::string& text)
{
    throw InputError(file.string(), 0, "is damaged: " + text + ". Use a backup copy, or run the diagnosis again.");
}

/// Its seal verified. @throws InputError
OpenDiagnosis open_sealed(const std::filesystem::path& file)
{
    OpenDiagnosis open;
    open.handle = FileHandle::open(file, false);
    check_seal(open.handle, file.string());
    try {
        open.hdf5 = hdf5::open_file(file, false);
    } catch (const hdf5::Error& error) {
        refuse_damaged(file, error.what());
    }
    return open;
}

} // namespace

void write_diagnosis(const Diagnosis& diagnosis, const std::filesystem::path& file)
{
    AtomicFile target(file);
    try {
        const std::uint64_t block = seal_bytes(0);
        hdf5::Handle made = hdf5::create_file(target.temporary(), block);
        hdf5::write_text(made.id(), "format", format_name);
        hdf5::write_number(made.id(), "format_version", H5T_STD_U32LE, format_version);
        hdf5::write_text(made.id(), "kind", "diagnosis");
        hdf5::write_text(made.id(), "code_version", diagnosis.code_version);
        write_table<Diagnosis>(made.id(), {&diagnosis});
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

Diagnosis read_diagnosis(const std::filesystem::path& file)
{
    const OpenDiagnosis open = open_sealed(file);
    try {
        const hid_t root = open.hdf5.id();
        if (hdf5::read_text(root, "format") != format_name)
            throw InputError(file.string(), 0, "contains no diagnosis, but the results of a study");
        const std::uint64_t version = hdf5::read_number(root, "format_version");
        if (version < least_format_version || version > format_version)
            throw InputError(file.string(), 0,
                             "is a diagnosis of format version " + std::to_string(version) +
                                 "; this program reads versions " + std::to_string(least_format_version) + " to " +
                                 std::to_string(format_version) +
                                 ". Read it with the version that wrote it, or run the diagnosis again.");
        Diagnosis diagnosis = std::move(read_table<Diagnosis>(root, 1, version).front());
        if (diagnosis.motion)
            if (const std::string fault = diagnosis.motion->fault(); !fault.empty())
                throw hdf5::Error(fault);
        return diagnosis;
    } catch (const hdf5::Error& error) {
        refuse_damaged(file, error.what());
    }
}

} // namespace stylobate

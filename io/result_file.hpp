#pragma once
/// A results file that exists: what its reader and its resuming writer share.

#include "io/file_handle.hpp"
#include "io/hdf5.hpp"
#include "io/result_layout.hpp"
#include "io/result_seal.hpp"

#include <optional>
#include <unordered_map>

namespace stylobate {

/// A name in the same folder, for what is not ready to be seen.
std::filesystem::path beside(const std::filesystem::path& file, const char* suffix);

/// Removes an unfinished file when something fails on the way.
class Temporary {
public:
    explicit Temporary(std::filesystem::path file) : file_(std::move(file)) {}
    ~Temporary()
    {
        std::error_code ignored;
        if (!kept_)
            std::filesystem::remove(file_, ignored);
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    void keep() { kept_ = true; }

private:
    std::filesystem::path file_;
    bool kept_ = false;
};

/// The names of the inputs as one text.
std::string joined_inputs(const ResultHeader& header);
/// The attributes of the file, the axes of its surface and its motions.
void write_header(hid_t file, const ResultHeader& header, bool complete);
/// The table of a finished surface, into the group that `write_header` has made.
void write_surface(hid_t file, const SurfaceTable& table);
/// @throws std::invalid_argument if the table does not fit the header's axes
void check_table(const ResultHeader& header, const SurfaceTable& table);

/// Where the rows lie in the file, in bytes from its start.
struct RowPlaces {
    std::vector<std::uint64_t> column; ///< by column of the layout
    std::uint64_t checksum = 0;

    /// All of it, joined: what the seal leaves out.
    std::vector<Extent> extents(const ResultLayout& layout) const;
};

/// The HDF5 type of a column, or of a field, in the file.
hdf5::Handle file_type(Stored stored);
/// That of a block's role.
hdf5::Handle role_type();
/// That of a cell's interval.
hdf5::Handle method_type();
/// Shape of a column.
hdf5::Dims column_dims(const ResultLayout& layout, const Column& column);

/// Finds the columns. @throws hdf5::Error if one is missing or has another type or shape
RowPlaces find_rows(hid_t file, const ResultLayout& layout);

/// Which row is a realization's, among those that are known.
class RowNumbers {
public:
    RowNumbers() = default;
    explicit RowNumbers(const ResultHeader& header)
        : selected_(header.selected), first_(header.first), rows_(header.total)
    {
    }
    /// Where the rows are selected, of those that were added only.
    std::optional<std::uint64_t> of(std::uint64_t index) const;
    /// @returns false if the realization has a row already
    bool add(std::uint64_t index, std::uint64_t number) { return number_.emplace(index, number).second; }

private:
    bool selected_ = false;
    std::uint64_t first_ = 0;
    std::uint64_t rows_ = 0;
    std::unordered_map<std::uint64_t, std::uint64_t> number_; ///< where the rows are selected
};

/// An open results file, its seal verified.
struct ResultFile {
    std::filesystem::path path;
    FileHandle handle;
    hdf5::Handle hdf5;
    ResultHeader header;
    bool complete = false;
    ResultLayout layout;
    RowPlaces places;

    /// The bytes of a chunk, or nothing if it is not written or its checksum is wrong.
    std::optional<std::vector<std::byte>> read_chunk(std::uint64_t chunk) const;
    /// Writes the rows first, their checksum last.
    void write_chunk(std::uint64_t chunk, std::span<const std::byte> bytes);
    /// Refuses with "damaged" and the reason.
    [[noreturn]] void refuse_damaged(const std::string& text) const;
};

/// Opens and verifies all but the rows.
/// @param writable also takes the lock of the one writer
/// @throws InputError as `ResultReader` and `ResultWriter::resume` say
ResultFile open_result(const std::filesystem::path& path, bool writable);

/// @throws InputError unless the file is an unfinished one of this study and version
void check_same_study(const ResultFile& file, const ResultHeader& asked);

} // namespace stylobate

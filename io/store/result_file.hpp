#pragma once
/// A results file that exists: what its reader and its resuming writer share.

#include "io/files/file_handle.hpp"
#include "io/files/hdf5.hpp"
#include "io/store/result_layout.hpp"
#include "io/store/result_seal.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>

namespace stylobate {

/// A name in the same folder, for what is not ready to be seen.
std::filesystem::path beside(const std::filesystem::path& file, const char* suffix);

/// The names of the inputs as one text.
std::string joined_inputs(const ResultHeader& header);
/// The attributes of the file, the axes of its surface and its motions.
void write_header(hid_t file, const ResultHeader& header, bool complete);
/// The table of a finished surface, into the group that `write_header` has made.
void write_surface(hid_t file, const SurfaceTable& table);
/// @throws std::invalid_argument if the table does not fit the header's axes
void check_table(const ResultHeader& header, const SurfaceTable& table);

/// Makes a results file explain itself to programs that do not know it (xarray, netCDF tools, MATLAB): gives every data
/// set its `long_name`, every numerical one its `units` ("1": dimensionless), and every dimension its scale, a data set
/// of the same group or of one above it. Scales that the file lacks, such as `block` with the names of the blocks, are
/// added as lists of text. A data set that FORMAT.md does not list is left as it is. Called once, when everything else
/// has been written.
void write_labels(hid_t file);

/// @param dimensions of the structure, 2 or 3
/// @throws std::invalid_argument if the arrays of the trajectory do not fit together, or its channels are not those of
///         the model
void check_trajectory(const Trajectory& trajectory, int dimensions);
/// Below /trajectories, which is there.
void write_trajectory(hid_t file, const Trajectory& trajectory);
/// @param dimensions of the structure, 2 or 3
/// @throws hdf5::Error or std::invalid_argument if it is not there as it was written
Trajectory read_trajectory(hid_t file, int dimensions, std::uint64_t index);
/// A trajectory as a record of the journal: its index first, then every list with its length in front.
std::vector<std::byte> bytes_of(const Trajectory& trajectory);
/// @param dimensions of the structure, 2 or 3
/// @throws std::invalid_argument if the bytes are not those of a trajectory
Trajectory trajectory_of(int dimensions, std::span<const std::byte> bytes);

/// What a file has that holds counts instead of rows.
struct TallyFile {
    Tally tally;
    DoneSet done; ///< what is counted, by its place in the order of the run
};
void write_tally(hid_t file, const ResultHeader& header, const TallyFile& counted);
/// @throws hdf5::Error if something is missing, has another shape, or does not fit the rest
TallyFile read_tally(hid_t file, const ResultHeader& header);

/// The end of an unfinished results file: records of what has ended, one behind the other as it came. `io/FORMAT.md`
/// has their bytes.
///
/// A record is written as a whole and is there when its checksum is right, so that a process that is killed at any
/// moment loses nothing that was added; what it wrote of a last one is ignored, and removed when the run goes on:
/// behind a damaged record there may be whole ones, which would be found again behind new ones of the same size.
class RowJournal {
public:
    enum class Kind : std::uint32_t { row = 1, trajectory = 2 };
    struct Record {
        Kind kind = Kind::row;
        std::uint64_t offset = 0; ///< of its content in the file
        std::uint64_t size = 0;   ///< of its content [bytes]
    };

    static constexpr std::uint64_t head_bytes = 16; ///< in front of the content of a record

    RowJournal() = default;
    /// @param begin end of the rest of the file
    explicit RowJournal(std::uint64_t begin) : end_(begin) {}

    /// Goes through the records, from where the last one ended that is known. What comes behind the first one that is
    /// not whole is not there. @param f takes each and its content
    void read(const FileHandle& file, const std::function<void(const Record&, std::span<const std::byte>)>& f);
    /// What comes behind the last whole record, once all have been read.
    struct Rest {
        std::uint64_t bytes = 0;
        /// Whether it is more than the beginning of a record, which is what a process leaves that is killed.
        bool damaged = false;
    };
    /// @param row_bytes of the content of a row
    Rest rest(const FileHandle& file, std::uint64_t row_bytes) const;
    /// Writes a record, and now and then waits until the disk has what was written.
    /// @throws std::system_error if it cannot be written: what is there stays
    Record append(FileHandle& file, Kind kind, std::span<const std::byte> content);
    /// The content of a record again. @throws InputError if it is not there, or not as it was
    static std::vector<std::byte> content(const FileHandle& file, const Record& record);

private:
    std::uint64_t end_ = 0;
    bool cut_ = false; ///< whether nothing is behind `end_` any more
    std::vector<std::byte> buffer_;
    std::chrono::steady_clock::time_point due_ = std::chrono::steady_clock::now() + std::chrono::seconds(2);
};

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

/// Where a realization's row is: of a complete file its number, of an unfinished one the place of its record, which the
/// caller gives.
class RowNumbers {
public:
    RowNumbers() = default;
    RowNumbers(const ResultHeader& header, bool complete)
        : scattered_(header.selected || !header.shard.whole()), in_order_(complete && !header.selected),
          first_(header.first), rows_(header.total)
    {
    }
    /// Nothing for a realization that has no row.
    std::optional<std::uint64_t> of(std::uint64_t index) const;
    /// Where the rows do not lie in index order without a gap.
    /// @returns false if the realization has a row already @pre the file has room for it
    bool add(std::uint64_t index, std::uint64_t place);
    std::uint64_t added() const { return added_; }
    /// The places of all that were added, in index order.
    void for_each(const std::function<void(std::uint64_t place)>& f) const;

private:
    bool scattered_ = false; ///< only some of the study's realizations will ever have rows
    bool in_order_ = false;
    std::uint64_t first_ = 0;
    std::uint64_t rows_ = 0;
    std::uint64_t added_ = 0;
    std::vector<std::uint64_t> after_;                       ///< place + 1 by index - first, 0: none
    std::unordered_map<std::uint64_t, std::uint64_t> place_; ///< where few have rows, instead
};

/// An open results file, its seal verified.
struct ResultFile {
    std::filesystem::path path;
    FileHandle handle;
    hdf5::Handle hdf5;
    ResultHeader header;
    bool complete = false;
    ResultLayout layout;
    RowPlaces places;   ///< of a complete file
    RowJournal journal; ///< of an unfinished one

    /// The bytes of a chunk, or nothing if it is not written or its checksum is wrong.
    std::optional<std::vector<std::byte>> read_chunk(std::uint64_t chunk) const;
    /// Writes the rows first, their checksum last.
    void write_chunk(std::uint64_t chunk, std::span<const std::byte> bytes);
    /// A row that was written without others, or in a chunk. Refuses with "damaged" what no run writes.
    ResultRow decode(std::uint64_t k, std::span<const std::byte> bytes) const;
    /// Goes through the rows and trajectories of an unfinished file.
    void read_journal(const std::function<void(const ResultRow&, const RowJournal::Record&)>& row,
                      const std::function<void(const RowJournal::Record&, std::span<const std::byte>)>& trajectory);
    /// Refuses with "damaged" and the reason.
    [[noreturn]] void refuse_damaged(const std::string& text) const;
};

/// Opens and verifies all but the rows.
/// @param writable also takes the lock of the one writer
/// @throws InputError as `ResultReader` and `ResultWriter::resume`
ResultFile open_result(const std::filesystem::path& path, bool writable);

/// @throws InputError unless the file is of this study and version
void check_same_study(const ResultFile& file, const ResultHeader& asked);
/// @throws InputError besides if the file is complete
void check_unfinished(const ResultFile& file, const ResultHeader& asked);

} // namespace stylobate

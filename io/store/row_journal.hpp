#pragma once
/// The end of an unfinished results file: records of what has ended, one behind the other as it came. `io/FORMAT.md`
/// has their bytes.
///
/// A record is written as a whole and is there when its checksum is right, so that a process that is killed at any
/// moment loses nothing that was added; what it wrote of a last one is ignored, and removed when the run goes on:
/// behind a damaged record there may be whole ones, which would be found again behind new ones of the same size.

#include "io/files/file_handle.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace stylobate {

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

} // namespace stylobate

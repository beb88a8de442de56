#pragma once
/// An open file: bytes at a place, a lock, and renaming without overwriting.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace stylobate {

/// Owns a file descriptor. Reading never changes the file or its time of change.
class FileHandle {
public:
    FileHandle() = default;
    FileHandle(FileHandle&& other) noexcept;
    FileHandle& operator=(FileHandle&& other) noexcept;
    FileHandle(const FileHandle&) = delete;
    FileHandle& operator=(const FileHandle&) = delete;
    ~FileHandle();

    /// @throws InputError if there is no such file, if it is no regular file, or if it may not be opened so
    static FileHandle open(const std::filesystem::path& file, bool writable);
    /// Creates the file, or takes over one that a dead process left, and locks it.
    /// @throws InputError if the folder cannot be written or another process holds the file
    static FileHandle claim(const std::filesystem::path& file);

    std::uint64_t size() const;
    /// @throws InputError if the bytes are not all there
    void read(std::uint64_t offset, std::span<std::byte> bytes) const;
    /// @throws std::system_error, for example where the disk is full
    void write(std::uint64_t offset, std::span<const std::byte> bytes);
    void take_permissions(const FileHandle& other);
    /// Reserves the disk space of the whole file and of what will be appended, where the file system can.
    /// @throws InputError if the disk is full
    void reserve(std::uint64_t appended = 0);
    /// Waits until the disk has what was written.
    void sync();
    /// Truncates the file to a number of bytes.
    /// @throws std::system_error if the file cannot be written
    void cut(std::uint64_t size);

    /// One writer at a time, among processes and within one; given up when the handle closes.
    /// @returns false if another handle has the lock
    bool try_lock();
    /// True if the path still leads to this file.
    bool is_at(const std::filesystem::path& file) const;

    /// What was found in it is not to be used. @throws InputError, which names it
    [[noreturn]] void refuse_content(const std::string& why) const;

private:
    explicit FileHandle(int descriptor, std::filesystem::path path);
    int descriptor_ = -1;
    std::filesystem::path path_; ///< for messages
};

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

/// @throws InputError if there is a file of the new name; it is left alone
void rename_new(const std::filesystem::path& from, const std::filesystem::path& to);
/// Replaces the file of the new name in one step, and makes the folder remember it.
void rename_over(const std::filesystem::path& from, const std::filesystem::path& to);
/// Replaces the file of the new name in one step, where it is `ours`. Another one that has taken its place is left
/// alone, and the new file gets the name `to`.rescued.
/// @throws InputError that states this
void rename_over(const std::filesystem::path& from, const std::filesystem::path& to, const FileHandle& ours);

} // namespace stylobate

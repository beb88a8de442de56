#include "io/files/file_handle.hpp"

#include "ensemble/model/input_error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace stylobate {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& text)
{
    throw InputError(file.string(), 0, text);
}

std::string reason(int error)
{
    return std::generic_category().message(error);
}

std::filesystem::path folder_of(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// The folder's entry for a renamed file must survive the end of the machine too.
void sync_folder(const std::filesystem::path& file)
{
    const int folder = ::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
}

} // namespace

FileHandle::FileHandle(int descriptor, std::filesystem::path path) : descriptor_(descriptor), path_(std::move(path)) {}

FileHandle::FileHandle(FileHandle&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_))
{
}

FileHandle& FileHandle::operator=(FileHandle&& other) noexcept
{
    std::swap(descriptor_, other.descriptor_);
    std::swap(path_, other.path_);
    return *this;
}

FileHandle::~FileHandle()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

FileHandle FileHandle::open(const std::filesystem::path& file, bool writable)
{
    struct stat status = {};
    if (::stat(file.c_str(), &status) != 0)
        refuse(file, errno == ENOENT ? "there is no such file" : "cannot be read: " + reason(errno));
    if (S_ISDIR(status.st_mode))
        refuse(file, "is a folder; name a file");
    if (!S_ISREG(status.st_mode))
        refuse(file, "is not a regular file");
    const int descriptor = ::open(file.c_str(), (writable ? O_RDWR : O_RDONLY) | O_CLOEXEC);
    if (descriptor < 0)
        refuse(file, (writable ? "cannot be written: " : "cannot be read: ") + reason(errno));
    return FileHandle(descriptor, file);
}

FileHandle FileHandle::claim(const std::filesystem::path& file)
{
    const auto folder = folder_of(file);
    std::error_code error;
    const std::filesystem::file_status there = std::filesystem::status(folder, error);
    if (there.type() == std::filesystem::file_type::not_found)
        refuse(folder, "there is no such folder; create it first, or choose another output");
    if (there.type() == std::filesystem::file_type::none)
        refuse(folder, "cannot be written: " + error.message() + "; choose another output folder");
    if (!std::filesystem::is_directory(there))
        refuse(folder, "is not a folder; choose another output");
    for (int attempt = 0; attempt < 2; ++attempt) {
        const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno == EISDIR)
            refuse(file, "is a folder; name a file");
        if (descriptor < 0)
            refuse(file.has_parent_path() ? folder : std::filesystem::current_path(error), // "." names no folder
                   "cannot be written: " + reason(errno) + "; choose another output folder");
        FileHandle handle(descriptor, file);
        if (!handle.try_lock() || !handle.is_at(file))
            refuse(file, "another run is writing it; wait until it ends, or choose another output");
        struct stat status = {};
        if (::fstat(descriptor, &status) == 0 && status.st_nlink == 1)
            return handle;
        // killed between two names for one file: only this name may go, the other one's content must stay
        ::unlink(file.c_str());
    }
    refuse(file, "cannot be replaced; remove it, or choose another output");
}

std::uint64_t FileHandle::size() const
{
    struct stat status = {};
    if (::fstat(descriptor_, &status) != 0)
        refuse(path_, "cannot be read: " + reason(errno));
    return static_cast<std::uint64_t>(status.st_size);
}

void FileHandle::read(std::uint64_t offset, std::span<std::byte> bytes) const
{
    while (!bytes.empty()) {
        const ssize_t n = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            refuse(path_, "cannot be read: " + reason(errno));
        if (n == 0)
            refuse(path_, "is truncated");
        bytes = bytes.subspan(static_cast<std::size_t>(n));
        offset += static_cast<std::uint64_t>(n);
    }
}

void FileHandle::write(std::uint64_t offset, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            throw std::system_error(errno, std::generic_category(), path_.string() + ": cannot be written");
        bytes = bytes.subspan(static_cast<std::size_t>(n));
        offset += static_cast<std::uint64_t>(n);
    }
}

void FileHandle::take_permissions(const FileHandle& other)
{
    struct stat status = {};
    if (::fstat(other.descriptor_, &status) == 0)
        ::fchmod(descriptor_, status.st_mode & 07777);
}

void FileHandle::reserve(std::uint64_t appended)
{
    const auto bytes = static_cast<off_t>(size() + appended);
    if (bytes > 0 && ::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, 0, bytes) != 0 && errno == ENOSPC)
        refuse(path_, "needs " + std::to_string(bytes) +
                          " bytes, more than the free space of the disk; choose another output");
}

void FileHandle::sync()
{
    if (::fdatasync(descriptor_) != 0)
        throw std::system_error(errno, std::generic_category(), path_.string() + ": cannot be written");
}

void FileHandle::cut(std::uint64_t size)
{
    if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0)
        throw std::system_error(errno, std::generic_category(), path_.string() + ": cannot be written");
}

void FileHandle::refuse_content(const std::string& why) const
{
    refuse(path_, why);
}

bool FileHandle::try_lock()
{
#ifdef F_OFD_SETLK
    // It belongs to this open file, as flock's does, but leaves alone the locks of HDF5, which are flock's: other tools
    // may look into a file that is being written.
    struct flock lock = {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    if (::fcntl(descriptor_, F_OFD_SETLK, &lock) == 0)
        return true;
    if (errno == EAGAIN || errno == EACCES)
        return false;
#endif
    // A file system without locks can give no better protection than none.
    return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

bool FileHandle::is_at(const std::filesystem::path& file) const
{
    struct stat here = {};
    struct stat there = {};
    return ::fstat(descriptor_, &here) == 0 && ::stat(file.c_str(), &there) == 0 && here.st_dev == there.st_dev &&
           here.st_ino == there.st_ino;
}

void rename_new(const std::filesystem::path& from, const std::filesystem::path& to)
{
    int error = ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0 ? 0 : errno;
    if (error == EINVAL || error == ENOSYS) { // a file system that cannot: a second name, then the first one goes
        error = ::link(from.c_str(), to.c_str()) == 0 ? 0 : errno;
        if (error == 0)
            ::unlink(from.c_str());
    }
    if (error == EEXIST)
        refuse(to, "exists already; choose another output");
    if (error != 0)
        refuse(to, "cannot be written: " + reason(error));
    sync_folder(to);
}

void rename_over(const std::filesystem::path& from, const std::filesystem::path& to)
{
    if (::rename(from.c_str(), to.c_str()) != 0)
        throw std::system_error(errno, std::generic_category(), to.string() + ": cannot be written");
    sync_folder(to);
}

void rename_over(const std::filesystem::path& from, const std::filesystem::path& to, const FileHandle& ours)
{
    if (!std::filesystem::exists(to) || ours.is_at(to))
        return rename_over(from, to);
    const std::string rescued = to.string() + ".rescued";
    rename_over(from, rescued);
    refuse(to, "another file has taken the place of the results while they were written. It is left as it is; the "
               "results are in " +
                   rescued + ".");
}

} // namespace stylobate

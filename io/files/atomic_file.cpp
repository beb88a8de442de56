#include "io/files/atomic_file.hpp"

#include "ensemble/model/input_error.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

namespace stylobate {

namespace {

/// A hidden name beside it, whose last six letters mkostemp and mkdtemp replace.
std::string name_beside(const std::filesystem::path& path)
{
    return (path.parent_path() / ('.' + path.filename().string() + '.')).string() + std::string(6, 'X');
}

bool is_folder(const std::filesystem::path& file)
{
    std::error_code ignored;
    return file.filename().empty() || std::filesystem::is_directory(file, ignored);
}

} // namespace

void AtomicFile::check(const std::filesystem::path& file)
{
    if (is_folder(file))
        fail(file, EISDIR);
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code ignored;
    if (std::filesystem::exists(folder, ignored) && !std::filesystem::is_directory(folder, ignored))
        fail(file, ENOTDIR);
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        fail(file, errno);
}

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file))
{
    if (is_folder(file_))
        fail(file_, EISDIR);
    temporary_ = name_beside(file_);
    descriptor_ = ::mkostemp(temporary_.data(), O_CLOEXEC);
    if (descriptor_ < 0)
        fail(file_, errno);
}

AtomicFile::~AtomicFile()
{
    if (descriptor_ < 0)
        return;
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view content)
{
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor_, content.data(), content.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            fail(file_, errno);
        content.remove_prefix(static_cast<std::size_t>(written));
    }
}

void AtomicFile::commit()
{
    // mkostemp makes the file private; the user's umask decides who may read it.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    if (::fchmod(descriptor_, 0666 & ~mask) != 0 || ::fsync(descriptor_) != 0 ||
        ::rename(temporary_.c_str(), file_.c_str()) != 0)
        fail(file_, errno);
    ::close(descriptor_);
    descriptor_ = -1;
}

void AtomicFile::fail(const std::filesystem::path& file, int error)
{
    throw InputError(
        fmt::format("cannot write '{}': {}.\n  Name a file in a folder that exists, can be written and has "
                    "room; nothing was written.",
                    file.string(), why_not_written(file, error)));
}

std::string why_not_written(const std::filesystem::path& file, int error)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    const std::string reason = std::generic_category().message(error);
    if (error == EISDIR)
        return "it is a folder";
    fs::path folder = fs::absolute(file, ignored).lexically_normal().parent_path();
    const std::string shown = file.has_parent_path() ? file.parent_path().string() : folder.string();
    if (error == EACCES || error == EROFS || error == EPERM)
        return fmt::format("the folder '{}' cannot be written: {}", shown, reason);
    if (error != ENOENT && error != ENOTDIR)
        return reason;
    const bool missing = !fs::exists(folder, ignored);
    while (!fs::exists(folder, ignored) && folder.has_relative_path())
        folder = folder.parent_path();
    if (!fs::is_directory(folder, ignored))
        return fmt::format("'{}' is a file, not a folder", folder.string());
    return missing ? fmt::format("there is no such folder '{}'", shown) : reason;
}

void make_folder(const std::filesystem::path& folder)
{
    std::error_code error, ignored;
    std::filesystem::create_directory(folder, error);
    if (std::filesystem::is_directory(folder, ignored))
        return;
    throw InputError(fmt::format("cannot make the folder '{}': {}.\n  Name a folder whose parent exists and can be "
                                 "written; nothing was written.",
                                 folder.string(),
                                 error && error != std::errc::file_exists ? why_not_written(folder, error.value())
                                                                          : "it is a file"));
}

void write_whole(const std::filesystem::path& file, std::string_view content)
{
    AtomicFile out(file);
    out.write(content);
    out.commit();
}

namespace fs = std::filesystem;

AtomicFolder::AtomicFolder(fs::path folder) : folder_(std::move(folder))
{
    if (folder_.filename().empty()) // "name/"
        folder_ = folder_.parent_path();
    std::error_code ignored;
    if (fs::exists(folder_, ignored) && (!fs::is_directory(folder_, ignored) || !fs::is_empty(folder_, ignored)))
        fail(fs::is_directory(folder_, ignored) ? "it holds files already" : "it is a file");
    std::string name = name_beside(folder_);
    if (::mkdtemp(name.data()) == nullptr)
        fail(why_not_written(folder_, errno));
    temporary_ = name;
}

AtomicFolder::~AtomicFolder()
{
    std::error_code ignored;
    if (temporary_)
        fs::remove_all(*temporary_, ignored);
}

void AtomicFolder::write(const std::string& name, std::string_view content)
{
    std::ofstream file(*temporary_ / name, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file)
        fail(fmt::format("{}: {}", name, std::generic_category().message(errno)));
}

void AtomicFolder::commit()
{
    // mkdtemp makes the folder private; a new one has the permissions that the umask leaves
    std::error_code error;
    const fs::path like = *temporary_ / ".permissions";
    fs::create_directory(like, error);
    const fs::perms permissions = fs::status(like, error).permissions();
    fs::remove(like, error);
    fs::permissions(*temporary_, permissions, error);
    fs::rename(*temporary_, folder_, error); // takes the place of an empty folder
    if (error)
        fail(error.message());
    temporary_.reset();
}

void AtomicFolder::fail(const std::string& reason) const
{
    throw InputError(fmt::format("cannot write the folder '{}': {}.\n  Name a new folder, in one that exists, can be "
                                 "written and has room; nothing was written.",
                                 folder_.string(), reason));
}

TemporaryFolder::TemporaryFolder()
{
    std::error_code error;
    std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    if (const char* const named = std::getenv("TMPDIR"); error && named != nullptr)
        parent = named;
    std::string name = (parent / "stylobate-XXXXXX").string();
    if (error || ::mkdtemp(name.data()) == nullptr)
        throw InputError(fmt::format("cannot make a temporary folder in '{}': {}.\n  Set TMPDIR to a folder that "
                                     "exists and can be written.",
                                     parent.string(),
                                     error ? error.message() : std::generic_category().message(errno)));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace stylobate

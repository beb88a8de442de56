#pragma once
/// A file that appears whole or not at all.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace stylobate {

/// Written under another name beside its target, and renamed by `commit`. Without a commit nothing remains,
/// and a file that bore the name before stays as it was.
class AtomicFile {
public:
    /// @throws InputError if the folder is missing or cannot be written, or if `file` is a folder
    explicit AtomicFile(std::filesystem::path file);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Whether a file of that name could be made now, without making anything: for what takes long before it writes.
    /// @throws InputError as the constructor does
    static void check(const std::filesystem::path& file);

    /// Where it lies until then: for libraries that want to write the content themselves.
    const std::string& temporary() const { return temporary_; }
    /// @throws InputError if the content cannot be written (full disk)
    void write(std::string_view content);
    /// Makes the content safe on the disk and gives the file its name.
    /// @throws InputError if that fails
    void commit();

private:
    [[noreturn]] static void fail(const std::filesystem::path& file, int error);

    std::filesystem::path file_;
    std::string temporary_;
    int descriptor_ = -1;
};

/// Why a file or a folder cannot be made: which folder is missing, is a file, or may not be written (by its whole path
/// where it is the working folder), or else what the system reports.
std::string why_not_written(const std::filesystem::path& file, int error);

/// A folder for several files: it may be there. @throws InputError if it cannot be made
void make_folder(const std::filesystem::path& folder);

/// One text as a file, whole or not at all. @throws InputError as above
void write_whole(const std::filesystem::path& file, std::string_view content);

/// Filled under another name beside its target, and renamed by `commit`. Without a commit nothing remains.
class AtomicFolder {
public:
    /// @throws InputError if the folder above is missing or cannot be written, or if the target is a file or holds
    /// files
    explicit AtomicFolder(std::filesystem::path folder);
    ~AtomicFolder();
    AtomicFolder(const AtomicFolder&) = delete;
    AtomicFolder& operator=(const AtomicFolder&) = delete;

    /// @throws InputError if it cannot be written (full disk)
    void write(const std::string& name, std::string_view content);
    /// @throws InputError if the target holds files by now
    void commit();

private:
    [[noreturn]] void fail(const std::string& reason) const;

    std::filesystem::path folder_;
    std::optional<std::filesystem::path> temporary_; ///< where it is filled; nullopt once it is committed
};

// A folder for by-products.

/// A folder of its own that is removed with everything in it at the end of the scope.
class TemporaryFolder {
public:
    /// @throws InputError if none can be made
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path operator/(const char* name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace stylobate

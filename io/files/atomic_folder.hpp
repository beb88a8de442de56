#pragma once
/// A folder of many files that appears whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace stylobate {

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
    std::filesystem::path temporary_; ///< empty: committed
};

} // namespace stylobate

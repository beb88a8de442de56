#pragma once
/// A folder for by-products.

#include <filesystem>

namespace stylobate {

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

#pragma once
/// What measured data are known by.

#include <filesystem>
#include <string>

namespace stylobate {

/// "crc32 1a2b3c4d" of a file, or of a folder's files.
std::string fingerprint(const std::filesystem::path& path);

} // namespace stylobate

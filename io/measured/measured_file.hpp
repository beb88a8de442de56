#pragma once
/// Measured campaigns in files: HDF5, or a folder of CSV files with one TOML beside them. See FORMAT.md.

#include "ensemble/model/campaign.hpp"

#include <filesystem>
#include <string>

namespace stylobate {

/// Reads a campaign and checks it (`check_campaign`): what contradicts itself is refused, what is doubtful is in
/// `findings`. Any data set may be absent; whatever number type and unit it was written in, it is SI here.
///
/// @param path an HDF5 file, a folder with campaign.toml, or that TOML file
/// @throws InputError, naming file, run and data set
Campaign read_campaign(const std::filesystem::path& path);

/// "crc32 1a2b3c4d" of a file, or of a folder's files.
std::string fingerprint(const std::filesystem::path& path);

} // namespace stylobate

#pragma once
/// Measured campaigns in files: HDF5, or a folder of CSV files with one TOML beside them. See FORMAT.md.

#include "ensemble/model/campaign.hpp"

#include <filesystem>

namespace stylobate {

/// Reads a campaign and checks it (`measured_check.hpp`): what contradicts itself is refused, what is doubtful is in
/// `findings`. Any data set may be absent; whatever number type and unit it was written in, it is SI here.
///
/// @param path an HDF5 file, a folder with campaign.toml, or that TOML file
/// @throws InputError, naming file, run and data set
Campaign read_campaign(const std::filesystem::path& path);

/// Writes a campaign: as HDF5 where the name ends in .h5 or .hdf5, else as a new folder. Reading it again gives the
/// same bits. An HDF5 file of that name is replaced; either appears whole or not at all.
///
/// @throws InputError if it cannot be written, or if a folder is there already
void write_campaign(const Campaign& campaign, const std::filesystem::path& path);

} // namespace stylobate

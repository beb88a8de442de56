#pragma once
/// Measured campaigns written as files, in version 2 of the format: planned runs, and those of virtual laboratories.

#include "ensemble/model/campaign.hpp"

#include <filesystem>

namespace stylobate {

/// Writes a campaign: as HDF5 where the name ends in .h5 or .hdf5, else as a new folder. Reading it again gives the
/// same bits. An HDF5 file of that name is replaced; either appears whole or not at all.
///
/// @throws InputError if it cannot be written, or if a folder is there already
void write_campaign(const Campaign& campaign, const std::filesystem::path& path);

} // namespace stylobate

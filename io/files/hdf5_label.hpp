#pragma once
/// The type of an HDF5 file from its attributes, for readers that do not know the layout.

#include <filesystem>
#include <string>

namespace stylobate {

struct Hdf5Label {
    std::string format; ///< attribute `format` of the root: "stylobate-diagnosis"; empty: none, or not to be read
    std::string kind;   ///< attribute `kind`
};

/// A file that may be damaged is to be checked before, by its seal.
Hdf5Label hdf5_label(const std::filesystem::path& file);

} // namespace stylobate

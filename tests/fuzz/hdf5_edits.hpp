#pragma once
/// Changes of an HDF5 file by the library itself, so that what comes out is whole HDF5 with unexpected content. (Bytes
/// changed at random would test the library, and mostly its first refusal.)

#include "tests/fuzz/byte_source.hpp"

#include <filesystem>
#include <hdf5.h>
#include <string>
#include <vector>

namespace stylobate::fuzz {

/// What edits are of.
struct Hdf5Object {
    std::string path;
    bool dataset = false; ///< else a group
};

/// All of a file that is whole. Asking for them takes longer than an edit: once for each original.
std::vector<Hdf5Object> objects_in(const std::filesystem::path& path);

/// Up to `most` changes of a file: of a value, a type, a shape, an attribute or a name, of an object or an attribute
/// taken away or added. What the library cannot do is left out.
/// @returns false where the file could not be closed whole, or has become a large one
bool edit_hdf5_file(const std::filesystem::path& path, std::vector<Hdf5Object> objects, ByteSource& recipe,
                    std::size_t most);

} // namespace stylobate::fuzz

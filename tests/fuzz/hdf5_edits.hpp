#pragma once
/// Changes of an HDF5 file by the library itself, so that what comes out is whole HDF5 with unexpected content. (Bytes
/// changed at random would test the library, and mostly its first refusal.)

#include "tests/fuzz/byte_source.hpp"

#include <filesystem>
#include <hdf5.h>

namespace stylobate::fuzz {

/// One change: of a value, a type, a shape, an attribute or a name, of an object or an attribute taken away or added.
/// What the library cannot do is left out.
void edit_hdf5(hid_t file, ByteSource& recipe);

/// Up to `most` changes of a file. @returns false where it could not be closed whole, or has become a large one
bool edit_hdf5_file(const std::filesystem::path& path, ByteSource& recipe, std::size_t most);

} // namespace stylobate::fuzz

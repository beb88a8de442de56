#pragma once
/// The file of a diagnosis (HDF5). `io/FORMAT.md` describes it.

#include "studies/measured/diagnosis/findings/diagnosis.hpp"

#include <filesystem>

namespace stylobate {

/// Writes the file whole or not at all; one that is there is replaced.
/// @throws InputError if it cannot be written
void write_diagnosis(const Diagnosis& diagnosis, const std::filesystem::path& file);

/// @throws InputError if there is no such file, if it is none of stylobate's, if it is damaged, if it holds no
///         diagnosis, or if it is of another format version
Diagnosis read_diagnosis(const std::filesystem::path& file);

} // namespace stylobate

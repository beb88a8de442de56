#pragma once
/// The file of a diagnosis (HDF5). `io/FORMAT.md` describes it.

#include "studies/diagnosis/diagnosis.hpp"

#include <filesystem>

namespace stylobate {

/// Writes the file whole or not at all; one that is there is replaced.
/// @throws InputError if it cannot be written
void write_diagnosis(const Diagnosis& diagnosis, const std::filesystem::path& file);

/// True if it is a file of stylobate, undamaged, that holds a diagnosis.
/// @throws InputError if there is no such file, if it is none of stylobate's, or if it is damaged
bool is_diagnosis(const std::filesystem::path& file);

/// @throws InputError as above, if it holds none, or if it is of another format version
Diagnosis read_diagnosis(const std::filesystem::path& file);

} // namespace stylobate

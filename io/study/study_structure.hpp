#pragma once
/// The [structure] of a study file.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

namespace stylobate {

/// @throws InputError naming the key
StructureSpec read_structure(const KeyReader& keys);

} // namespace stylobate

#pragma once
/// The [excitation] of a study file.

#include "ensemble/study.hpp"
#include "io/key_reader.hpp"

namespace stylobate {

/// @param in_surface frequency and PGA come from the axes of [surface]
/// @throws InputError naming the key
ExcitationSpec read_excitation(const KeyReader& keys, bool in_surface);

} // namespace stylobate

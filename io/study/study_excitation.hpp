#pragma once
/// The [excitation] of a study file.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

#include <string>

namespace stylobate {

/// @param kind in a surface frequency and PGA come from its axes; in a fragility study the records and how strong they
///        are from [fragility]
/// @throws InputError naming the key
ExcitationSpec read_excitation(const KeyReader& keys, StudyKind kind);

/// The unit of a record, canonical; empty where the key is absent.
/// @param key whose words are units
std::string acceleration_unit(const KeyReader& keys, const TextKey& key);

/// Additional requirements of an excitation for the axes of a surface.
/// @param surface the table [surface]
void check_axes(const KeyReader& surface, const ExcitationSpec& excitation, const SurfaceSpec& axes);

} // namespace stylobate

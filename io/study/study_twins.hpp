#pragma once
/// The [twins] of a study file.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

namespace stylobate {

/// @param keys  the table [twins]
/// @param study all else of it
/// @throws InputError naming the key
TwinsSpec read_twins(const KeyReader& keys, const Study& study);

} // namespace stylobate

#pragma once
/// The [survival] of a study file.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

#include <filesystem>

namespace stylobate {

/// @param top    the whole file
/// @param study  all else of it
/// @param beside the study's folder: a hazard curve is looked for there, and then in the working folder
/// @throws InputError naming the key
SurvivalSpec read_survival(const KeyReader& top, const Study& study, const std::filesystem::path& beside);

} // namespace stylobate

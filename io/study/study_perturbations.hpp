#pragma once
/// The [perturbation] section of a study file.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

namespace stylobate {

/// Reads the section into the study's `perturbations` and `mechanism_perturbations`.
/// @param study with everything else filled in: it has the nominal values
/// @throws InputError for a key, word or number that is not allowed, for a quantity or mechanism that the study does
///         not use, and for a distribution that could leave the physical range or has next to nothing between `min` and
///         `max`
void read_perturbations(const KeyReader& section, Study& study);

} // namespace stylobate

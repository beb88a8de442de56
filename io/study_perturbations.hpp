#pragma once
/// The [perturbation] section of a study file.

#include "ensemble/study.hpp"
#include "io/key_reader.hpp"

#include <vector>

namespace stylobate {

/// Reads the section. @param study with everything but its perturbations filled in: it has the nominal values
/// @throws InputError for a key, word or number that is not allowed, for a quantity that the study does not use, and
/// for
///         a distribution that could leave the physical range or has next to nothing between `min` and `max`
std::vector<Perturbation> read_perturbations(const KeyReader& section, const Study& study);

} // namespace stylobate

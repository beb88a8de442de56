#pragma once
/// The [sensitivity] and [rare] sections of a study file.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// @param study with its perturbations
/// @throws InputError for a key, word or number that is not allowed, for a factor that is not perturbed or named twice,
///         and where `inner` does not fit what is left to draw
SensitivitySpec read_sensitivity(const KeyReader& keys, const Study& study);

/// @param study with its perturbations and its excitation
/// @throws InputError for a key or number that is not allowed, and where nothing is perturbed, or not everything by
///         numbers that a chain can move
RareSpec read_rare(const KeyReader& keys, const Study& study);

/// The perturbed quantities of a study by the names of its inputs, in their order.
std::vector<std::string> perturbed_names(const Study& study);

} // namespace stylobate

#pragma once
/// What the verbs that run a study say of one that can hardly be meant.

#include "studies/experiment/loaded_study.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// What is doubtful about a study, as sentences.
/// @throws InputError with the reason if it is too far from what can be meant
std::vector<std::string> warnings_of(const LoadedStudy& loaded, const std::string& file);

} // namespace stylobate

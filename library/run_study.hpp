#pragma once
/// A study run into a results file.

#include "ensemble/engine/executor.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <string>

namespace stylobate::api {

/// Runs what is left of a study into its file, which is made, or continued; one that is complete is left alone.
/// @param name of the study in messages
/// @throws stylobate::InputError before anything is written, for a realization that cannot be built; and if the file is
///         another study's, damaged, or cannot be written
void run_study(const stylobate::LoadedStudy& loaded, const stylobate::RunOptions& options, const std::string& results,
               const std::string& name, stylobate::Observer& observer);

} // namespace stylobate::api

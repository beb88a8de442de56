#pragma once
/// A check of a study, from what it refuses to its report and drawing.

#include "studies/check/check_report.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/workflow/workflow.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace stylobate {

struct CheckRequest {
    /// Realizations that are run twice, 16 to 10 million; 0: none. Not given: the usual number, where the kind of study
    /// allows it.
    std::optional<std::uint64_t> pilot{};
    double trial_seconds = 2;                       ///< of the trial, up to 3600; 0: none
    double law_seconds = 20;                        ///< of the pilot under other contact laws, up to 86400; 0: none
    std::optional<std::filesystem::path> drawing{}; ///< of the structure; none: it is not drawn
    bool force = false;                             ///< replace a drawing that is there
};

/// @param file of the study, for messages and texts
/// @returns nothing if the observer has asked to stop   @throws InputError for what a run refuses
std::optional<CheckReport> check_study(LoadedStudy loaded, const std::string& file, const CheckRequest& request,
                                       const Machine& machine, WorkObserver& observer);

} // namespace stylobate

#pragma once
/// A check of a study, from what it refuses to its report and drawing.

#include "studies/check/check_study.hpp"
#include "studies/workflow/workflow.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace stylobate {

struct CheckRequest {
    std::optional<std::uint64_t> pilot{};           ///< realizations that are run twice (`CheckPlan::pilot`)
    double trial_seconds = 2;                       ///< of the trial; 0: none
    double law_seconds = 20;                        ///< of the pilot under other contact laws; 0: none
    std::optional<std::filesystem::path> drawing{}; ///< of the structure; none: it is not drawn
    bool force = false;                             ///< replace a drawing that is there
};

/// @param file of the study, for messages and texts
/// @returns nothing if the observer has asked to stop   @throws InputError for what a run refuses
std::optional<CheckReport> check_study(LoadedStudy loaded, const std::string& file, const CheckRequest& request,
                                       const Machine& machine, WorkObserver& observer);

} // namespace stylobate

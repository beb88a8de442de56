#pragma once
/// A calibration of measured data, from their file to its results.

#include "studies/measured/calibration/calibration.hpp"
#include "studies/workflow/workflow.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct CalibrationRequest {
    std::string measured;                ///< a campaign, or a table of outcomes (CSV)
    std::optional<Study> start{};        ///< to begin from; none: the specimen's (`default_study`)
    std::string start_name = "study";    ///< for messages
    std::vector<std::string> settings{}; ///< of the start where none is given
    std::vector<std::string> fit{};      ///< "KEY" or "KEY=FROM:TO", beside the contact's or instead of them
    std::vector<std::string> hold{};     ///< keys of the contact that keep the study's value
    std::vector<std::string> forms{};    ///< contact forms, or "all"; none: the study's
    bool outcomes = false;               ///< use the outcomes (fell or stood) even where histories are available
    bool held_out = true;                ///< cross-validation over motions
    std::optional<std::filesystem::path> kept{}; ///< file of what was predicted, until it is complete
    std::function<void()> check_outputs{};       ///< called where nothing else is refused any more; may be empty
};

struct CalibrationEnd {
    Calibration found; ///< complete, unless the observer has asked to stop
    Study start;
    std::uint64_t planned = 0; ///< parameter sets, at most
};

/// Collective, of all ranks of the machine; rank 0 has the calibration. Progress is `counted`, in parameter sets.
/// @throws InputError if the data cannot be read or used, or if a key cannot be fitted
CalibrationEnd calibrate_measured(const CalibrationRequest& request, const Machine& machine, WorkObserver& observer);

/// Writes the results of a calibration, whole or not at all. @throws InputError if they cannot be written
void write_results(const CalibrationEnd& calibration, const std::filesystem::path& file);

} // namespace stylobate

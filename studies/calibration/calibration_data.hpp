#pragma once
/// What a calibration is given: a measured campaign, or a table of outcomes.

#include "studies/calibration/calibration.hpp"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace stylobate {

class CalibrationData {
public:
    /// @param file a table of outcomes if it ends in .csv and is no folder, else a campaign
    /// @throws InputError if it cannot be read
    explicit CalibrationData(std::filesystem::path file);

    /// The study to begin from where none is given: `default_study` of a campaign.
    /// @param settings "KEY=VALUE"
    /// @throws InputError for a setting that cannot be, and for a table, which does not describe the structure
    Study default_start(const std::vector<std::string>& settings) const;

    /// By which the data are known (`CalibrationOptions::kept_key`): the file, and the motions that a table names.
    std::string key() const;

    /// @throws InputError as `calibrate`
    Calibration calibrated(const Study& start, const CalibrationOptions& options, const RunOptions& run,
                           Observer& observer) const;

private:
    std::filesystem::path file_;
    std::variant<Campaign, OutcomeTable> measured_;
};

} // namespace stylobate

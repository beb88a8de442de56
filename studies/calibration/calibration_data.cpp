#include "studies/calibration/calibration_data.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_outcomes.hpp"
#include "io/study/study_file.hpp"
#include "studies/diagnosis/findings/fingerprint.hpp"

#include <set>
#include <system_error>
#include <utility>

namespace stylobate {

CalibrationData::CalibrationData(std::filesystem::path file) : file_(std::move(file))
{
    std::error_code ignored;
    if (file_.extension() == ".csv" && !std::filesystem::is_directory(file_, ignored))
        measured_ = read_outcomes(file_);
    else
        measured_ = read_campaign(file_);
}

Study CalibrationData::default_start(const std::vector<std::string>& settings) const
{
    const auto* campaign = std::get_if<Campaign>(&measured_);
    if (!campaign)
        throw InputError(file_.string(), 0,
                         "a table of outcomes does not describe the structure.\n  Give the structure, and the "
                         "parameters of the shaking that the table omits, by --study STUDY.toml.");
    return parse_study(default_study(*campaign).text, "the default start study of a calibration", settings);
}

std::string CalibrationData::key() const
{
    std::string key = fingerprint(file_);
    std::set<std::string> files;
    if (const auto* table = std::get_if<OutcomeTable>(&measured_))
        for (const MeasuredOutcome& row : table->rows)
            if (!row.motion_file.empty() && files.insert(row.motion_file).second)
                key += " " + fingerprint(file_.parent_path() / row.motion_file);
    return key;
}

Calibration CalibrationData::calibrated(const Study& start, const CalibrationOptions& options, const RunOptions& run,
                                        Observer& observer) const
{
    return std::visit([&](const auto& measured) { return calibrate(measured, start, options, run, observer); },
                      measured_);
}

} // namespace stylobate

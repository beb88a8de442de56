#pragma once
/// A calibration in words, as JSON, as the study that it leads to, and as a page.

#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <optional>
#include <string>

namespace stylobate {

/// The result of the page as a console shows it: what is determined, the parameters of each contact form with their
/// intervals, what is gained on held-out motions, and the notes.
std::string calibration_text(const Calibration& calibration);

/// What it took: "350 parameter sets, 2800 runs and 38150 windows simulated in 33 s".
std::string calibration_cost(const Calibration& calibration);

/// How far a calibration is: "scan: 48 of at most 350 parameter sets, at most 20 s left".
/// @param stage what is being done, as `CalibrationOptions::stage` is told
std::string calibration_progress(const std::string& stage, const Progress& progress);

/// All of it but the profiles and correlations, which are in the file.
Json calibration_json(const Calibration& calibration);

/// The study with the calibrated values of the best form, which `stylobate run` takes; comments at its beginning state
/// the values with their intervals. @param measured the file, for its name
std::string calibrated_text(const Calibration& calibration, const std::string& measured);

/// The same, and profiles, runs, windows in motion, cost, and how to make it again.
/// @param file for names
/// @param title of the page; nullopt: by what was measured
Document calibration_page(const StoredCalibration& calibration, const std::string& file,
                          const std::optional<std::string>& title = std::nullopt);

} // namespace stylobate

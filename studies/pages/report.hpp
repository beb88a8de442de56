#pragma once
/// The pages of `stylobate report`.

#include "io/store/result_store.hpp"
#include "studies/calibration/calibration_file.hpp"
#include "studies/diagnosis/findings/diagnosis.hpp"
#include "studies/pages/result_picture.hpp"
#include "studies/report/html.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// What was run and what became of it: summary, probabilities, pictures, order of falls, motions, energy, and how to do
/// it again. Where the pictures cannot be drawn the page says so.
/// @param rerun for realizations whose trajectories the file does not hold
/// @param file for names and messages
/// @param title of the page; empty: by the study or the file
/// @param warnings receives a line for each picture that could not be drawn
/// @pre the run is complete
HtmlPage result_page(const Rerun& rerun, const ResultReader& reader, const std::string& file, const std::string& title,
                     std::vector<std::string>& warnings);

/// The verdict first, then what it rests on.
/// @param file for names
/// @param title of the page; empty: by the specimen
HtmlPage diagnosis_page(const Diagnosis& diagnosis, const std::string& file, const std::string& title = "");

/// The parameters with their intervals, what is not determined and why, the contact forms, what it gains.
/// @param file for names
/// @param title of the page; empty: by what was measured
HtmlPage calibration_page(const StoredCalibration& calibration, const std::string& file, const std::string& title = "");

} // namespace stylobate

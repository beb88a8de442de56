#pragma once
/// A calibration as a page.

#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/report/html.hpp"

#include <string>

namespace stylobate {

/// The parameters with their intervals, what is not determined and why, the contact forms, what it gains.
/// @param file for names
/// @param title of the page; empty: by what was measured
HtmlPage calibration_page(const StoredCalibration& calibration, const std::string& file, const std::string& title = "");

} // namespace stylobate

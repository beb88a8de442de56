#pragma once
/// Windows in motion as a part of a page: measured blocks over simulated ones.

#include "studies/measured/windows/motion_stage.hpp"
#include "studies/measured/windows/window_motion.hpp"
#include "studies/report/html.hpp"

#include <string>

namespace stylobate {

/// Adds the player of the animations (windows.js), a picture of a moment of each window, and a table of their errors;
/// the latter two need no script.
/// @pre the motion has a window, and no fault
void add_motion(HtmlPage& page, const WindowMotions& motion);

/// Why there is none though windows were simulated. @param code_version that wrote the file
std::string no_motion_words(const std::string& file, const std::string& code_version);

// ---- A moment of each window side by side: what is printed, and seen where no scripts run.

/// Where the first model is farthest from what was measured, in the sizes with which the player (windows.js) begins.
Html motion_svg(const WindowMotions& motion, const MotionStage& stage);

} // namespace stylobate

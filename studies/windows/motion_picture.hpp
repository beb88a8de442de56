#pragma once
/// A moment of each window side by side: what is printed, and seen where no scripts run.

#include "studies/report/html.hpp"
#include "studies/windows/motion_stage.hpp"

namespace stylobate {

/// Where the first model is farthest from what was measured, in the sizes with which the player (windows.js) begins.
Html motion_svg(const WindowMotions& motion, const MotionStage& stage);

} // namespace stylobate

#pragma once
/// Where and how the baseline is off: the windows that it predicts worst, and the motion in them.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/prediction.hpp"
#include "studies/measured/windows/window_motions.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

struct WrongWindows {
    std::vector<WrongStretch> stretches; ///< worst first
    /// Measured and simulated x and rotation over each other, about the worst windows of the worst runs.
    std::vector<DiagnosisFigure> figures;
    std::vector<ChosenWindow> shown; ///< windows to be shown in motion
};

/// Errors of the baseline by more than noise and a lag of some milliseconds make.
/// @param most stretches; the rest is left out
/// @return empty where no window can be simulated, or the observer stopped it
WrongWindows wrong_windows(const Campaign& campaign, const Study& baseline, std::size_t most, const RunOptions& options,
                           SimulationCount& count, Observer& observer);

} // namespace stylobate

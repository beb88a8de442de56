#pragma once
/// The contacts of the baseline, and where and how it is off, from free windows of the simulation
/// (`window_comparison.hpp`): the model tracks the measured motion, and the contacts of each form are those that
/// predict best what is seen in windows that run free.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/prediction.hpp"
#include "studies/measured/windows/window_comparison.hpp"
#include "studies/measured/windows/window_motions.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

/// A contact model of the baseline that was tried.
struct WindowBaseline {
    std::string contacts; ///< in words
    Study study;
    double score = 0; ///< log score of all windows by its own scales [nats]
};

/// A study with causes in it, for a campaign that is corrected.
ModelVariant with_causes(const Study& study, const SpecimenStructure& built, std::vector<SizedCause> causes);

struct WindowEvidence {
    std::vector<WindowBaseline> baselines; ///< the best of each contact form, best first
    SimulationCount cost;
    std::string why_not; ///< where there are no windows
    bool complete = false;
};

/// @param start contacts to begin with
/// @param given causes that are in the model already
WindowEvidence window_evidence(const Campaign& campaign, const Study& start, const CampaignScales& scales,
                               const std::vector<SizedCause>& given, const RunOptions& options, Observer& observer);

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

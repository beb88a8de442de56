#pragma once
/// The contacts of the baseline, from free windows of the simulation (`window_comparison.hpp`): the model tracks the
/// measured motion, and the contacts of each form are those that predict best what is seen in windows that run free.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"
#include "studies/measured/windows/window_comparison.hpp"

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

} // namespace stylobate

#pragma once
/// What naming a cause is worth: predictions of runs that were not used to size it, with and without it.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/tracking/specimen.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/diagnosis/decision.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/window_evidence.hpp"
#include "studies/measured/windows/window_comparison.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// The campaign with the base motion as it must have been.
Campaign corrected(const Campaign& campaign, const DirectResult& direct);

/// Sizes of causes that act in the model; those that act on the base's horizontal motion are in its correction.
std::vector<SizedCause> model_causes(const std::vector<JudgedCause>& named);

/// Sum and number of the squared residuals of each run, winsorized.
struct RunErrors {
    std::vector<double> squares, counts;
    double rms() const; ///< of all runs; 0 without residuals
};

/// 95 % interval of the ratio after / before of the root mean squares, runs drawn anew; nothing where too few draws
/// have any error.
std::optional<std::pair<double, double>> interval_of_ratio(const RunErrors& before, const RunErrors& after,
                                                           std::uint64_t seed);

/// Every second motion is left out; the causes are sized by the others.
/// @return nothing where there are fewer than two motions, or the observer stopped it
std::optional<ModelGain> predictive_gain(const Campaign& campaign, const CampaignScales& scales, const Study& baseline,
                                         const std::vector<JudgedCause>& named, std::uint64_t seed,
                                         const RunOptions& options, SimulationCount& count, Observer& observer);

} // namespace stylobate

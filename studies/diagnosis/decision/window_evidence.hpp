#pragma once
/// Evidence of free windows of the simulation for each cause (`calibration_windows.hpp`): a cause is added to the
/// model, the model follows the measured motion, and what it predicts in windows that run free is compared with what
/// was seen, with and without the cause. Slow motions and short slips are seen here that the balance of forces does not
/// see; but the model's own contacts matter, so that each contact form judges by itself.

#include "ensemble/engine/executor.hpp"
#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "studies/calibration/calibration_windows.hpp"
#include "studies/diagnosis/laws/balance_fit.hpp"
#include "studies/diagnosis/laws/track.hpp"
#include "studies/diagnosis/tests/cause_model.hpp"

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

struct WindowEvidence {
    std::vector<WindowBaseline> baselines; ///< the best of each contact form, best first
    /// One for each mechanism and place, best first: what the two best contact forms both grant it.
    std::vector<CauseFit> causes;
    std::vector<std::vector<double>> gain_by_form; ///< (causes x 2) by each of these forms, in the order of `baselines`
    std::uint64_t simulations = 0, window_simulations = 0, block_steps = 0;
    std::string why_not; ///< where there are no windows
    bool complete = false;
};

/// Causes and sizes that windows are asked about.
struct TriedCause {
    Cause cause;
    std::vector<double> sizes;
};
std::vector<TriedCause> window_causes(const Specimen& specimen, const TrackScales& scales, double friction);

/// @param start contacts to begin with
/// @param given causes that are in the model already
/// @param judge_causes false: only the contacts of the baseline are looked for
WindowEvidence window_evidence(const Campaign& campaign, const Study& start, const TrackScales& scales,
                               const std::vector<SizedCause>& given, bool judge_causes, const RunOptions& options,
                               Observer& observer);

} // namespace stylobate

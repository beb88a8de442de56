#pragma once
/// What a campaign determines of the friction: one judgement, for the diagnosis and for the calibration.
///
/// A free window of the simulation may like a friction that the specimen does not have: where little slides, the
/// friction of the model stands in for whatever else its contact law gets wrong, and a tight interval means nothing. So
/// friction is judged by the balance of forces alone (`law_samples.hpp`): where a joint slides all through a smoothing
/// window, F_T = mu F_N by Coulomb's law, and no law of normal contact enters. Slides are few, and the windows of one
/// slide err together; so the interval comes from how the estimate changes when a slide is left out, not from the
/// number of windows:
///
///   sd^2 = sd_fit^2 + sd_slides^2,    interval = mu exp(+- k sd / mu)
///
/// with k = 1.96. How often they hold, in campaigns of two contact laws that the model does not have, is in
/// `docs/calibration.md`. Where the interval is wide, or rests on too few windows, the friction is not determined.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/law_samples.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace stylobate {

/// Friction of the joints, mean over them.
struct FrictionJudgement {
    bool determined = false;
    double value = std::numeric_limits<double>::quiet_NaN(); ///< NaN where no joint slides
    double low = 0; ///< 95 % interval; 0 and infinity where it is not determined
    double high = std::numeric_limits<double>::infinity();
    std::size_t windows = 0; ///< in which a joint slides all through
    std::size_t slides = 0;  ///< that these windows lie in
    std::size_t runs = 0;    ///< in which there are slides
    std::string note;        ///< what it rests on, or why it is not determined
    // the parts of the standard deviation, over the value
    double fit = 0;         ///< of the regression: noise of the cameras, scatter from joint to joint
    double leaving_out = 0; ///< jackknife over the slides
};

/// @param base_m (runs)(nt) the base displacement to be used (`DirectResult`); empty: not known
FrictionJudgement judge_friction(const Campaign& campaign, const CampaignScales& scales,
                                 const std::vector<std::vector<double>>& base_m);

/// Judges the friction after direct tests of base and sensors of its own. What cannot be judged (no rotations, cameras
/// too slow) is not determined.
FrictionJudgement judge_friction(const Campaign& campaign);

/// From the samples of all runs, which were written with `friction`.
FrictionJudgement judge_friction(const Specimen& specimen, const CampaignScales& scales,
                                 const std::vector<LawSample>& samples, double friction, int runs);

} // namespace stylobate

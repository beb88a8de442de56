#pragma once
/// What joints and blocks go through in the runs of a measured campaign.

#include "ensemble/model/campaign.hpp"
#include "studies/diagnosis/laws/track.hpp"
#include "studies/diagnosis/tests/cause_model.hpp"

#include <vector>

namespace stylobate {

/// In a run of a campaign: wear, drag and ties are in proportion to it.
struct JointPaths {
    JointPath mean;                ///< over the runs
    std::vector<JointPath> before; ///< (runs) in the runs before each, in the order in which they were shaken
    double speed_m_s = 0;          ///< sideways, of the blocks: 99 % quantile; drag goes with its square
    // of each block against the base, 99 % quantiles
    std::vector<double> reach_m;       ///< (blocks) sideways from its place
    std::vector<double> leaving_m_s;   ///< (blocks) sideways speed
    std::vector<double> turning_rad_s; ///< (blocks) rate of rotation
};

/// From the smoothed motion.
/// @param base_m (runs)(nt) displacement of the base at the cameras' samples
JointPaths joint_paths(const Campaign& campaign, const TrackScales& scales,
                       const std::vector<std::vector<double>>& base_m);

} // namespace stylobate

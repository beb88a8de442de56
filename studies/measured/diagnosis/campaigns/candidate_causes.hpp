#pragma once
/// The causes that labelled campaigns are simulated with: each mechanism at each place, with a range of sizes that are
/// of the same order for every specimen.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <vector>

namespace stylobate {

// ---- What joints and blocks go through in the runs of a measured campaign.

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
JointPaths joint_paths(const Campaign& campaign, const CampaignScales& scales,
                       const std::vector<std::vector<double>>& base_m);

/// A mechanism at a place. Its size is counted by z: 0 is neutral, 1 is strong.
struct CandidateCause {
    Cause cause;
    double at_one = 0;  ///< size at z = 1; of a ratio, the ratio there
    bool ratio = false; ///< the size is at_one^z, else at_one z
    double least = 0;   ///< z; below 0 only where the size has two signs
    double most = 1;    ///< z
    double size_of(double z) const;
};

/// @param friction of the joints   @param stiffness_n_m2 K_N of the joints: dashpots are in proportion to critical ones
std::vector<CandidateCause> candidate_causes(const Specimen& specimen, const CampaignScales& scales,
                                             const JointPaths& paths, double friction, double stiffness_n_m2);

} // namespace stylobate

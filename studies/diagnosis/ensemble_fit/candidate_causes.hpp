#pragma once
/// The causes that labelled campaigns are simulated with: each mechanism at each place, with a range of sizes that are
/// of the same order for every specimen.

#include "ensemble/model/campaign.hpp"
#include "studies/diagnosis/ensemble_fit/joint_paths.hpp"
#include "studies/diagnosis/laws/track.hpp"
#include "studies/diagnosis/tests/cause_model.hpp"

#include <vector>

namespace stylobate {

/// Of a centre of mass, over the block's width: the strongest that is simulated.
inline constexpr double largest_eccentricity = 0.08;

/// A mechanism at a place. Its size is counted by z: 0 is neutral, 1 is strong.
struct CandidateCause {
    Cause cause;
    double at_one = 0;  ///< size at z = 1; of a ratio, the ratio there
    bool ratio = false; ///< the size is at_one^z, else at_one z
    double least = 0;   ///< z; below 0 only where the size has two signs
    double most = 1;    ///< z
    double size_of(double z) const;
    /// @pre the size is one that `size_of` can give
    double z_of(double size) const;
};

/// @param friction of the joints   @param stiffness_n_m2 K_N of the joints: dashpots are in proportion to critical ones
std::vector<CandidateCause> candidate_causes(const Specimen& specimen, const TrackScales& scales,
                                             const JointPaths& paths, double friction, double stiffness_n_m2);

} // namespace stylobate

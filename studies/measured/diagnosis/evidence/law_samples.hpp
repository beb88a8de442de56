#pragma once
/// Samples of the laws of the joints, from the measured motion and Newton's law alone.
///
/// From the smoothed accelerations of the blocks follow the forces and moments that their joints carry: at every
/// instant 3 equations for each block (its inertia and weight) in 3 unknowns for each joint. A column has as many of
/// one as of the other; a colonnade has fewer equations. A joint that slides all through a smoothing window obeys
/// |F_T| = mu F_N, one that rocks has no moment about the corner on which it turns: each such law is one equation more.
/// Combinations of laws in which the unknowns cancel can be checked against the measurement: those are the samples.
///
///   value = sum over the laws of  weight x (the quantity that is 0 under the law, over the weight that its joint
///   carries at rest)
///         = coefficients . (m a - m g)            linear in what was measured
///
/// No contact stiffness and no damping enters, and no simulation: nothing here is chaotic, and the noise is known.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <vector>

namespace stylobate {

/// Joints that carry less than this part of their weight are about to open, or have just been hit.
inline constexpr double least_normal = 0.25;

enum class Law {
    sliding, ///< -sign F_T - mu F_N over the weight: 0
    rocking  ///< sign x moment about the corner, over weight x half width: 0
};

/// One law in a sample, with what its joint does there.
struct LawTerm {
    Law law = Law::sliding;
    int joint = 0;
    int sign = 0;            ///< of the slip of the upper block; of the upper block's rotation (1: on its left corner)
    double weight = 1;       ///< in the sample
    double normal = 0;       ///< F_N over the weight that the joint carries at rest
    double half_width_m = 0; ///< of the narrower face
    double rest_weight_n = 0;
    double slip_m_s = 0;     ///< velocity of the upper block against the lower one, where they touch
    double slip_m = 0;       ///< how far it has slipped since the run began
    double slip_path_m = 0;  ///< sum of |slip|
    double rotation_rad = 0; ///< relative
    double rotation_path_rad = 0;
    double recent_slip_m = 0; ///< slip path with a memory of one time scale
    double slip_before_m = 0; ///< slip path of the runs before
    double rotation_before_rad = 0;
};

struct LawSample {
    int run = 0; ///< index in the campaign
    double time_s = 0;
    double value = 0;
    double sd = 0; ///< of the cameras' noise
    std::vector<LawTerm> terms;
    std::vector<double> coefficients; ///< (3 n_block) of force x, force y, moment of each block: value per N, N m
    /// Motion of the blocks at the sample: [derivative 0 to 2].
    std::array<BlockValues, 3> motion;
};

/// What each joint has gone through.
struct JointPath {
    std::vector<double> slip_m;       ///< (joints)
    std::vector<double> rotation_rad; ///< (joints)
};

/// Samples of each run, far enough apart to be independent. Paths of earlier runs are counted in the order in which the
/// runs were shaken: what wears goes on from run to run.
///
/// @param base_m (runs)(nt) the base displacement to be used; an inner one empty: not known
/// @param friction that the sliding law is written with; what the true one differs by is left to be fitted
/// @return (runs)
std::vector<std::vector<LawSample>> law_samples(const Campaign& campaign, const CampaignScales& scales,
                                                const std::vector<std::vector<double>>& base_m, double friction);

/// Friction that the sliding law is written with: the nominal one, 0.7 where the specimen states none.
double nominal_friction(const Specimen& specimen);

/// Weight that each joint carries at rest [N]: of what stands on it, shared equally among a block's joints.
std::vector<double> rest_weights(const Specimen& specimen);

} // namespace stylobate

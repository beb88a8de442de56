#pragma once
/// One measured run at intervals of 0.04 sqrt(height / g): means over the samples of each interval, whose noise is
/// known, and how the joints move there.
///
/// A smoothing that follows every impact is not needed for path integrals, and costs a hundred times as much.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

struct CoarsePose {
    double x_m = 0, y_m = 0, theta_rad = 0;
    double sine = 0, cosine = 1; ///< of theta
};

struct CoarseRun {
    double spacing_s = 0;
    std::size_t bins = 0;
    std::size_t blocks = 0;
    std::vector<CoarsePose> poses; ///< (bins x n_block)
    std::vector<double> base_m;    ///< (bins) displacement of the base; empty: not known
    std::vector<char> usable;      ///< (bins) all blocks are seen, and none is falling
    double noise_m = 0;            ///< standard deviation of x and y of a bin
    double noise_rad = 0;          ///< of its rotations

    const CoarsePose& pose(std::size_t bin, std::size_t block) const { return poses[bin * blocks + block]; }
};

/// @param base_m (nt) displacement of the base at the samples; empty: not known
/// @return no bins where the blocks were not seen
CoarseRun coarse_run(const Specimen& specimen, const MeasuredRun& run, const CampaignScales& scales,
                     const std::vector<double>& base_m);

/// Where the faces of a joint touch, or would.
struct JointPose {
    double slip_m = 0;       ///< of the upper block along the face that is touched; at closed faces of their middles
    double rotation_rad = 0; ///< upper - lower
    double lift_m = 0;       ///< of the lower of the two corners above the face that it would touch
    double corner_x_m = 0;   ///< that corner, in the frame of the laboratory
    double corner_y_m = 0;
    bool on_upper = true; ///< it is a corner of the upper block
};

/// Sizes of a joint's blocks; the base as a block of half height 1 m and without ends where they are not known.
struct JointFaces {
    int lower = -1, upper = 0;
    double lower_half_width_m = 0, lower_half_height_m = 0;
    double upper_half_width_m = 0, upper_half_height_m = 0;
    double base_y_m = 0; ///< of the base as such a block
    double narrower_m() const;
};
JointFaces joint_faces(const Specimen& specimen, std::size_t joint);

/// @pre the bin is usable   @note without a base displacement the base is taken to stand still
JointPose joint_pose(const JointFaces& faces, const CoarseRun& run, std::size_t bin);

/// A joint all through a run.
struct JointSeries {
    bool has_slip = true;                             ///< false: on the base, whose displacement is not known
    std::vector<double> slip_m, rotation_rad, lift_m; ///< (bins); 0 where not usable
    double slip_noise_m = 0, rotation_noise_rad = 0, lift_noise_m = 0; ///< standard deviations of a bin
};
JointSeries joint_series(const JointFaces& faces, const CoarseRun& run);

} // namespace stylobate

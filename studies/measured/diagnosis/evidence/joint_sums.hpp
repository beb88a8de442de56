#pragma once
/// What one joint did in one run, as sums: those of several runs add up, and every statistic is a function of the sums.
///
/// A path grows with the noise of the cameras. What is summed is therefore not the size |x| of an increment but
///
///   f(x) = |x| - 1.784 sigma exp(-2 x^2 / sigma^2)
///
/// with sigma the standard deviation of its noise: of noise alone f has the mean 0, of an increment of 3 sigma and more
/// it has the increment's size, and between them at most 0.4 sigma less. Squares are reduced by their noise.
///
/// One measured run at intervals of 0.04 sqrt(height / g): means over the samples of each interval, whose noise is
/// known, and how the joints move there.
///
/// A smoothing that follows every impact is not needed for path integrals, and costs a hundred times as much.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <array>
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

/// Size of an increment, without the part that noise gives to it on average.
double noiseless_size(double increment, double noise_sd);

/// The rigid block that a joint carries: it turns on a corner, at the angle alpha from the vertical of its centre of
/// mass, with the frequency p of Housner (1963).
struct RigidRocking {
    double alpha_rad = 0;
    double p_rad_s = 0;
    /// How long it takes from an angle back to the same angle, going up to `most_rad`.
    double excursion_s(double from_rad, double most_rad) const;
};

/// @param above the blocks that the joint carries, as one
RigidRocking rigid_rocking(const Specimen& specimen, std::size_t joint, const std::vector<int>& above);

/// Classes of slip speed.
inline constexpr std::size_t slip_classes = 3;

struct JointSums {
    double runs = 0;
    double seen_s = 0;
    double slip_path_m = 0, first_path_m = 0, second_path_m = 0; ///< of the halves of what was seen
    double impact_path_m = 0; ///< part of the path within 0.1 time scales of a closure
    double path_noise_m = 0;  ///< standard deviation of the path by noise, of the runs' sum
    double net_slip_m = 0;    ///< signed, from the first to the last bin
    double slip_range_m = 0;
    double rotation_square = 0; ///< integral [rad2 s]
    double rotation_path_rad = 0;
    double rotation_path_noise_rad = 0; ///< as of the slip
    double hop_s = 0;                   ///< both corners above the face
    /// Of closures, by the class of speed: slow, fast. Squares of the rotation speeds [rad2/s2].
    std::array<double, 2> closures{}, before{}, after{};
    /// Of excursions, by the class of their height: number, sum of ln(duration / that of a rigid block).
    std::array<double, 2> excursions{}, log_duration{};
    /// By side: the block turns on its left corner, on its right one.
    std::array<double, 2> open_s{};
    /// Regression of the lift on |rotation|, by side: n, sum r, sum z, sum r2, sum r z.
    std::array<std::array<double, 5>, 2> turning{};
    double rotation_variance = 0; ///< of the rotations' noise, mean over the runs
    /// By class of slip speed: sums over slips of their length times -sign T, and times N, over the weight that the
    /// joint carries at rest [m]; length of these slips.
    std::array<double, slip_classes> tangential{}, normal{}, slipped{};

    JointSums& operator+=(const JointSums& other);
    void scale(double factor);
};

/// All but the work of friction.
/// @param open_rad beyond which the joint is open   @param time_s time scale of the specimen
JointSums joint_sums(const JointFaces& faces, const JointSeries& series, const CoarseRun& run,
                     const RigidRocking& rigid, double open_rad, double time_s);

} // namespace stylobate

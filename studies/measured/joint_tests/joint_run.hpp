#pragma once
/// A run of a test as its estimators see it: the body above the joint, what is below it, and the noise. Samples that
/// were not measured are NaN.

#include "studies/measured/joint_tests/procedures.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace stylobate {

struct JointRun {
    const MeasuredRun* run = nullptr;
    TestedBody body;
    double weight_n = 0;
    double half_width_m = 0;       ///< of the block above the joint
    std::size_t samples = 0;       ///< that may be used: up to a collapse
    std::vector<double> base_m;    ///< (nt) displacement of the table
    std::vector<double> x_m, y_m;  ///< (nt) of the block above the joint
    std::vector<double> theta_rad; ///< (nt)
    std::vector<double> below_m;   ///< (nt) x of what is below: a block, the table as seen, or its displacement
    std::vector<double> below_rad; ///< (nt) its rotation, 0 where that was not seen
    double x_sd = 0, y_sd = 0, theta_sd = 0;
    double below_sd = 0, below_rad_sd = 0;
    double offset_m = 0;    ///< of the body from its planned place on what is below, in the first samples
    double offset_sd_m = 0; ///< the tolerance of placement where it was not seen

    double time(std::size_t i) const { return run->time_s[i]; }
    double step_s() const { return 1 / run->rate_hz; }
    /// Of the body against what is below, from the first samples [m].
    double slip(std::size_t i) const { return x_m[i] - below_m[i] - slip_zero_m; }
    double slip_sd() const;
    /// Rotation against what is below [rad].
    double turn(std::size_t i) const { return theta_rad[i] - below_rad[i] - turn_zero_rad; }
    double turn_sd() const;
    /// What a face of the body's width would bear on, left and right of the body's middle, as it stands [m].
    std::pair<double, double> bearing_m(const Specimen& specimen) const;

    double slip_zero_m = 0;   ///< mean of the first samples
    double turn_zero_rad = 0; ///< likewise
};

/// Nothing where the run has no such joint, no clock, or the body was not seen; or where it collapsed at an unknown
/// time and `may_fall` is false.
std::optional<JointRun> joint_run(const Specimen& specimen, const MeasuredRun& run, bool may_fall);

/// The standard deviation of white noise on a smooth series, by the median of its second differences; 0: too few
/// values.
double noise_of(std::span<const double> values);

/// Where a series turns round: indices of its extremes, each at least `least` away from the one before.
std::vector<std::size_t> turning_points(std::span<const double> values, double least);

/// Mean and its number of the finite values of [from, to).
std::pair<double, int> finite_mean(std::span<const double> values, std::size_t from, std::size_t to);

/// A straight line by least squares, value = at_zero + slope x.
struct LineFit {
    double at_zero = 0, slope = 0;
    double at_zero_sd = 0, slope_sd = 0; ///< for values of standard deviation 1
    int count = 0;                       ///< of points with weight
};

/// @param weights empty: all 1. Pairs that are not finite are left out.
LineFit line_fit(std::span<const double> x, std::span<const double> values, std::span<const double> weights = {});

} // namespace stylobate

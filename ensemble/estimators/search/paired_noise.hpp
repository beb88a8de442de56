#pragma once
/// Means at points that have their realizations in common, and the covariance of their errors.

#include <cstddef>
#include <vector>

namespace stylobate {

/// What was found at m points. A mean lies between 0 and `most`: 1 for a probability.
struct PairedNoise {
    std::vector<double> share;      ///< (m)
    std::vector<double> covariance; ///< (m x m)
    double most = 1;
    double half = 0;             ///< variance of half a count: 0.5 (most / realizations)^2
    double groups = 0;           ///< how many groups of one size would be as uneven: (sum n)^2 / sum n^2
    std::vector<double> freedom; ///< (m) of the variance; infinite of single realizations, whose outcome is 0 or 1
};

/// From sums by group: a realization, or the realizations of one motion; within strata (cells), whose means are no
/// error.
/// @param reached (groups x m) how many of a group's realizations reached the limit state at each point, or the sum
///                over a group of any other number between 0 and `most`
/// @param size    (groups) realizations of each   @param stratum (groups)
/// Half a count is added to each variance, so that a share of 0 or 1 has an error too. The degrees of freedom of groups
/// are (sum y)^2 / sum y^2 - 1, since a group that the state is not reached in carries no information on the scatter
/// (as of `share_frequency`).
PairedNoise paired_noise(const std::vector<double>& reached, const std::vector<double>& size,
                         const std::vector<std::size_t>& stratum, std::size_t points, double most = 1);

/// The noise with variances and correlations that do not follow the accidents of the sample: a share that is low by
/// chance has a small estimated variance too, and would draw the surface down, and of few groups the estimated
/// covariance is singular where there are many points.
///
///   v_i is replaced by r_i mu_i (most - mu_i),   r_i = v_i / (y_i (most - y_i)),
///
/// with the surface's mu_i instead of the share y_i; then r and the correlations are drawn to their means, with the
/// weight of nu = 3 m groups beside the ones that there are (the mean of an inverse Wishart prior with nu degrees of
/// freedom; nu is an own choice, by the coverage of searches under 20 motions).
/// @param mean (m) of the surface
PairedNoise smoothed_noise(const PairedNoise& noise, const std::vector<double>& mean);

} // namespace stylobate

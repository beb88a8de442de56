#pragma once
/// A mean (a probability, a frequency) as a function of one to three numbers, from points that share their random
/// numbers.
///
/// At m points x_i of the unit cube, y_i is the mean over the same realizations. Then
///
///   y = p(x) + e,   e ~ N(0, S),   p ~ GP(mean, s2 k(x, x')),   k: Matern 5/2 with a length for each number
///
/// S is the covariance of the means over the realizations (`smoothed_noise`): common realizations make the errors of
/// neighbouring points nearly equal, and these errors then cancel in differences, which decide where p is smallest.
/// This is stochastic kriging with common random numbers: Ankenman, Nelson & Staum, "Stochastic kriging for simulation
/// metamodeling", Operations Research 58 (2010) 371; Chen, Ankenman & Nelson, "The effects of common random numbers on
/// stochastic kriging metamodels", ACM Transactions on Modeling and Computer Simulation 22 (2012) 7. The mean has a
/// flat prior; s and the lengths are averaged over a grid with the weights of their marginal likelihood, so that few
/// points do not look more certain than they are (own choice).

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace stylobate {

// Means at points that have their realizations in common, and the covariance of their errors.

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

/// A place in the unit cube.
using SearchPlace = std::vector<double>;

/// The first points: the middle and both ends of one number, else a low-discrepancy sequence (Roberts' generalised
/// golden ratio).
std::vector<SearchPlace> first_places(std::size_t dimensions);
/// All places that are looked at: 201, 41 x 41 or 17 x 17 x 17.
std::vector<SearchPlace> candidate_places(std::size_t dimensions);

class ResponseSurface {
public:
    /// @pre at least two points, of one size
    ResponseSurface(std::vector<SearchPlace> points, PairedNoise noise);

    const std::vector<SearchPlace>& points() const { return points_; }
    const PairedNoise& noise() const { return noise_; }

    struct Value {
        double mean = 0, sd = 0;
    };
    std::vector<Value> values(const std::vector<SearchPlace>& places) const;
    Value at(const SearchPlace& place) const;
    /// p(place) - p(from) of each place.
    std::vector<Value> differences(const std::vector<SearchPlace>& places, const SearchPlace& from) const;
    /// p(a) - p(b).
    Value difference(const SearchPlace& a, const SearchPlace& b) const;

    /// Draws of p at all the places jointly, of all the models by their weights.
    /// @returns (number x places)
    std::vector<std::vector<double>> draws(const std::vector<SearchPlace>& places, std::size_t number,
                                           std::uint64_t seed) const;

private:
    struct Model;
    void fit(const PairedNoise& noise);
    /// Of p, or of its difference from a place.
    std::vector<Value> mixture(const std::vector<SearchPlace>& places, const SearchPlace* from) const;

    std::vector<SearchPlace> points_;
    PairedNoise noise_;
    std::shared_ptr<const std::vector<Model>> models_;
};

} // namespace stylobate

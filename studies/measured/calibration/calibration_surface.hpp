#pragma once
/// A parabola through many noisy scores: where they are largest, and how well that is known.
///
/// The score of a rocking structure is rough: from one parameter set to the next an impact goes the other way, and the
/// score jumps. A search that follows its slope stalls; so points are spread about the best ones, and a quadratic form
/// is fitted to all of them by least squares. The same is fitted to the part of each unit (a window, a run): the
/// scatter of its slopes at the best point between units gives the uncertainty of that point, the roughness included:
///
///   cov = H^-1 J H^-1,   H = - curvature of the sum,   J = sum over units of slope slope^T
///
/// (the sandwich of Huber, 1967; as the units of one run are not independent, the larger of the two J is taken, of
/// windows and of runs). Directions in which the scores are flat are held by a weak prior: they have its deviation.

#include <cstddef>
#include <vector>

namespace stylobate {

/// In the unit cube of the parameters.
using UnitPoint = std::vector<double>;

struct ScoredPoint {
    UnitPoint at;
    std::vector<double> scores; ///< (units) [nats]
};

/// Deviation of the prior, in the range of a parameter: that of a uniform distribution over it.
inline constexpr double prior_deviation = 0.2887;

struct ScoreSurface {
    UnitPoint best;                     ///< largest value of the quadratic form among the points that it is fitted to
    double largest = 0;                 ///< its value there
    double roughness = 0;               ///< deviation of the sum of scores from the form near the best point
    std::vector<double> deviation;      ///< (d) from `cov`
    std::vector<double> reach;          ///< (d) half the range of the points
    std::vector<double> correlation;    ///< (d x d) of `cov`
    std::vector<double> along;          ///< (d x d) row i: how the others move with parameter i along its profile
    std::vector<double> overdispersion; ///< (d) variance over that of the curvature alone
    bool fitted = false;                ///< false: fewer points than coefficients
};

/// @param points  all with as many units
/// @param group   (units) of which run, or motion, each is
/// @param use     (units) whether it counts; empty: all
ScoreSurface fit_surface(const std::vector<ScoredPoint>& points, const std::vector<std::size_t>& group,
                         const std::vector<bool>& use = {});

/// Points of Halton's sequence from number `first` on: evenly spread over the cube. @pre at most 12 dimensions
std::vector<UnitPoint> spread_points(std::size_t dimensions, std::size_t count, std::size_t first);

/// Normally distributed points about `centre` from the same sequence, reflected into the cube.
/// @param deviation, correlation as in `ScoreSurface`
std::vector<UnitPoint> points_about(const UnitPoint& centre, const std::vector<double>& deviation,
                                    const std::vector<double>& correlation, std::size_t count, std::size_t first);

} // namespace stylobate

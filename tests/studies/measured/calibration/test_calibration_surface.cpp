/// The quadratic form of the scores and the points of the search by hand.

#include "studies/measured/calibration/calibration_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace stylobate {
namespace {

/// Scores -5, 7, 4, -4, -7, 5 (times 0.001) at six equal steps are orthogonal to all parabolas: the form is 0, and what
/// is left has the mean square 180 / (6 - 3). So small scores all have the weight 1.
TEST(CalibrationSurface, RoughnessIsOverTheDegreesOfFreedom)
{
    const std::vector<double> cubic = {-5, 7, 4, -4, -7, 5};
    std::vector<ScoredPoint> points;
    for (std::size_t i = 0; i < cubic.size(); ++i)
        points.push_back({{0.2 + 0.1 * static_cast<double>(i)}, {0.001 * cubic[i]}});
    const ScoreSurface surface = fit_surface(points, {0});
    ASSERT_TRUE(surface.fitted);
    EXPECT_NEAR(surface.roughness, 0.001 * std::sqrt(60.0), 1e-7);
    EXPECT_NEAR(surface.largest, 0, 1e-7);
    EXPECT_NEAR(surface.reach[0], 0.25, 1e-12); // half of 0.2 to 0.7
}

/// The radical inverse of 1, 2, 3, 4 in bases 2 and 3.
TEST(CalibrationSurface, PointsOfTheScanByHand)
{
    const std::vector<UnitPoint> points = spread_points(2, 4, 0);
    const double want[][2] = {{1.0 / 2, 1.0 / 3}, {1.0 / 4, 2.0 / 3}, {3.0 / 4, 1.0 / 9}, {1.0 / 8, 4.0 / 9}};
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k)
            EXPECT_NEAR(points[i][k], want[i][k], 1e-15) << i;
}

} // namespace
} // namespace stylobate

/// Faces in plan: distances, and areas in common, against a fine grid and by hand.

#include "ensemble/model/plan_face.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace stylobate::test_plan_face {
namespace {

constexpr double pi = std::numbers::pi;

/// The area in common, from the middles of small squares.
double counted_area(const PlanFace& a, const PlanFace& b)
{
    constexpr int n = 600;
    const double left = a.x_m - a.half_x_m, back = a.z_m - a.half_z_m;
    const double dx = 2 * a.half_x_m / n, dz = 2 * a.half_z_m / n;
    int inside = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = left + (i + 0.5) * dx, z = back + (k + 0.5) * dz;
            inside += outside_m(a, x, z) < 0 && outside_m(b, x, z) < 0;
        }
    return inside * dx * dz;
}

TEST(PlanFace, AreasInCommonAreThoseOfAGrid)
{
    const PlanFace disc{true, 0.1, -0.2, 0.5, 0.5};
    const std::vector<PlanFace> others = {
        {true, 0.4, 0.3, 0.6, 0.6},     {true, 0.1, -0.2, 0.2, 0.2},   {false, 0.1, -0.2, 2, 2},
        {false, 0.5, 0, 0.4, 0.3},      {false, 0.6, -0.2, 0.5, 2},    {false, -0.3, 0.3, 0.3, 0.4},
        {false, 0.1, -0.2, 0.05, 1},    {false, 0.1, 0.28, 1, 0.1},    {true, 0.1, -0.2, 0.5, 0.5},
        {false, 0.05, -0.15, 0.3, 0.2}, {false, 0.42, 0.12, 0.2, 0.2},
    };
    for (const PlanFace& other : others) {
        EXPECT_NEAR(common_area_m2(disc, other), counted_area(disc, other), 1e-3) << other.x_m << " " << other.half_x_m;
        EXPECT_NEAR(common_area_m2(other, disc), common_area_m2(disc, other), 1e-15);
    }
    const PlanFace rectangle{false, 0, 0, 1, 2};
    EXPECT_DOUBLE_EQ(common_area_m2(rectangle, {false, 1.5, 1, 1, 2}), 0.5 * 3);
    EXPECT_EQ(common_area_m2(rectangle, {false, 2.5, 0, 1, 1}), 0);
    EXPECT_EQ(common_area_m2(disc, {true, 1.2, -0.2, 0.5, 0.5}), 0);
    // a quarter of a disc, to rounding
    EXPECT_NEAR(common_area_m2({true, 0, 0, 1, 1}, {false, 2, 2, 2, 2}), pi / 4, 1e-15);
}

TEST(PlanFace, GapsByHand)
{
    const PlanFace disc{true, 0, 0, 1, 1}, box{false, 4, 0, 1, 2};
    EXPECT_DOUBLE_EQ(gap_m(disc, {true, 3, 4, 2, 2}), 2);
    EXPECT_DOUBLE_EQ(gap_m(disc, {true, 1, 0, 2, 2}), -2);
    EXPECT_DOUBLE_EQ(gap_m(disc, box), 2);
    EXPECT_DOUBLE_EQ(gap_m(box, disc), 2);
    EXPECT_DOUBLE_EQ(gap_m(disc, {false, 4, 6, 1, 2}), 4); // its corner is at (3, 4)
    EXPECT_DOUBLE_EQ(gap_m(box, {false, 4, 5, 3, 2}), 1);
    EXPECT_DOUBLE_EQ(gap_m(box, {false, 5, 1, 1, 2}), -1);
}

} // namespace
} // namespace stylobate::test_plan_face

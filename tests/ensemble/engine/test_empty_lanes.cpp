/// Empty lanes must not slow the realizations beside them.

#include "ensemble/engine/lanes.hpp"
#include "kernels/mechanisms/points.hpp"
#include "kernels/mechanisms/two_corner.hpp"
#include "kernels/overlap.hpp"
#include "kernels/scratch.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

TEST(EmptyLanes, NeedNoGeneralOverlapInAnyContactForm)
{
    constexpr double b = LaneSet::empty_half_width, limit = LaneSet::empty_depth_limit;
    const Placement<double> at_rest{0, 0, 0, 1}; // all of an empty lane is 0
    bool fits = false;
    EXPECT_LT(stacked_overlap(at_rest, b, b, limit, fits).area, 0.1 * detail::least_area); // below it nothing touches
    EXPECT_TRUE(fits);
    FormPoints<double, 2> corners;
    EXPECT_EQ(two_corner_overlap(at_rest, b, b, limit, corners, fits).area, 0);
    EXPECT_TRUE(fits);
    FormPoints<double, 5> points;
    EXPECT_EQ(points_overlap(at_rest, b, b, limit, 0.0, points, fits).area, 0);
    EXPECT_TRUE(fits);
    // blocks of no size do
    stacked_overlap(at_rest, 0.0, 0.0, 0.0, fits);
    EXPECT_FALSE(fits);
}

} // namespace
} // namespace stylobate

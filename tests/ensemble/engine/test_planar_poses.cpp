// The channels of a trajectory, and where a block lies: by hand.

#include "ensemble/model/fields.hpp"
#include "ensemble/planar/planar_poses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace stylobate {
namespace {

/// Two blocks at three times. Each value is 100 (number of its list) + 10 (time) + block.
Trajectory numbered()
{
    Trajectory t(planar_channels);
    t.time_s = {0, 1, 2};
    t.role = {BlockRole::drum, BlockRole::epistyle};
    t.column = {0, -1};
    t.name = {"drum 1", "epistyle"};
    for (std::size_t c = 0; c < t.channels.size(); ++c)
        for (int k = 0; k < (t.channels[c].of == ListOf::blocks ? 1 : 3); ++k)
            for (int i = 0; i < (t.channels[c].of == ListOf::times ? 1 : 2); ++i)
                t.lists[c].push_back(100 * static_cast<double>(c) + 10 * k + i);
    return t;
}

TEST(PlanarPoses, ChannelsAreNamedWithTheirUnits)
{
    std::string text;
    const Trajectory t(planar_channels);
    visit_lists(t, [&](const TrajectoryChannel& channel, const std::vector<double>& list) {
        EXPECT_TRUE(list.empty());
        text += std::string(channel.name) + " [" + std::string(unit_of(channel.name)) + "] " +
                (channel.of == ListOf::times    ? "times"
                 : channel.of == ListOf::blocks ? "blocks"
                                                : "poses") +
                '\n';
    });
    EXPECT_EQ(text, "time_s [s] times\nx_m [m] poses\ny_m [m] poses\ntheta_rad [rad] poses\nbase_x_m [m] times\n"
                    "rest_x_m [m] blocks\nrest_y_m [m] blocks\nhalf_width_m [m] blocks\nhalf_height_m [m] blocks\n");
}

TEST(PlanarPoses, SnapshotHasTheChannelsOfPosesInTheirOrder)
{
    const Snapshot s{{1, 2}, {3, 4}, {5, 6}};
    EXPECT_EQ(s.pose(0), s.x_m);
    EXPECT_EQ(s.pose(1), s.y_m);
    EXPECT_EQ(s.pose(2), s.theta_rad);
}

TEST(PlanarPoses, ListsAreFoundByName)
{
    Trajectory t = numbered();
    EXPECT_EQ(t["time_s"], (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(t["y_m"], (std::vector<double>{100, 101, 110, 111, 120, 121}));
    EXPECT_EQ(t["base_x_m"], (std::vector<double>{300, 310, 320}));
    EXPECT_EQ(t["half_width_m"], (std::vector<double>{600, 601}));
    t["y_m"].back() = 7;
    EXPECT_EQ(t.lists[1].back(), 7);
    EXPECT_THROW(t["z_m"], std::out_of_range);
    EXPECT_THROW(Trajectory()["x_m"], std::out_of_range);
}

TEST(PlanarPoses, ListsFitOnlyWhereEachHasAllItsValues)
{
    EXPECT_TRUE(lists_fit(numbered()));
    EXPECT_TRUE(lists_fit(Trajectory(planar_channels)));
    for (std::size_t c = 0; c < planar_channels.size(); ++c) {
        Trajectory t = numbered();
        t.lists[c].pop_back();
        EXPECT_FALSE(lists_fit(t)) << planar_channels[c].name;
    }
    Trajectory t = numbered();
    t.time_s.push_back(3);
    EXPECT_FALSE(lists_fit(t));
    t = numbered();
    t.name.pop_back();
    EXPECT_FALSE(lists_fit(t));
    t = numbered();
    t.column.push_back(0);
    EXPECT_FALSE(lists_fit(t));
}

TEST(PlanarPoses, RectangleOfABlockAtASample)
{
    EXPECT_EQ(rectangle_of(numbered(), 2, 1), (Rectangle{21, 121, 221, 601, 701}));
}

TEST(PlanarPoses, CornersAreCounterClockwiseFromTheLowerLeft)
{
    const auto expect = [](const Rectangle& r, const double(&want)[4][2]) {
        const auto corners = r.corners();
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(corners[i].x, want[i][0], 1e-14) << i;
            EXPECT_NEAR(corners[i].y, want[i][1], 1e-14) << i;
        }
    };
    expect({3, 4, 0, 2, 1}, {{1, 3}, {5, 3}, {5, 5}, {1, 5}});
    expect({3, 4, std::numbers::pi / 2, 2, 1}, {{4, 2}, {4, 6}, {2, 6}, {2, 2}});
    // turned by the angle of the triangle of sides 3, 4, 5: cos 0.8, sin 0.6
    expect({0, 0, std::atan2(3, 4), 1, 0.5}, {{-0.5, -1}, {1.1, 0.2}, {0.5, 1}, {-1.1, -0.2}});
    EXPECT_EQ((Rectangle{0, 0, 0, 3, 4}.reach()), 5);
    EXPECT_TRUE((Rectangle{1, 2, 3, 4, 5}.is_finite()));
    EXPECT_FALSE((Rectangle{1, 2, std::nan(""), 4, 5}.is_finite()));
}

} // namespace
} // namespace stylobate

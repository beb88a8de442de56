/// Rods, tendons and clamps as lines among moving blocks.

#include "ensemble/planar/fastening.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stylobate {
namespace {

MechanismSpec spec_of(Mechanism mechanism, std::vector<int> places, std::initializer_list<double> values)
{
    MechanismSpec spec = neutral_spec(mechanism, 0.6);
    spec.places = std::move(places);
    std::copy(values.begin(), values.end(), spec.values.begin());
    return spec;
}

/// Three drums of 2 m x 1 m, the lowest one fixed.
Layout drums()
{
    return lay_out(equal_column(3, 1, 2, 1, 1, 1000));
}

std::vector<Rectangle> at_rest(const Layout& layout)
{
    std::vector<Rectangle> blocks;
    for (const PlacedBlock& block : layout.blocks)
        blocks.push_back({block.x_m(), block.y_m, 0, block.width_m / 2, block.height_m / 2});
    return blocks;
}

TEST(Fastenings, AreThoseThatAct)
{
    const Layout layout = drums();
    EXPECT_TRUE(fastenings({}, 0.6, layout).empty());
    EXPECT_TRUE(fastenings({neutral_spec(Mechanism::rod, 0.6), spec_of(Mechanism::dowel, {}, {1e6, 1e3})}, 0.6, layout)
                    .empty());
    const std::vector<Fastening> all = fastenings(
        {spec_of(Mechanism::rod, {1, 2}, {1e4, 1e4, 0.25}), spec_of(Mechanism::tendon, {}, {1e8})}, 0.6, layout);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].at.block, 1U);
    EXPECT_FALSE(all[1].other) << "a rod";
    ASSERT_TRUE(all[2].other) << "the tendon";
    EXPECT_EQ(all[2].at.block, 2U) << "the uppermost drum";
}

TEST(Fastenings, ATendonGoesFromTheFixedDrumToTheMiddleOfATop)
{
    const Layout layout = drums();
    const Fastening tendon = fastenings({spec_of(Mechanism::tendon, {2}, {1e8})}, 0.6, layout).at(0);
    std::vector<Rectangle> blocks = at_rest(layout);
    blocks[2].x += 0.3;
    blocks[2].turned_rad = std::acos(-1.0) / 2; // its top is at the left now
    const auto line = line_of(tendon, blocks, at_rest(layout)[2], 0, 0);
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->from.x, 0.3 - 0.5, 1e-12);
    EXPECT_NEAR(line->from.y, 2.5, 1e-12);
    EXPECT_NEAR(line->to.x, 0, 1e-12);
    EXPECT_NEAR(line->to.y, 1, 1e-12) << "the top of the drum that is fixed";
    blocks[2].x = std::nan("");
    EXPECT_FALSE(line_of(tendon, blocks, at_rest(layout)[2], 0, 0));
}

TEST(Fastenings, AClampGoesWithBothBlocks)
{
    StructureSpec row = equal_column(1, 0, 2, 1, 1, 1000);
    row.kind = StructureKind::colonnade;
    row.columns.push_back(row.columns.front());
    row.columns.back().x_m = 2.5;
    const Layout layout = lay_out(row);
    const Fastening clamp = fastenings({spec_of(Mechanism::clamp, {0}, {1e6, 1e3, 0, 1, 0.2})}, 0.6, layout).at(0);
    std::vector<Rectangle> blocks = at_rest(layout);
    blocks[1].y += 0.1;
    const auto line = line_of(clamp, blocks, blocks[0], 0, 0);
    ASSERT_TRUE(line && clamp.other && clamp.other->block == 1U);
    EXPECT_NEAR(line->from.x, 1 - 0.25, 1e-12);
    EXPECT_NEAR(line->from.y, 0.7, 1e-12);
    EXPECT_NEAR(line->to.x, 1.5 + 0.25, 1e-12);
    EXPECT_NEAR(line->to.y, 0.8, 1e-12);
}

TEST(Fastenings, ARodHoldsItsBlockOrOnlyPushesIt)
{
    const Layout layout = drums();
    const auto rod = [&](std::initializer_list<double> values) {
        return fastenings({spec_of(Mechanism::rod, {1}, values)}, 0.6, layout).at(0);
    };
    std::vector<Rectangle> blocks = at_rest(layout);
    const Rectangle start = blocks[1];
    blocks[1].x += 0.5;
    const auto tip = [&](const Fastening& fastening, double time_s, double base_m) {
        return line_of(fastening, blocks, start, time_s, base_m)->from;
    };
    const Fastening holds = rod({1e4, 1e4, 0.75, 0, 0, 0, 1});
    EXPECT_NEAR(tip(holds, 9, 0.3).x, 0.5, 1e-12) << "with its block, wherever that is";
    EXPECT_NEAR(tip(holds, 9, 0.3).y, 1.75, 1e-12);
    EXPECT_LT(line_of(holds, blocks, start, 0, 0)->to.x, -1e9) << "from the left";

    // to the right at 0.1 m/s from 2 s on, by 0.4 m at most: the block is ahead of it
    const Fastening pushes = rod({1e4, 0, 0.75, 0.1, 2, 0.4, 0});
    for (const auto& [time_s, x] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.2}, {6.0, 0.4}, {9.0, 0.4}})
        EXPECT_NEAR(tip(pushes, time_s, 0.3).x, x, 1e-12) << time_s;
    const Fastening from_laboratory = rod({1e4, 0, 0.75, 0.1, 2, 0.4, 1});
    EXPECT_NEAR(tip(from_laboratory, 4, 0.05).x, 0.15, 1e-12) << "the base moves away under it";
    blocks[1].x = 0.1;
    EXPECT_NEAR(tip(pushes, 4, 0).x, 0.1, 1e-12) << "it touches the block, and is shortened";

    const Fastening left = rod({0, 1e4, 0.75, -0.1, 2, 0.4, 0});
    EXPECT_GT(line_of(left, blocks, start, 0, 0)->to.x, 1e9) << "from the right";
    blocks[1].x = -0.5;
    EXPECT_NEAR(tip(left, 4, 0).x, -0.2, 1e-12);
}

} // namespace
} // namespace stylobate

/// The rose of falls against counts and directions that were chosen.

#include "studies/results/fall_rose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate {
namespace {

constexpr double degree = std::numbers::pi / 180;

Outcome fall_towards(double degrees)
{
    Outcome outcome;
    outcome.state = State::collapsed;
    outcome.fall_azimuth_rad = degrees * degree;
    return outcome;
}

TEST(FallRose, CountsByTheNearestSixteenth)
{
    FallRose rose;
    for (const double degrees : {0.0, 11.2, -11.2, 11.3, 90.0, -90.0, 180.0, -179.0})
        rose.add(fall_towards(degrees));
    std::vector<std::uint64_t> counts(16, 0);
    counts[0] = 3, counts[1] = 1, counts[4] = 1, counts[12] = 1, counts[8] = 2;
    EXPECT_EQ(rose.counts(), counts);
    EXPECT_EQ(rose.falls(), 8U);
}

TEST(FallRose, OnlyFallsWithADirectionCount)
{
    FallRose rose;
    Outcome stands = fall_towards(10);
    stands.state = State::rocked;
    rose.add(stands);
    Outcome nowhere = fall_towards(10);
    nowhere.fall_azimuth_rad = std::numeric_limits<double>::quiet_NaN();
    rose.add(nowhere);
    EXPECT_EQ(rose.falls(), 0U);
    EXPECT_EQ(rose.resultant(), 0);
}

TEST(FallRose, MeanAndResultantAreThoseOfUnitVectors)
{
    FallRose rose;
    rose.add(fall_towards(170));
    rose.add(fall_towards(-150));
    EXPECT_NEAR(rose.mean_deg(), -170, 1e-9);
    EXPECT_NEAR(rose.resultant(), std::cos(20 * degree), 1e-12);
    rose.add(fall_towards(10));
    EXPECT_NEAR(rose.resultant(), (2 * std::cos(20 * degree) - 1) / 3, 1e-12);
}

TEST(FallRose, AreasAreAsTheCounts)
{
    FallRose rose;
    for (int i = 0; i < 4; ++i)
        rose.add(fall_towards(0));
    rose.add(fall_towards(90));
    const std::string svg = rose.svg("falls").markup;
    // the radius of one is half of that of four
    EXPECT_NE(svg.find("A108.0 108.0"), std::string::npos) << svg;
    EXPECT_NE(svg.find("A54.0 54.0"), std::string::npos) << svg;
    EXPECT_NE(svg.find("90°: 1"), std::string::npos) << svg;
    EXPECT_NE(rose.caption().find("5 realizations fell"), std::string::npos) << rose.caption();
}

} // namespace
} // namespace stylobate

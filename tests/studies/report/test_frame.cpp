/// Pixels of films: what is covered, by areas in closed form.

#include "studies/report/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stylobate {
namespace {

constexpr Rgb white{255, 255, 255}, black{0, 0, 0};

/// The area that is dark [px2].
double dark(const Frame& frame)
{
    double sum = 0;
    for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x)
            sum += 1 - frame.at(x, y).g / 255.0;
    return sum;
}

TEST(Frame, FillsWhatLiesInside)
{
    Frame frame(20, 10, white);
    EXPECT_EQ(frame.bytes().size(), 600U);
    frame.fill({{2, 3}, {7, 3}, {7, 5}, {2, 5}}, {255, 0, 0});
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x)
            EXPECT_EQ(frame.at(x, y), (x >= 2 && x < 7 && y >= 3 && y < 5 ? Rgb{255, 0, 0} : white)) << x << ' ' << y;
    EXPECT_EQ(static_cast<unsigned char>(frame.bytes()[3 * (3 * 20 + 2) + 1]), 0U);
}

TEST(Frame, TurnedSquaresKeepTheirArea)
{
    for (const double turn : {0.1, 0.5, 1.0, -0.7}) {
        for (const bool other_sense : {false, true}) {
            std::vector<FramePoint> corners;
            for (int k = 0; k < 4; ++k) {
                const double angle = turn + (other_sense ? -k : k) * std::acos(0.0);
                corners.push_back({50 + 30 * std::cos(angle), 50 + 30 * std::sin(angle)});
            }
            Frame frame(100, 100, white);
            frame.fill(corners, black);
            EXPECT_NEAR(dark(frame), 2 * 30 * 30, 15) << turn; // half the product of the diagonals
        }
    }
}

TEST(Frame, LinesHaveTheirWidthAndNothingIsDrawnOutside)
{
    Frame frame(100, 60, white);
    frame.line({10.3, 10.1}, {70.7, 47.9}, 3, black); // no edge runs through the samples
    EXPECT_NEAR(dark(frame), 3 * std::hypot(60.4, 37.8), 5);
    Frame partly(40, 40, white);
    partly.fill({{-100, -100}, {20, -100}, {20, 500}, {-100, 500}}, black);
    EXPECT_NEAR(dark(partly), 20 * 40, 1e-9);
    partly.line({-50, -50}, {-10, -20}, 4, black);
    partly.fill({{1000, 0}, {2000, 0}, {2000, 10}}, black);
    EXPECT_NEAR(dark(partly), 20 * 40, 1e-9);
}

} // namespace
} // namespace stylobate

/// Animations of a page, read back by another reader than that of the page: positions are those of the trajectory to
/// half a tenth of a pixel, whatever moved before.

#include "ensemble/model/structure.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "studies/report/animation.hpp"
#include "tests/studies/report/animation_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace stylobate {
namespace {

ReadBack read_back(const Animation& animation, std::size_t blocks)
{
    return stylobate::read_back(animation.data, animation.samples, blocks);
}

AnimationStage small_stage()
{
    PlacedBlock block;
    block.width_m = 1;
    block.height_m = 2;
    block.axis_m = 3;
    block.y_m = 1;
    return animation_stage({block});
}

/// Two blocks that walk at random, rest for a while, and fly far away.
Trajectory walk(std::size_t samples)
{
    Trajectory t(planar_channels);
    t.index = 7;
    t.role.assign(2, BlockRole::drum);
    t["half_width_m"] = {0.5, 0.25};
    t["half_height_m"] = {1, 0.5};
    std::mt19937 random(1);
    std::normal_distribution<double> step(0, 0.02);
    double x[2] = {3, 3}, y[2] = {1, 2.5}, theta[2] = {0, 0}, base = 0;
    for (std::size_t k = 0; k < samples; ++k) {
        const bool rests = k > 40 && k < 200;
        for (int b = 0; b < 2; ++b) {
            x[b] += rests ? 0 : step(random);
            y[b] += rests ? 0 : step(random);
            theta[b] += rests || b == 0 ? 0 : 10 * step(random);
            t["x_m"].push_back(x[b]);
            t["y_m"].push_back(y[b]);
            t["theta_rad"].push_back(theta[b]);
        }
        base += step(random);
        t["base_x_m"].push_back(base);
        t.time_s.push_back(0.01 * static_cast<double>(k));
    }
    return t;
}

TEST(Animation, HasTheTrajectoryToHalfATenthOfAPixel)
{
    const AnimationStage stage = small_stage();
    EXPECT_DOUBLE_EQ(stage.middle_m, 3);
    for (const std::size_t stride : {1U, 3U, 7U}) {
        const Trajectory t = walk(300);
        const Animation animation = animation_of(t, stage, stride);
        EXPECT_EQ(animation.index, 7U);
        EXPECT_EQ(animation.samples, (300 + stride - 1) / stride);
        const ReadBack back = read_back(animation, 2);
        EXPECT_NEAR(back.half_size_px[0][0], 0.5 * stage.px_m, 0.0501);
        EXPECT_NEAR(back.half_size_px[1][1], 0.5 * stage.px_m, 0.0501);
        for (std::size_t k = 0; k < animation.samples; ++k)
            for (std::size_t b = 0; b < 2; ++b) {
                const std::size_t at = 2 * k * stride + b;
                ASSERT_NEAR(back.x_px[b][k], (t["x_m"][at] - 3) * stage.px_m, 0.0501);
                ASSERT_NEAR(back.y_px[b][k], t["y_m"][at] * stage.px_m, 0.0501);
                // a corner moves on the circle of the half diagonal
                const double half_diagonal = std::hypot(t["half_width_m"][b], t["half_height_m"][b]) * stage.px_m;
                ASSERT_NEAR(back.theta_rad[b][k] * half_diagonal, t["theta_rad"][at] * half_diagonal,
                            0.0501 + 0.001 * std::abs(t["theta_rad"][at]) * half_diagonal);
                ASSERT_NEAR(back.base_px[k], t["base_x_m"][k * stride] * stage.px_m, 0.0501);
            }
    }
}

TEST(Animation, OfWhatRestsIsShort)
{
    Trajectory t = walk(1);
    const auto repeat = [](std::vector<double>& values, std::size_t n) {
        const std::vector<double> first = values;
        for (std::size_t k = 1; k < n; ++k)
            values.insert(values.end(), first.begin(), first.end());
    };
    for (std::vector<double>* values : {&t["x_m"], &t["y_m"], &t["theta_rad"], &t["base_x_m"], &t.time_s})
        repeat(*values, 5000);
    const Animation animation = animation_of(t, small_stage(), 1);
    EXPECT_LT(animation.data.size(), 80U);
    EXPECT_EQ(read_back(animation, 2).x_px[1].size(), 5000U);
}

TEST(Animation, KeepsWhatIsNotFiniteOrFarAwayWithinBounds)
{
    Trajectory t = walk(4);
    t["x_m"][2] = std::numeric_limits<double>::quiet_NaN();
    t["y_m"][2] = std::numeric_limits<double>::infinity();
    t["x_m"][4] = 1e30;
    t["x_m"][6] = -1e30;
    const ReadBack back = read_back(animation_of(t, small_stage(), 1), 2);
    EXPECT_EQ(back.x_px[0][1], back.x_px[0][0]);
    EXPECT_EQ(back.y_px[0][1], back.y_px[0][0]);
    EXPECT_NEAR(back.x_px[0][2], 1e5, 1e-6);
    EXPECT_NEAR(back.x_px[0][3], -1e5, 1e-6);
}

TEST(Animation, StageHoldsTheStructure)
{
    for (const auto& [width, height] : {std::pair{0.1, 5.0}, {30.0, 2.0}, {1.0, 1.0}}) {
        PlacedBlock block;
        block.width_m = width;
        block.height_m = height;
        block.y_m = height / 2;
        const AnimationStage stage = animation_stage({block});
        EXPECT_LT(width * stage.px_m, 0.6 * stage.width_px);
        EXPECT_LT(height * stage.px_m, stage.ground_px);
        EXPECT_GT(std::max(width * stage.px_m / stage.width_px, height * stage.px_m / stage.ground_px), 0.5);
        EXPECT_LT(stage.ground_px, stage.height_px);
        EXPECT_LT((width / 2 + height) * stage.px_m, stage.width_px / 2); // toppled to a side it is still seen
    }
}

TEST(Animation, AscendingTimesReadBackToHalfAQuantum)
{
    const double quantum_s = 0.003;
    const std::vector<double> times_s = {0, 0.001, 0.4, 0.4, 0.4, 0.41, 3, 1000};
    std::vector<double> read;
    std::uint64_t sum = 0, value = 0;
    int shift = 0;
    for (const unsigned byte : decoded_base64(ascending_text(times_s, quantum_s))) {
        value |= static_cast<std::uint64_t>(byte & 127) << shift;
        shift += 7;
        if (byte < 128) {
            sum += value;
            read.push_back(static_cast<double>(sum) * quantum_s);
            value = 0;
            shift = 0;
        }
    }
    ASSERT_EQ(read.size(), times_s.size());
    for (std::size_t i = 0; i < read.size(); ++i)
        EXPECT_NEAR(read[i], times_s[i], quantum_s / 2 + 1e-12);
    EXPECT_EQ(ascending_text({}, quantum_s), "");
}

} // namespace
} // namespace stylobate

/// Blocks at rest, run by run at places and angles that are written down here: limits and standard deviations by hand.

#include "studies/measured/diagnosis/direct/direct_tests.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace stylobate {
namespace {

constexpr double tolerance_m = 1e-3;
constexpr std::size_t rest_samples = 20, rest_runs = 4; // the fewest that are counted

/// (runs) of one block or joint.
using OfRuns = std::array<double, rest_runs>;
constexpr OfRuns in_place = {0, 0, 0, 0};

/// A column of three blocks whose places and angles do not change during a run.
Campaign still(const std::array<OfRuns, 3>& place_m, const std::array<OfRuns, 3>& angle_rad, bool table,
               double placement_m = tolerance_m)
{
    Campaign campaign;
    Specimen& s = campaign.specimen;
    s.half_width_m = s.half_height_m = {0.05, 0.05, 0.05};
    s.mass_kg = {1, 1, 1};
    s.rest_x_m = {0.1, 0.2, 0.3}; // places are counted from here
    s.rest_y_m = {0.05, 0.15, 0.25};
    s.joints = {{-1, 0}, {0, 1}, {1, 2}};
    s.placement_tolerance_m = placement_m;
    for (std::size_t r = 0; r < rest_runs; ++r) {
        MeasuredRun run;
        for (std::size_t i = 0; i < rest_samples; ++i) {
            run.time_s.push_back(0.01 * static_cast<double>(i));
            for (std::size_t b = 0; b < 3; ++b) {
                run.blocks.x_m.values.push_back(s.rest_x_m[b] + place_m[b][r]);
                run.blocks.theta_rad.values.push_back(angle_rad[b][r]);
            }
            if (table)
                run.table.x_m.values.push_back(0);
        }
        campaign.runs.push_back(run);
    }
    return campaign;
}

DirectResult tested_at_rest(const Campaign& campaign, double noise_m = 1e-9, double noise_rad = 1e-9)
{
    CampaignScales scales;
    scales.noise_m = noise_m;
    scales.noise_rad = noise_rad;
    DirectResult out;
    test_rest(campaign, scales, {}, out);
    EXPECT_EQ(out.sensor_tests.size(), 6U) << "a wedge at each joint, the place of each block";
    return out;
}

const DataTest& place_of(const DirectResult& result, std::size_t block)
{
    return result.sensor_tests.at(3 + block);
}

OfRuns always(double value)
{
    return {value, value, value, value};
}

/// The quantile of a normal distribution whose tails beyond +-3.4808 have 1.5e-3 / 3: of three blocks any is farther
/// off by chance in 1.5e-3 of the campaigns at the most (Bonferroni).
constexpr double bonferroni = 3.4808;

TEST(RestTests, ABlockThatIsPlacedOffByLessThanTheLimitIsNotNamed)
{
    EXPECT_NEAR(3 * std::erfc(bonferroni / std::sqrt(2.0)), 1.5e-3, 1e-6);
    for (const bool table : {true, false}) {
        // four runs with the tolerance each, beside the table; beside the mean of the two others half as much again
        const double sd = tolerance_m * std::sqrt((table ? 1 : 1.5) / 4);
        const auto found = [&](double deviations) {
            return tested_at_rest(
                still({in_place, always(deviations * sd), in_place}, {in_place, in_place, in_place}, table));
        };
        const DirectResult within = found(3.3), beyond = found(3.6);
        EXPECT_TRUE(within.found.empty()) << table;
        EXPECT_EQ(place_of(within, 1).outcome, TestOutcome::passed);
        EXPECT_NEAR(*place_of(within, 1).value, 3.3 * sd, 1e-12);
        EXPECT_NEAR(*place_of(within, 1).sd, sd, 1e-12);
        EXPECT_NEAR(*place_of(within, 1).threshold, bonferroni * sd, 1e-4 * sd);
        ASSERT_EQ(beyond.found.size(), 1U) << table;
        EXPECT_EQ(beyond.found[0].cause.place, "block 1");
        EXPECT_NEAR(beyond.found[0].size, 3.6 * sd, 1e-12);
        EXPECT_NEAR(beyond.found[0].gain, 3.6 * 3.6 / 2, 1e-9);
        EXPECT_EQ(place_of(beyond, 1).outcome, TestOutcome::failed);
        for (const std::size_t other : {0, 2})
            EXPECT_EQ(place_of(beyond, other).outcome, TestOutcome::passed) << "the one that is off is no measure";
        EXPECT_TRUE(found(-3.3).found.empty());
        EXPECT_EQ(found(-3.6).found.size(), 1U);
    }
}

TEST(RestTests, TheStandardDeviationOfAPlaceIsThatOfTheMeanOfTheRuns)
{
    // +-3 mm from run to run, more than the tolerance: 3 mm sqrt(4 / 3) / sqrt(4)
    const OfRuns scattered = {0.003, -0.003, 0.003, -0.003};
    const DirectResult by_runs =
        tested_at_rest(still({in_place, scattered, in_place}, {in_place, in_place, in_place}, true));
    EXPECT_NEAR(*place_of(by_runs, 1).sd, 0.003 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(*place_of(by_runs, 1).value, 0, 1e-12);
    // of exact places the noise of two means (block and table) of 20 samples in each of four runs is left
    const DirectResult by_noise =
        tested_at_rest(still({in_place, in_place, in_place}, {in_place, in_place, in_place}, true, 0), 1e-3);
    EXPECT_NEAR(*place_of(by_noise, 0).sd, 1e-3 * std::sqrt(2.0 / 80), 1e-12);
}

TEST(RestTests, TheStandardDeviationOfAWedgeIsThatOfTheMeanOfTheRuns)
{
    // blocks 1 and 2 lean together by 0.01 +- 0.002: joint 1 scatters, the others do not
    const OfRuns lean = {0.012, 0.008, 0.012, 0.008};
    const double noise = 1e-4;
    const DirectResult result =
        tested_at_rest(still({in_place, in_place, in_place}, {in_place, lean, lean}, true), 1e-9, noise);
    const auto wedge = [&](std::size_t joint) { return result.sensor_tests.at(joint); };
    // a mean of four means of 20 samples, of one block beside the horizontal and of two beside each other
    EXPECT_NEAR(*wedge(2).value, 0, 1e-12);
    const double of_noise = noise * std::sqrt(2.0 / 80), of_runs = 0.002 / std::sqrt(3.0);
    const double common = std::pow(of_runs / of_noise, 2) / 3; // what all three joints show on the mean
    EXPECT_NEAR(*wedge(1).value, 0.01, 1e-12);
    EXPECT_NEAR(*wedge(1).sd, of_runs * std::sqrt((1 + 1.0 / 3) / 2), 1e-9);
    EXPECT_NEAR(*wedge(2).sd, of_noise * std::sqrt(common / 2), 1e-9) << "half of it is what all joints show";
    EXPECT_NEAR(*wedge(0).sd, of_noise / std::sqrt(2.0) * std::sqrt(common / 2), 1e-9);
    ASSERT_EQ(result.found.size(), 1U);
    EXPECT_EQ(result.found[0].cause.place, "joint 1");
    EXPECT_NEAR(result.found[0].gain, std::pow(0.01 / *wedge(1).sd, 2) / 2, 1e-9);
    // runs that are alike leave the noise alone; five deviations and 3e-4 rad are the limits
    const auto found = [&](double angle) {
        return tested_at_rest(still({in_place, in_place, in_place}, {in_place, always(angle), always(angle)}, true),
                              1e-9, 4e-4)
            .found.size();
    };
    EXPECT_NEAR(4e-4 * std::sqrt(2.0 / 80), 6.325e-5, 1e-8);
    EXPECT_EQ(found(4.9 * 6.325e-5), 0U);
    EXPECT_EQ(found(5.1 * 6.325e-5), 1U);
}

} // namespace
} // namespace stylobate

/// Regressions over rides, and what they say of the table: standard deviations by hand.

#include "studies/measured/diagnosis/direct/direct_tests.hpp"
#include "studies/measured/diagnosis/direct/pitch_test.hpp"
#include "studies/measured/diagnosis/evidence/ride.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace stylobate {
namespace {

constexpr std::size_t ride_samples = 1600;

/// Four runs of 1600 samples under an acceleration of +-1.
std::vector<Ride> four_rides()
{
    std::vector<Ride> rides;
    for (std::size_t r = 0; r < 4; ++r) {
        Ride ride;
        ride.run = r;
        ride.noise_theta = 1e-3;
        for (std::size_t i = 0; i < ride_samples; ++i)
            ride.acceleration.push_back(i % 2 == 0 ? 1 : -1);
        ride.base.assign(ride_samples, 0);
        ride.theta.assign(ride_samples, 0);
        ride.parts = {{0, ride_samples}};
        rides.push_back(ride);
    }
    return rides;
}

/// Slopes of 2 +- 0.001 in turn.
double slope_in(std::size_t run)
{
    return run % 2 == 0 ? 2.001 : 1.999;
}

/// Leaving out one of four slopes moves their mean as Quenouille's jackknife says: s / sqrt(4), s^2 with n - 1.
const double of_runs = 0.001 * std::sqrt(4.0 / 3) / std::sqrt(4.0);

TEST(FitOverRuns, HasTheJackknifesDeviationWhereRunsDiffer)
{
    const auto fitted = [](double noise) {
        const auto value = [noise](const Ride& r, std::size_t i) {
            return std::pair{slope_in(r.run) * r.acceleration[i] + 7, noise}; // each stretch has its own offset
        };
        const auto column = [](const Ride& r, std::size_t i, int) { return r.acceleration[i]; };
        return std::pair{fit_rides(four_rides(), 1, value, column), fit_over_runs(four_rides(), 1, value, column)};
    };
    const auto [alone, over_runs] = fitted(0.02);
    EXPECT_NEAR(alone.size[0], 2, 1e-9);
    // all errors have the size 0.001, a twentieth of the noise: the scale is its least, 1/2, and Student's weights are
    // (4 + 1) / (4 + 0.1^2) each
    EXPECT_NEAR(alone.scale, 0.5, 1e-12);
    EXPECT_NEAR(alone.sd[0], 0.02 / 2 / std::sqrt(6400 * 5 / 4.01), 1e-9);
    EXPECT_NEAR(alone.gain[0] / (std::pow(2 / alone.sd[0], 2) / 2), 1, 1e-9);
    EXPECT_NEAR(over_runs.sd[0], of_runs, 0.01 * of_runs) << "larger than the noise says";
    EXPECT_DOUBLE_EQ(over_runs.gain[0], 0.5 * std::pow(over_runs.size[0] / over_runs.sd[0], 2));
    // runs that differ by less than the noise do not make it smaller
    const auto [noisy, also_noisy] = fitted(0.2);
    EXPECT_EQ(also_noisy.sd[0], noisy.sd[0]);
    EXPECT_GT(noisy.sd[0], of_runs);
}

TEST(FitPitch, OfAColumnHasTheJackknifesDeviationToo)
{
    Campaign campaign;
    Specimen& s = campaign.specimen;
    s.half_width_m = s.half_height_m = {0.05, 0.05, 0.05};
    s.mass_kg = {1, 1, 1};
    s.rest_x_m = {0, 0, 0};
    s.rest_y_m = {0.05, 0.15, 0.25};
    s.joints = {{-1, 0}, {0, 1}, {1, 2}};
    CampaignScales scales;
    scales.spacing_s = 0.01;
    scales.rotation_rad = 100; // nothing leaves its bed
    scales.noise_rad = 0.02;
    Prepared prepared;
    prepared.rides = four_rides();
    for (std::size_t r = 0; r < 4; ++r) { // all blocks turn with the table
        MeasuredRun run;
        for (std::size_t i = 0; i < ride_samples; ++i) {
            run.time_s.push_back(0.01 * static_cast<double>(i));
            for (int b = 0; b < 3; ++b)
                run.blocks.theta_rad.values.push_back(slope_in(r) * prepared.rides[r].acceleration[i]);
        }
        prepared.rides[r].noise_theta = 0.02;
        campaign.runs.push_back(run);
    }
    const PitchFit fit = fit_pitch(campaign, scales, prepared);
    ASSERT_TRUE(fit.seen && fit.apart);
    EXPECT_NEAR(fit.slope, 2, 1e-9);
    EXPECT_NEAR(fit.sd, of_runs, 0.01 * of_runs);
    EXPECT_NEAR(fit.gain / (std::pow(2 / fit.sd, 2) / 2), 1, 1e-9);
}

Campaign of_one_block()
{
    Campaign campaign;
    Specimen& s = campaign.specimen;
    s.half_width_m = {0.1};
    s.half_height_m = {0.2};
    s.mass_kg = {1};
    s.rest_x_m = {0};
    s.rest_y_m = {0.2};
    s.joints = {{-1, 0}};
    return campaign;
}

/// A table that the cameras see moves up and down with 9 Hz, by other amplitudes in each of four motions.
TEST(VerticalMotion, TheDeviationOfALineIsThatOfTheMeanOfTheRuns)
{
    Campaign campaign = of_one_block();
    const double omega = 2 * std::numbers::pi * 9;
    const std::vector<double> amplitude_m_s2 = {1, 1.4, 0.6, 1};
    for (std::size_t r = 0; r < 4; ++r) {
        MeasuredRun run;
        run.motion_id = static_cast<int>(r);
        run.rate_hz = 500;
        for (std::size_t i = 0; i <= 2000; ++i) {
            const double t = static_cast<double>(i) / 500;
            const double x = 0.005 * std::sin(2 * std::numbers::pi * (1.5 + 0.4 * static_cast<double>(r)) * t);
            run.time_s.push_back(t);
            run.base_displacement_m.values.push_back(x);
            run.table.x_m.values.push_back(x);
            run.table.y_m.values.push_back(amplitude_m_s2[r] / (omega * omega) * std::sin(omega * t));
            run.table.theta_rad.values.push_back(0);
            run.blocks.x_m.values.push_back(x);
            run.blocks.y_m.values.push_back(0.2);
            run.blocks.theta_rad.values.push_back(0);
        }
        run.table.x_m.noise_sd = 1e-6;
        run.table.y_m.noise_sd = 1e-4; // what is farther off than six times this counts no more; 0.44 mm at the most
        run.table.theta_rad.noise_sd = 1e-6;
        run.blocks.x_m.noise_sd = run.blocks.y_m.noise_sd = 1e-6;
        run.blocks.theta_rad.noise_sd = 1e-6;
        campaign.runs.push_back(run);
    }
    const CampaignScales scales = campaign_scales(campaign);
    const VerticalMotion found = vertical_motion(campaign, prepare_rides(campaign, scales), scales, 0);
    EXPECT_NEAR(found.line_hz, 9, 0.2);
    // a frequency of the grid lies within a tenth of the width of the line, where its amplitude is 2 % less at the most
    EXPECT_NEAR(found.line_m_s2, 1, 0.05);
    // scatter of the four: sqrt((0.4^2 + 0.4^2) / 3) = 0.3266, of their mean half of that
    EXPECT_NEAR(found.line_sd_m_s2 / found.line_m_s2, 0.3266 / 2, 0.005);
}

TEST(DirectFindings, AFindingIsBeyondItsThresholdAndItsNoise)
{
    EXPECT_TRUE(beyond(-0.03, 0.005, 0.02, 5));
    EXPECT_FALSE(beyond(0.03, 0.0061, 0.02, 5)) << "five deviations";
    EXPECT_FALSE(beyond(0.019, 0.001, 0.02, 5));
    // an error of 2 % of what a size differs from its neutral value by
    const CauseFit fit = cause_of("sensor_gain", "base", "gain", "", 1, 1.5, 0.0075, 12);
    EXPECT_NEAR(fit.sd, std::hypot(0.0075, 0.01), 1e-12);
    EXPECT_EQ(fit.size, 1.5);
    EXPECT_EQ(fit.gain, 12);
}

TEST(CampaignScales, TheNoiseOfSamplesIsThatOfTheirFourthDifferences)
{
    // white noise of 1 mm and 3 mrad upon a slow motion; the median of 1.2e4 squares is known to 1.2 % (1 sigma), as
    // neighbouring differences are correlated perhaps to twice that
    Campaign campaign = of_one_block();
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    MeasuredRun run;
    for (std::size_t i = 0; i < 12000; ++i) {
        const double t = static_cast<double>(i) / 500;
        run.time_s.push_back(t);
        run.blocks.x_m.values.push_back(0.05 * std::sin(3 * t) + 1e-3 * normal(random));
        run.blocks.y_m.values.push_back(0.2 + 1e-3 * normal(random));
        run.blocks.theta_rad.values.push_back(3e-3 * normal(random));
    }
    campaign.runs.push_back(run);
    const CampaignScales scales = campaign_scales(campaign);
    EXPECT_NEAR(scales.noise_m, 1e-3, 7e-5);
    EXPECT_NEAR(scales.noise_rad, 3e-3, 2.1e-4);
}

} // namespace
} // namespace stylobate

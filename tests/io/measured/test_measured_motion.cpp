/// The table's motion from noisy sensors, against a truth in closed form.

#include "io/measured/measured_file.hpp"
#include "io/measured/measured_motion.hpp"
#include "tests/io/measured/measured_samples.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

struct Errors {
    double displacement_m = 0;     ///< root mean square
    double acceleration_m_s2 = 0;  ///< root mean square
    double displacement_in_sd = 0; ///< root mean square of error over stated deviation
    double acceleration_in_sd = 0;
};

/// @param shift of the time: where the truth's clock was when the run's began
Errors errors_of(const MeasuredMotion& found, const SampleMotion& truth, double shift = 0)
{
    Errors e;
    const Motion& m = found.motion;
    const double n = static_cast<double>(m.acceleration_m_s2.size());
    for (std::size_t i = 0; i < m.acceleration_m_s2.size(); ++i) {
        const double t = shift + m.dt_s * static_cast<double>(i);
        const double du = m.displacement_m[i] - truth.displacement_m(t);
        const double da = m.acceleration_m_s2[i] - truth.acceleration_m_s2(t);
        e.displacement_m += du * du / n;
        e.acceleration_m_s2 += da * da / n;
        if (found.displacement_sd_m[i] > 0)
            e.displacement_in_sd += std::pow(du / found.displacement_sd_m[i], 2) / n;
        e.acceleration_in_sd += std::pow(da / found.acceleration_sd_m_s2[i], 2) / n;
    }
    e.displacement_m = std::sqrt(e.displacement_m);
    e.acceleration_m_s2 = std::sqrt(e.acceleration_m_s2);
    e.displacement_in_sd = std::sqrt(e.displacement_in_sd);
    e.acceleration_in_sd = std::sqrt(e.acceleration_in_sd);
    return e;
}

void expect_consistent(const Motion& m)
{
    const double d = m.dt_s;
    for (std::size_t i = 1; i < m.acceleration_m_s2.size(); ++i) {
        const double a0 = m.acceleration_m_s2[i - 1], a1 = m.acceleration_m_s2[i];
        ASSERT_NEAR(m.velocity_m_s[i], m.velocity_m_s[i - 1] + d * (a0 + a1) / 2, 1e-13);
        ASSERT_NEAR(m.displacement_m[i],
                    m.displacement_m[i - 1] + d * m.velocity_m_s[i - 1] + d * d * (a0 / 3 + a1 / 6), 1e-13);
    }
}

const SampleMotion truth; // 5 mm at 2 Hz: about 0.8 m/s2

TEST(MeasuredMotion, BothSensorsBeatEither)
{
    const Specimen specimen = sample_specimen(1);
    MeasuredRun both = sample_run(specimen, "both", 11, truth);
    for (double& a : both.base_acceleration_m_s2.values)
        a += 0.03; // bias
    const MeasuredMotion found = smoothed_base_motion(both);
    const Errors e = errors_of(found, truth);
    expect_consistent(found.motion);
    EXPECT_LT(e.displacement_m, 1e-5);    // half the sensor's noise of 2e-5
    EXPECT_LT(e.acceleration_m_s2, 0.01); // half of 0.02
    EXPECT_GT(e.displacement_in_sd, 0.3);
    EXPECT_LT(e.displacement_in_sd, 2);
    EXPECT_GT(e.acceleration_in_sd, 0.3);
    EXPECT_LT(e.acceleration_in_sd, 2);
    EXPECT_NEAR(found.accelerometer.offset, 0.03, 4 * found.accelerometer.offset_sd + 1e-4);
    EXPECT_LT(found.accelerometer.offset_sd, 0.005);
    EXPECT_NEAR(found.accelerometer.misfit_sd, 0.02, 0.002);
    EXPECT_NEAR(found.displacement.misfit_sd, 2e-5, 2e-6);
    EXPECT_FALSE(found.assumed_at_rest);
    EXPECT_NEAR(found.motion.predominant_frequency_hz, 2, 0.5);

    MeasuredRun one = both;
    one.base_acceleration_m_s2 = {};
    EXPECT_LT(e.acceleration_m_s2, errors_of(smoothed_base_motion(one), truth).acceleration_m_s2);
    one = both;
    one.base_displacement_m = {};
    EXPECT_LT(e.displacement_m, errors_of(smoothed_base_motion(one), truth).displacement_m);
}

TEST(MeasuredMotion, OnlyTheDisplacement)
{
    MeasuredRun run = sample_run(sample_specimen(1), "u", 12, truth);
    run.base_acceleration_m_s2 = {};
    const MeasuredMotion found = smoothed_base_motion(run);
    const Errors e = errors_of(found, truth);
    expect_consistent(found.motion);
    EXPECT_LT(e.displacement_m, 1e-5);
    EXPECT_LT(e.acceleration_m_s2, 0.1); // second differences of the samples would have 12
    EXPECT_LT(e.displacement_in_sd, 2);
    EXPECT_LT(e.acceleration_in_sd, 2);
    EXPECT_EQ(found.accelerometer.samples, 0);
}

TEST(MeasuredMotion, OnlyTheAcceleration)
{
    MeasuredRun run = sample_run(sample_specimen(1), "a", 13, truth);
    run.base_displacement_m = {};
    for (double& a : run.base_acceleration_m_s2.values)
        a += 0.05;
    const MeasuredMotion found = smoothed_base_motion(run);
    const Errors e = errors_of(found, truth);
    expect_consistent(found.motion);
    EXPECT_TRUE(found.assumed_at_rest);
    EXPECT_LT(e.displacement_m, 1e-3); // 0.05 m/s2 left in would be 100 mm
    EXPECT_LT(e.acceleration_m_s2, 0.01);
    EXPECT_LT(e.displacement_in_sd, 2.5);
    EXPECT_NEAR(found.accelerometer.offset, 0.05, 0.005);
}

TEST(MeasuredMotion, OnlyTheCamerasAndTheirZero)
{
    MeasuredRun run = sample_run(sample_specimen(1), "cameras", 14, truth);
    run.table.x_m = run.base_displacement_m;
    MeasuredRun alone = run;
    alone.base_acceleration_m_s2 = {};
    alone.base_displacement_m = {};
    EXPECT_LT(errors_of(smoothed_base_motion(alone), truth).displacement_m, 1e-5);
    for (double& x : run.table.x_m.values)
        x += 0.012;
    const MeasuredMotion found = smoothed_base_motion(run);
    EXPECT_NEAR(found.cameras.offset, 0.012, 1e-5);
    EXPECT_LT(errors_of(found, truth).displacement_m, 1e-5);
}

TEST(MeasuredMotion, AJitteryClockWithGapsIsResampled)
{
    std::mt19937_64 random(15);
    std::uniform_real_distribution<double> jitter(-0.0008, 0.0008);
    std::normal_distribution<double> normal;
    MeasuredRun run;
    run.name = "jitter";
    run.base_acceleration_m_s2.noise_sd = 0.02;
    run.base_displacement_m.noise_sd = 2e-5;
    const double begin = 0.1;
    for (int i = 0; i <= 1400; ++i) {
        const double t = begin + 0.002 * i + (i == 0 || i == 1400 ? 0 : jitter(random));
        if (i >= 700 && i < 710)
            continue; // frames lost
        run.time_s.push_back(t);
        run.base_acceleration_m_s2.values.push_back(
            i > 300 && i < 320 ? nan_value : truth.acceleration_m_s2(t) + 0.02 * normal(random));
        run.base_displacement_m.values.push_back(truth.displacement_m(t) + 2e-5 * normal(random));
    }
    const MeasuredMotion found = smoothed_base_motion(run);
    EXPECT_NEAR(found.motion.dt_s, 0.002, 2e-5);
    expect_consistent(found.motion);
    const Errors e = errors_of(found, truth, begin);
    EXPECT_LT(e.displacement_m, 1e-5); // 0.8 ms of 63 mm/s would be 5e-5
    EXPECT_LT(e.acceleration_m_s2, 0.01);
    EXPECT_LT(e.acceleration_in_sd, 2);
}

TEST(MeasuredMotion, AMovingStartIsNotMadeUp)
{
    MeasuredRun run = sample_run(sample_specimen(1), "late", 16, truth);
    const std::ptrdiff_t late = 500; // 1 s: in the middle of the motion
    for (std::vector<double>* values :
         {&run.time_s, &run.base_acceleration_m_s2.values, &run.base_displacement_m.values})
        values->erase(values->begin(), values->begin() + late);
    run.blocks = {};
    const MeasuredMotion found = smoothed_base_motion(run);
    const Errors e = errors_of(found, truth, 1.0);
    EXPECT_LT(e.displacement_m, 1e-5);
    const double v = (truth.displacement_m(1.001) - truth.displacement_m(0.999)) / 0.002;
    EXPECT_NEAR(found.motion.velocity_m_s[0], v, 0.002);
}

TEST(MeasuredMotion, UndeclaredNoiseIsFound)
{
    MeasuredRun run = sample_run(sample_specimen(1), "undeclared", 17, truth);
    run.base_acceleration_m_s2.noise_sd.reset();
    run.base_displacement_m.noise_sd.reset();
    const MeasuredMotion found = smoothed_base_motion(run);
    EXPECT_NEAR(found.accelerometer.noise_sd, 0.02, 0.003);
    EXPECT_NEAR(found.displacement.noise_sd, 2e-5, 3e-6);
    EXPECT_LT(errors_of(found, truth).displacement_m, 1e-5);
}

TEST(MeasuredMotion, WhatCannotBeIsRefused)
{
    const auto message = [](auto&& change) {
        MeasuredRun run = sample_run(sample_specimen(1), "bad", 18);
        change(run);
        return refusal([&] { base_motion_of(run); });
    };
    EXPECT_NE(message([](MeasuredRun& r) {
                  r.base_acceleration_m_s2 = r.base_displacement_m = {};
              }).find("nothing of the base was measured"),
              std::string::npos);
    EXPECT_NE(message([](MeasuredRun& r) { std::swap(r.time_s[5], r.time_s[6]); }).find("must increase"),
              std::string::npos);
    EXPECT_NE(message([](MeasuredRun& r) { r.time_s.resize(3); }).find("too few"), std::string::npos);
    EXPECT_NE(message([](MeasuredRun& r) { r.time_s.back() = 1e9; }).find("gap is too large"), std::string::npos);
}

TEST(MeasuredMotion, PracticeCampaignsFitWithinTheNoise)
{
    const auto files = practice_campaigns();
    if (files.empty())
        GTEST_SKIP() << "no practice campaigns beside this checkout";
    for (const auto& file : files) {
        const Campaign campaign = read_campaign(file);
        for (std::size_t r = 0; r < campaign.runs.size(); r += 3) {
            const MeasuredRun& run = campaign.runs[r];
            const MeasuredMotion found = smoothed_base_motion(run);
            SCOPED_TRACE(file.filename().string() + " " + run.name);
            expect_consistent(found.motion);
            ASSERT_EQ(found.motion.displacement_m.size(), run.time_s.size());
            // its exact double integral is the measured displacement to the sensor's noise, without any drift: the mean
            // of the misfit over tenths of the run is a fraction of it
            const std::size_t n = run.time_s.size();
            for (std::size_t part = 0; part < 10; ++part) {
                double mean = 0;
                const std::size_t from = part * n / 10, to = (part + 1) * n / 10;
                for (std::size_t i = from; i < to; ++i)
                    mean += (run.base_displacement_m.values[i] - found.motion.displacement_m[i]) /
                            static_cast<double>(to - from);
                EXPECT_LT(std::abs(mean), 0.35 * *run.base_displacement_m.noise_sd);
            }
            EXPECT_NEAR(found.displacement.misfit_sd, *run.base_displacement_m.noise_sd,
                        0.1 * *run.base_displacement_m.noise_sd);
            // the smoother follows a part of the noise where the motion is fast
            EXPECT_LT(found.accelerometer.misfit_sd, 1.05 * *run.base_acceleration_m_s2.noise_sd);
            EXPECT_GT(found.accelerometer.misfit_sd, 0.5 * *run.base_acceleration_m_s2.noise_sd);
        }
    }
}

} // namespace
} // namespace stylobate

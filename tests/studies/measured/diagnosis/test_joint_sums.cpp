/// Bins of a run, and sums of what a joint does in them, by hand.

#include "studies/measured/diagnosis/evidence/joint_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stylobate {
namespace {

constexpr double spacing_s = 0.01, open_rad = 0.005, time_scale_s = 0.1;
const RigidRocking rigid{.alpha_rad = 0.2, .p_rad_s = 5};

/// Bins of a joint.
struct Bins {
    std::vector<double> slip_m{}, rotation_rad{}, lift_m{};
    double slip_noise_m = 0, rotation_noise_rad = 0;
};

/// Sums over bins of 10 ms. @param usable empty: all are seen
JointSums sums_of(const Bins& seen, std::vector<char> usable = {})
{
    CoarseRun run;
    run.spacing_s = spacing_s;
    run.bins = std::max(seen.rotation_rad.size(), seen.slip_m.size());
    run.usable = usable.empty() ? std::vector<char>(run.bins, 1) : std::move(usable);
    JointSeries series;
    for (const auto& [to, from] : {std::pair{&series.slip_m, &seen.slip_m},
                                   {&series.rotation_rad, &seen.rotation_rad},
                                   {&series.lift_m, &seen.lift_m}}) {
        *to = *from;
        to->resize(run.bins);
    }
    series.slip_noise_m = seen.slip_noise_m;
    series.rotation_noise_rad = seen.rotation_noise_rad;
    JointFaces faces;
    faces.lower_half_width_m = faces.upper_half_width_m = 0.1;
    return joint_sums(faces, series, run, rigid, open_rad, time_scale_s);
}

TEST(JointSums, SquaresOfSpeedsAtAClosureAreReducedByTheirNoise)
{
    // opens, comes down from 0.06 and goes on to the other side; the noise of a bin is 2e-3 rad
    const double noise = 2e-3;
    const JointSums s = sums_of({.rotation_rad = {0, 0.02, 0.04, 0.06, 0.05, 0.03, 0, -0.02, -0.035, -0.045, 0, 0},
                                 .rotation_noise_rad = noise});
    // differences of two bins over 20 ms: their square has 2 noise^2 / 20 ms^2 more than that of the speed
    const double of_noise = 2 * noise * noise / 4e-4;
    // what a rigid block gains between an angle and the closure: p^2 (2 alpha - t) t
    const auto gained = [](double t) { return 25 * (0.4 - t) * t; };
    const double before = std::pow(0.03 / 0.02, 2) - of_noise + gained(0.05);
    const double after = std::pow(0.025 / 0.02, 2) - of_noise + gained(0.035);
    EXPECT_GT(before, std::pow(0.3 * 0.2 * 5, 2)) << "a fast closure: the second class";
    EXPECT_EQ(s.closures[0], 0);
    EXPECT_EQ(s.closures[1], 1) << "the second stretch goes outward until it ends";
    EXPECT_NEAR(s.before[1], before, 1e-12);
    EXPECT_NEAR(s.after[1], after, 1e-12);
    EXPECT_NEAR(s.rotation_variance, noise * noise, 1e-18);
    EXPECT_NEAR(s.open_s[0], 5 * spacing_s, 1e-12);
    EXPECT_NEAR(s.open_s[1], 3 * spacing_s, 1e-12);
    // faces that open again after more than half a time scale: 5 bins
    const JointSums late =
        sums_of({.rotation_rad = {0, 0.02, 0.04, 0.06, 0.05, 0.03, 0, 0, 0, 0, 0, 0, 0.02, 0.04, 0.05, 0.03, 0}});
    EXPECT_EQ(late.closures[0] + late.closures[1], 2);
    EXPECT_EQ(late.after[0] + late.after[1], 0);
}

TEST(JointSums, AnExcursionLastsAsLongAsThatOfARigidBlock)
{
    // Housner: from rest at 0.1 back to the closure p t = acosh(1 / (1 - 0.1 / alpha)) = 1.31696; up and down twice
    // that
    EXPECT_NEAR(rigid.excursion_s(0, 0.1), 2 * 1.3169579 / 5, 1e-7);
    EXPECT_NEAR(rigid.excursion_s(0.05, 0.1), 2 / 5.0 * std::acosh(0.75 / 0.5), 1e-12);
    const JointSums s = sums_of({.rotation_rad = {0, 0.04, 0.1, 0.04, 0, -0.015, -0.02, -0.015, 0}});
    EXPECT_EQ(s.excursions[1], 1) << "beyond 0.15 alpha = 0.03";
    EXPECT_EQ(s.excursions[0], 1);
    EXPECT_NEAR(s.log_duration[1], std::log(0.03 / rigid.excursion_s(open_rad, 0.1)), 1e-12);
    EXPECT_NEAR(s.log_duration[0], std::log(0.03 / rigid.excursion_s(open_rad, 0.02)), 1e-12);
}

TEST(JointSums, PathsAndSquaresAreReducedByTheirNoise)
{
    const double sd = 1e-4, turn = 2e-4;
    // means of two bins: 0, 5, 5, 1 mm; rotations 1, 1, 3, 3 mrad
    const JointSums s = sums_of({.slip_m = {0, 0, 0.004, 0.006, 0.005, 0.005, 0.001, 0.001},
                                 .rotation_rad = {0.001, 0.001, 0.001, 0.001, 0.003, 0.003, 0.003, 0.003},
                                 .slip_noise_m = sd,
                                 .rotation_noise_rad = turn});
    // |x| - 1.784 sd exp(-2 x^2 / sd^2) of the increments 5, 0 and -4 mm
    EXPECT_NEAR(s.slip_path_m, 0.005 - 1.7841241 * sd + 0.004, 1e-10);
    EXPECT_NEAR(s.first_path_m, 0.005, 1e-10) << "of the first four of eight bins";
    EXPECT_NEAR(s.second_path_m, 0.004 - 1.7841241 * sd, 1e-10);
    EXPECT_NEAR(s.path_noise_m, 1.2 * sd * std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(s.net_slip_m, 0.001, 1e-12);
    EXPECT_NEAR(s.slip_range_m, 0.005 - 4 * sd / std::sqrt(2.0), 1e-12);
    EXPECT_EQ(s.impact_path_m, 0);
    EXPECT_NEAR(s.rotation_path_rad, 0.002 - 2 * 1.7841241 * turn, 1e-10);
    EXPECT_NEAR(s.rotation_path_noise_rad, 1.2 * turn * std::sqrt(3.0), 1e-12);
    // the noise of a mean of two bins has half the variance
    EXPECT_NEAR(s.rotation_square, 2 * spacing_s * (2e-6 + 18e-6 - 4 * turn * turn / 2), 1e-15);
    EXPECT_NEAR(s.seen_s, 0.08, 1e-12);
    // what was not seen divides the path
    const JointSums gap = sums_of({.slip_m = {0, 0, 0.5, 0.5, 0.005, 0.005, 0.001, 0.001}}, {1, 1, 0, 1, 1, 1, 1, 1});
    EXPECT_NEAR(gap.slip_path_m, 0.004, 1e-12);
    EXPECT_NEAR(gap.seen_s, 0.07, 1e-12);
}

TEST(JointSums, LiftsAreRegressedOnRotationsAndHopsAreCounted)
{
    // closed at a lift of 1 mm, open to the right by 10 and 20 mrad, then both corners 2 mm above the face
    const JointSums s = sums_of({.rotation_rad = {0, 0.01, 0.02, 0, 0}, .lift_m = {0.001, 0.002, 0.004, 0.001, 0.003}});
    const auto& [n, r, z, rr, rz] = s.turning[0];
    EXPECT_EQ(n, 2);
    EXPECT_NEAR(r, 0.03, 1e-12);
    EXPECT_NEAR(z, 0.006, 1e-12);
    EXPECT_NEAR(rr, 5e-4, 1e-12);
    EXPECT_NEAR(rz, 1e-4, 1e-12);
    EXPECT_EQ(s.turning[1][0], 0);
    // closed it is (1 + 1 + 3) / 3 mm on the mean: 2, 4 and 3 mm are more than 0.2 mm (2e-3 of the half width) above
    EXPECT_NEAR(s.hop_s, 0.03, 1e-12);
}

TEST(JointSums, OfRunsAddUp)
{
    JointSums a, b;
    a.runs = 1;
    b.runs = 3;
    a.rotation_variance = 4;
    b.rotation_variance = 8;
    a.path_noise_m = 3;
    b.path_noise_m = 4;
    a.closures = {1, 2};
    b.closures = {10, 20};
    a.tangential = {1, 2, 3};
    b.tangential = {4, 5, 6};
    a += b;
    EXPECT_EQ(a.runs, 4);
    EXPECT_EQ(a.rotation_variance, 7) << "mean over the runs";
    EXPECT_EQ(a.path_noise_m, 5) << "variances add up";
    EXPECT_EQ(a.closures[1], 22);
    EXPECT_EQ(a.tangential[2], 9);
    a.scale(0.25);
    EXPECT_EQ(a.closures[1], 5.5);
    EXPECT_EQ(a.tangential[2], 2.25);
    EXPECT_EQ(a.path_noise_m, 1.25);
    EXPECT_EQ(a.rotation_variance, 7) << "it is a mean already";
    EXPECT_EQ(a.runs, 4);
}

/// A block of 1 m that moves by 1 m/s, seen every ms.
Specimen one_tall_block()
{
    Specimen s;
    s.half_width_m = {0.1};
    s.half_height_m = {0.5};
    s.mass_kg = {1};
    s.rest_x_m = {0};
    s.rest_y_m = {0.5};
    s.joints = {{-1, 0}};
    return s;
}

MeasuredRun moving(std::size_t samples)
{
    MeasuredRun run;
    for (std::size_t i = 0; i < samples; ++i) {
        run.time_s.push_back(0.001 * static_cast<double>(i));
        run.blocks.x_m.values.push_back(0.001 * static_cast<double>(i));
        run.blocks.y_m.values.push_back(0.5);
        run.blocks.theta_rad.values.push_back(0.01);
    }
    return run;
}

TEST(CoarseRun, BinsAreMeansWithTheNoiseOfMeans)
{
    CampaignScales scales;
    scales.time_s = 0.1; // bins of 4 ms
    scales.noise_m = 2e-3;
    scales.noise_rad = 4e-3;
    const MeasuredRun run = moving(42);
    const CoarseRun coarse = coarse_run(one_tall_block(), run, scales, run.blocks.x_m.values);
    EXPECT_NEAR(coarse.spacing_s, 0.004, 1e-12);
    ASSERT_EQ(coarse.bins, 10U) << "what is left over is no bin";
    EXPECT_NEAR(coarse.noise_m, 1e-3, 1e-12) << "of a mean of four";
    EXPECT_NEAR(coarse.noise_rad, 2e-3, 1e-12);
    EXPECT_NEAR(coarse.pose(3, 0).x_m, 0.0135, 1e-12);
    EXPECT_NEAR(coarse.base_m[3], 0.0135, 1e-12);
    EXPECT_NEAR(coarse.pose(3, 0).sine, std::sin(0.01), 1e-10);
    EXPECT_NEAR(coarse.pose(3, 0).cosine, std::cos(0.01), 1e-10);
}

TEST(CoarseRun, NothingIsUsedAfterACollapseLessOneTimeScale)
{
    CampaignScales scales;
    scales.time_s = 0.1;
    MeasuredRun run = moving(1000);
    const auto usable = [&] {
        const CoarseRun coarse = coarse_run(one_tall_block(), run, scales, {});
        return std::count(coarse.usable.begin(), coarse.usable.end(), 1);
    };
    EXPECT_EQ(usable(), 250);
    run.collapsed = true;
    run.collapse_time_s = 0.5;
    EXPECT_EQ(usable(), 100) << "bins that end before 0.4 s";
    run.collapse_time_s = -1;
    EXPECT_EQ(usable(), 250) << "when it fell is not known";
    run.collapsed = false;
    run.blocks.y_m.values[9] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(usable(), 249);
    for (std::size_t i = 41; i < 1000; ++i)
        run.time_s[i] += 0.003; // within the bin from 40 to 43
    EXPECT_EQ(usable(), 248);
}

TEST(JointSeries, NoiseIsPropagatedToTheFirstOrder)
{
    CoarseRun run;
    run.noise_m = 3e-4;
    run.noise_rad = 1e-3;
    JointFaces faces;
    faces.lower = 0;
    faces.upper = 1;
    faces.upper_half_width_m = 0.2;
    faces.lower_half_width_m = 0.3;
    faces.upper_half_height_m = 0.4;
    faces.lower_half_height_m = 0.3;
    // slip x_u - x_l + 0.4 theta_u + 0.3 theta_l; lift y_u - y_l - 0.2 |theta_u - theta_l|
    const JointSeries between = joint_series(faces, run);
    EXPECT_NEAR(between.slip_noise_m, std::sqrt(2 * 9e-8 + 0.25 * 1e-6), 1e-12);
    EXPECT_NEAR(between.rotation_noise_rad, std::sqrt(2.0) * 1e-3, 1e-12);
    EXPECT_NEAR(between.lift_noise_m, std::sqrt(2 * 9e-8 + 2 * 0.04 * 1e-6), 1e-12);
    faces.lower = -1; // on the base, which does not turn
    const JointSeries below = joint_series(faces, run);
    EXPECT_NEAR(below.slip_noise_m, std::sqrt(9e-8 + 0.16 * 1e-6), 1e-12);
    EXPECT_NEAR(below.rotation_noise_rad, 1e-3, 1e-12);
    EXPECT_FALSE(below.has_slip) << "the displacement of the base is not known";
}

} // namespace
} // namespace stylobate

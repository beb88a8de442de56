/// Sums, densities and thresholds of the diagnosis by hand (tests/mutants).

#include "tests/ensemble/motion/formula_motions.hpp"

#include "studies/measured/diagnosis/campaigns/ensemble_diagnosis.hpp"
#include "studies/measured/diagnosis/campaigns/law_adjustment.hpp"
#include "studies/measured/diagnosis/campaigns/synthetic_likelihood.hpp"
#include "studies/measured/diagnosis/evidence/balance_evidence.hpp"
#include "studies/measured/diagnosis/evidence/joint_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stylobate {
namespace {

/// -(5 + 3) / 2 ln(1 + 4 / 5) of a squared distance of 4 in three dimensions with five degrees of freedom.
TEST(LawAdjustment, KernelOfStudentsDensityByHand)
{
    EXPECT_NEAR(student_kernel(4, 3, 5), -4 * std::log(1.8), 1e-12);
}

/// A unit is 1.6449 standard deviations of a normal score: two of them are z^2 / 2 nats.
TEST(ForceTest, NatsOfAScoreByHand)
{
    EXPECT_NEAR(nats_of_score(2), 3.2898 * 3.2898 / 2, 1e-12);
}

/// Two statistics with shifts of 10 and 0.7 at size 1: F = 100 and 0.49. Stein's risk is 1 + k (k + 2) / F above k and
/// F
/// - 1 below it. It is 2 at k = 0, 1.0125 - 0.51 at 0.5 and 1.03 - 0.51 at 1, so that k = 0.5: the first shift keeps
/// 0.995 of it, the second one nothing.
TEST(ShiftModel, ShrinkageByHand)
{
    Eigen::MatrixXd residuals(1, 2);
    residuals << 10, 0.7;
    const ShiftModel model(residuals, Eigen::VectorXd::Ones(1));
    EXPECT_FALSE(model.curved());
    EXPECT_NEAR(model.mean(1)(0), 9.95, 1e-12);
    EXPECT_EQ(model.mean(1)(1), 0);
    EXPECT_NEAR(model.variance(2), 4 * 0.995 / 2, 1e-12);
}

/// Of a gain of 10 nats more than a fifth must be left without the run that shows most.
TEST(Evidence, NotByOneRunByHand)
{
    EXPECT_FALSE(not_by_one_run(10, {9, 1}, 0.2));
    EXPECT_TRUE(not_by_one_run(10, {7, 3}, 0.2));
    EXPECT_FALSE(not_by_one_run(10, {7}, 0.2)) << "there is but one run";
}

/// Independent errors of two runs: 3 and 4 mm make 5.
TEST(JointSums, ErrorsOfPathsAddAsSquares)
{
    JointSums one, other;
    one.path_noise_m = 3e-3;
    other.path_noise_m = 4e-3;
    one.rotation_path_noise_rad = 0.05;
    other.rotation_path_noise_rad = 0.12;
    one += other;
    EXPECT_NEAR(one.path_noise_m, 5e-3, 1e-15);
    EXPECT_NEAR(one.rotation_path_noise_rad, 0.13, 1e-15);
}

/// A bin is the mean of its samples.
TEST(CoarseRun, NoiseOfABinIsThatOfAMean)
{
    Campaign campaign;
    campaign.specimen = one_block();
    const auto pose = [&](int b, int) { return at_rest(campaign.specimen, b); };
    campaign.runs = {formula_run(campaign.specimen, 2000, pose, 1e-4, 1e-3, 3)};
    const CampaignScales scales = campaign_scales(campaign);
    const MeasuredRun& run = campaign.runs.front();
    const CoarseRun coarse = coarse_run(campaign.specimen, run, scales, run.base_displacement_m.values);
    const double samples = coarse.spacing_s * formula_rate_hz;
    ASSERT_GT(samples, 2);
    EXPECT_NEAR(coarse.noise_m, scales.noise_m / std::sqrt(samples), 1e-6 * scales.noise_m);
    EXPECT_NEAR(coarse.noise_rad, scales.noise_rad / std::sqrt(samples), 1e-6 * scales.noise_rad);
}

} // namespace
} // namespace stylobate

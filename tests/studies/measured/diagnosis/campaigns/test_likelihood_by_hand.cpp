/// The parts of the likelihood of statistics, each on a few numbers whose answer is computed here.

#include "studies/measured/diagnosis/campaigns/conformal.hpp"
#include "studies/measured/diagnosis/campaigns/ensemble_diagnosis.hpp"
#include "studies/measured/diagnosis/campaigns/synthetic_likelihood.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stylobate {
namespace {

/// Healthy campaigns with one descriptor and one statistic.
CampaignTable table_of(const std::vector<double>& descriptor, const std::vector<double>& statistic)
{
    const auto n = static_cast<Eigen::Index>(descriptor.size());
    CampaignTable table{Eigen::MatrixXd(n, 1), Eigen::MatrixXd(n, 1)};
    for (Eigen::Index i = 0; i < n; ++i) {
        table.descriptors(i, 0) = descriptor[static_cast<std::size_t>(i)];
        table.statistics(i, 0) = statistic[static_cast<std::size_t>(i)];
    }
    return table;
}

double residual_of(const LawAdjustment& law, double descriptor, double statistic)
{
    return law.residual(Eigen::VectorXd::Constant(1, descriptor), Eigen::VectorXd::Constant(1, statistic))(0);
}

TEST(LawAdjustmentByHand, TheScatterIsThatOfTheNullsAboutTheirMean)
{
    // 20 nulls of 5 +- 1 and a descriptor that does not vary: 19 degrees of freedom
    std::vector<double> statistic;
    for (int i = 0; i < 20; ++i)
        statistic.push_back(i % 2 == 0 ? 6 : 4);
    const std::vector<double> descriptor(20, 3);
    const LawAdjustment law(table_of(descriptor, statistic), Eigen::VectorXd::Ones(20), {true});
    EXPECT_NEAR(residual_of(law, 3, 7), 2 / std::sqrt(20.0 / 19), 1e-9);
    EXPECT_EQ(residual_of(law, 3, 100), LawAdjustment::farthest);
    // noise that the nulls hardly show is the least scatter
    const LawAdjustment noisy(table_of(descriptor, statistic), Eigen::VectorXd::Ones(20), {true}, {4});
    EXPECT_NEAR(residual_of(noisy, 3, 7), 0.5, 1e-9);
    // weights: those of 6 count a quarter; mean (10 x 6 / 4 + 10 x 4) / 12.5 = 4.4, squares 25.6 / 4 + 1.6 at 11.5
    Eigen::VectorXd weights(20);
    for (int i = 0; i < 20; ++i)
        weights(i) = i % 2 == 0 ? 0.25 : 1;
    const LawAdjustment weighted(table_of(descriptor, statistic), weights, {true});
    EXPECT_NEAR(residual_of(weighted, 3, 5.4), 1 / std::sqrt((2.5 * 2.56 + 10 * 0.16) / 11.5), 1e-9);
}

TEST(LawAdjustmentByHand, TheExpectationIsARidgeRegressionOnTheDescriptor)
{
    // descriptors -2 ... 2, four of each, statistics 10 + 3 d: standardized by 1.4826 (their median deviation is 1)
    // the sum of squares is 40 / 1.4826^2, beside which the ridge of 0.05 x 20 draws the slope to 0
    std::vector<double> descriptor, statistic;
    for (int i = 0; i < 20; ++i) {
        descriptor.push_back(i % 5 - 2);
        statistic.push_back(10 + 3 * descriptor.back());
    }
    const LawAdjustment law(table_of(descriptor, statistic), Eigen::VectorXd::Ones(20), {true});
    const double squares = 40 / (1.4826 * 1.4826), part = squares / (squares + 1);
    const double scatter = std::sqrt(9 * 40 * (1 - part) * (1 - part) / (20 - 1 - part));
    EXPECT_NEAR(residual_of(law, 2, 16), (16 - (10 + 6 * part)) / scatter, 1e-9);
    EXPECT_NEAR(residual_of(law, 0, 10 + scatter), 1, 1e-9);
}

TEST(ShrunkCorrelationByHand, IsShrunkByItsNoiseOverItsSquares)
{
    // 16 rows of (+-1, +-1), of which 12 agree: a correlation of 1/2 whose variance is (1 - 1/4) / 15 = 1/20; over its
    // square that is 1/5
    Eigen::MatrixXd rows(16, 2);
    for (int i = 0; i < 16; ++i) {
        rows(i, 0) = i % 2 == 0 ? 1 : -1;
        rows(i, 1) = (i < 12 ? 1 : -1) * rows(i, 0);
    }
    const Eigen::MatrixXd shrunk = shrunk_correlation(rows, Eigen::VectorXd::Ones(16));
    EXPECT_NEAR(shrunk(0, 1), 0.8 * 0.5, 1e-12);
    EXPECT_EQ(shrunk(0, 0), 1);
    // weights w of the first twelve and 1 of the others: correlation (12 w - 4) / (12 w + 4), and as many campaigns as
    // (sum w)^2 / sum w^2 count
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(16);
    weights.head(12).setConstant(0.5);
    const double r = 0.2, campaigns = 100.0 / 7, noise = (1 - r * r) / (campaigns - 1);
    EXPECT_GT(noise, r * r);
    EXPECT_EQ(shrunk_correlation(rows, weights)(0, 1), 0) << "nothing but noise";
    weights.head(12).setConstant(1);
    weights.tail(4).setConstant(0.25);
    const double more = 11.0 / 13, of = 169 / 12.25;
    EXPECT_NEAR(shrunk_correlation(rows, weights)(0, 1), more * (1 - (1 - more * more) / (of - 1) / (more * more)),
                1e-12);
}

TEST(ShiftModelByHand, IsALineThroughTheNeutralSize)
{
    // sizes 1, 2, 2: of a = sum z r / sum z^2, sum z^2 = 9, and of its variance 1 / 9
    const Eigen::Vector3d sizes(1, 2, 2);
    Eigen::MatrixXd residuals(3, 2);
    residuals << 5, 0.1, 10, 0.2, 11, 0.05;
    const ShiftModel strong(residuals.col(0), sizes);
    EXPECT_FALSE(strong.curved());
    EXPECT_NEAR(strong.mean(1)(0), 47.0 / 9, 1e-12);
    EXPECT_NEAR(strong.mean(0.5)(0), 47.0 / 18, 1e-12);
    EXPECT_NEAR(strong.variance(1), 1.0 / 9, 1e-12);
    EXPECT_NEAR(strong.variance(0.5), 1.0 / 36, 1e-12);
    // beside noise of chi-squared 0.6^2 / 9 = 0.04 Stein's estimate takes kappa = 1/2: 1 + kappa (kappa + 2) / F of the
    // strong one and F - 1 of the noise, which falls away; half of the coefficients are kept
    const ShiftModel both(residuals, sizes);
    const double f = 47.0 * 47 / 9, factor = 1 - 0.5 / f;
    EXPECT_NEAR(both.mean(1)(0), factor * 47 / 9, 1e-12);
    EXPECT_EQ(both.mean(1)(1), 0);
    EXPECT_NEAR(both.variance(1), factor / 2 / 9, 1e-12);
}

TEST(ShiftModelByHand, IsAParabolaWhereSizesDiffer)
{
    // residuals 30 z - 10 z^2 at 1 and 2, twice each: the variance there is that of a mean of two
    const Eigen::Vector4d sizes(1, 2, 1, 2);
    Eigen::MatrixXd residuals(4, 1);
    residuals << 20, 20, 20, 20;
    const ShiftModel model(residuals, sizes);
    EXPECT_TRUE(model.curved());
    EXPECT_NEAR(model.mean(1.5)(0), 22.5, 1e-9);
    EXPECT_NEAR(model.mean(-1)(0), -20, 1e-9) << "a side has its own sign";
    EXPECT_NEAR(model.variance(1), 0.5, 1e-12);
    EXPECT_NEAR(model.variance(2), 0.5, 1e-12);
    // between them: (z, z^2) (10, 18; 18, 34)^-1 (z, z^2)^T
    EXPECT_NEAR(model.variance(1.5), (34 * 2.25 - 36 * 3.375 + 10 * 5.0625) / 16, 1e-12);
}

/// One statistic; a cause that shifts it by 3 z at the size z, known from sizes of which sum z^2 = 9; Student's density
/// with the freedom f that the nulls have.
TEST(SyntheticLikelihoodByHand, IsTheMeanOverTheSizesOfStudentsDensity)
{
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    std::vector<double> descriptor, statistic;
    for (int i = 0; i < 200; ++i) {
        descriptor.push_back(normal(random));
        statistic.push_back(normal(random));
    }
    const LawAdjustment law(table_of(descriptor, statistic), Eigen::VectorXd::Ones(200), {true});
    const ShiftModel cause(Eigen::Vector3d(3, 6, 6), Eigen::Vector3d(1, 2, 2));
    ASSERT_NEAR(cause.mean(1)(0), 3, 1e-12);
    const SyntheticLikelihood likelihood(law, {cause});
    const double seen = 4, f = law.freedom();
    const auto density = [&](double x, double variance) {
        return std::pow(1 + x * x / (f * variance), -(f + 1) / 2) / std::sqrt(variance);
    };
    // nine sizes up to the largest one, 2/9 ... 2, each as probable as the others
    std::vector<double> size, weight;
    double sum = 0, mean = 0;
    for (int k = 1; k <= 9; ++k) {
        size.push_back(2.0 * k / 9);
        weight.push_back(density(seen - 3 * size.back(), 1 + size.back() * size.back() / 9));
        sum += weight.back();
        mean += weight.back() * size.back();
    }
    const CauseLikelihood found = likelihood.of(Eigen::VectorXd::Constant(1, seen)).front();
    EXPECT_NEAR(found.gain, std::log(sum / 9 / density(seen, 1)), 1e-9);
    EXPECT_NEAR(found.size, mean / sum, 1e-9);
    // cells of 2/9 about the sizes, over each of which the probability is spread evenly
    const auto below = [&](double z) {
        double part = 0;
        for (std::size_t k = 0; k < 9; ++k)
            part += weight[k] / sum * std::clamp((z - size[k]) * 4.5 + 0.5, 0.0, 1.0);
        return part;
    };
    EXPECT_NEAR(below(found.low), 0.05, 1e-9);
    EXPECT_NEAR(below(found.high), 0.95, 1e-9);
}

TEST(ForceTestByHand, AScoreIsInUnitsOfTheNineTenthsOfHealthyCampaigns)
{
    // a score of noise alone is 0.7; nine tenths of 1, 2, ... 10 are 9
    ForceEvidence evidence;
    evidence.nulls.resize(10, 1);
    for (int i = 0; i < 10; ++i)
        evidence.nulls(i, 0) = i % 2 == 0 ? i + 1 : -(i + 1);
    evidence.campaign = Eigen::VectorXd::Constant(1, -18);
    const ForceTest far = force_test(evidence);
    EXPECT_NEAR(far.unit[0], std::hypot(9, 0.7), 1e-12);
    EXPECT_NEAR(far.score, 18 / std::hypot(9, 0.7), 1e-12);
    EXPECT_NEAR(far.p_value, 1.0 / 11, 1e-12);
    // every sixth campaign is left out of its own unit: the one of 9 has that of 1, 2, 4, 5, 6, 7, 8, 10, which is 10;
    // the one of 10 has that of 1, 2, 3, 5, 6, 7, 8, 9, which is 9
    ASSERT_EQ(far.nulls.size(), 10U);
    EXPECT_NEAR(far.nulls[8], 9 / std::hypot(10, 0.7), 1e-12);
    EXPECT_NEAR(far.nulls[9], 10 / std::hypot(9, 0.7), 1e-12);
    evidence.campaign(0) = 8.9;
    EXPECT_NEAR(force_test(evidence).p_value, 2.0 / 11, 1e-12) << "that of 9 is no larger";
    // likeness weighs: of weights 1 for 10 and 0.1 for the others nine tenths are 10
    evidence.likeness.assign(10, 0.1);
    evidence.likeness[9] = 1;
    EXPECT_NEAR(force_test(evidence).unit[0], std::hypot(10, 0.7), 1e-12);
    EXPECT_NEAR(nats_of_score(2), 2 * 1.6449 * 1.6449, 1e-12);
}

TEST(CalibratedProbabilityByHand, WeighsItsCases)
{
    // a wrong one of weight 3 at 1, a right one at 2: with half a case of either kind added to each
    const CalibratedProbability apart({{1, false, 3}, {2, true, 1}});
    EXPECT_NEAR(apart(1), 0.5 / 4, 1e-12);
    EXPECT_NEAR(apart(2), 1.5 / 2, 1e-12);
    // in the other order both are one block, at (3 x 2 + 1) / 4, of which a quarter is right
    const CalibratedProbability pooled({{1, true, 1}, {2, false, 3}});
    EXPECT_NEAR(pooled(1.75), (1 + 0.5) / 5, 1e-12);
}

} // namespace
} // namespace stylobate

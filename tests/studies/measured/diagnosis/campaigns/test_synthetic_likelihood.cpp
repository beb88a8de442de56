/// Causes named by the likelihood of statistics, in a world whose truth is known: statistics that are linear in the law
/// descriptors, with correlated noise, and causes that shift a few of them. The world shares nothing with the
/// estimators.

#include "studies/measured/diagnosis/campaigns/conformal.hpp"
#include "studies/measured/diagnosis/campaigns/synthetic_likelihood.hpp"
#include "tests/studies/measured/diagnosis/campaigns/world.hpp"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace stylobate {
namespace {

using namespace test_world;

const std::vector<bool> all_wanted(statistics, true);

double most(const std::vector<CauseLikelihood>& of)
{
    return std::max_element(of.begin(), of.end(), [](const auto& a, const auto& b) { return a.gain < b.gain; })->gain;
}

TEST(LawAdjustment, ResidualsKnowNoLaw)
{
    World world(1);
    const CampaignTable nulls = world.nulls(300);
    const LawAdjustment adjustment(nulls, Eigen::VectorXd::Ones(nulls.statistics.rows()), all_wanted);
    ASSERT_EQ(adjustment.used().size(), std::size_t{statistics});
    const int n = 400;
    Eigen::MatrixXd laws(n, descriptors), residuals(n, statistics);
    for (int i = 0; i < n; ++i) {
        const Eigen::VectorXd l = world.law();
        laws.row(i) = l.transpose();
        residuals.row(i) = adjustment.residual(l, world.campaign(l, -1, 0)).transpose();
    }
    // slopes on the law have a standard error of 1 / sqrt(n) = 0.05, and the fit one of about 0.08
    const Eigen::MatrixXd slopes = laws.transpose() * residuals / n;
    EXPECT_LT(slopes.cwiseAbs().maxCoeff(), 0.45);
    EXPECT_LT(slopes.cwiseAbs().mean(), 0.12);
    EXPECT_NEAR(residuals.array().square().mean(), 1, 0.1);
}

TEST(LawAdjustment, CorrelationIsThatOfTheWorld)
{
    World world(2);
    const CampaignTable nulls = world.nulls(400);
    const LawAdjustment adjustment(nulls, Eigen::VectorXd::Ones(nulls.statistics.rows()), all_wanted);
    EXPECT_TRUE(adjustment.correlation().diagonal().isOnes());
    // by many other campaigns of one law
    const int n = 4000;
    Eigen::MatrixXd fresh(n, statistics);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(descriptors);
    for (int i = 0; i < n; ++i)
        fresh.row(i) = adjustment.residual(zero, world.campaign(zero, -1, 0)).transpose();
    const Eigen::MatrixXd centred = fresh.rowwise() - fresh.colwise().mean();
    Eigen::MatrixXd truth = centred.transpose() * centred / n;
    const Eigen::VectorXd sd = truth.diagonal().cwiseSqrt();
    truth = sd.cwiseInverse().asDiagonal() * truth * sd.cwiseInverse().asDiagonal();
    EXPECT_LT((adjustment.correlation() - truth).cwiseAbs().mean(), 0.06);
    EXPECT_GT(adjustment.freedom(), 20) << "this noise is normal";
    EXPECT_NEAR(adjustment.scale(), 1, 0.35);
}

TEST(LawAdjustment, DecorrelatedResidualsStayNearTheirStatistics)
{
    World world(2);
    const LawAdjustment adjustment(world.nulls(400), Eigen::VectorXd::Ones(400), all_wanted);
    const int n = 4000;
    Eigen::MatrixXd before(n, statistics), after(n, statistics);
    for (int i = 0; i < n; ++i) {
        const Eigen::VectorXd law = world.law(), residual = adjustment.residual(law, world.campaign(law, -1, 0));
        before.row(i) = residual.transpose();
        after.row(i) = adjustment.decorrelated(residual).transpose();
    }
    const Eigen::MatrixXd covariance = after.transpose() * after / n;
    Eigen::MatrixXd off = covariance;
    off.diagonal().setZero();
    EXPECT_LT(off.cwiseAbs().mean(), 0.06);
    EXPECT_NEAR(covariance.diagonal().mean(), 1, 0.2);
    const Eigen::MatrixXd both = after.transpose() * before;
    for (Eigen::Index j = 0; j < statistics; ++j) {
        Eigen::Index nearest = -1;
        both.row(j).cwiseAbs().maxCoeff(&nearest);
        EXPECT_EQ(nearest, j);
    }
}

TEST(LawAdjustment, AStatisticThatIsMissingSaysNothing)
{
    World world(3);
    CampaignTable nulls = world.nulls(200);
    const double missing = std::numeric_limits<double>::quiet_NaN();
    nulls.statistics.col(7).head(100).setConstant(missing); // half of the nulls have it
    nulls.statistics.col(8).head(20).setConstant(missing);  // nearly all
    std::vector<bool> wanted = all_wanted;
    wanted[3] = false;
    const LawAdjustment adjustment(nulls, Eigen::VectorXd::Ones(nulls.statistics.rows()), wanted);
    ASSERT_EQ(adjustment.used().size(), std::size_t{statistics - 2});
    const Eigen::VectorXd law = world.law();
    Eigen::VectorXd campaign = world.campaign(law, -1, 0);
    campaign(8) = missing;
    const Eigen::VectorXd residual = adjustment.residual(law, campaign);
    EXPECT_TRUE(residual.allFinite());
    EXPECT_EQ(residual(6), 0) << "column 8 is the seventh used one";
}

TEST(ShrunkCorrelation, OfIndependentNoiseIsNearlyNone)
{
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const Eigen::MatrixXd noise = Eigen::MatrixXd::NullaryExpr(60, 50, [&] { return normal(random); });
    const Eigen::MatrixXd shrunk = shrunk_correlation(noise, Eigen::VectorXd::Ones(60));
    Eigen::MatrixXd sample = noise.transpose() * noise / 60;
    const auto off = [](Eigen::MatrixXd m) {
        m.diagonal().setZero();
        return m.norm();
    };
    EXPECT_LT(off(shrunk), 0.25 * off(sample));
    // and the inverse of the sample, of rank 60 for 50 columns, is far from the truth where that of the shrunk is not
    EXPECT_LT((shrunk.inverse() - Eigen::MatrixXd::Identity(50, 50)).norm(), 2);
}

TEST(ShiftModel, KeepsStrongShiftsAndDropsNoise)
{
    std::mt19937 random(6);
    std::normal_distribution<double> normal;
    const int n = 12, p = 100;
    Eigen::VectorXd sizes(n);
    Eigen::MatrixXd residuals = Eigen::MatrixXd::NullaryExpr(n, p, [&] { return normal(random); });
    for (int i = 0; i < n; ++i) {
        sizes(i) = (1 + i % 3) / 3.0;
        for (int j = 0; j < 4; ++j)
            residuals(i, j) += 6 * sizes(i);
    }
    const ShiftModel model(residuals, sizes);
    const Eigen::VectorXd mean = model.mean(1);
    for (int j = 0; j < 4; ++j)
        EXPECT_NEAR(mean(j), 6, 2);
    // least squares alone would leave p x (variance of the mean at size 1, about 0.5) = 50
    EXPECT_LT(mean.tail(p - 4).squaredNorm(), 25);
    EXPECT_EQ(model.mean(0).norm(), 0);
    EXPECT_GT(model.variance(1), model.variance(0.1));
}

TEST(SyntheticLikelihoodStatistics, NamesThePlantedCauseWithItsSize)
{
    World world(7);
    const LawAdjustment adjustment(world.nulls(300), Eigen::VectorXd::Ones(300), all_wanted);
    const SyntheticLikelihood likelihood(adjustment, world.learnt(adjustment));
    int named = 0, inside = 0, total = 0;
    for (int i = 0; i < 200; ++i) {
        const int cause = i % causes;
        const int rank = i / causes;
        const double size = 0.4 + 0.024 * rank;
        const Eigen::VectorXd law = world.law();
        const auto found = likelihood.of(seen(adjustment, law, world.campaign(law, cause, size)));
        const auto best =
            std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.gain < b.gain; });
        ++total;
        if (best - found.begin() != cause)
            continue;
        ++named;
        inside += best->low <= size && size <= best->high ? 1 : 0;
    }
    EXPECT_GE(named, 0.95 * total);
    EXPECT_GE(inside, 0.8 * named) << "of intervals of 90 %";
    EXPECT_LE(inside, 0.98 * named);
}

TEST(SyntheticLikelihoodStatistics, PValuesOfNullsAreUniform)
{
    World world(9);
    const LawAdjustment adjustment(world.nulls(300), Eigen::VectorXd::Ones(300), all_wanted);
    const SyntheticLikelihood likelihood(adjustment, world.learnt(adjustment));
    const auto score = [&] {
        const Eigen::VectorXd law = world.law();
        return most(likelihood.of(seen(adjustment, law, world.campaign(law, -1, 0))));
    };
    std::vector<double> held_out;
    for (int i = 0; i < 999; ++i)
        held_out.push_back(score());
    int alarms = 0;
    std::vector<int> tenths(10, 0);
    const int n = 1000;
    for (int i = 0; i < n; ++i) {
        const double p = conformal_p_value(held_out, score());
        alarms += p <= 0.015 ? 1 : 0;
        ++tenths[std::min<std::size_t>(9, static_cast<std::size_t>(p * 10))];
    }
    EXPECT_LE(alarms, 0.015 * n + 5 * std::sqrt(0.015 * n) + 5);
    for (const int count : tenths) // the held-out nulls scatter too: standard deviation 13
        EXPECT_NEAR(count, 0.1 * n, 60);
}

/// Ten pairs of statistics, of which each two scatter by 1.5 together and by 0.3 alone. The cause moves one of the
/// first pair by 1.5: once its scatter, and nearly four times that of the pair's difference.
TEST(SyntheticLikelihood, FindsAShiftThatOnlyAContrastShows)
{
    constexpr int pairs = 10;
    std::mt19937 random(12);
    std::normal_distribution<double> normal;
    const auto campaign = [&](double shift) {
        Eigen::VectorXd out(2 * pairs);
        for (int k = 0; k < pairs; ++k) {
            const double common = 1.5 * normal(random);
            out(2 * k) = common + 0.3 * normal(random);
            out(2 * k + 1) = common + 0.3 * normal(random);
        }
        out(0) += shift;
        return out;
    };
    CampaignTable nulls{Eigen::MatrixXd(300, 1), Eigen::MatrixXd(300, 2 * pairs)};
    for (int i = 0; i < 300; ++i) {
        nulls.descriptors(i, 0) = normal(random);
        nulls.statistics.row(i) = campaign(0).transpose();
    }
    const LawAdjustment adjustment(nulls, Eigen::VectorXd::Ones(300), std::vector<bool>(2 * pairs, true));
    const Eigen::VectorXd law = Eigen::VectorXd::Zero(1);
    Eigen::MatrixXd residuals(12, 2 * pairs);
    Eigen::VectorXd sizes(12);
    for (int i = 0; i < 12; ++i) {
        sizes(i) = (i + 1) / 12.0;
        residuals.row(i) = seen(adjustment, law, campaign(1.5 * sizes(i))).transpose();
    }
    const SyntheticLikelihood likelihood(adjustment, {ShiftModel(residuals, sizes)});
    const auto mean_gain = [&](double shift) {
        double sum = 0;
        for (int i = 0; i < 200; ++i)
            sum += likelihood.of(seen(adjustment, law, campaign(shift))).front().gain / 200;
        return sum;
    };
    // an observer who knows all gains (1.5 / 0.42)^2 / 2 = 6.4 nats at the size 1, less the prior's 1 or 2; by the
    // statistic alone it would be 0.5
    EXPECT_GT(mean_gain(1.5), 2);
    EXPECT_LT(mean_gain(0), 0);
}

TEST(SyntheticLikelihood, AShiftCommonToAllIsNoCause)
{
    World world(10);
    const LawAdjustment adjustment(world.nulls(300), Eigen::VectorXd::Ones(300), all_wanted);
    const std::vector<ShiftModel> models = world.learnt(adjustment);
    const Eigen::MatrixXd common = Eigen::MatrixXd::Ones(1, statistics) / std::sqrt(double{statistics});
    const SyntheticLikelihood plain(adjustment, models), contrasts(adjustment, models, common);
    // a law that the family does not have
    Eigen::VectorXd residual = adjustment.decorrelated(Eigen::VectorXd::Constant(statistics, 3));
    EXPECT_GT(most(plain.of(residual)), most(contrasts.of(residual)));
    EXPECT_LT(most(contrasts.of(residual)), 2);
    residual += models[3].mean(1); // and a cause on top of it
    const auto found = contrasts.of(residual);
    EXPECT_EQ(
        std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.gain < b.gain; }) -
            found.begin(),
        3);
}

TEST(Conformal, RanksByHand)
{
    const std::vector<double> nulls = {1, 2, 3, 4};
    EXPECT_EQ(conformal_p_value(nulls, 5), 1.0 / 5);
    EXPECT_EQ(conformal_p_value(nulls, 4), 2.0 / 5) << "as large counts";
    EXPECT_EQ(conformal_p_value(nulls, 0), 1);
    EXPECT_EQ(conformal_p_value({}, 3), 1) << "without nulls nothing is improbable";
}

TEST(Conformal, WeighsByHand)
{
    EXPECT_DOUBLE_EQ(conformal_p_value({1, 2, 3}, 1.5, {0.5, 0.25, 1}), (1 + 0.25 + 1) / (1 + 0.5 + 0.25 + 1));
    EXPECT_DOUBLE_EQ(conformal_p_value({1, 2, 3}, 2.5, {0, 1, 0}), 0.5) << "only one campaign is like this one";
}

TEST(CalibratedProbability, PoolsWhatFalls)
{
    // shares 0, 1, 0, 1 at 1, 2, 3, 4: the second and third are pooled to one half
    const CalibratedProbability of({{1, false}, {2, true}, {3, false}, {4, true}});
    EXPECT_NEAR(of(2.5), 0.5, 1e-12);
    EXPECT_NEAR(of(0), 0.25, 1e-12) << "(0 + 0.5) / 2";
    EXPECT_NEAR(of(9), 0.75, 1e-12) << "(1 + 0.5) / 2";
    EXPECT_NEAR(of(1.75), 0.375, 1e-12) << "half way between 0.25 and 0.5";
    EXPECT_EQ(CalibratedProbability({})(3), 0.5);
    for (double score = 0; score < 5; score += 0.1)
        EXPECT_LE(of(score), of(score + 0.1));
}

} // namespace
} // namespace stylobate

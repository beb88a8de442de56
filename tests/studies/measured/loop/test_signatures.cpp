/// Signatures from tables: of Gaussian specimens whose scatter and shifts are known.

#include "studies/measured/loop/signatures.hpp"
#include "tests/studies/measured/loop/gaussian_laboratory.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace stylobate {
namespace {

/// Healthy specimens of the Gaussian laboratory, and of a lost corner at joint 1, all around 10.
TestSamples gaussian_tables(Eigen::Index healthy, Eigen::Index with, bool paired, unsigned seed)
{
    gaussian::Specimens specimens(gaussian::covariance(), seed);
    TestSamples out{gaussian::columns(), Eigen::MatrixXd(healthy, 15), {}};
    for (Eigen::Index i = 0; i < healthy; ++i)
        out.healthy.row(i) = specimens.draw().transpose().array() + 10;
    CauseSamples samples{{"corner_loss", "joint 1", 1, "m"}, Eigen::MatrixXd(with, 15), {}};
    for (Eigen::Index i = 0; i < with; ++i) {
        samples.rows.row(i) = paired ? Eigen::RowVectorXd(out.healthy.row(i))
                                     : Eigen::RowVectorXd(specimens.draw().transpose().array() + 10);
        for (const auto& [column, shift] : gaussian::shifts(1, 1, 1))
            samples.rows(i, column) += shift;
        if (paired)
            samples.pairs.push_back(static_cast<int>(i));
    }
    out.causes.push_back(samples);
    return out;
}

TEST(Signatures, KeepTheContrastsOfTheJoints)
{
    const Signatures s = signatures_of(gaussian_tables(96, 12, true, 3));
    // of a plateau given those at the two other joints: 5^2 is common, 0.5^2 + 0.3^2 its own
    const double own = 0.25 + 0.09, others = 25 + own / 2;
    const double expected = std::sqrt(25 + own - 25 * 25 / others);
    const Eigen::VectorXd sd = s.sd_given_others({6, 7, 8});
    for (const double found : sd)
        EXPECT_NEAR(found, expected, 0.25 * expected) << "and not the common scatter of 5";
    EXPECT_NEAR(std::sqrt(s.covariance(6, 6)), 5, 1.2);
    EXPECT_GE(s.scale, 1);
    EXPECT_LT(s.scale, 1.6);
}

TEST(Signatures, OneQuantityThatTwoTestsSeeStaysOne)
{
    // twelve estimators at four joints, of few specimens; the first two see the same friction of each joint, to 0.1
    constexpr Eigen::Index specimens = 40, estimators = 12, tested = 4;
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd rows(specimens, estimators * tested);
    std::vector<std::vector<Eigen::Index>> alike(estimators);
    for (Eigen::Index e = 0; e < estimators; ++e)
        for (Eigen::Index j = 0; j < tested; ++j)
            alike[static_cast<std::size_t>(e)].push_back(e * tested + j);
    for (Eigen::Index i = 0; i < specimens; ++i)
        for (Eigen::Index j = 0; j < tested; ++j) {
            const double friction = normal(random);
            for (Eigen::Index e = 0; e < estimators; ++e)
                rows(i, e * tested + j) = e < 2 ? friction + 0.1 * normal(random) : normal(random);
        }
    const Eigen::MatrixXd c = healthy_scatter(rows, alike).second;
    for (Eigen::Index j = 0; j < tested; ++j) {
        const double given = c(j, j) - c(j, j + tested) * c(j, j + tested) / c(j + tested, j + tested);
        EXPECT_LT(std::sqrt(given), 0.35) << "of 0.14; a shrinkage of all correlations gave 0.9";
        EXPECT_GT(std::sqrt(given), 0.1);
    }
}

TEST(Signatures, AJointThatGaveNoEstimateMakesNoContrast)
{
    // the joints have a common part of 5 and own ones of 0.5; each tenth estimate is missing
    constexpr Eigen::Index specimens = 80, tested = 4;
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd rows(specimens, tested);
    for (Eigen::Index i = 0; i < specimens; ++i) {
        const double common = 5 * normal(random);
        for (Eigen::Index j = 0; j < tested; ++j)
            rows(i, j) = (tested * i + j) % 10 == 0 ? std::nan("") : common + 0.5 * normal(random);
    }
    const Eigen::MatrixXd inverse = healthy_scatter(rows, {{0, 1, 2, 3}}).second.inverse();
    for (Eigen::Index j = 0; j < tested; ++j)
        EXPECT_NEAR(1 / std::sqrt(inverse(j, j)), 0.5 * std::sqrt(4 / 3.0), 0.12) << "given the three others";
}

TEST(Signatures, HaveShiftsOfTwoDeviationsAndMore)
{
    for (const bool paired : {true, false}) {
        const Signatures s = signatures_of(gaussian_tables(96, 24, paired, 7));
        ASSERT_EQ(s.causes.size(), 1U);
        for (Eigen::Index j = 0; j < 15; ++j)
            EXPECT_NEAR(s.causes[0].shift(j), j == 7 || j == 10 ? 6 : 0,
                        j != 7 && j != 10 ? 0
                        : paired          ? 1e-9
                                          : 3.5)
                << j;
        EXPECT_GE(s.causes[0].variance(7), 0);
    }
    // with the same specimens a small shift is exact, and still too small to count
    TestSamples small = gaussian_tables(96, 24, true, 7);
    small.causes[0].rows.col(7).array() -= 5;
    const Signatures s = signatures_of(small);
    EXPECT_EQ(s.causes[0].shift(7), 0) << "1 of 0.7";
    EXPECT_GT(s.causes[0].shift(10), 0);
}

TEST(Signatures, ScatterOfACauseIsBesideThatOfHealthySpecimens)
{
    TestSamples tests = gaussian_tables(96, 24, true, 9);
    double sum = 0, squares = 0;
    for (Eigen::Index i = 0; i < 24; ++i) {
        const double more = std::sin(37.0 * static_cast<double>(i));
        tests.causes[0].rows(i, 7) += more;
        sum += more;
        squares += more * more;
    }
    const double variance = (squares - sum * sum / 24) / 23;
    const Signatures s = signatures_of(tests);
    EXPECT_NEAR(s.causes[0].variance(7) + s.causes[0].common.row(7).squaredNorm(), variance * (1 + 1 / 24.0), 1e-9);
    EXPECT_NEAR(s.causes[0].shift(7), 6 + sum / 24, 1e-9);
    EXPECT_NEAR(s.causes[0].variance(10), 0, 1e-9);
}

TEST(Signatures, KnowWhatEstimatesScatterTogether)
{
    TestSamples tests = gaussian_tables(96, 24, true, 9);
    Eigen::VectorXd more(24);
    for (Eigen::Index i = 0; i < 24; ++i)
        more(i) = std::sin(37.0 * static_cast<double>(i));
    tests.causes[0].rows.col(7) += more;
    tests.causes[0].rows.col(10) -= 2 * more;
    const CauseSignature c = signatures_of(tests).causes[0];
    const double variance = (more.array() - more.mean()).square().sum() / 23;
    // half of it, with the sign that they have
    EXPECT_NEAR(c.common.row(7).dot(c.common.row(10)), -2 * variance / 2, 1e-9);
    EXPECT_NEAR(c.common.row(7).squaredNorm(), variance / 2, 1e-9);
    EXPECT_NEAR(c.variance(10), 4 * variance * (0.5 + 1 / 24.0), 1e-9);
    EXPECT_EQ(c.common.row(0).squaredNorm(), 0) << "it shifts nothing there";
}

TEST(Signatures, OfASizeUnderWhichAllFallsFollowTheWeakerOne)
{
    TestSamples tests = gaussian_tables(96, 24, true, 13);
    CauseSamples strong = tests.causes[0];
    strong.cause.size = 3;
    strong.rows.col(10).array() += 12;
    const double none = std::numeric_limits<double>::quiet_NaN();
    strong.rows.col(7).tail(22).setConstant(none);
    strong.rows.col(0).setConstant(none);
    tests.causes.push_back(strong);
    const Signatures s = signatures_of(tests);
    EXPECT_NEAR(s.causes[1].shift(7), 18, 1e-9) << "three times that of the weaker size";
    EXPECT_NEAR(s.causes[1].variance(7), 81, 1e-9) << "to a half";
    EXPECT_NEAR(s.causes[1].shift(10), 18, 1e-9) << "as simulated";
    EXPECT_EQ(s.causes[1].shift(0), 0) << "the weaker size shifts nothing there either";
    EXPECT_EQ(s.causes[1].variance(0), 0);
}

TEST(Signatures, LeaveOutWhatFallsAndWhatHasNoScatter)
{
    TestSamples tests = gaussian_tables(96, 12, true, 11);
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (Eigen::Index i = 0; i < 96; ++i)
        if (i % 3 != 0)
            tests.healthy(i, 2) = none; // in two of three
    tests.healthy(0, 3) = none;
    tests.healthy.col(14).setConstant(4);
    tests.columns[14].floor_sd = 0;
    const Signatures s = signatures_of(tests);
    EXPECT_FALSE(s.used[2]);
    EXPECT_TRUE(s.used[3]);
    EXPECT_FALSE(s.used[14]);
    EXPECT_TRUE(std::isfinite(s.covariance.sum()));
    tests.healthy.setConstant(none);
    EXPECT_THROW(signatures_of(tests), std::runtime_error);
}

TEST(Signatures, FloorIsAddedToTheDiagonal)
{
    const Signatures s = signatures_of(gaussian_tables(96, 12, true, 13));
    const Eigen::MatrixXd c = s.covariance_of({6, 7, 6});
    EXPECT_DOUBLE_EQ(c(0, 0), s.covariance(6, 6) + std::max(0.09, 0.0025 * s.covariance(6, 6) / s.scale));
    EXPECT_DOUBLE_EQ(c(0, 1), s.covariance(6, 7));
    EXPECT_DOUBLE_EQ(c(0, 2), s.covariance(6, 6)) << "a repeat on the same specimen";
}

TEST(Signatures, AreOfSpecimensWhoseLawIsLikeTheMeasuredOne)
{
    // stiff beds turn at their full width, soft ones earlier, and scatter ten times as much
    constexpr Eigen::Index n = 60;
    TestSamples tests;
    tests.columns = {
        {RunKind::tilt, 0, "tilt.width"}, {RunKind::tilt, 1, "tilt.width"}, {RunKind::pull, 0, "pull.wear"}};
    tests.columns[0].of_the_law = tests.columns[1].of_the_law = true;
    tests.healthy.resize(n, 3);
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < 3; ++j)
            tests.healthy(i, j) = (i % 2 == 0 ? 0.1 : 1) * normal(random) - (j < 2 && i % 2 == 1 ? 10 : 0);
    CauseSamples lost{{"corner_loss", "joint 0 left", 1, ""}, tests.healthy.topRows(6)};
    lost.rows.col(0).array() -= 2;
    lost.pairs = {0, 1, 2, 3, 4, 5};
    tests.causes = {lost};
    const std::vector<std::pair<Eigen::Index, double>> seen = {{0, 0.05}, {1, -0.02}, {2, 30}};
    const TestSamples like = like_measured(tests, seen, 25);
    ASSERT_EQ(like.healthy.rows(), 25);
    for (Eigen::Index i = 0; i < 25; ++i)
        EXPECT_GT(like.healthy(i, 0), -5) << "a soft one";
    ASSERT_EQ(like.causes[0].rows.rows(), 3);
    EXPECT_NEAR(like.causes[0].rows.col(0).mean(), -2, 1e-12) << "what the cause shifts";
    EXPECT_NEAR(like.causes[0].rows.col(2).cwiseAbs().maxCoeff(), 0, 1e-12);
    // what wear gives is no sign of the law; without such a sign all count
    const std::vector<std::pair<Eigen::Index, double>> wear = {{2, 30}};
    EXPECT_EQ(like_measured(tests, wear, 25).healthy.rows(), n);
    const Signatures s = signatures_of(like);
    EXPECT_LT(s.covariance(0, 0), 0.1);
    EXPECT_NEAR(s.causes[0].shift(0), -2, 0.1);
}

TEST(SignaturesStatistics, DistancesOfOtherSpecimensAreAsLargeAsTheySay)
{
    // 48 specimens for 15 columns: without the factor of parts left out the distances would be too large
    double sum = 0;
    const int repeats = 20;
    for (unsigned seed = 0; seed < repeats; ++seed) {
        const Signatures s = signatures_of(gaussian_tables(48, 12, true, 100 + seed));
        std::vector<Eigen::Index> all;
        for (Eigen::Index j = 0; j < 15; ++j)
            all.push_back(j);
        const Eigen::MatrixXd inverse = s.covariance_of(all).inverse();
        gaussian::Specimens others(gaussian::covariance(), 1000 + seed);
        for (int i = 0; i < 50; ++i) {
            const Eigen::VectorXd off = others.draw() + Eigen::VectorXd::Constant(15, 10) - s.mean;
            sum += off.dot(inverse * off) / 15 / 50 / repeats;
        }
    }
    EXPECT_LT(sum, 1.05);
    EXPECT_GT(sum, 0.5);
}

} // namespace
} // namespace stylobate

/// Densities of hypotheses over the healthy one: against Student's densities in closed form and their integrals.

#include "studies/measured/loop/joint_density.hpp"
#include "tests/studies/measured/loop/gaussian_laboratory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace stylobate {
namespace {

using gaussian::student_density;

Eigen::VectorXd numbers(std::initializer_list<double> values)
{
    Eigen::VectorXd out(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), out.begin());
    return out;
}

/// One column of mean 2 and variance 0.25 + 0.11; a cause of size 1 shifts it by 3, with a variance of 0.2.
Signatures one_column()
{
    return gaussian::signatures({{RunKind::push, 0, "plateau"}}, numbers({2}), Eigen::MatrixXd::Constant(1, 1, 0.25),
                                std::sqrt(0.11), {gaussian::cause("corner_loss", "joint 0", 1, 1, {{0, 3}}, 0.2)});
}

TEST(JointDensity, OfOneEstimateIsStudents)
{
    const Signatures s = one_column();
    const Hypotheses hypotheses(s);
    ASSERT_EQ(hypotheses.each.size(), 2U);
    const JointDensity density(s, hypotheses, {0});
    // sizes from 0.5 to 1.5, spread evenly: the shift has a variance of 3^2 / 12 beside that of the specimens; what is
    // not listed has 6 times the scatter
    for (const double x : {-4.0, 1.0, 2.0, 4.2, 7.0}) {
        const Eigen::VectorXd ratios = density.log_ratios(density.whitened(numbers({x})));
        const double healthy = student_density(x, 2, 0.36);
        EXPECT_NEAR(ratios(0), std::log(student_density(x, 5, 0.36 + 0.2 + 0.75) / healthy), 1e-12) << x;
        EXPECT_NEAR(ratios(1), std::log(student_density(x, 2, 0.36 * 37) / healthy), 1e-12) << x;
    }
    EXPECT_NEAR(density.distances()(0), 3 / 0.6, 1e-12);
}

TEST(JointDensity, QuietEstimatesDoNotMakeTheOneThatIsOffCountTwice)
{
    // forty estimates; one is off by 4, which a cause gives, the others are as quiet as can be
    constexpr Eigen::Index p = 40;
    std::vector<TestColumn> columns;
    for (Eigen::Index j = 0; j < p; ++j)
        columns.push_back({RunKind::pull, 0, "estimate " + std::to_string(j)});
    const Signatures s = gaussian::signatures(columns, Eigen::VectorXd::Zero(p), Eigen::MatrixXd::Identity(p, p), 0,
                                              {gaussian::cause("dowel", "joint 0", 1, p, {{0, 4}})});
    const Hypotheses hypotheses(s);
    const auto ratio = [&](Eigen::Index count) {
        std::vector<Eigen::Index> used;
        Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
        for (Eigen::Index j = 0; j < count; ++j)
            used.push_back(j);
        values(0) = 4;
        const JointDensity density(s, hypotheses, used);
        return density.log_ratios(density.whitened(values))(0);
    };
    // by normal numbers: 4^2 / 2, less the spread of the sizes, 1 + 16 / 12
    const double normal = 8 - std::log(1 + 16 / 12.0) / 2;
    EXPECT_LT(ratio(1), normal) << "a heavy tail";
    EXPECT_NEAR(ratio(p), normal, 0.25 * normal) << "Student's density alone: 26";
}

TEST(JointDensity, RatiosAverageToOneUnderTheHealthyDensity)
{
    const Signatures s = one_column();
    const JointDensity density(s, Hypotheses(s), {0});
    // x = 2 + sinh(u): the tails of the wide densities fall as x^-9
    double listed = 0, unlisted = 0;
    const double step = 0.001;
    for (double u = -12; u <= 12; u += step) {
        const double x = 2 + std::sinh(u);
        const Eigen::VectorXd ratios = density.log_ratios(density.whitened(numbers({x})));
        const double weight = student_density(x, 2, 0.36) * std::cosh(u) * step;
        listed += weight * std::exp(ratios(0));
        unlisted += weight * std::exp(ratios(1));
    }
    EXPECT_NEAR(listed, 1, 1e-6);
    EXPECT_NEAR(unlisted, 1, 1e-6);
}

/// Two tests that share a parameter: variances 1.25 and 1.25, covariance 1.
Signatures two_columns()
{
    Eigen::MatrixXd covariance(2, 2);
    covariance << 1.21, 1, 1, 1.21;
    return gaussian::signatures({{RunKind::push, 0, "plateau"}, {RunKind::tilt, 0, "width"}}, numbers({0, 0}),
                                covariance, 0.2,
                                {gaussian::cause("corner_loss", "joint 0", 1, 2, {{0, 1}, {1, -1}}, 0)});
}

TEST(JointDensity, OfTwoTestsCountsTheSecondGivenTheFirst)
{
    const Signatures s = two_columns();
    const Hypotheses hypotheses(s);
    const JointDensity density(s, hypotheses, {0, 1}), first(s, hypotheses, {0}), second(s, hypotheses, {1});
    for (const auto& [x, y] : std::vector<std::pair<double, double>>{{1, -1}, {2, 2}, {0.3, 1.7}}) {
        // the sizes' spread is 1 / 12 along (1, -1)
        const double healthy = student_density(x, y, 1.25, 1.25, 1);
        const double with = student_density(x - 1, y + 1, 1.25 + 1 / 12.0, 1.25 + 1 / 12.0, 1 - 1 / 12.0);
        const double joint = density.log_ratios(density.whitened(numbers({x, y})))(0);
        EXPECT_NEAR(joint, std::log(with / healthy), 1e-12) << x << ' ' << y;
        const double naive =
            first.log_ratios(first.whitened(numbers({x})))(0) + second.log_ratios(second.whitened(numbers({y})))(0);
        EXPECT_GT(std::fabs(joint - naive), 0.5) << "as if nothing were shared, at " << x << ' ' << y;
    }
}

TEST(JointDensity, ARepeatSharesTheSpecimenAndNotTheLaboratory)
{
    // one estimate of variance 1.21 among specimens, repeated with a floor of 0.04: covariance 1.21
    const Signatures s =
        gaussian::signatures({{RunKind::push, 0, "plateau"}}, numbers({0}), Eigen::MatrixXd::Constant(1, 1, 1.21), 0.2,
                             {gaussian::cause("corner_loss", "joint 0", 1, 1, {{0, 2}}, 0.3)});
    const JointDensity density(s, Hypotheses(s), {0, 0});
    const double x = 1.7, y = 2.4, more = 0.3 + 4 / 12.0;
    const double with = student_density(x - 2, y - 2, 1.25 + more, 1.25 + more, 1.21 + more);
    EXPECT_NEAR(density.log_ratios(density.whitened(numbers({x, y})))(0),
                std::log(with / student_density(x, y, 1.25, 1.25, 1.21)), 1e-12);
}

TEST(JointDensityStatistics, EstimatesThatFollowHaveTheConditionalDensity)
{
    const Signatures s = two_columns();
    const JointDensity density(s, Hypotheses(s), {0, 1});
    const double x = 2.5;
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    // scale matrix (a, c; c, b) and location of each; nothing: healthy
    struct Case {
        std::optional<std::size_t> hypothesis;
        double a, c, mx, my;
    };
    for (const Case& k : {Case{std::nullopt, 1.25, 1, 0, 0}, Case{0, 1.25 + 1 / 12.0, 1 - 1 / 12.0, 1, -1}}) {
        const int n = 40'000;
        double sum = 0, squares = 0;
        for (int i = 0; i < n; ++i) {
            Eigen::VectorXd normals(3);
            for (double& value : normals)
                value = normal(random);
            const Eigen::VectorXd first = density.whitened(numbers({x, 0})).head(1);
            const Eigen::VectorXd white = density.continued(k.hypothesis, first, normals, uniform(random));
            // back from the root of (1.25, 1; 1, 1.25)
            const double y = 1 / std::sqrt(1.25) * white(0) + std::sqrt(1.25 - 1 / 1.25) * white(1);
            sum += y;
            squares += y * y;
        }
        // Student given the first: 9 degrees of freedom, scale (8 + q) / 9 times the conditional variance
        const double mean = k.my + k.c / k.a * (x - k.mx), q = (x - k.mx) * (x - k.mx) / k.a;
        const double variance = (8 + q) / 9 * (k.a - k.c * k.c / k.a) * 9 / 7;
        EXPECT_NEAR(sum / n, mean, 5 * std::sqrt(variance / n));
        EXPECT_NEAR(squares / n - sum / n * sum / n, variance, 0.05 * variance);
    }
}

TEST(Hypotheses, HaveTheSizesBetweenTheSimulatedOnes)
{
    const Signatures s = gaussian::signatures(
        {{RunKind::push, 0, "plateau"}}, numbers({0}), Eigen::MatrixXd::Identity(1, 1), 0.1,
        {gaussian::cause("wedge", "block 0", 3, 1, {{0, 12}}), gaussian::cause("wedge", "block 0", 1, 1, {{0, 2}}),
         gaussian::cause("wedge", "block 0", -1, 1, {{0, -2}})});
    const Hypotheses h(s);
    ASSERT_EQ(h.causes.size(), 1U);
    ASSERT_EQ(h.each.size(), 5U); // 1, 2, 3; -1; not listed
    EXPECT_DOUBLE_EQ(h.each[1].size, 2);
    EXPECT_DOUBLE_EQ(h.each[1].shift(0), 7) << "between 2 and 12";
    EXPECT_DOUBLE_EQ(h.each[0].from, 0.5);
    EXPECT_DOUBLE_EQ(h.each[0].to, 1.5);
    EXPECT_DOUBLE_EQ(h.each[2].to, 3.5);
    EXPECT_DOUBLE_EQ(h.each[3].size, -1);
    EXPECT_DOUBLE_EQ(h.each[3].shift(0), -2);
    EXPECT_DOUBLE_EQ(h.each[0].share, 0.25);
    EXPECT_EQ(h.each[4].cause, -1);
}

} // namespace
} // namespace stylobate

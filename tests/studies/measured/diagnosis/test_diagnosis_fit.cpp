/// Smoothing by local cubics and the robust regression of the diagnosis, against what mathematics says of them.

#include "studies/measured/diagnosis/evidence/robust_fit.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace stylobate {
namespace {

TEST(LocalCubic, ASeriesAndItsSamplesHaveTheSameBits)
{
    // longer than several groups of samples that are computed together, and not a multiple of them
    std::vector<double> series;
    for (int i = 0; i < 83; ++i)
        series.push_back(std::sin(0.37 * i) + 1e-7 * i * i);
    const LocalCubic smoothing(7, 0.01);
    for (int d = 0; d < 3; ++d) {
        const std::vector<double> all = smoothing.apply(d, series);
        ASSERT_EQ(all.size(), series.size());
        for (std::size_t i = 0; i < series.size(); ++i)
            EXPECT_EQ(all[i], smoothing.at(d, series, i)) << d << ", " << i;
        EXPECT_EQ(all[6], 0);
        EXPECT_NE(all[7], 0);
        EXPECT_NE(all[75], 0);
        EXPECT_EQ(all[76], 0);
    }
    EXPECT_EQ(LocalCubic(7, 0.01).apply(0, {1, 2, 3}), std::vector<double>(3, 0.0)) << "shorter than the window";
}

/// This file does not include what fixes them: the program has them by linking the fit.
TEST(RobustFit, SumsInBlocksThatAreNotThoseOfThisMachine)
{
    EXPECT_EQ(Eigen::l1CacheSize(), 32 << 10);
    EXPECT_EQ(Eigen::l2CacheSize(), 1 << 20);
    EXPECT_EQ(Eigen::l3CacheSize(), 32 << 20);
}

TEST(LocalCubic, IsExactOnCubics)
{
    const double dt = 0.002;
    for (const int half : {2, 3, 6, 20}) {
        const LocalCubic smooth(half, dt);
        std::vector<double> series;
        const auto value = [](double t) { return 0.3 - 2 * t + 7 * t * t - 11 * t * t * t; };
        for (int i = 0; i < 80; ++i)
            series.push_back(value(dt * i));
        const std::vector<double> x = smooth.apply(0, series), v = smooth.apply(1, series), a = smooth.apply(2, series);
        for (int i = 0; i < 80; ++i) {
            const double t = dt * i;
            const auto k = static_cast<std::size_t>(i);
            if (i < half || i + half >= 80) {
                EXPECT_EQ(x[k], 0);
                EXPECT_EQ(a[k], 0);
                continue;
            }
            // rounding of the samples, over the powers of the window that derivatives are taken with
            const double window = half * dt;
            EXPECT_NEAR(x[k], value(t), 1e-14);
            EXPECT_NEAR(v[k], -2 + 14 * t - 33 * t * t, 1e-14 / window);
            EXPECT_NEAR(a[k], 14 - 66 * t, 1e-13 / (window * window));
        }
    }
}

TEST(LocalCubic, NoiseIsTheSpreadOfManyNoisySeries)
{
    const int half = 6, n = 2 * half + 1, trials = 20000;
    const LocalCubic smooth(half, 0.004);
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    double squares[3] = {};
    for (int k = 0; k < trials; ++k) {
        std::vector<double> series(n);
        for (double& v : series)
            v = normal(random);
        for (int d = 0; d < 3; ++d)
            squares[d] += std::pow(smooth.apply(d, series)[half], 2);
    }
    // the standard error of such a spread is 0.5 %: four of them
    for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(std::sqrt(squares[d] / trials) / smooth.noise(d), 1, 0.02) << "derivative " << d;
}

/// y = a + b t at n points, with errors that are given.
RegressionData line(int n, double a, double b, const std::vector<double>& errors, double sd)
{
    RegressionData data;
    data.columns.resize(n, 2);
    data.values.resize(n);
    data.sd = Eigen::VectorXd::Constant(n, sd);
    data.group.assign(static_cast<std::size_t>(n), 0);
    data.prior_sd = Eigen::VectorXd::Constant(2, std::numeric_limits<double>::infinity());
    for (int i = 0; i < n; ++i) {
        const double t = -1 + 2.0 * i / (n - 1);
        data.columns(i, 0) = 1;
        data.columns(i, 1) = t;
        data.values(i) = a + b * t + errors[static_cast<std::size_t>(i)];
    }
    return data;
}

/// Errors of one absolute size: Student's weights are then equal, and least squares is the answer.
std::vector<double> equal_errors(int n, double size)
{
    std::vector<double> errors;
    for (int i = 0; i < n; ++i)
        errors.push_back(i / 2 % 2 == i % 2 ? size : -size); // + - - + + - - +: of no sum and no slope
    return errors;
}

TEST(RobustFit, IsWeightedLeastSquaresWithoutOutliers)
{
    // values without error under any weights; and the covariance of the closed form with the scale and weight found
    const int n = 40;
    RegressionData data = line(n, 0.7, -1.3, std::vector<double>(n, 0.0), 0.1);
    for (int i = 0; i < n; ++i)
        data.sd(i) = i % 3 == 0 ? 0.05 : 0.2;
    const RobustFit fit = robust_fit(data);
    EXPECT_NEAR(fit.coefficients(0), 0.7, 1e-12);
    EXPECT_NEAR(fit.coefficients(1), -1.3, 1e-12);
    // no error: every weight is (nu + 1) / nu, the scale is its least value
    double s0 = 0, s1 = 0, s2 = 0;
    for (int i = 0; i < n; ++i) {
        const double w = (student_freedom + 1) / student_freedom / std::pow(data.sd(i) * fit.scale(0), 2);
        const double t = data.columns(i, 1);
        s0 += w;
        s1 += w * t;
        s2 += w * t * t;
    }
    const double det = s0 * s2 - s1 * s1;
    EXPECT_NEAR(fit.covariance(0, 0), s2 / det, 1e-9 * s2 / det);
    EXPECT_NEAR(fit.covariance(1, 1), s0 / det, 1e-9 * s0 / det);
    EXPECT_NEAR(fit.covariance(0, 1), -s1 / det, 1e-9 * s0 / det);
}

TEST(RobustFit, EqualErrorsWeighEqually)
{
    const int n = 400;
    const RegressionData data = line(n, 2, 0.5, equal_errors(n, 0.1), 0.1);
    double y0 = 0, y1 = 0, t2 = 0;
    for (int i = 0; i < n; ++i) {
        y0 += data.values(i);
        y1 += data.values(i) * data.columns(i, 1);
        t2 += std::pow(data.columns(i, 1), 2);
    }
    const RobustFit fit = robust_fit(data);
    EXPECT_NEAR(fit.coefficients(0), y0 / n, 1e-5); // the points are symmetric about 0
    EXPECT_NEAR(fit.coefficients(1), y1 / t2, 1e-5);
    // the scale s of errors of the size 1 (in sd): s^2 = (8 + n w) / (8 + n), 8 errors of the scale 1 beforehand, with
    // Student's weight w = 5 / (4 + 1 / s^2)
    const double s2 = std::pow(fit.scale(0), 2), w = 5 / (4 + 1 / s2);
    EXPECT_NEAR(s2, (8 + n * w) / (8 + n), 1e-6);
    EXPECT_NEAR(fit.covariance(1, 1), 0.01 * s2 / (w * t2), 1e-6 * 0.01 / t2);
}

TEST(RobustFit, SizesAreWithinTheirIntervals)
{
    // Student's errors of the stated scale: 200 fits of 60 samples; 95 % intervals hold the truth in 95 %
    std::mt19937_64 random(5);
    std::student_t_distribution<double> student(student_freedom);
    int inside = 0;
    const int trials = 200, n = 60;
    for (int k = 0; k < trials; ++k) {
        std::vector<double> errors;
        for (int i = 0; i < n; ++i)
            errors.push_back(0.3 * student(random));
        const RobustFit fit = robust_fit(line(n, 1, -2, errors, 0.3));
        inside += std::fabs(fit.coefficients(1) + 2) < 1.96 * std::sqrt(fit.covariance(1, 1)) ? 1 : 0;
    }
    EXPECT_GE(inside, 175); // 190 expected, 3.1 its standard deviation: a false alarm in 1e6; EM's intervals are short
    EXPECT_LE(inside, 199);
}

TEST(RobustFit, OutliersAreIgnored)
{
    const int n = 60;
    std::mt19937_64 random(8);
    std::normal_distribution<double> normal(0, 0.01);
    std::vector<double> errors;
    for (int i = 0; i < n; ++i)
        errors.push_back(i % 6 == 5 ? 50.0 : normal(random));
    const RobustFit fit = robust_fit(line(n, 1, 3, errors, 0.01));
    // least squares would be off by 50 / 6 = 8.3
    EXPECT_NEAR(fit.coefficients(0), 1, 0.02);
    EXPECT_NEAR(fit.coefficients(1), 3, 0.03);
}

TEST(RobustFit, PriorsPullAsInRidgeRegression)
{
    // One coefficient, values all y: what is sought is the maximum of log Student + log Gauss, found here by bisection
    // of its derivative at the scale that was fitted.
    const int n = 12;
    const double y = 0.6, sd = 0.5, prior = 0.1;
    RegressionData data;
    data.columns = Eigen::MatrixXd::Ones(n, 1);
    data.values = Eigen::VectorXd::Constant(n, y);
    data.sd = Eigen::VectorXd::Constant(n, sd);
    data.group.assign(n, 0);
    data.prior_sd = Eigen::VectorXd::Constant(1, prior);
    const RobustFit fit = robust_fit(data);
    const double s = sd * fit.scale(0);
    double low = 0, high = y;
    for (int i = 0; i < 100; ++i) {
        const double c = (low + high) / 2, r = y - c;
        const double slope = n * (student_freedom + 1) * r / (student_freedom * s * s + r * r) - c / (prior * prior);
        (slope > 0 ? low : high) = c;
    }
    EXPECT_NEAR(fit.coefficients(0), low, 1e-5);
    EXPECT_LT(fit.coefficients(0), 0.5 * y); // it does pull
    EXPECT_NEAR(fit.log_prior, -0.5 * std::pow(low / prior, 2), 1e-4);
    EXPECT_NEAR(fit.log_posterior, fit.log_density.sum() + fit.log_prior, 1e-12);

    data.prior_sd(0) = 1e-6;
    EXPECT_NEAR(robust_fit(data).coefficients(0), 0, 1e-9);
    data.prior_sd(0) = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(robust_fit(data).coefficients(0), y, 1e-12);
}

TEST(RobustFit, AColumnOfZerosIsLeftAtZero)
{
    RegressionData data = line(20, 1, 1, std::vector<double>(20, 0.0), 0.1);
    data.columns.col(1).setZero();
    data.values.setConstant(1);
    const RobustFit fit = robust_fit(data);
    EXPECT_EQ(fit.coefficients(1), 0);
    EXPECT_NEAR(fit.coefficients(0), 1, 1e-12);
}

TEST(RobustFit, DensityIntegratesToOne)
{
    for (const double sd : {0.02, 1.0, 40.0}) {
        // r = sd tan(angle): the whole line, the tails as well
        double sum = 0;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double angle = (-0.5 + (i + 0.5) / steps) * M_PI, r = sd * std::tan(angle);
            sum += std::exp(student_log_density(r, sd)) * sd / std::pow(std::cos(angle), 2) * M_PI / steps;
        }
        EXPECT_NEAR(sum, 1, 1e-8) << sd;
    }
}

} // namespace
} // namespace stylobate

/// The smoother against generalized least squares over all unknowns at once: the state at the beginning and the changes
/// of the jerk, with their prior variances.

#include "ensemble/numerics/kalman_smoother.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

namespace stylobate::kalman {
namespace {

/// Five steps of 0.5 s: places with an offset at most of them, accelerations with another one, at two a second place.
Problem problem()
{
    Problem p;
    p.dt_s = 0.5;
    p.start_mean = {0.1, 0, 0.2, 0, 0, 0};
    p.start_variance = {1, 0.5, 2, 0.3, 0.25, 0.16};
    const double place[] = {0.2, 0.1, 0.5, 0.9, 0.4}, acceleration[] = {0.5, 1.1, -0.3, 0.2, -0.8};
    for (std::size_t k = 0; k < 5; ++k) {
        p.at.emplace_back();
        if (k != 2)
            p.at.back().push_back({0, {1, 0, 0, 0, 0, 1}, place[k], 0.04});
        p.at.back().push_back({1, {0, 0, 1, 0, 1, 0}, acceleration[k], 0.09});
        if (k == 1 || k == 3) // a fifth of a second after the step
            p.at.back().push_back({2, {1, 0.2, 0.02, 0.2 * 0.02 / 3, 0, 0}, place[k] + 0.1, 0.01});
    }
    return p;
}

/// The same by one system of equations. Unknowns: the state at the beginning and the jerk's change at each later step.
struct LeastSquares {
    std::vector<Vector> mean, variance;
    double log_likelihood = 0; ///< without its constants
};
LeastSquares least_squares(const Problem& p, const Process& process)
{
    constexpr Eigen::Index all = states;
    const auto steps = static_cast<Eigen::Index>(p.steps()), unknowns = all + steps - 1;
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(all, all);
    const double d = p.dt_s;
    F(u, v) = F(v, a) = F(a, j) = d;
    F(u, a) = F(v, j) = d * d / 2;
    F(u, j) = d * d * d / 6;
    F(j, j) = process.smooth_jerk ? 1 : 0;
    std::vector<Eigen::MatrixXd> state = {Eigen::MatrixXd::Identity(all, unknowns)};
    for (Eigen::Index k = 1; k < steps; ++k) {
        state.push_back(F * state.back());
        state.back()(j, all + k - 1) += 1;
    }
    Eigen::VectorXd prior = Eigen::VectorXd::Zero(unknowns), variance(unknowns);
    for (Eigen::Index i = 0; i < all; ++i) {
        prior[i] = p.start_mean[static_cast<std::size_t>(i)];
        variance[i] = p.start_variance[static_cast<std::size_t>(i)];
    }
    if (!process.smooth_jerk)
        variance[j] = process.sd * process.sd;
    variance.tail(steps - 1).setConstant(process.sd * process.sd);
    std::vector<Eigen::RowVectorXd> rows;
    std::vector<double> value, noise;
    for (std::size_t k = 0; k < p.steps(); ++k)
        for (const Measurement& m : p.at[k]) {
            rows.push_back(Eigen::Map<const Eigen::RowVectorXd>(m.row.data(), all) * state[k]);
            value.push_back(m.value - rows.back().dot(prior));
            noise.push_back(m.variance);
        }
    Eigen::MatrixXd H(static_cast<Eigen::Index>(rows.size()), unknowns);
    for (std::size_t i = 0; i < rows.size(); ++i)
        H.row(static_cast<Eigen::Index>(i)) = rows[i];
    const Eigen::VectorXd y = Eigen::Map<Eigen::VectorXd>(value.data(), H.rows());
    const Eigen::VectorXd R = Eigen::Map<Eigen::VectorXd>(noise.data(), H.rows());
    const Eigen::MatrixXd S = H * variance.asDiagonal() * H.transpose() + Eigen::MatrixXd(R.asDiagonal());
    const Eigen::LLT<Eigen::MatrixXd> factor(S);
    const Eigen::MatrixXd gain = factor.solve(H * variance.asDiagonal()).transpose();
    const Eigen::VectorXd posterior = prior + gain * y;
    const Eigen::MatrixXd covariance =
        Eigen::MatrixXd(variance.asDiagonal()) - gain * H * Eigen::MatrixXd(variance.asDiagonal());
    LeastSquares found;
    found.log_likelihood = -factor.matrixLLT().diagonal().array().log().sum() - 0.5 * y.dot(factor.solve(y));
    for (const Eigen::MatrixXd& of : state) {
        const Eigen::VectorXd mean = of * posterior, own = (of * covariance * of.transpose()).diagonal();
        found.mean.emplace_back();
        found.variance.emplace_back();
        for (Eigen::Index i = 0; i < all; ++i) {
            found.mean.back()[static_cast<std::size_t>(i)] = mean[i];
            found.variance.back()[static_cast<std::size_t>(i)] = own[i];
        }
    }
    return found;
}

TEST(KalmanSmoother, IsThatOfLeastSquares)
{
    const Problem p = problem();
    for (const bool smooth_jerk : {false, true})
        for (const double sd : {0.1, 2.0}) {
            const Smoothed found = smoothed(p, {smooth_jerk, sd});
            const LeastSquares want = least_squares(p, {smooth_jerk, sd});
            for (std::size_t k = 0; k < p.steps(); ++k)
                for (std::size_t i = 0; i < states; ++i) {
                    EXPECT_NEAR(found.mean[k][i], want.mean[k][i], 1e-9) << smooth_jerk << sd << k << i;
                    EXPECT_NEAR(found.variance[k][i], want.variance[k][i], 1e-9) << smooth_jerk << sd << k << i;
                }
        }
}

/// The likelihood is flat at its maximum: a hundredth of a decade more or less changes nothing, a half does.
TEST(KalmanSmoother, TheLikeliestProcessHasTheLargestLikelihood)
{
    const Problem p = problem();
    for (const bool smooth_jerk : {false, true}) {
        double likelihood = 0;
        const Process found = likeliest(p, smooth_jerk, likelihood);
        const double own = least_squares(p, found).log_likelihood;
        EXPECT_NEAR(likelihood, own, 1e-3);
        for (const double factor : {0.3, 3.0})
            EXPECT_LT(least_squares(p, {smooth_jerk, factor * found.sd}).log_likelihood, own + 1e-6) << smooth_jerk;
    }
}

} // namespace
} // namespace stylobate::kalman

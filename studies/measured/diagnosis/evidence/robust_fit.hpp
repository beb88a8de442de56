#pragma once
/// Linear regression with Student's t for the errors, Gaussian priors on the coefficients, and one scale for each group
/// of samples: maximum a posteriori by expectation maximization.

#include <Eigen/Core>

#include <vector>

namespace stylobate {

/// Degrees of freedom: impacts that slip into a window make heavy tails.
inline constexpr double student_freedom = 4;

struct RegressionData {
    Eigen::MatrixXd columns; ///< (n x p)
    Eigen::VectorXd values;  ///< (n)
    Eigen::VectorXd sd;      ///< (n) of each value, up to its group's factor
    std::vector<int> group;  ///< (n) from 0
    int groups = 1;
    Eigen::VectorXd prior_sd; ///< (p) about 0; infinity: none
    /// (p) whether a coefficient cannot be negative; empty: none. One that would be is held at 0.
    std::vector<bool> one_sided = {};
};

struct RobustFit {
    Eigen::VectorXd coefficients; ///< (p)
    Eigen::MatrixXd covariance;   ///< (p x p); 0 of coefficients that are held at 0
    std::vector<bool> held;       ///< (p)
    Eigen::VectorXd weights;      ///< (n) of each sample's square, Student's over its variance
    Eigen::VectorXd scale;        ///< (groups) factor of the samples' sd
    Eigen::VectorXd log_density;  ///< (n) of each sample
    Eigen::VectorXd errors;       ///< (n) values less what the columns give
    Eigen::VectorXd residuals;    ///< (n) the same over their sd and scale
    double log_prior = 0;
    double log_posterior = 0; ///< sum of the above two
};

/// @pre n > 0; prior_sd > 0
RobustFit robust_fit(const RegressionData& data);

/// log of Student's density of `residual` with scale `sd`
double student_log_density(double residual, double sd);

} // namespace stylobate

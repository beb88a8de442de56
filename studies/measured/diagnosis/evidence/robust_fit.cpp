#include "studies/measured/diagnosis/evidence/robust_fit.hpp"

#include "ensemble/numerics/eigen_blocks.hpp"
#include "ensemble/numerics/interval.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <numbers>

namespace stylobate {

namespace {

constexpr int iterations = 60;
constexpr double settled = 1e-7;
// A group's errors are never taken to be smaller than this part of the known noise: a handful of samples may agree by
// chance.
constexpr double least_scale = 0.5;
// Samples that count as seen beforehand, with the scale 1: a group of few samples keeps a sensible one.
constexpr double prior_samples = 8;

/// The normal equations without the coefficients that are held at 0.
void hold(Eigen::MatrixXd& normal, Eigen::VectorXd& right, const std::vector<bool>& held)
{
    for (Eigen::Index k = 0; k < right.size(); ++k)
        if (held[static_cast<std::size_t>(k)]) {
            normal.row(k).setZero();
            normal.col(k).setZero();
            normal(k, k) = 1;
            right(k) = 0;
        }
}

} // namespace

double student_log_density(double residual, double sd)
{
    constexpr double nu = student_freedom;
    const double z = residual / sd;
    return log_gamma((nu + 1) / 2) - log_gamma(nu / 2) - 0.5 * std::log(nu * std::numbers::pi) - std::log(sd) -
           (nu + 1) / 2 * std::log1p(z * z / nu);
}

RobustFit robust_fit(const RegressionData& data)
{
    constexpr double nu = student_freedom;
    const Eigen::Index n = data.columns.rows(), p = data.columns.cols();
    Eigen::VectorXd precision(p);
    for (Eigen::Index k = 0; k < p; ++k)
        precision(k) = std::isinf(data.prior_sd(k)) ? 0 : 1 / (data.prior_sd(k) * data.prior_sd(k));

    RobustFit fit;
    fit.coefficients = Eigen::VectorXd::Zero(p);
    fit.scale = Eigen::VectorXd::Ones(data.groups);
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
    Eigen::MatrixXd normal;
    const auto one_sided = [&](Eigen::Index k) {
        return !data.one_sided.empty() && data.one_sided[static_cast<std::size_t>(k)];
    };
    for (int i = 0; i < iterations; ++i) {
        Eigen::VectorXd w(n);
        for (Eigen::Index k = 0; k < n; ++k) {
            const double s = data.sd(k) * fit.scale(data.group[static_cast<std::size_t>(k)]);
            w(k) = weights(k) / (s * s);
        }
        normal = data.columns.transpose() * w.asDiagonal() * data.columns;
        normal.diagonal() += precision;
        // a column that is nothing but zeros, without a prior, is left at 0
        for (Eigen::Index k = 0; k < p; ++k)
            if (normal(k, k) == 0)
                normal(k, k) = 1;
        Eigen::VectorXd right = data.columns.transpose() * (w.array() * data.values.array()).matrix();
        Eigen::VectorXd next = normal.ldlt().solve(right);
        fit.weights = w;
        fit.held.assign(static_cast<std::size_t>(p), false);
        for (bool negative = true; negative;) {
            negative = false;
            for (Eigen::Index k = 0; k < p; ++k)
                if (one_sided(k) && next(k) < 0)
                    fit.held[static_cast<std::size_t>(k)] = negative = true;
            if (negative) {
                hold(normal, right, fit.held);
                next = normal.ldlt().solve(right);
            }
        }
        const double moved = (next - fit.coefficients).cwiseAbs().maxCoeff();
        fit.coefficients = next;

        const Eigen::VectorXd residual = data.values - data.columns * next;
        Eigen::VectorXd sum = Eigen::VectorXd::Constant(data.groups, prior_samples);
        Eigen::VectorXd count = Eigen::VectorXd::Constant(data.groups, prior_samples);
        for (Eigen::Index k = 0; k < n; ++k) {
            const auto g = data.group[static_cast<std::size_t>(k)];
            const double z = residual(k) / (data.sd(k) * fit.scale(g));
            weights(k) = (nu + 1) / (nu + z * z);
            sum(g) += weights(k) * std::pow(residual(k) / data.sd(k), 2);
            count(g) += 1;
        }
        double changed = 0;
        for (int g = 0; g < data.groups; ++g) {
            const double scale = std::max(least_scale, std::sqrt(sum(g) / count(g)));
            changed = std::max(changed, std::fabs(scale / fit.scale(g) - 1));
            fit.scale(g) = scale;
        }
        if (i > 2 && moved <= settled * (1 + fit.coefficients.cwiseAbs().maxCoeff()) && changed < settled)
            break;
    }
    fit.covariance = normal.ldlt().solve(Eigen::MatrixXd::Identity(p, p));
    for (Eigen::Index k = 0; k < p; ++k)
        if (fit.held[static_cast<std::size_t>(k)])
            fit.covariance(k, k) = 0;
    fit.log_density.resize(n);
    fit.residuals.resize(n);
    fit.errors = data.values - data.columns * fit.coefficients;
    for (Eigen::Index k = 0; k < n; ++k) {
        const double sd = data.sd(k) * fit.scale(data.group[static_cast<std::size_t>(k)]);
        fit.log_density(k) = student_log_density(fit.errors(k), sd);
        fit.residuals(k) = fit.errors(k) / sd;
    }
    fit.log_prior = -0.5 * (precision.array() * fit.coefficients.array().square()).sum();
    fit.log_posterior = fit.log_density.sum() + fit.log_prior;
    return fit;
}

} // namespace stylobate

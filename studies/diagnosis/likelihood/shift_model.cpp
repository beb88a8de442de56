#include "studies/diagnosis/likelihood/shift_model.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace stylobate {

namespace {

// Of chi-squared with one or two degrees of freedom: from no shrinkage to what is left of strong signals alone.
constexpr std::array kappas = {0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 11.0, 15.0, 20.0};

/// Stein's unbiased estimate of the risk of shrinking groups of `d` unit normal numbers with these squared lengths by
/// max(0, 1 - kappa / F).
double risk(const Eigen::VectorXd& f, double d, double kappa)
{
    double sum = 0;
    for (const double each : f)
        sum += each <= kappa ? each - d : d + kappa * (kappa - 2 * (d - 2)) / each;
    return sum;
}

} // namespace

ShiftModel::ShiftModel(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& sizes)
{
    std::set<double> positive, negative;
    for (const double z : sizes)
        (z > 0 ? positive : negative).insert(std::fabs(z));
    curved_ = std::max(positive.size(), negative.size()) > 1 && sizes.size() > 3;
    least_ = sizes.minCoeff();
    most_ = sizes.maxCoeff();
    Eigen::MatrixXd design(sizes.size(), curved_ ? 2 : 1);
    design.col(0) = sizes;
    if (curved_)
        design.col(1) = sizes.cwiseProduct(sizes.cwiseAbs()); // odd: a side has its own sign
    const Eigen::MatrixXd normal = design.transpose() * design;
    covariance_ = normal.inverse();
    coefficients_ = covariance_ * (design.transpose() * residuals);

    Eigen::VectorXd f(residuals.cols());
    for (Eigen::Index j = 0; j < f.size(); ++j)
        f(j) = coefficients_.col(j).dot(normal * coefficients_.col(j));
    const auto d = static_cast<double>(design.cols());
    double best = HUGE_VAL, chosen = 0;
    for (const double kappa : kappas)
        if (const double r = risk(f, d, kappa); r < best) {
            best = r;
            chosen = kappa;
        }
    kept_ = 0;
    for (Eigen::Index j = 0; j < f.size(); ++j) {
        const double factor = f(j) > 0 ? std::max(0.0, 1 - chosen / f(j)) : 0;
        coefficients_.col(j) *= factor;
        kept_ += factor / static_cast<double>(f.size());
    }
}

Eigen::VectorXd ShiftModel::mean(double size) const
{
    Eigen::VectorXd out = size * coefficients_.row(0).transpose();
    if (curved_)
        out += size * std::fabs(size) * coefficients_.row(1).transpose();
    return out;
}

double ShiftModel::variance(double size) const
{
    Eigen::VectorXd at(covariance_.rows());
    at(0) = size;
    if (curved_)
        at(1) = size * std::fabs(size);
    return kept_ * at.dot(covariance_ * at);
}

} // namespace stylobate

#include "studies/measured/diagnosis/campaigns/synthetic_likelihood.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace stylobate {

namespace {

constexpr int size_steps = 9; // of a cause, over the range that was simulated
// Variance along a common pattern, in units of a statistic's own: as good as unknown.
constexpr double unknown = 1e4;

double half_log_determinant(const Eigen::VectorXd& variances)
{
    return 0.5 * variances.array().log().sum();
}

/// Sizes of equal prior weight, both ends included, without the neutral one.
std::vector<double> grid(const ShiftModel& cause)
{
    std::vector<double> out;
    const double from = cause.least() > 0 ? 0 : cause.least(), to = cause.most() < 0 ? 0 : cause.most();
    for (int i = 0; i <= size_steps; ++i) {
        const double z = from + (to - from) * i / size_steps;
        if (std::fabs(z) > 1e-9 * (to - from))
            out.push_back(z);
    }
    return out;
}

/// A quantile of the sizes by the weights of the grid's points, linear between the middles of the cells.
double weighted_quantile(const std::vector<double>& size, const std::vector<double>& weight, double part)
{
    double below = 0;
    for (std::size_t i = 0; i < size.size(); ++i) {
        if (below + weight[i] >= part) {
            const double left =
                i == 0 ? size[0] - (size.size() > 1 ? (size[1] - size[0]) / 2 : 0) : (size[i - 1] + size[i]) / 2;
            const double right = i + 1 == size.size() ? size[i] + (i > 0 ? (size[i] - size[i - 1]) / 2 : 0)
                                                      : (size[i] + size[i + 1]) / 2;
            return left + (right - left) * (weight[i] > 0 ? (part - below) / weight[i] : 0.5);
        }
        below += weight[i];
    }
    return size.back();
}

} // namespace

SyntheticLikelihood::SyntheticLikelihood(const LawAdjustment& law, const std::vector<ShiftModel>& causes,
                                         const Eigen::MatrixXd& common)
    : freedom_(law.freedom())
{
    const auto used = static_cast<Eigen::Index>(law.used().size());
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(used, used);
    for (const auto& pattern : common.rowwise()) {
        const Eigen::VectorXd along = law.decorrelated(pattern.transpose());
        covariance += unknown * along * along.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
    axes_ = solver.eigenvectors();
    variances_ = solver.eigenvalues();
    log_determinant_ = half_log_determinant(variances_);
    for (const ShiftModel& cause : causes) {
        std::vector<Point> points;
        for (const double size : grid(cause)) {
            Point point;
            point.size = size;
            point.mean = axes_.transpose() * cause.mean(size);
            point.variance = cause.variance(size);
            point.log_determinant = half_log_determinant((variances_.array() + point.variance).matrix());
            points.push_back(std::move(point));
        }
        points_.push_back(std::move(points));
    }
}

double SyntheticLikelihood::log_density(double variance, double log_determinant, const Eigen::VectorXd& along) const
{
    const double distance = (along.array().square() / (variances_.array() + variance)).sum();
    return student_kernel(distance, static_cast<double>(along.size()), freedom_) - log_determinant;
}

std::vector<CauseLikelihood> SyntheticLikelihood::of(const Eigen::VectorXd& residual) const
{
    const Eigen::VectorXd left = axes_.transpose() * residual;
    const double nothing = log_density(0, log_determinant_, left);
    std::vector<CauseLikelihood> out;
    for (const std::vector<Point>& points : points_) {
        std::vector<double> gain, size, weight;
        for (const Point& point : points) {
            gain.push_back(log_density(point.variance, point.log_determinant, left - point.mean) - nothing);
            size.push_back(point.size);
        }
        const double best = *std::max_element(gain.begin(), gain.end());
        double sum = 0;
        for (const double g : gain) {
            weight.push_back(std::exp(g - best));
            sum += weight.back();
        }
        CauseLikelihood cause;
        cause.gain = best + std::log(sum / static_cast<double>(gain.size()));
        for (std::size_t i = 0; i < weight.size(); ++i) {
            weight[i] /= sum;
            cause.size += weight[i] * size[i];
        }
        cause.low = weighted_quantile(size, weight, 0.05);
        cause.high = weighted_quantile(size, weight, 0.95);
        out.push_back(cause);
    }
    return out;
}

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

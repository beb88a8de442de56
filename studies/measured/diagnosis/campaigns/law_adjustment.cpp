#include "studies/measured/diagnosis/campaigns/law_adjustment.hpp"

#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {

namespace {

// A statistic that fewer of the nulls have does not show what nulls give.
constexpr double least_share = 0.8;
// Ridge on standardized descriptors: two of them may show the same, and there are many for the campaigns there are.
constexpr double ridge = 0.05;
constexpr int parts = 5;
constexpr std::array freedoms = {4.0, 6.0, 9.0, 14.0, 22.0, 35.0, 60.0, 120.0, 1000.0};

} // namespace

double student_kernel(double distance2, double p, double freedom)
{
    return -0.5 * (freedom + p) * std::log1p(distance2 / freedom);
}

Eigen::MatrixXd shrunk_correlation(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& weights)
{
    const Eigen::Index p = residuals.cols();
    const Eigen::VectorXd w = weights / weights.sum();
    const double effective = 1 / w.squaredNorm();
    const Eigen::MatrixXd weighted = w.asDiagonal() * residuals;
    Eigen::MatrixXd sample = residuals.transpose() * weighted;
    const Eigen::VectorXd sd = sample.diagonal().cwiseMax(1e-12).cwiseSqrt();
    sample = sd.cwiseInverse().asDiagonal() * sample * sd.cwiseInverse().asDiagonal();
    // variance of each correlation: that of the products of two residuals, over the number of campaigns
    const Eigen::MatrixXd unit = residuals * sd.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd square = unit.cwiseProduct(unit);
    const Eigen::MatrixXd fourth = square.transpose() * w.asDiagonal() * square;
    double noise = 0, signal = 0;
    for (Eigen::Index j = 0; j < p; ++j)
        for (Eigen::Index k = 0; k < j; ++k) {
            noise += (fourth(j, k) - sample(j, k) * sample(j, k)) / std::max(effective - 1, 1.0);
            signal += sample(j, k) * sample(j, k);
        }
    const double shrink = signal > 0 ? std::clamp(noise / signal, 0.02, 1.0) : 1.0;
    Eigen::MatrixXd out = (1 - shrink) * sample;
    out.diagonal().setOnes();
    return out;
}

LawAdjustment::LawAdjustment(const CampaignTable& nulls, const Eigen::VectorXd& weights,
                             const std::vector<bool>& wanted, const std::vector<double>& least_scatter)
{
    const Eigen::Index n = nulls.statistics.rows(), q = nulls.descriptors.cols();
    for (Eigen::Index j = 0; j < nulls.statistics.cols(); ++j) {
        const auto finite = nulls.statistics.col(j).array().isFinite().count();
        if (wanted[static_cast<std::size_t>(j)] && static_cast<double>(finite) >= least_share * static_cast<double>(n))
            used_.push_back(j);
    }
    middle_.resize(q);
    spread_.resize(q);
    for (Eigen::Index k = 0; k < q; ++k) {
        std::vector<double> values(nulls.descriptors.col(k).begin(), nulls.descriptors.col(k).end());
        middle_(k) = upper_median(values);
        for (double& value : values)
            value = std::fabs(value - middle_(k));
        spread_(k) = std::max(1.4826 * upper_median(std::move(values)), 1e-12);
    }
    regress(nulls, weights, least_scatter);
    Eigen::MatrixXd residuals(n, static_cast<Eigen::Index>(used_.size()));
    for (Eigen::Index i = 0; i < n; ++i)
        residuals.row(i) = residual(nulls.descriptors.row(i), nulls.statistics.row(i)).transpose();
    correlation_ = shrunk_correlation(residuals, weights);
    find_tails(residuals, weights);
    // (the shrinkage keeps it far from singular)
    whitening_ = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale_ * correlation_).operatorInverseSqrt();
}

Eigen::VectorXd LawAdjustment::standardized(const Eigen::VectorXd& descriptors) const
{
    // beyond five spreads a straight line is no guide
    return ((descriptors - middle_).cwiseQuotient(spread_)).cwiseMax(-5).cwiseMin(5);
}

void LawAdjustment::regress(const CampaignTable& nulls, const Eigen::VectorXd& weights,
                            const std::vector<double>& least_scatter)
{
    const Eigen::Index n = nulls.statistics.rows(), q = nulls.descriptors.cols();
    const auto p = static_cast<Eigen::Index>(used_.size());
    coefficients_.resize(1 + q, p);
    scatter_.resize(p);
    Eigen::MatrixXd design(n, 1 + q);
    for (Eigen::Index i = 0; i < n; ++i)
        design.row(i) << 1, standardized(nulls.descriptors.row(i)).transpose();
    for (Eigen::Index j = 0; j < p; ++j) {
        const Eigen::VectorXd y = nulls.statistics.col(used_[static_cast<std::size_t>(j)]);
        const Eigen::VectorXd w = y.array().isFinite().select(weights.array(), Eigen::ArrayXd::Zero(n)).matrix();
        Eigen::VectorXd known = y.array().isFinite().select(y.array(), Eigen::ArrayXd::Zero(n)).matrix();
        // one extreme campaign does not bend the line: two rounds, the second with what is left cut off
        for (int round = 0; round < 2; ++round) {
            Eigen::MatrixXd normal = design.transpose() * w.asDiagonal() * design;
            normal.diagonal().tail(q).array() += ridge * w.sum();
            coefficients_.col(j) = normal.ldlt().solve(design.transpose() * (w.asDiagonal() * known));
            const Eigen::VectorXd expected = design * coefficients_.col(j);
            // the ridge takes less than one degree of freedom for each descriptor
            const Eigen::MatrixXd hat = normal.ldlt().solve(design.transpose() * w.asDiagonal() * design);
            const double freedom = std::max(w.sum() - hat.trace(), 1.0);
            const double least =
                least_scatter.empty() ? 0 : least_scatter[static_cast<std::size_t>(used_[static_cast<std::size_t>(j)])];
            const double square = (w.array() * (known - expected).array().square()).sum() / freedom;
            scatter_(j) = std::sqrt(std::max({square, least * least, 1e-24}));
            const double most = 4 * scatter_(j);
            known = expected + (known - expected).cwiseMax(-most).cwiseMin(most);
        }
    }
}

Eigen::VectorXd LawAdjustment::residual(const Eigen::VectorXd& descriptors, const Eigen::VectorXd& statistics) const
{
    const auto p = static_cast<Eigen::Index>(used_.size());
    Eigen::VectorXd row(1 + descriptors.size());
    row << 1, standardized(descriptors);
    const Eigen::VectorXd expected = coefficients_.transpose() * row;
    Eigen::VectorXd out(p);
    for (Eigen::Index j = 0; j < p; ++j) {
        const double value = statistics(used_[static_cast<std::size_t>(j)]);
        out(j) = std::isfinite(value) ? std::clamp((value - expected(j)) / scatter_(j), -farthest, farthest) : 0;
    }
    return out;
}

void LawAdjustment::find_tails(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& weights)
{
    const Eigen::Index n = residuals.rows(), p = residuals.cols();
    std::vector<double> distances;
    for (int part = 0; part < parts; ++part) {
        Eigen::VectorXd others = weights;
        for (Eigen::Index i = part; i < n; i += parts)
            others(i) = 0;
        const Eigen::LLT<Eigen::MatrixXd> factor(shrunk_correlation(residuals, others));
        for (Eigen::Index i = part; i < n; i += parts)
            distances.push_back(factor.matrixL().solve(residuals.row(i).transpose()).squaredNorm());
    }
    double best = -HUGE_VAL;
    const auto dimensions = static_cast<double>(p);
    for (const double freedom : freedoms) {
        // the scale at which the density is greatest: a fixed point (expectation maximization)
        double scale = 1;
        for (int round = 0; round < 50; ++round) {
            double sum = 0;
            for (const double d : distances)
                sum += (freedom + dimensions) * d / (freedom + d / scale);
            scale = std::max(sum / (dimensions * static_cast<double>(distances.size())), 1e-6);
        }
        double density =
            static_cast<double>(distances.size()) * (log_gamma((freedom + dimensions) / 2) - log_gamma(freedom / 2) -
                                                     0.5 * dimensions * std::log(freedom * scale));
        for (const double d : distances)
            density += student_kernel(d / scale, dimensions, freedom);
        if (density > best) {
            best = density;
            freedom_ = freedom;
            scale_ = scale;
        }
    }
}

} // namespace stylobate

#include "studies/evidence/measured/parts/logistic.hpp"

#include <Eigen/Dense>

#include <cassert>
#include <cmath>

namespace stylobate::measured {

double Logistic::probability(const std::vector<double>& x) const
{
    double sum = coefficients.front();
    for (std::size_t i = 0; i < x.size(); ++i)
        sum += coefficients[i + 1] * x[i];
    return 1 / (1 + std::exp(-sum));
}

Logistic fit_logistic(const std::vector<std::vector<double>>& x, const std::vector<bool>& event, double ridge)
{
    assert(!x.empty() && x.size() == event.size() && "an event to each observation");
    const auto n = static_cast<Eigen::Index>(x.size());
    const auto m = static_cast<Eigen::Index>(x.front().size()) + 1;
    Eigen::MatrixXd design(n, m);
    Eigen::VectorXd happened(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        design(i, 0) = 1;
        for (Eigen::Index j = 1; j < m; ++j)
            design(i, j) = x[static_cast<std::size_t>(i)][static_cast<std::size_t>(j - 1)];
        happened(i) = event[static_cast<std::size_t>(i)] ? 1 : 0;
    }
    Eigen::VectorXd penalty = Eigen::VectorXd::Constant(m, ridge);
    penalty(0) = 0;

    const auto loss = [&](const Eigen::VectorXd& b) {
        double sum = 0.5 * penalty.dot(b.cwiseAbs2());
        const Eigen::VectorXd z = design * b;
        for (Eigen::Index i = 0; i < n; ++i)
            sum += std::max(z(i), 0.0) + std::log1p(std::exp(-std::fabs(z(i)))) - happened(i) * z(i);
        return sum;
    };
    Eigen::VectorXd b = Eigen::VectorXd::Zero(m);
    double before = loss(b);
    for (int iteration = 0; iteration < 100; ++iteration) {
        const Eigen::VectorXd p = (1 + (-(design * b)).array().exp()).inverse().matrix();
        const Eigen::VectorXd gradient = design.transpose() * (happened - p) - penalty.cwiseProduct(b);
        const Eigen::VectorXd weight = (p.array() * (1 - p.array())).max(1e-12).matrix();
        Eigen::MatrixXd curvature = design.transpose() * weight.asDiagonal() * design;
        curvature.diagonal() += penalty;
        Eigen::VectorXd step = curvature.ldlt().solve(gradient);
        // the loss is convex: a Newton step that overshoots is halved
        double now = loss(b + step);
        for (int half = 0; half < 40 && !(now <= before); ++half) {
            step /= 2;
            now = loss(b + step);
        }
        b += step;
        const bool done = step.norm() < 1e-12 * (1 + b.norm());
        before = now;
        if (done)
            break;
    }
    return {std::vector<double>(b.data(), b.data() + m)};
}

} // namespace stylobate::measured

#include "studies/evidence/verification/stack_vibration.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

namespace stylobate::verification {

namespace {

struct Matrices {
    Eigen::MatrixXd M, K, C;
};

Matrices assemble(const Realization& r, double gravity)
{
    const auto n = static_cast<Eigen::Index>(3 * (r.blocks.size() - 1));
    Matrices m{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
    for (std::size_t b = 1; b < r.blocks.size(); ++b) {
        const auto at = static_cast<Eigen::Index>(3 * (b - 1));
        m.M(at, at) = m.M(at + 1, at + 1) = r.blocks[b].mass_kg;
        m.M(at + 2, at + 2) = r.blocks[b].inertia_kg_m2;
    }
    for (std::size_t j = 0; j < r.joints.size(); ++j) {
        const Joint& joint = r.joints[j];
        const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
        // displacement of the upper face less that of the lower one, vertical at the abscissa x, or horizontal
        const auto relative = [&](bool vertical, double x) {
            Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
            const auto up = static_cast<Eigen::Index>(3 * (joint.upper - 1));
            v(up + (vertical ? 1 : 0)) = 1;
            v(up + 2) = vertical ? x : upper.half_height_m;
            if (joint.lower > 0) {
                const auto low = static_cast<Eigen::Index>(3 * (joint.lower - 1));
                v(low + (vertical ? 1 : 0)) = -1;
                v(low + 2) = vertical ? -x : lower.half_height_m;
            }
            return v;
        };
        const double b = std::min(lower.half_width_m, upper.half_width_m);
        for (const double side : {-1.0, 1.0}) {
            const Eigen::VectorXd gap = relative(true, side * b / std::sqrt(3.0));
            m.K += joint.normal_stiffness_n_m2 * b * gap * gap.transpose();
        }
        const Eigen::VectorXd slide = relative(false, 0), open = relative(true, 0);
        m.K += joint.tangential_stiffness_n_m * slide * slide.transpose();
        m.C += joint.normal_damping_n_s_m * open * open.transpose() +
               joint.tangential_damping_n_s_m * slide * slide.transpose();
        double weight = 0;
        for (std::size_t k = j; k < r.joints.size(); ++k)
            weight += r.blocks[static_cast<std::size_t>(r.joints[k].upper)].mass_kg * gravity;
        for (int block : {joint.lower, joint.upper})
            if (block > 0)
                m.K(3 * block - 1, 3 * block - 1) -= weight * r.blocks[static_cast<std::size_t>(block)].half_height_m;
    }
    return m;
}

} // namespace

std::vector<double> frequencies_hz(const Realization& r)
{
    const Matrices m = assemble(r, r.gravity_m_s2);
    const Eigen::VectorXd w2 =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(m.K, m.M, Eigen::EigenvaluesOnly).eigenvalues();
    std::vector<double> f;
    for (const double value : w2)
        f.push_back(std::sqrt(std::max(value, 0.0)) / (2 * std::numbers::pi));
    return f;
}

double critical_step_s(const Realization& r)
{
    const Matrices m = assemble(r, r.gravity_m_s2);
    const auto stable = [&](double dt) {
        const Eigen::MatrixXd left = 4 * m.M - 2 * dt * m.C - dt * dt * m.K;
        return Eigen::LLT<Eigen::MatrixXd>(left).info() == Eigen::Success;
    };
    double low = 0, high = 1;
    while (high - low > 1e-10 * high) {
        const double middle = 0.5 * (low + high);
        (stable(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace stylobate::verification

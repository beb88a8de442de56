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
        const double b = std::min(lower.half_width_m, upper.half_width_m);
        double weight = 0;
        for (std::size_t k = j; k < r.joints.size(); ++k)
            weight += r.blocks[static_cast<std::size_t>(r.joints[k].upper)].mass_kg * gravity;
        // forces act in the middle of the overlap at rest
        const double half_overlap = 0.5 * weight / (joint.normal_stiffness_n_m2 * 2 * b);
        const double h_l = lower.half_height_m - half_overlap, h_u = upper.half_height_m - half_overlap;
        // displacement of the upper face less that of the lower one, vertical at the abscissa x, or horizontal
        const auto relative = [&](bool vertical, double x) {
            Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
            const auto up = static_cast<Eigen::Index>(3 * (joint.upper - 1));
            v(up + (vertical ? 1 : 0)) = 1;
            v(up + 2) = vertical ? x : h_u;
            if (joint.lower > 0) {
                const auto low = static_cast<Eigen::Index>(3 * (joint.lower - 1));
                v(low + (vertical ? 1 : 0)) = -1;
                v(low + 2) = vertical ? -x : h_l;
            }
            return v;
        };
        for (const double side : {-1.0, 1.0}) {
            const Eigen::VectorXd gap = relative(true, side * b / std::sqrt(3.0));
            m.K += joint.normal_stiffness_n_m2 * b * gap * gap.transpose();
        }
        const Eigen::VectorXd slide = relative(false, 0), open = relative(true, 0);
        m.K += joint.tangential_stiffness_n_m * slide * slide.transpose();
        m.C += joint.normal_damping_n_s_m * open * open.transpose() +
               joint.tangential_damping_n_s_m * slide * slide.transpose();
        // The weight N presses along the normal of the lower face. To second order the bed is then deeper by
        // X theta_l + (h_l + h_u) theta_l2 / 2 - h_u (theta_u - theta_l)2 / 2, with X = x_u - x_l, and N does that
        // work.
        const Eigen::Index u = 3 * (joint.upper - 1), l = 3 * (joint.lower - 1);
        m.K(u + 2, u + 2) -= weight * h_u;
        if (joint.lower > 0) {
            m.K(l + 2, l + 2) += weight * h_l; // h_l + h_u - h_u
            m.K(u + 2, l + 2) += weight * h_u;
            m.K(l + 2, u + 2) += weight * h_u;
            for (const auto& [x, sign] : {std::pair{u, 1.0}, {l, -1.0}}) {
                m.K(x, l + 2) += sign * weight;
                m.K(l + 2, x) += sign * weight;
            }
        }
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

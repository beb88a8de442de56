#include "ensemble/step_bound.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate {
namespace {

/// A joint at full contact in the reference stack.
struct FullContact {
    double chord = 0;   ///< length of the contact [m]
    double x = 0;       ///< its centre [m]
    double k_n = 0;     ///< normal stiffness [N/m]
    double k_theta = 0; ///< rotational stiffness about the centre [N m]
    double k_t = 0;     ///< tangential stiffness [N/m]
};

FullContact full_contact(const std::vector<Block>& blocks, const Joint& joint)
{
    const Block& a = blocks[static_cast<std::size_t>(joint.lower)];
    const Block& b = blocks[static_cast<std::size_t>(joint.upper)];
    const double left = std::max(a.x_m - a.half_width_m, b.x_m - b.half_width_m);
    const double right = std::min(a.x_m + a.half_width_m, b.x_m + b.half_width_m);
    assert(right > left && "the blocks of a joint lie on each other");
    const double chord = right - left;
    return {chord, (left + right) / 2, joint.normal_stiffness_n_m2 * chord,
            joint.normal_stiffness_n_m2 * chord * chord * chord / 12, joint.tangential_stiffness_n_m};
}

/// How the faces move against each other at a point of the contact when one block moves by (x, y, theta).
struct FaceMotion {
    Eigen::Vector3d opening;
    Eigen::Vector3d sliding;
};

/// @param arm the point's x against the block's centre
FaceMotion face_motion(const Block& block, bool upper, double arm)
{
    if (upper)
        return {{0, 1, arm}, {1, 0, block.half_height_m}};
    return {{0, -1, -arm}, {-1, 0, block.half_height_m}};
}

/// The largest eigenvalue of G diag(C_N, C_T) for a contact at `x` [1/s].
double edge_rate(const std::vector<Block>& blocks, const Joint& joint, double x)
{
    Eigen::Matrix2d compliance = Eigen::Matrix2d::Zero();
    for (const bool upper : {false, true}) {
        const Block& block = blocks[static_cast<std::size_t>(upper ? joint.upper : joint.lower)];
        if (block.fixed)
            continue;
        const FaceMotion face = face_motion(block, upper, x - block.x_m);
        Eigen::Matrix<double, 2, 3> motion;
        motion << face.opening.transpose(), face.sliding.transpose();
        const Eigen::Vector3d mobility(1 / block.mass_kg, 1 / block.mass_kg, 1 / block.inertia_kg_m2);
        compliance += motion * mobility.asDiagonal() * motion.transpose();
    }
    const Eigen::Vector2d root(std::sqrt(joint.normal_damping_n_s_m), std::sqrt(joint.tangential_damping_n_s_m));
    const Eigen::Matrix2d symmetric = root.asDiagonal() * compliance * root.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()(1);
}

/// Largest eigenvalue of M^-1 K of a block that is held on both its long faces by full contacts [1/s2].
double caught_between(const Block& block, const Joint& joint)
{
    const double face = 2 * std::max(block.half_width_m, block.half_height_m);
    const double arm = std::min(block.half_width_m, block.half_height_m);
    const double k_n = joint.normal_stiffness_n_m2 * face, k_t = joint.tangential_stiffness_n_m;
    return 2 * std::max({k_n / block.mass_kg, k_t / block.mass_kg,
                         (k_n * face * face / 12 + k_t * arm * arm) / block.inertia_kg_m2});
}

} // namespace

const char* to_string(StepLimit limit)
{
    switch (limit) {
    case StepLimit::stiffness:
        return "stiffness of the contacts";
    case StepLimit::dashpot:
        return "dashpots of the contacts";
    case StepLimit::edge_dashpot:
        return "dashpot at an edge";
    }
    return "?";
}

StepBound step_bound(const std::vector<Block>& blocks, const std::vector<Joint>& joints, int watched)
{
    const std::size_t beds = joints.size() - static_cast<std::size_t>(watched);
    assert(beds > 0 && "a structure without a bed has no step bound");
    std::vector<Eigen::Matrix3d> stiffness(blocks.size(), Eigen::Matrix3d::Zero());
    double beta = 0;
    double rate = 0;
    for (std::size_t j = 0; j < beds; ++j) {
        const Joint& joint = joints[j];
        const FullContact contact = full_contact(blocks, joint);
        for (const bool upper : {false, true}) {
            const std::size_t b = static_cast<std::size_t>(upper ? joint.upper : joint.lower);
            const FaceMotion face = face_motion(blocks[b], upper, contact.x - blocks[b].x_m);
            stiffness[b] += contact.k_n * face.opening * face.opening.transpose() +
                            contact.k_t * face.sliding * face.sliding.transpose();
            stiffness[b](2, 2) += contact.k_theta;
        }
        beta = std::max({beta, joint.normal_damping_n_s_m / contact.k_n, joint.tangential_damping_n_s_m / contact.k_t});
        if (joint.damping_chord_m == 0)
            for (const double side : {-0.5, 0.5})
                rate = std::max(rate, edge_rate(blocks, joint, contact.x + side * contact.chord));
    }

    StepBound bound;
    double w2 = 0;
    for (std::size_t j = beds; j < joints.size(); ++j) {
        const Joint& joint = joints[j];
        assert(joint.damping_chord_m > 0 && "the dashpots of a watched pair go with its length");
        const auto long_face = [&](int b) {
            const Block& block = blocks[static_cast<std::size_t>(b)];
            return 2 * std::max(block.half_width_m, block.half_height_m);
        };
        const double length = std::min(long_face(joint.lower), long_face(joint.upper)) / joint.damping_chord_m;
        beta = std::max({beta, joint.normal_damping_n_s_m / (joint.normal_stiffness_n_m2 * joint.damping_chord_m),
                         length * joint.tangential_damping_n_s_m / joint.tangential_stiffness_n_m});
        for (const int b : {joint.lower, joint.upper}) {
            const Block& block = blocks[static_cast<std::size_t>(b)];
            if (block.fixed)
                continue;
            const double held = caught_between(block, joint);
            if (2 * held > w2) {
                w2 = 2 * held;
                bound.block = b;
            }
        }
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks[b].fixed)
            continue;
        const Eigen::Vector3d scale(1 / std::sqrt(blocks[b].mass_kg), 1 / std::sqrt(blocks[b].mass_kg),
                                    1 / std::sqrt(blocks[b].inertia_kg_m2));
        const Eigen::Matrix3d dynamic = scale.asDiagonal() * stiffness[b] * scale.asDiagonal();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(dynamic, Eigen::EigenvaluesOnly);
        if (2 * solver.eigenvalues()(2) > w2) {
            w2 = 2 * solver.eigenvalues()(2);
            bound.block = static_cast<int>(b);
        }
    }
    const double w = std::sqrt(w2);
    const double z = beta * w / 2;
    bound.stiffness_s = 2 / w;
    bound.dashpot_s = 2 / (w * (std::sqrt(1 + z * z) + z)); // sqrt(1 + z2) - z without its cancellation
    bound.edge_s = rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity();
    bound.dt_s = std::min(bound.dashpot_s, bound.edge_s);
    if (bound.edge_s < bound.dashpot_s)
        bound.governed_by = StepLimit::edge_dashpot;
    else if (z > 0)
        bound.governed_by = StepLimit::dashpot;
    return bound;
}

LinearResponse linear_response(const std::vector<Block>& blocks, const std::vector<Joint>& joints, double gravity_m_s2,
                               int watched)
{
    const std::size_t beds = joints.size() - static_cast<std::size_t>(watched);
    // unknowns: (x, y, theta) of each free block
    std::vector<Eigen::Index> first(blocks.size(), -1);
    Eigen::Index size = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!blocks[b].fixed) {
            first[b] = size;
            size += 3;
        }
    }

    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd opening = Eigen::MatrixXd::Zero(size, static_cast<Eigen::Index>(beds));
    for (std::size_t j = 0; j < beds; ++j) {
        const Joint& joint = joints[j];
        const FullContact contact = full_contact(blocks, joint);
        Eigen::VectorXd slide = Eigen::VectorXd::Zero(size);
        Eigen::VectorXd turn = Eigen::VectorXd::Zero(size);
        auto open = opening.col(static_cast<Eigen::Index>(j));
        for (const bool upper : {false, true}) {
            const std::size_t b = static_cast<std::size_t>(upper ? joint.upper : joint.lower);
            if (blocks[b].fixed)
                continue;
            const FaceMotion face = face_motion(blocks[b], upper, contact.x - blocks[b].x_m);
            open.segment<3>(first[b]) = face.opening;
            slide.segment<3>(first[b]) = face.sliding;
            turn(first[b] + 2) = upper ? 1 : -1;
        }
        K += contact.k_n * open * open.transpose() + contact.k_t * slide * slide.transpose() +
             contact.k_theta * turn * turn.transpose();
        C += joint.normal_damping_n_s_m * open * open.transpose() +
             joint.tangential_damping_n_s_m * slide * slide.transpose();
    }

    Eigen::VectorXd root_mass(size);
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(size);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks[b].fixed)
            continue;
        const double root = std::sqrt(blocks[b].mass_kg);
        root_mass.segment<3>(first[b]) = Eigen::Vector3d(root, root, std::sqrt(blocks[b].inertia_kg_m2));
        weight(first[b] + 1) = -blocks[b].mass_kg * gravity_m_s2;
    }

    // what each joint carries at rest, and what that takes from the rotational stiffness of its blocks
    const Eigen::VectorXd settled = K.ldlt().solve(weight);
    for (std::size_t j = 0; j < beds; ++j) {
        const double carried =
            -full_contact(blocks, joints[j]).k_n * opening.col(static_cast<Eigen::Index>(j)).dot(settled);
        for (const int block : {joints[j].lower, joints[j].upper}) {
            const std::size_t b = static_cast<std::size_t>(block);
            if (!blocks[b].fixed)
                K(first[b] + 2, first[b] + 2) -= carried * blocks[b].half_height_m;
        }
    }

    const Eigen::VectorXd scale = root_mass.cwiseInverse();
    const Eigen::MatrixXd k = scale.asDiagonal() * K * scale.asDiagonal();
    const Eigen::MatrixXd c = scale.asDiagonal() * C * scale.asDiagonal();
    const Eigen::VectorXd w2 = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();

    LinearResponse response;
    for (const double value : w2)
        response.frequency_hz.push_back(std::sqrt(std::max(value, 0.0)) / (2 * std::numbers::pi));
    const double w_max = std::sqrt(w2(size - 1));
    response.undamped_step_s = 2 / w_max;

    // det(4 - 2 dt c - dt2 k) = 0: with s = 2 / (w_max dt) the largest real root of the quadratic eigenproblem
    // s2 v = (s c / w_max + k / w_max2) v, which is that of its companion matrix
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * size, 2 * size);
    companion.topRightCorner(size, size).setIdentity();
    companion.bottomLeftCorner(size, size) = k / (w_max * w_max);
    companion.bottomRightCorner(size, size) = c / w_max;
    const Eigen::EigenSolver<Eigen::MatrixXd> roots(companion, false);
    response.step_s = 2 / (w_max * roots.eigenvalues().real().maxCoeff());
    return response;
}

} // namespace stylobate

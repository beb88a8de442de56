#include "ensemble/planar/structure/step_bound.hpp"

#include "ensemble/planar/structure/bed.hpp"
#include "ensemble/planar/structure/mechanisms.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace stylobate {
namespace {

// What softens with the load is taken at this multiple of the load at rest, what stiffens at `bound_load`.
constexpr double least_load = 0.01;
// The form `points` carries what strikes a face at a few of its points, at many times the load at rest, and grows
// stiffer the deeper they go: of 2048 realizations of the small-scale column 25 flew apart with steps for 10 times it,
// none did with steps for 85 times (kernels/THEORY.md, section 6).
constexpr double points_load = 100;

FullContact stiffest_contact(const BedAtRest& bed)
{
    if (bed.joint.mechanisms.force_exponent < 1) // it is stiffest where it is least pressed
        return full_contact(bed, least_load);
    return full_contact(bed, bed.law.form == ContactForm::points ? points_load : bound_load);
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

/// The largest eigenvalue of M^-1 K of a block.
double largest_rate(const Block& block, const Eigen::Matrix3d& stiffness)
{
    const Eigen::Vector3d scale(1 / std::sqrt(block.mass_kg), 1 / std::sqrt(block.mass_kg),
                                1 / std::sqrt(block.inertia_kg_m2));
    const Eigen::Matrix3d dynamic = scale.asDiagonal() * stiffness * scale.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(dynamic, Eigen::EigenvaluesOnly).eigenvalues()(2);
}

/// The largest eigenvalue of G diag(C_N, C_T) for a contact at `x` [1/s].
double edge_rate(const Realization& r, const Joint& joint, double x, double C_n, double C_t)
{
    Eigen::Matrix2d compliance = Eigen::Matrix2d::Zero();
    for (const bool upper : {false, true}) {
        const Block& block = block_of(r, upper ? joint.upper : joint.lower);
        if (block.fixed)
            continue;
        const FaceMotion face = face_motion(block, upper, x - block.x_m - block.mechanisms.eccentricity_m);
        Eigen::Matrix<double, 2, 3> motion;
        motion << face.opening.transpose(), face.sliding.transpose();
        const Eigen::Vector3d mobility(1 / block.mass_kg, 1 / block.mass_kg, 1 / block.inertia_kg_m2);
        compliance += motion * mobility.asDiagonal() * motion.transpose();
    }
    const Eigen::Vector2d root(std::sqrt(C_n), std::sqrt(C_t));
    const Eigen::Matrix2d symmetric = root.asDiagonal() * compliance * root.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()(1);
}

/// Stiffness of a block against its tendon and its clamps, which may turn: in both directions, each fully.
Eigen::Matrix3d held_stiffness(const Realization& r, int block)
{
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
    const Block& b = block_of(r, block);
    const auto add = [&](double k, double arm_x, double arm_y) {
        const Eigen::Vector3d along(1, 0, -arm_y), up(0, 1, arm_x);
        stiffness += k * (along * along.transpose() + up * up.transpose());
    };
    const double e = b.mechanisms.eccentricity_m;
    add(b.strengthening.tendon_n_m, -e, b.half_height_m);
    for (std::size_t i = 0; i < r.blocks.size(); ++i) {
        const Block& left = r.blocks[i];
        const BlockStrengthening& clamp = left.strengthening;
        if (clamp.clamp_to < 0 || (static_cast<int>(i) != block && clamp.clamp_to != block))
            continue;
        const double side = static_cast<int>(i) == block ? 1 : -1;
        add(clamp.clamp_n_m, side * b.half_width_m - e, left.y_m + clamp.clamp_height_m - b.y_m);
    }
    return stiffness;
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

/// Stiffness of a block against its rod, at the rod's point.
Eigen::Matrix3d rod_stiffness(const Block& block)
{
    const BlockMechanisms& e = block.mechanisms;
    const Eigen::Vector3d along(1, 0, block.half_height_m - e.rod_height_m);
    return std::max(e.rod_right_n_m, e.rod_left_n_m) * along * along.transpose();
}

/// What watched pairs ask of the step, when they catch a block between them.
struct CaughtPairs {
    double w2 = 0;   ///< [1/s2]
    double beta = 0; ///< largest C over K [s]
    int block = 0;   ///< that sets w2
};

CaughtPairs caught_pairs(const Realization& r)
{
    CaughtPairs caught;
    for (std::size_t j = static_cast<std::size_t>(r.beds()); j < r.joints.size(); ++j) {
        const Joint& joint = r.joints[j];
        assert(joint.damping_chord_m > 0 && "the dashpots of a watched pair go with its length");
        const auto long_face = [&](int b) {
            const Block& block = block_of(r, b);
            return 2 * std::max(block.half_width_m, block.half_height_m);
        };
        const double length = std::min(long_face(joint.lower), long_face(joint.upper)) / joint.damping_chord_m;
        caught.beta =
            std::max({caught.beta, joint.normal_damping_n_s_m / (joint.normal_stiffness_n_m2 * joint.damping_chord_m),
                      length * joint.tangential_damping_n_s_m / joint.tangential_stiffness_n_m});
        for (const int b : {joint.lower, joint.upper}) {
            const Block& block = block_of(r, b);
            if (block.fixed)
                continue;
            const double held = caught_between(block, joint);
            if (2 * held > caught.w2) {
                caught.w2 = 2 * held;
                caught.block = b;
            }
        }
    }
    return caught;
}

/// Sets w2 and the block that sets it, from the stiffness of each block.
void take_stiffest(const Realization& r, const std::vector<Eigen::Matrix3d>& stiffness, double& w2, int& block)
{
    for (std::size_t b = 0; b < r.blocks.size(); ++b) {
        const double found = r.blocks[b].fixed ? 0 : 2 * largest_rate(r.blocks[b], stiffness[b]);
        if (found > w2) {
            w2 = found;
            block = static_cast<int>(b);
        }
    }
}

/// @param bound with what full contacts give   @param rate the largest one at an edge [1/s]
/// @param damped whether there is a dashpot at full contact
StepBound with_edges(StepBound bound, double rate, bool damped)
{
    bound.edge_s = rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity();
    bound.dt_s = std::min(bound.dashpot_s, bound.edge_s);
    if (bound.edge_s < bound.dashpot_s)
        bound.governed_by = StepLimit::edge_dashpot;
    else if (damped)
        bound.governed_by = StepLimit::dashpot;
    return bound;
}

/// The bound of the paper's model.
StepBound bound_of_paper(const Realization& r)
{
    assert(r.beds() > 0 && "a structure without a bed has no step bound");
    std::vector<Eigen::Matrix3d> stiffness(r.blocks.size(), Eigen::Matrix3d::Zero());
    double beta = 0, rate = 0;
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const FullContact contact = full_contact(block_of(r, joint.lower), block_of(r, joint.upper), joint);
        for (const bool upper : {false, true}) {
            const auto b = static_cast<std::size_t>(upper ? joint.upper : joint.lower);
            const FaceMotion face = face_motion(r.blocks[b], upper, contact.x - r.blocks[b].x_m);
            stiffness[b] += contact.k_n * face.opening * face.opening.transpose() +
                            contact.k_t * face.sliding * face.sliding.transpose();
            stiffness[b](2, 2) += contact.k_theta;
        }
        beta = std::max({beta, joint.normal_damping_n_s_m / contact.k_n, joint.tangential_damping_n_s_m / contact.k_t});
        if (joint.damping_chord_m == 0)
            for (const double side : {-0.5, 0.5})
                rate = std::max(rate, edge_rate(r, joint, contact.x + side * contact.chord, joint.normal_damping_n_s_m,
                                                joint.tangential_damping_n_s_m));
    }

    StepBound bound;
    const CaughtPairs caught = caught_pairs(r);
    double w2 = caught.w2;
    bound.block = caught.block;
    beta = std::max(beta, caught.beta);
    take_stiffest(r, stiffness, w2, bound.block);
    const double w = std::sqrt(w2), z = beta * w / 2;
    bound.stiffness_s = 2 / w;
    bound.dashpot_s = 2 / (w * (std::sqrt(1 + z * z) + z)); // sqrt(1 + z2) - z without its cancellation
    return with_edges(bound, rate, z > 0);
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
    case StepLimit::flat_fall:
        return "long face of a block that falls flat";
    }
    return "?";
}

StepBound step_bound(const Realization& r)
{
    if (!model_of(r).has_mechanism_rows())
        return bound_of_paper(r);
    std::vector<Eigen::Matrix3d> stiffness(r.blocks.size(), Eigen::Matrix3d::Zero()), damping = stiffness;
    double rate = 0;
    for (const BedAtRest& bed : beds_at_rest(r)) {
        const Joint& joint = bed.joint;
        const FullContact contact = stiffest_contact(bed);
        for (const bool upper : {false, true}) {
            const auto b = static_cast<std::size_t>(upper ? joint.upper : joint.lower);
            const Block& block = r.blocks[b];
            const FaceMotion face = face_motion(block, upper, contact.x - block.x_m - block.mechanisms.eccentricity_m);
            const Eigen::Matrix3d open = face.opening * face.opening.transpose();
            const Eigen::Matrix3d slide = face.sliding * face.sliding.transpose();
            stiffness[b] += contact.k_n * open + contact.k_t * slide;
            stiffness[b](2, 2) += contact.k_theta;
            damping[b] += contact.c_n * open + contact.c_t * slide;
            damping[b](2, 2) += contact.c_theta;
        }
        // a dashpot that stays when only an edge is left
        const bool stays = joint.damping_chord_m == 0 || r.form != ContactForm::area;
        const double at_edge = r.form == ContactForm::area ? 1 - joint.mechanisms.face_damping : 0.5;
        const double C_n =
            (stays ? at_edge * joint.normal_damping_n_s_m : 0) + joint.mechanisms.rate_s_m * bound_load * bed.force_n;
        const double C_t =
            (joint.damping_chord_m == 0 ? joint.tangential_damping_n_s_m : 0) + joint.strengthening.bearing_n_s_m;
        for (const double side : {-0.5, 0.5})
            rate = std::max(rate, edge_rate(r, joint, contact.x + side * contact.chord, C_n, C_t));
    }

    for (std::size_t b = 0; b < r.blocks.size(); ++b) { // a tie that drives away shortens no step
        stiffness[b](0, 0) += std::max(r.blocks[b].mechanisms.tie_n_m, 0.0);
        damping[b](0, 0) += r.blocks[b].mechanisms.tie_n_s_m;
        damping[b](2, 2) += r.blocks[b].mechanisms.tie_n_m_s;
        stiffness[b] += held_stiffness(r, static_cast<int>(b)) + rod_stiffness(r.blocks[b]);
    }

    StepBound bound;
    const CaughtPairs caught = caught_pairs(r);
    double w2 = caught.w2, c = 0;
    bound.block = caught.block;
    take_stiffest(r, stiffness, w2, bound.block);
    for (std::size_t b = 0; b < r.blocks.size(); ++b)
        if (!r.blocks[b].fixed)
            c = std::max(c, 2 * largest_rate(r.blocks[b], damping[b]));
    c = std::max(c, caught.beta * w2);
    bound.stiffness_s = 2 / std::sqrt(w2);
    bound.dashpot_s = 4 / (std::sqrt(c * c + 4 * w2) + c); // root of 4 - 2 dt c - dt2 w2 without its cancellation
    return with_edges(bound, rate, c > 0);
}

StepBound step_bound_to_rest(const Realization& r)
{
    StepBound bound = step_bound(r);
    if (r.watched > 0)
        return bound; // the long faces are in it
    double w2 = 0;
    int block = 0;
    for (const Joint& joint : r.joints)
        for (const int b : {joint.lower, joint.upper}) {
            const Block& meets = block_of(r, b);
            const double once = meets.fixed ? 0 : caught_between(meets, joint) / 2;
            if (once > w2) {
                w2 = once;
                block = b;
            }
        }
    constexpr double steps = 6;
    const double flat_s = 1 / (steps * std::sqrt(w2));
    bound.flat_s = flat_s;
    if (flat_s < bound.dt_s) {
        bound.dt_s = flat_s;
        bound.governed_by = StepLimit::flat_fall;
        bound.block = block;
    }
    return bound;
}

namespace {

/// Matrices of the free blocks' displacements (x, y, theta each), all contacts full, without gravity.
struct Vibration {
    std::vector<Eigen::Index> first; ///< a block's first unknown, -1: fixed
    Eigen::MatrixXd K, C;
    Eigen::MatrixXd opening;   ///< (unknowns x beds) of each bed
    Eigen::VectorXd root_mass; ///< square roots of the masses and inertias
};

Vibration assemble(const Realization& r, const std::vector<FullContact>& contacts)
{
    const std::vector<Block>& blocks = r.blocks;
    const std::size_t beds = contacts.size();
    Vibration v;
    v.first.assign(blocks.size(), -1);
    Eigen::Index size = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!blocks[b].fixed) {
            v.first[b] = size;
            size += 3;
        }
    }
    v.K = v.C = Eigen::MatrixXd::Zero(size, size);
    v.opening = Eigen::MatrixXd::Zero(size, static_cast<Eigen::Index>(beds));
    for (std::size_t j = 0; j < beds; ++j) {
        const Joint& joint = r.joints[j];
        const FullContact& contact = contacts[j];
        struct Side {
            Eigen::Index first;
            Eigen::Vector3d open, slide, turn;
        };
        std::vector<Side> sides; // the free ones
        for (const bool upper : {false, true}) {
            const std::size_t b = static_cast<std::size_t>(upper ? joint.upper : joint.lower);
            if (blocks[b].fixed)
                continue;
            const FaceMotion face =
                face_motion(blocks[b], upper, contact.x - blocks[b].x_m - blocks[b].mechanisms.eccentricity_m);
            sides.push_back({v.first[b], face.opening, face.sliding, {0, 0, upper ? 1.0 : -1.0}});
            v.opening.col(static_cast<Eigen::Index>(j)).segment<3>(v.first[b]) = face.opening;
        }
        for (const Side& p : sides)
            for (const Side& q : sides) {
                v.K.block<3, 3>(p.first, q.first) += contact.k_n * p.open * q.open.transpose() +
                                                     contact.k_t * p.slide * q.slide.transpose() +
                                                     contact.k_theta * p.turn * q.turn.transpose();
                v.C.block<3, 3>(p.first, q.first) += contact.c_n * p.open * q.open.transpose() +
                                                     contact.c_t * p.slide * q.slide.transpose() +
                                                     contact.c_theta * p.turn * q.turn.transpose();
            }
    }
    v.root_mass.resize(size);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!blocks[b].fixed) {
            const double root = std::sqrt(blocks[b].mass_kg);
            v.root_mass.segment<3>(v.first[b]) = Eigen::Vector3d(root, root, std::sqrt(blocks[b].inertia_kg_m2));
            const BlockMechanisms& e = blocks[b].mechanisms;
            v.K(v.first[b], v.first[b]) += e.tie_n_m;
            v.K.block<3, 3>(v.first[b], v.first[b]) += rod_stiffness(blocks[b]);
            v.C(v.first[b], v.first[b]) += e.tie_n_s_m;
            v.C(v.first[b] + 2, v.first[b] + 2) += e.tie_n_m_s;
        }
    return v;
}

/// Tendons and clamps about the reference stack, without the play of clamps.
void add_held(const std::vector<Block>& blocks, Vibration& v)
{
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const BlockStrengthening& held = blocks[b].strengthening;
        const auto add = [&](double k, const Eigen::VectorXd& stretch) { v.K += k * stretch * stretch.transpose(); };
        Eigen::VectorXd stretch = Eigen::VectorXd::Zero(v.K.rows());
        if (v.first[b] >= 0 && held.tendon_n_m > 0) {
            stretch.segment<3>(v.first[b]) = Eigen::Vector3d(0, 1, -blocks[b].mechanisms.eccentricity_m);
            add(held.tendon_n_m, stretch);
        }
        if (held.clamp_to < 0)
            continue;
        const auto right = static_cast<std::size_t>(held.clamp_to);
        stretch.setZero();
        if (v.first[b] >= 0)
            stretch.segment<3>(v.first[b]) = Eigen::Vector3d(-1, 0, held.clamp_height_m);
        if (v.first[right] >= 0)
            stretch.segment<3>(v.first[right]) =
                Eigen::Vector3d(1, 0, blocks[right].y_m - blocks[b].y_m - held.clamp_height_m);
        add(held.clamp_n_m, stretch);
    }
}

/// M^-1/2 K M^-1/2 about the static equilibrium, and M^-1/2 C M^-1/2.
struct Dynamics {
    Eigen::MatrixXd k, c;
};

Dynamics dynamics_of(const Realization& r, const std::vector<FullContact>& contacts)
{
    const std::vector<Block>& blocks = r.blocks;
    Vibration v = assemble(r, contacts);
    add_held(blocks, v);
    const std::vector<Eigen::Index>& first = v.first;
    Eigen::MatrixXd& K = v.K;
    const Eigen::Index size = K.rows();

    Eigen::VectorXd weight = Eigen::VectorXd::Zero(size);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks[b].fixed)
            continue;
        weight(first[b] + 1) = -blocks[b].mass_kg * r.gravity_m_s2;
    }

    // what each joint carries at rest, and what that takes from the rotational stiffness of its blocks
    const Eigen::VectorXd settled = K.ldlt().solve(weight);
    for (std::size_t j = 0; j < contacts.size(); ++j) {
        const double carried = -contacts[j].k_n * v.opening.col(static_cast<Eigen::Index>(j)).dot(settled);
        for (const int block : {r.joints[j].lower, r.joints[j].upper}) {
            const std::size_t b = static_cast<std::size_t>(block);
            if (!blocks[b].fixed)
                K(first[b] + 2, first[b] + 2) -= carried * blocks[b].half_height_m;
        }
    }

    const Eigen::VectorXd scale = v.root_mass.cwiseInverse();
    return {scale.asDiagonal() * K * scale.asDiagonal(), scale.asDiagonal() * v.C * scale.asDiagonal()};
}

LinearResponse response_of(const Dynamics& dynamics)
{
    const Eigen::MatrixXd &k = dynamics.k, &c = dynamics.c;
    const Eigen::Index size = k.rows();
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

FirstMode first_mode_of(const Dynamics& dynamics)
{
    constexpr Eigen::Index most_shapes = 8;
    constexpr int most_iterations = 1000;
    constexpr double change = 1e-14;
    const Eigen::MatrixXd &k = dynamics.k, &c = dynamics.c;
    const Eigen::LLT<Eigen::MatrixXd> factors(k);
    if (factors.info() != Eigen::Success)
        return {};
    const Eigen::Index shapes = std::min(most_shapes, k.rows());
    Eigen::MatrixXd v(k.rows(), shapes); // no symmetry of the structure holds for all of these
    for (Eigen::Index i = 0; i < v.rows(); ++i)
        for (Eigen::Index j = 0; j < shapes; ++j)
            v(i, j) = std::sin(1.0 + static_cast<double>((i + 1) * (j + 1)));
    double w2 = 0;
    for (int n = 0; n < most_iterations; ++n) {
        const Eigen::HouseholderQR<Eigen::MatrixXd> orthogonal(factors.solve(v));
        v = orthogonal.householderQ() * Eigen::MatrixXd::Identity(k.rows(), shapes);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(v.transpose() * k * v);
        v *= ritz.eigenvectors();
        const double before = std::exchange(w2, ritz.eigenvalues()(0));
        if (std::fabs(w2 - before) <= change * w2)
            break;
    }
    if (!(w2 > 0))
        return {};
    const double w = std::sqrt(w2);
    return {w / (2 * std::numbers::pi), v.col(0).dot(c * v.col(0)) / (2 * w)};
}

std::vector<FullContact> contacts_of_paper(const Realization& r)
{
    std::vector<FullContact> contacts;
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        contacts.push_back(full_contact(block_of(r, joint.lower), block_of(r, joint.upper), joint));
    }
    return contacts;
}

/// The beds of a realization at full contact, in its own model.
/// @param contact of a bed that has mechanisms
template <class Contact>
std::vector<FullContact> contacts_of(const Realization& r, const Contact& contact)
{
    if (!model_of(r).has_mechanism_rows())
        return contacts_of_paper(r);
    std::vector<FullContact> contacts;
    for (const BedAtRest& bed : beds_at_rest(r))
        contacts.push_back(contact(bed));
    return contacts;
}

Dynamics dynamics_of(const Realization& r)
{
    return dynamics_of(r, contacts_of(r, [](const BedAtRest& bed) { return full_contact(bed, 1); }));
}

/// Whether all normal dashpots are at the ends of their contacts, so that none of a smaller contact has more of them.
bool damped_at_ends(const Realization& r)
{
    return r.form == ContactForm::area &&
           std::all_of(r.joints.begin(), r.joints.begin() + r.beds(), [](const Joint& joint) {
               const JointMechanisms& e = joint.mechanisms;
               return (joint.normal_damping_n_s_m == 0 || e.face_damping == 1) && e.rate_s_m == 0;
           });
}

/// How long a step is stable where pairs catch a block between them.
double caught_step(const Realization& r)
{
    const CaughtPairs caught = caught_pairs(r);
    const double w = std::sqrt(caught.w2), z = caught.beta * w / 2;
    return w > 0 ? 2 / (w * (std::sqrt(1 + z * z) + z)) : std::numeric_limits<double>::infinity();
}

} // namespace

StepBound structure_step_bound(const Realization& r, StepBound bound)
{
    if (!damped_at_ends(r))
        return bound;
    Vibration v = assemble(r, contacts_of(r, stiffest_contact));
    for (std::size_t b = 0; b < r.blocks.size(); ++b) // they turn: each end in both directions; a clamp has two of them
        if (v.first[b] >= 0)
            v.K.block<3, 3>(v.first[b], v.first[b]) += 2 * held_stiffness(r, static_cast<int>(b));
    const Eigen::SparseMatrix<double> K = v.K.sparseView(), C = v.C.sparseView();
    Eigen::SparseMatrix<double> M(K.rows(), K.cols());
    M.setIdentity();
    M.diagonal() = v.root_mass.cwiseAbs2();
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factors;
    factors.analyzePattern(Eigen::SparseMatrix<double>(4 * M + C + K));
    const auto stable = [&](double dt) {
        factors.factorize(Eigen::SparseMatrix<double>(4 * M - 2 * dt * C - dt * dt * K));
        return factors.info() == Eigen::Success;
    };
    const double other = std::min(bound.flat_s, caught_step(r));
    double low = bound.dt_s, high = 2 * low;
    while (low < other && stable(high)) {
        low = high;
        high *= 2;
    }
    while (high - low > 1e-4 * low)
        (stable((low + high) / 2) ? low : high) = (low + high) / 2;
    bound.dashpot_s = low;
    bound.dt_s = std::min(low, other);
    bound.edge_s = std::numeric_limits<double>::infinity(); // the matrices have what is left of them
    if (bound.dt_s == bound.flat_s)
        bound.governed_by = StepLimit::flat_fall;
    else
        bound.governed_by = v.C.isZero(0) ? StepLimit::stiffness : StepLimit::dashpot;
    return bound;
}

LinearResponse linear_response(const Realization& r)
{
    return response_of(dynamics_of(r));
}

FirstMode first_mode(const Realization& r)
{
    return first_mode_of(dynamics_of(r));
}

FirstMode first_mode_of_paper(const Realization& r)
{
    return first_mode_of(dynamics_of(r, contacts_of_paper(r)));
}

} // namespace stylobate

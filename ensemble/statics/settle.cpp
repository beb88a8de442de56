#include "ensemble/statics/settle.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr int most_iterations = 60;
constexpr int most_halvings = 12;
constexpr double balanced = 1e-11;
constexpr double least_chord = 1e-12; // m; as in the kernel

using Row = Eigen::Matrix<double, 6, 1>; // motion of the lower block (x, y, theta), then of the upper one

/// A joint in some pose: its force on (lower, upper) and its tangent stiffness.
struct JointForce {
    Row force = Row::Zero();
    Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
    double spring = 0;
};

/// How the upper face moves against the lower one, along (x, y), at a point, when the blocks move.
Row relative_motion(double x, double y, double px, double py, const Pose& lower, const Pose& upper)
{
    const double lx = px - lower.x, ly = py - lower.y, ux = px - upper.x, uy = py - upper.y;
    Row row;
    row << -x, -y, -(lx * y - ly * x), x, y, ux * y - uy * x;
    return row;
}

/// Bottom face of the upper block, in the lower block's frame with its origin in the top face.
Placement<double> placement(const Block& lower, const Pose& l, const Block& upper, const Pose& u)
{
    const double sine = std::sin(u.theta - l.theta), cosine = std::cos(u.theta - l.theta);
    const double bx = u.x + upper.half_height_m * std::sin(u.theta) - l.x;
    const double by = u.y - upper.half_height_m * std::cos(u.theta) - l.y;
    const double x = bx * std::cos(l.theta) + by * std::sin(l.theta);
    const double y = -bx * std::sin(l.theta) + by * std::cos(l.theta) - lower.half_height_m;
    return {x, -y, sine, cosine};
}

/// @param law of a bed of an extended model, else null
JointForce joint_force(const Realization& r, int index, const BedLaw* law, const Pose& l, const Pose& u)
{
    const Joint& joint = r.joints[static_cast<std::size_t>(index)];
    const bool bed = index < r.beds();
    const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
    const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
    JointForce f;
    const Overlap<double> o = law == nullptr ? overlap_of(lower, l, upper, u) : bed_overlap_of(r, index, *law, l, u);
    const double chord = std::hypot(o.normal_x, o.normal_y);
    if (o.area <= 0 || chord < least_chord)
        return f;
    const double sine = std::sin(l.theta), cosine = std::cos(l.theta);
    const auto into_base = [&](double x, double y) {
        return Pose{l.x + x * cosine - y * sine, l.y + x * sine + y * cosine, 0};
    };
    const double nx = (o.normal_x * cosine - o.normal_y * sine) / chord;
    const double ny = (o.normal_x * sine + o.normal_y * cosine) / chord;
    const double cx = o.moment_x / o.area, cy = lower.half_height_m - o.moment_depth / o.area;
    const Pose centroid = into_base(cx, cy);
    // a bed's stiffness acts at the middle of its length, from which the centroid is drawn towards the deeper end
    const double length = std::min(chord, 2 * std::min(lower.half_width_m, upper.half_width_m));
    const double turn = std::sin(u.theta - l.theta - (law == nullptr ? 0 : joint.extension.wedge_rad));
    const double spread = law != nullptr && law->form == ContactForm::two_corner ? 4 : 12; // k_theta = k_n L2 / spread
    const double aside =
        bed ? std::clamp(turn * length * length * length / (spread * o.area), -length / 2, length / 2) : 0;
    const Pose middle = into_base(cx + aside, cy);

    const double F_n = law == nullptr ? joint.normal_stiffness_n_m2 * o.area : law->force(o.area);
    double k_n = joint.normal_stiffness_n_m2 * length;
    if (law != nullptr)
        k_n = F_n / o.area * length * (1 + law->exponent) * (law->form == ContactForm::points ? 1.5 : 1);
    const Row opening = relative_motion(nx, ny, middle.x, middle.y, l, u);
    f.stiffness = k_n * opening * opening.transpose();
    Row turning = Row::Zero();
    turning(2) = -1;
    turning(5) = 1;
    f.stiffness += k_n * length * length / spread * turning * turning.transpose();

    double F_t = 0;
    if (bed) { // sliding since the reference stack, for small displacements
        const Row sliding = relative_motion(ny, -nx, centroid.x, centroid.y, l, u);
        Row moved;
        moved << l.x - lower.x_m, l.y - lower.y_m, l.theta, u.x - upper.x_m, u.y - upper.y_m, u.theta;
        const double limit = joint.friction * F_n;
        F_t = std::clamp(joint.tangential_stiffness_n_m * sliding.dot(moved), -limit, limit);
        f.stiffness += joint.tangential_stiffness_n_m * sliding * sliding.transpose();
    }
    f.spring = F_t;
    f.force = relative_motion(F_n * nx - F_t * ny, F_n * ny + F_t * nx, centroid.x, centroid.y, l, u);
    return f;
}

} // namespace

Overlap<double> overlap_of(const Block& lower, const Pose& l, const Block& upper, const Pose& u)
{
    return general_overlap<double>(placement(lower, l, upper, u),
                                   {lower.half_width_m, lower.half_height_m, upper.half_width_m, upper.half_height_m});
}

Overlap<double> bed_overlap_of(const Realization& r, int bed, const BedLaw& law, const Pose& l, const Pose& u)
{
    const Joint& joint = r.joints[static_cast<std::size_t>(bed)];
    const Placement<double> place = placement(r.blocks[static_cast<std::size_t>(joint.lower)], l,
                                              r.blocks[static_cast<std::size_t>(joint.upper)], u);
    const auto general = [](const Placement<double>& p, const PairSizes<double>& sizes, bool fits, Overlap<double>& o,
                            auto& points) { take_general(p, sizes, fits, o, points); };
    FormPoints<double, 0> none{};
    FormPoints<double, 2> two{};
    FormPoints<double, 5> five{};
    switch (law.form) {
    case ContactForm::two_corner:
        return bed_overlap<ContactForm::two_corner>(place, law.faces, false, two, general);
    case ContactForm::points:
        return bed_overlap<ContactForm::points>(place, law.faces, false, five, general);
    case ContactForm::area:
        break;
    }
    return bed_overlap<ContactForm::area>(place, law.faces, false, none, general);
}

double bed_elastic_n(const Realization& r, int bed, const Pose& l, const Pose& u)
{
    const BedLaw law = bed_law(r, bed);
    return law.force(bed_overlap_of(r, bed, law, l, u).area);
}

double settle(const Realization& r, std::vector<Pose>& poses, std::vector<double>& spring_n)
{
    std::vector<Eigen::Index> first(r.blocks.size(), -1);
    Eigen::Index size = 0;
    for (std::size_t b = 0; b < r.blocks.size(); ++b)
        if (!r.blocks[b].fixed) {
            first[b] = size;
            size += 3;
        }
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(size), scale(size);
    for (std::size_t b = 0; b < r.blocks.size(); ++b) {
        if (first[b] < 0)
            continue;
        const double m = r.blocks[b].mass_kg, g = r.gravity_m_s2;
        weight(first[b]) = m * g * std::sin(r.base_tilt_rad);
        weight(first[b] + 1) = -m * g * std::cos(r.base_tilt_rad);
        scale.segment<3>(first[b]) = Eigen::Vector3d(m * g, m * g, m * g * r.blocks[b].half_width_m);
    }

    std::vector<BedLaw> laws; // with extensions
    if (rests_otherwise(r))
        for (int j = 0; j < r.beds(); ++j)
            laws.push_back(bed_law(r, j));

    Eigen::MatrixXd K(size, size);
    Eigen::VectorXd residual(size);
    const auto add = [&](const Joint& joint, const JointForce& f) {
        const std::size_t both[2] = {static_cast<std::size_t>(joint.lower), static_cast<std::size_t>(joint.upper)};
        for (int a = 0; a < 2; ++a) {
            if (first[both[a]] < 0)
                continue;
            residual.segment<3>(first[both[a]]) += f.force.segment<3>(3 * a);
            for (int b = 0; b < 2; ++b)
                if (first[both[b]] >= 0)
                    K.block<3, 3>(first[both[a]], first[both[b]]) += f.stiffness.block<3, 3>(3 * a, 3 * b);
        }
    };
    const auto evaluate = [&](const std::vector<Pose>& at) {
        K.setZero();
        residual = weight;
        for (std::size_t b = 0; b < r.blocks.size(); ++b) // a centre of mass beside the middle
            if (first[b] >= 0) {
                const double e = r.blocks[b].extension.eccentricity_m;
                residual(first[b] + 2) +=
                    e * (std::cos(at[b].theta) * weight(first[b] + 1) - std::sin(at[b].theta) * weight(first[b]));
            }
        spring_n.assign(r.joints.size(), 0);
        for (std::size_t j = 0; j < r.joints.size(); ++j) {
            const Joint& joint = r.joints[j];
            const auto l = static_cast<std::size_t>(joint.lower), u = static_cast<std::size_t>(joint.upper);
            const JointForce f =
                joint_force(r, static_cast<int>(j), j < laws.size() ? &laws[j] : nullptr, at[l], at[u]);
            spring_n[j] = f.spring;
            add(joint, f);
        }
        return residual.cwiseQuotient(scale).cwiseAbs().maxCoeff();
    };
    const auto moved = [&](const Eigen::VectorXd& by, double part) {
        std::vector<Pose> to = poses;
        for (std::size_t b = 0; b < to.size(); ++b)
            if (first[b] >= 0) {
                to[b].x += part * by(first[b]);
                to[b].y += part * by(first[b] + 1);
                to[b].theta += part * by(first[b] + 2);
            }
        return to;
    };

    // first guess: full beds, which carry tension too
    K.setZero();
    residual = weight;
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const auto l = static_cast<std::size_t>(joint.lower), u = static_cast<std::size_t>(joint.upper);
        const Block &lower = r.blocks[l], &upper = r.blocks[u];
        const double left = std::max(lower.x_m - lower.half_width_m, upper.x_m - upper.half_width_m);
        const double right = std::min(lower.x_m + lower.half_width_m, upper.x_m + upper.half_width_m);
        const double length = std::max(right - left, 1e-6 * upper.half_width_m), middle = 0.5 * (left + right);
        const double face = lower.y_m + lower.half_height_m;
        JointForce f;
        const Row opening = relative_motion(0, 1, middle, face, poses[l], poses[u]);
        const Row sliding = relative_motion(1, 0, middle, face, poses[l], poses[u]);
        Row turning = Row::Zero();
        turning(2) = -1;
        turning(5) = 1;
        const double k_n = joint.normal_stiffness_n_m2 * length;
        f.stiffness = k_n * opening * opening.transpose() +
                      joint.tangential_stiffness_n_m * sliding * sliding.transpose() +
                      k_n * length * length / 12 * turning * turning.transpose();
        f.force = k_n * length * length / 12 * joint.extension.wedge_rad * turning; // what would turn it by its wedge
        add(joint, f);
    }
    // a block that has lost all its contacts must not make the tangent singular
    const Eigen::VectorXd least = 1e-9 * K.diagonal();
    poses = moved(K.ldlt().solve(residual), 1);

    double lacks = evaluate(poses);
    for (int i = 0; i < most_iterations && lacks > balanced; ++i) {
        K.diagonal() += least;
        const Eigen::VectorXd by = K.ldlt().solve(residual);
        double part = 1, found = lacks;
        std::vector<Pose> to;
        for (int k = 0; k < most_halvings; ++k, part *= 0.5) {
            to = moved(by, part);
            found = evaluate(to);
            if (found < lacks)
                break;
        }
        if (!(found < lacks))
            break;
        poses = to;
        lacks = found;
    }
    return evaluate(poses);
}

} // namespace stylobate

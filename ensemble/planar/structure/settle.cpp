#include "ensemble/planar/structure/settle.hpp"

#include "kernels/planar/mechanisms/mortar.hpp"

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

/// The part of a bonded bed that opens.
JointForce bond_force(const BedAtRest& bed, const Pose& l, const Pose& u)
{
    const Joint& joint = bed.joint;
    const Block &lower = bed.lower, &upper = bed.upper;
    const BedLaw& law = bed.law;
    const Placement<double> place =
        onto_wedge(placement(lower, l, upper, u), law.faces.wedge_sine, law.faces.wedge_versine);
    const double left = std::max(-lower.half_width_m - place.x, -upper.half_width_m) + joint.mechanisms.chip_left_m;
    const double right = std::min(lower.half_width_m - place.x, upper.half_width_m) - joint.mechanisms.chip_right_m;
    const double at_left = left * place.sine - place.depth, at_right = right * place.sine - place.depth;
    const BondPull<double> pull = bond_pull(left, right, at_left, at_right);
    JointForce f;
    if (!(pull.force > 0))
        return f;
    const double most = std::max(at_left, at_right), least = std::min(at_left, at_right);
    const double length = (right - left) * most / (most - std::min(least, 0.0)), arm = pull.couple / pull.force;
    const double nx = -std::sin(l.theta), ny = std::cos(l.theta);
    const double px = u.x + upper.half_height_m * std::sin(u.theta) + arm * std::cos(u.theta);
    const double py = u.y - upper.half_height_m * std::cos(u.theta) + arm * std::sin(u.theta);
    const Row opening = relative_motion(nx, ny, px, py, l, u);
    Row turning = Row::Zero();
    turning(2) = -1;
    turning(5) = 1;
    const double k = law.K_n * length;
    f.stiffness = k * opening * opening.transpose() + k * length * length / 12 * turning * turning.transpose();
    f.force = -law.K_n * pull.force * opening;
    return f;
}

/// @param is_bed    or a watched pair, which has no friction at rest
/// @param mechanisms of a bed on which they act at rest, else null: the paper's contact
JointForce joint_force(const Realization& r, const Joint& joint, bool is_bed, const BedAtRest* mechanisms,
                       const Pose& l, const Pose& u)
{
    const Block& lower = block_of(r, joint.lower);
    const Block& upper = block_of(r, joint.upper);
    const BedLaw* const law = mechanisms == nullptr ? nullptr : &mechanisms->law;
    JointForce f;
    const Overlap<double> o = mechanisms == nullptr ? overlap_of(lower, l, upper, u) : overlap_of(*mechanisms, l, u);
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
    const double turn = std::sin(u.theta - l.theta - (law == nullptr ? 0 : joint.mechanisms.wedge_rad));
    const double spread = law != nullptr && law->form == ContactForm::two_corner ? 4 : 12; // k_theta = k_n L2 / spread
    const double aside =
        is_bed ? std::clamp(turn * length * length * length / (spread * o.area), -length / 2, length / 2) : 0;
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
    if (is_bed) { // sliding since the reference stack, for small displacements
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

/// A full bed, which carries tension too: the first guess.
JointForce full_bed(const BedAtRest& bed, const Pose& l, const Pose& u)
{
    const Joint& joint = bed.joint;
    const Block &lower = bed.lower, &upper = bed.upper;
    const double length = std::max(bed.right_m - bed.left_m, 1e-6 * upper.half_width_m);
    const double middle = 0.5 * (bed.left_m + bed.right_m);
    const double face = lower.y_m + lower.half_height_m;
    JointForce f;
    const Row opening = relative_motion(0, 1, middle, face, l, u);
    const Row sliding = relative_motion(1, 0, middle, face, l, u);
    Row turning = Row::Zero();
    turning(2) = -1;
    turning(5) = 1;
    const double k_n = joint.normal_stiffness_n_m2 * length;
    f.stiffness = k_n * opening * opening.transpose() + joint.tangential_stiffness_n_m * sliding * sliding.transpose() +
                  k_n * length * length / 12 * turning * turning.transpose();
    f.force = k_n * length * length / 12 * joint.mechanisms.wedge_rad * turning; // what would turn it by its wedge
    return f;
}

/// The forces on the free blocks in some pose and their tangent: K d = residual is Newton's step.
class Equilibrium {
public:
    Equilibrium(const Realization& r, const std::vector<BedAtRest>& beds, std::vector<double>& spring_n)
        : r_(r), beds_(beds), spring_n_(spring_n), mechanisms_(rests_otherwise(r)), first_(r.blocks.size(), -1)
    {
        Eigen::Index size = 0;
        for (std::size_t b = 0; b < r.blocks.size(); ++b)
            if (!r.blocks[b].fixed) {
                first_[b] = size;
                size += 3;
            }
        weight_ = Eigen::VectorXd::Zero(size);
        scale_.resize(size);
        for (std::size_t b = 0; b < r.blocks.size(); ++b) {
            if (first_[b] < 0)
                continue;
            const double m = r.blocks[b].mass_kg, g = r.gravity_m_s2;
            weight_(first_[b]) = m * g * std::sin(r.base_tilt_rad);
            weight_(first_[b] + 1) = -m * g * std::cos(r.base_tilt_rad);
            scale_.segment<3>(first_[b]) = Eigen::Vector3d(m * g, m * g, m * g * r.blocks[b].half_width_m);
        }
        for (std::size_t b = 0; b < r.blocks.size(); ++b)
            if (first_[b] >= 0 && r.blocks[b].strengthening.tendon_prestress_n > 0)
                tendons_.push_back(static_cast<int>(b));
        K_.resize(size, size);
        residual_.resize(size);
    }

    /// Full beds at these poses, without friction's limit. They leave behind the least stiffness with which a block
    /// that has lost all its contacts does not make the tangent singular.
    void assume_full_beds(const std::vector<Pose>& at)
    {
        K_.setZero();
        residual_ = weight_;
        add_tendons(at);
        for (const BedAtRest& bed : beds_)
            add(bed.joint, full_bed(bed, at[static_cast<std::size_t>(bed.joint.lower)],
                                    at[static_cast<std::size_t>(bed.joint.upper)]));
        least_ = 1e-9 * K_.diagonal();
    }

    /// @return largest force on a block that is not balanced, over the block's weight
    double evaluate(const std::vector<Pose>& at)
    {
        K_.setZero();
        residual_ = weight_;
        for (std::size_t b = 0; b < r_.blocks.size(); ++b) // a centre of mass beside the middle
            if (first_[b] >= 0) {
                const double e = r_.blocks[b].mechanisms.eccentricity_m;
                residual_(first_[b] + 2) +=
                    e * (std::cos(at[b].theta) * weight_(first_[b] + 1) - std::sin(at[b].theta) * weight_(first_[b]));
            }
        add_tendons(at);
        spring_n_.assign(r_.joints.size(), 0);
        for (std::size_t j = 0; j < r_.joints.size(); ++j) {
            const Joint& joint = r_.joints[j];
            const auto l = static_cast<std::size_t>(joint.lower), u = static_cast<std::size_t>(joint.upper);
            const bool is_bed = j < beds_.size();
            const BedAtRest* const mechanisms = is_bed && mechanisms_ ? &beds_[j] : nullptr;
            const JointForce f = joint_force(r_, joint, is_bed, mechanisms, at[l], at[u]);
            spring_n_[j] = f.spring;
            add(joint, f);
            if (mechanisms != nullptr && mechanisms->law.bonded)
                add(joint, bond_force(*mechanisms, at[l], at[u]));
        }
        return residual_.cwiseQuotient(scale_).cwiseAbs().maxCoeff();
    }

    void stiffen() { K_.diagonal() += least_; }
    Eigen::VectorXd step() const { return K_.ldlt().solve(residual_); }

    /// The poses after a part of a step.
    std::vector<Pose> moved(const std::vector<Pose>& from, const Eigen::VectorXd& by, double part) const
    {
        std::vector<Pose> to = from;
        for (std::size_t b = 0; b < to.size(); ++b)
            if (first_[b] >= 0) {
                to[b].x += part * by(first_[b]);
                to[b].y += part * by(first_[b] + 1);
                to[b].theta += part * by(first_[b] + 2);
            }
        return to;
    }

private:
    void add_tendons(const std::vector<Pose>& at)
    {
        for (const int block : tendons_) {
            const auto b = static_cast<std::size_t>(block);
            const TendonPull pull = tendon_pull(r_, block, at[b]);
            residual_.segment<3>(first_[b]) += Eigen::Vector3d(pull.x_n, pull.y_n, pull.moment_n_m);
        }
    }

    void add(const Joint& joint, const JointForce& f)
    {
        const std::size_t both[2] = {static_cast<std::size_t>(joint.lower), static_cast<std::size_t>(joint.upper)};
        for (int a = 0; a < 2; ++a) {
            if (first_[both[a]] < 0)
                continue;
            residual_.segment<3>(first_[both[a]]) += f.force.segment<3>(3 * a);
            for (int b = 0; b < 2; ++b)
                if (first_[both[b]] >= 0)
                    K_.block<3, 3>(first_[both[a]], first_[both[b]]) += f.stiffness.block<3, 3>(3 * a, 3 * b);
        }
    }

    const Realization& r_;
    const std::vector<BedAtRest>& beds_;
    std::vector<double>& spring_n_;   ///< (joints) of the last poses [N]
    bool mechanisms_;                 ///< whether one acts at rest
    std::vector<Eigen::Index> first_; ///< (blocks) of the three unknowns of a block; -1: fixed
    Eigen::VectorXd weight_, scale_;  ///< of the blocks in the base's frame; what an unbalanced force is measured by
    std::vector<int> tendons_;        ///< free blocks with a prestressed one
    Eigen::MatrixXd K_;
    Eigen::VectorXd residual_, least_;
};

} // namespace

bool rests_otherwise(const Realization& r)
{
    return (r.form != ContactForm::area && r.form != ContactForm::rigid) ||
           std::any_of(r.blocks.begin(), r.blocks.end(),
                       [](const Block& block) {
                           return block.mechanisms.eccentricity_m != 0 || block.strengthening.tendon_prestress_n > 0;
                       }) ||
           std::any_of(r.joints.begin(), r.joints.end(), [](const Joint& joint) {
               const JointMechanisms& e = joint.mechanisms;
               return joint.bonded() || e.force_exponent != 1 || e.chip_left_m != 0 || e.chip_right_m != 0 ||
                      e.wedge_rad != 0;
           });
}

Overlap<double> overlap_of(const Block& lower, const Pose& l, const Block& upper, const Pose& u)
{
    return general_overlap<double>(placement(lower, l, upper, u),
                                   {lower.half_width_m, lower.half_height_m, upper.half_width_m, upper.half_height_m});
}

Overlap<double> overlap_of(const BedAtRest& bed, const Pose& l, const Pose& u)
{
    const Placement<double> place = placement(bed.lower, l, bed.upper, u);
    const BedLaw& law = bed.law;
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
    case ContactForm::rigid: // has no such law
        break;
    }
    return bed_overlap<ContactForm::area>(place, law.faces, false, none, general);
}

TendonAnchors tendon_anchors(const Realization& r, int block, const Pose& pose)
{
    const Block& b = block_of(r, block);
    double ground_y_m = 0; // of the highest fixed drum of the column, or of the base
    for (const Block& below : r.blocks)
        if (below.fixed && below.role == BlockRole::drum && below.column == b.column)
            ground_y_m = std::max(ground_y_m, below.y_m + below.half_height_m);
    const double arm_x = -b.half_height_m * std::sin(pose.theta), arm_y = b.half_height_m * std::cos(pose.theta);
    return {pose.x + arm_x - b.x_m, pose.y + arm_y - ground_y_m, arm_x, arm_y};
}

TendonPull tendon_pull(const Realization& r, int block, const Pose& pose)
{
    const double T = block_of(r, block).strengthening.tendon_prestress_n;
    if (!(T > 0))
        return {0, 0, 0};
    const TendonAnchors a = tendon_anchors(r, block, pose);
    const double x = -T * a.x / a.length(), y = -T * a.y / a.length();
    return {x, y, a.arm_x * y - a.arm_y * x};
}

double settle(const Realization& r, const std::vector<BedAtRest>& beds, std::vector<Pose>& poses,
              std::vector<double>& spring_n)
{
    Equilibrium balance(r, beds, spring_n);
    balance.assume_full_beds(poses);
    poses = balance.moved(poses, balance.step(), 1);

    // Newton's method; a step that does not better the balance is halved
    double lacks = balance.evaluate(poses);
    for (int i = 0; i < most_iterations && lacks > balanced; ++i) {
        balance.stiffen();
        const Eigen::VectorXd by = balance.step();
        double part = 1, found = lacks;
        std::vector<Pose> to;
        for (int k = 0; k < most_halvings; ++k, part *= 0.5) {
            to = balance.moved(poses, by, part);
            found = balance.evaluate(to);
            if (found < lacks)
                break;
        }
        if (!(found < lacks))
            break;
        poses = to;
        lacks = found;
    }
    return balance.evaluate(poses);
}

} // namespace stylobate

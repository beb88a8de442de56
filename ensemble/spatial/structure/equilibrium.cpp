#include "ensemble/spatial/structure/equilibrium.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace stylobate {
namespace {

using Vector = spatial::Vector<double>;
using Sparse = Eigen::SparseMatrix<double>;

constexpr int freedoms = 6;
constexpr int most_iterations = 60;
constexpr int most_halvings = 12;
constexpr double target = 1e-12;             ///< of the weight: the search ends
constexpr double balanced = 1e-11;           ///< of the weight: at rest
constexpr double most_allowed = 1e-3;        ///< of the weight, in any case
constexpr double keeps = 0.1;                ///< a step that leaves less of the residual keeps the derivatives
constexpr double overshoots = 0.8;           ///< of the first slope of the energy, beyond its minimum
constexpr double longest_step = 0.05;        ///< of a body's radius of gyration
constexpr double difference = 1e-2;          ///< of the least depth: the step of the derivatives
constexpr double least_difference_m = 1e-13; ///< of a joint that hardly presses: its derivatives keep four digits
constexpr double least_stiffness = 1e-9;     ///< of the largest: what holds a body that has lost all its contacts

double smaller_half(const Face& face)
{
    return face.round ? face.half_x_m : std::min(face.half_x_m, face.half_z_m);
}

/// The search: poses, residual and derivatives. Moments and rotations are in units of a body's radius of gyration, so
/// that all are forces and lengths.
class Search {
public:
    Search(const SpatialStructure& structure, const SolidTopology& solids, ForcesAtRest& forces)
        : structure_(structure), solids_(solids), topology_(solids.kernel()), forces_(forces),
          gravity_(std::sqrt(dot(forces.gravity(), forces.gravity()))), residual_(freedoms * topology_.free_bodies()),
          K_(residual_.size(), residual_.size())
    {
        rest_.poses.assign(static_cast<std::size_t>(topology_.bodies), {{0, 0, 0}, spatial::no_rotation<double>()});
        for (const int i : solids.order()) {
            const Solid& solid = structure.solids[static_cast<std::size_t>(i)];
            const auto& I = solid.inertia_kg_m2;
            gyration_m_.push_back(std::sqrt((I[0] + I[1] + I[2]) / (3 * solid.mass_kg)));
            weight_n_.push_back(solid.mass_kg * gravity_);
        }
        color();
    }

    Rest run()
    {
        forces_.limit_friction(false);
        sink();
        iterate(false);
        forces_.limit_friction(true);
        take(evaluate(rest_.poses));
        if (!rest_.balanced())
            iterate(true);
        const auto stable = [&] { return slips_ || ldlt_.vectorD().minCoeff() > 0; };
        if (!stable() && !derived_here_) // those of poses nearby
            derive();
        rest_.stable = stable();
        evaluate(rest_.poses); // the derivatives have left other poses
        return std::move(rest_);
    }

private:
    /// Bodies of one colour share no joint: they can be displaced at once, and each change of force belongs to one.
    void color()
    {
        color_.assign(static_cast<std::size_t>(topology_.bodies), -1);
        for (int i = topology_.fixed; i < topology_.bodies; ++i) {
            std::vector<bool> taken(static_cast<std::size_t>(topology_.bodies), false);
            for (int at = topology_.joint_lists[i]; at < topology_.joint_lists[i + 1]; ++at) {
                const spatial::TopologyJoint& joint = topology_.joint[topology_.joint_lists[at] / 2];
                const int of = color_[static_cast<std::size_t>(joint.lower == i ? joint.upper : joint.lower)];
                if (of >= 0)
                    taken[static_cast<std::size_t>(of)] = true;
            }
            const auto free = std::find(taken.begin(), taken.end(), false);
            color_[static_cast<std::size_t>(i)] = static_cast<int>(free - taken.begin());
            colors_ = std::max(colors_, color_[static_cast<std::size_t>(i)] + 1);
        }
    }

    /// Puts each body as deep into its beds as the mean of their depths under their loads. The depths follow from the
    /// forces at any other ones, as full beds are linear.
    void sink()
    {
        const std::vector<double> load = bed_loads_n(structure_, -forces_.gravity().y);
        depth_m_.resize(load.size());
        for (std::size_t j = 0; j < load.size(); ++j) {
            const SolidJoint& joint = structure_.joints[j];
            const double half = std::min(smaller_half(joint.lower_face), smaller_half(joint.upper_face));
            const double bearing = 1 - joint.inner_ratio * joint.inner_ratio;
            depth_m_[j] = load[j] / (4 * bearing * half * half * joint.normal_stiffness_n_m3);
        }
        lower_by(depth_m_);
        evaluate(rest_.poses);
        for (std::size_t j = 0; j < load.size(); ++j)
            if (const double force = forces_.normal_n(static_cast<int>(j)); force > 0)
                depth_m_[j] *= load[j] / force;
        lower_by(depth_m_);
        allow();
        take(evaluate(rest_.poses));
    }

    /// Stacks the bodies: each on the turned faces below it, as deep as given.
    void lower_by(const std::vector<double>& depth_m)
    {
        std::vector<int> order(structure_.solids.size());
        std::iota(order.begin(), order.end(), 0);
        const auto height = [&](int i) { return structure_.solids[static_cast<std::size_t>(i)].centre_m[1]; };
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return height(a) < height(b); });
        for (const int i : order)
            if (const int place = solids_.place_of(static_cast<std::size_t>(i)); place >= topology_.fixed)
                rest_.poses[static_cast<std::size_t>(place)] = stacked(i, depth_m);
    }

    SolidPose stacked(int upper, const std::vector<double>& depth_m) const
    {
        const auto each_seat = [&](const auto& take) {
            for (std::size_t j = 0; j < depth_m.size(); ++j)
                if (const SolidJoint& joint = structure_.joints[j]; joint.upper == upper && joint.normal == Normal::y)
                    take(
                        joint, depth_m[j],
                        rest_.poses[static_cast<std::size_t>(solids_.place_of(static_cast<std::size_t>(joint.lower)))]);
        };
        const auto wedge = [](const SolidJoint& joint) {
            return Vector{joint.mechanisms.wedge_x_rad, 0, joint.mechanisms.wedge_rad};
        };
        spatial::Quaternion<double> sum{0, 0, 0, 0};
        int seats = 0;
        each_seat([&](const SolidJoint& joint, double, const SolidPose& below) {
            const Vector turn = rotated(spatial::minus_identity(below.attitude), wedge(joint));
            const spatial::Quaternion<double> q = after_turn(below.attitude, turn);
            sum = {sum.w + q.w, sum.x + q.x, sum.y + q.y, sum.z + q.z};
            ++seats;
        });
        if (seats == 0)
            return {{0, 0, 0}, spatial::no_rotation<double>()};
        const double per = 1 / std::sqrt(sum.w * sum.w + sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
        SolidPose pose{{0, 0, 0}, {per * sum.w, per * sum.x, per * sum.y, per * sum.z}};
        each_seat([&](const SolidJoint& joint, double depth, const SolidPose& below) {
            const auto anchor = [&](int solid) {
                const auto& c = structure_.solids[static_cast<std::size_t>(solid)].centre_m;
                return Vector{joint.point_m[0] - c[0], joint.point_m[1] - c[1], joint.point_m[2] - c[2]};
            };
            const Vector from_pivot{-joint.lower_middle_m[1], 0, -joint.lower_middle_m[0]};
            const auto face = spatial::minus_identity(after_turn(spatial::no_rotation<double>(), wedge(joint)));
            const auto lower = spatial::minus_identity(below.attitude), own = spatial::minus_identity(pose.attitude);
            const Vector moved = below.displacement + displaced(lower, anchor(joint.lower)) +
                                 rotated(lower, displaced(face, from_pivot)) - displaced(own, anchor(upper)) -
                                 Vector{0, depth, 0};
            pose.displacement = pose.displacement + 1.0 / seats * moved;
        });
        return pose;
    }

    /// Where sides of the two faces lie exactly over each other, or the rims of equal discs do, the lateral force of
    /// the bed jumps by about the depth over the width of its load (kernels/spatial/THEORY.md, section 5), and a pose
    /// beside it may not be balanced to less.
    void allow()
    {
        rest_.allowed = balanced;
        for (std::size_t j = 0; j < depth_m_.size(); ++j) {
            const SolidJoint& joint = structure_.joints[j];
            // pieces that just touch: what is not balanced there closes or opens their joint by nanometres
            if (joint.normal != Normal::y && joint.gap_m == 0)
                rest_.allowed = most_allowed;
            const double half = std::min(smaller_half(joint.lower_face), smaller_half(joint.upper_face));
            const double sides = (1 + joint.inner_ratio) * half; // those of the recesses, too
            const double jump = joint.normal_stiffness_n_m3 * depth_m_[j] * depth_m_[j] * sides;
            for (const int of : {joint.lower, joint.upper})
                if (!structure_.solids[static_cast<std::size_t>(of)].fixed)
                    rest_.allowed = std::max(
                        rest_.allowed,
                        4 * jump / weight_n_[static_cast<std::size_t>(solids_.place_of(static_cast<std::size_t>(of)))]);
        }
        rest_.allowed = std::min(rest_.allowed, most_allowed);
    }

    /// Newton's method.
    /// @param cone with the friction cone
    void iterate(bool cone)
    {
        cone_ = cone;
        derive();
        bool opened = false; // the derivatives are those with all butt joints open
        for (int i = 0; i < most_iterations && rest_.unbalanced > target; ++i) {
            const double before = rest_.unbalanced;
            const bool fresh = derived_here_, moved = step();
            if (rest_.unbalanced <= keeps * before)
                continue;
            if (fresh && !moved && !opened && butts_press()) { // a kink: the step that opens them may lead past it
                derive(true);
                opened = true;
                continue;
            }
            if (fresh && (!moved || rest_.balanced()))
                break;
            derive();
            opened = false;
        }
    }

    bool butts_press() const
    {
        for (std::size_t j = 0; j < depth_m_.size(); ++j)
            if (!(depth_m_[j] > 0) && forces_.normal_n(static_cast<int>(j)) > 0)
                return true;
        return false;
    }

    struct Residual {
        Eigen::VectorXd of;
        double most;
        int worst;
    };
    Residual evaluate(const std::vector<SolidPose>& poses)
    {
        forces_.put(poses);
        Residual r{Eigen::VectorXd(residual_.size()), 0, topology_.fixed};
        for (int i = topology_.fixed; i < topology_.bodies; ++i) {
            const auto [f, m] = forces_.unbalanced(i);
            const double per = 1 / gyration_m_[static_cast<std::size_t>(i)];
            auto part = r.of.segment<freedoms>(freedoms * (i - topology_.fixed));
            part << f.x, f.y, f.z, per * m.x, per * m.y, per * m.z;
            const double most = part.cwiseAbs().maxCoeff() / weight_n_[static_cast<std::size_t>(i)];
            if (!(most <= r.most)) {
                r.most = most;
                r.worst = i;
            }
        }
        return r;
    }
    void take(const Residual& r)
    {
        residual_ = r.of;
        rest_.unbalanced = r.most;
        rest_.worst = r.worst;
        derived_here_ = false;
    }

    SolidPose moved(int i, const SolidPose& from, const Eigen::Matrix<double, freedoms, 1>& by) const
    {
        const double per = 1 / gyration_m_[static_cast<std::size_t>(i)];
        return {from.displacement + Vector{by(0), by(1), by(2)},
                after_turn(from.attitude, per * Vector{by(3), by(4), by(5)})};
    }

    /// The derivatives at the present poses, and their factors.
    /// @param butts_open as if no butt joint pressed
    void derive(bool butts_open = false)
    {
        const auto joints = static_cast<std::size_t>(topology_.joints);
        forces_.put(rest_.poses);
        std::vector<BedForces> here(joints);
        std::vector<bool> open(joints); // a butt joint that just touches would press when one body moves only
        slips_ = false;
        for (std::size_t j = 0; j < joints; ++j) {
            here[j] = forces_.forces(static_cast<int>(j));
            open[j] = !(depth_m_[j] > 0) && (butts_open || !(forces_.normal_n(static_cast<int>(j)) > 0));
            slips_ = slips_ || forces_.slips(static_cast<int>(j));
        }
        const double most_m = difference * *std::max_element(depth_m_.begin(), depth_m_.end());
        std::vector<double> by_m(static_cast<std::size_t>(topology_.bodies), most_m);
        for (std::size_t j = 0; j < joints; ++j) {
            // a butt joint has no load of its own: it is as deep as it is pressed now
            const SolidJoint& joint = structure_.joints[j];
            const double depth_m =
                depth_m_[j] > 0 ? depth_m_[j]
                                : forces_.normal_n(static_cast<int>(j)) / (joint.normal_stiffness_n_m3 * joint.area_m2);
            for (const int i : {topology_.joint[j].lower, topology_.joint[j].upper})
                if (double& by = by_m[static_cast<std::size_t>(i)]; depth_m > 0)
                    by = std::min(by, std::max(difference * depth_m, least_difference_m));
        }
        entries_.clear();
        for (int c = 0; c < colors_; ++c)
            for (int k = 0; k < freedoms; ++k) {
                std::vector<SolidPose> poses = rest_.poses;
                for (std::size_t i = 0; i < poses.size(); ++i)
                    if (color_[i] == c)
                        poses[i] =
                            moved(static_cast<int>(i), poses[i], by_m[i] * Eigen::Matrix<double, freedoms, 1>::Unit(k));
                forces_.put(poses);
                for (std::size_t j = 0; j < joints; ++j)
                    for (const int i : {topology_.joint[j].lower, topology_.joint[j].upper})
                        if (color_[static_cast<std::size_t>(i)] == c && !open[j])
                            add_column(static_cast<int>(j), here[j], i, k, by_m[static_cast<std::size_t>(i)]);
            }
        K_.setFromTriplets(entries_.begin(), entries_.end());
        factorize();
        derived_here_ = true;
    }

    /// Adds to the column of one freedom of a body what a joint's forces change by.
    void add_column(int j, const BedForces& before, int body, int freedom, double by_m)
    {
        const BedForces now = forces_.forces(j);
        const int column = freedoms * (body - topology_.fixed) + freedom;
        const auto add = [&](int to, double sign, const Vector& force, const Vector& moment) {
            if (to < topology_.fixed)
                return;
            const int row = freedoms * (to - topology_.fixed);
            const double f = -sign / by_m, m = f / gyration_m_[static_cast<std::size_t>(to)];
            int k = 0;
            for (const double value : {f * force.x, f * force.y, f * force.z, m * moment.x, m * moment.y, m * moment.z})
                entries_.emplace_back(row + k++, column, value);
        };
        const spatial::TopologyJoint& joint = topology_.joint[j];
        const Vector force = now.force - before.force;
        add(joint.upper, 1, force, now.upper_moment - before.upper_moment);
        add(joint.lower, -1, force, now.lower_moment - before.lower_moment);
    }

    void factorize()
    {
        const double least = least_stiffness * K_.diagonal().cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < K_.rows(); ++i)
            K_.coeffRef(i, i) += least;
        if (slips_) {
            lu_.compute(K_);
            return;
        }
        const Sparse across = K_.transpose(), symmetric = 0.5 * (K_ + across);
        ldlt_.compute(symmetric);
    }

    /// Newton's step, or the part of it that is better. Without the friction cone the forces are nearly the derivatives
    /// of an energy, along which a step may not go far beyond its minimum; the residual may grow meanwhile, as where
    /// beds open. With the cone a step must reduce the residual.
    /// @return whether the poses have changed
    bool step()
    {
        const Eigen::VectorXd by =
            slips_ ? Eigen::VectorXd(lu_.solve(residual_)) : Eigen::VectorXd(ldlt_.solve(residual_));
        const double work = std::fabs(residual_.dot(by));
        double part = 1;
        for (int i = topology_.fixed; i < topology_.bodies; ++i) {
            const double far = by.segment<freedoms>(freedoms * (i - topology_.fixed)).cwiseAbs().maxCoeff();
            if (const double longest = longest_step * gyration_m_[static_cast<std::size_t>(i)]; part * far > longest)
                part = longest / far;
        }
        for (int n = 0; n < most_halvings; ++n, part *= 0.5) {
            std::vector<SolidPose> poses = rest_.poses;
            for (int i = topology_.fixed; i < topology_.bodies; ++i)
                poses[static_cast<std::size_t>(i)] =
                    moved(i, poses[static_cast<std::size_t>(i)],
                          part * by.segment<freedoms>(freedoms * (i - topology_.fixed)));
            const Residual r = evaluate(poses);
            if (cone_ ? r.most < rest_.unbalanced : r.of.dot(by) > -overshoots * work) {
                rest_.poses = std::move(poses);
                take(r);
                return true;
            }
        }
        return false;
    }

    const SpatialStructure& structure_;
    const SolidTopology& solids_;
    const spatial::Topology& topology_;
    ForcesAtRest& forces_;
    double gravity_;
    Rest rest_;
    std::vector<double> gyration_m_, weight_n_; ///< (bodies)
    std::vector<int> color_;                    ///< (bodies) -1: fixed
    int colors_ = 0;
    std::vector<double> depth_m_; ///< (joints) under their loads
    Eigen::VectorXd residual_;    ///< (free bodies x 6)
    Sparse K_;                    ///< its negative derivatives
    std::vector<Eigen::Triplet<double>> entries_;
    bool derived_here_ = false; ///< K_ is that of the present poses
    bool cone_ = false;         ///< friction has its limit
    bool slips_ = false;        ///< friction was at its limit somewhere when K_ was derived: it is not symmetric
    Eigen::SimplicialLDLT<Sparse> ldlt_;
    Eigen::SparseLU<Sparse> lu_;
};

} // namespace

std::vector<double> bed_loads_n(const SpatialStructure& structure, double gravity_m_s2)
{
    const std::vector<Solid>& solids = structure.solids;
    std::vector<int> order(solids.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return solids[static_cast<std::size_t>(a)].centre_m[1] > solids[static_cast<std::size_t>(b)].centre_m[1];
    });
    std::vector<double> load_n(structure.joints.size(), 0), carried_n(solids.size(), 0);
    for (const int i : order) {
        const auto body = static_cast<std::size_t>(i);
        const auto carries = [&](const SolidJoint& joint) { return joint.upper == i && joint.normal == Normal::y; };
        const auto seats = std::count_if(structure.joints.begin(), structure.joints.end(), carries);
        const double all = carried_n[body] + solids[body].mass_kg * gravity_m_s2;
        for (std::size_t j = 0; j < structure.joints.size(); ++j)
            if (carries(structure.joints[j])) {
                load_n[j] = all / static_cast<double>(seats);
                carried_n[static_cast<std::size_t>(structure.joints[j].lower)] += load_n[j];
            }
    }
    return load_n;
}

Rest rest_of(const SpatialStructure& structure, const SolidTopology& topology, ForcesAtRest& forces)
{
    return Search(structure, topology, forces).run();
}

} // namespace stylobate

#pragma once
/// Bodies and beds in space, stepped by a kernel's table: for tests of the spatial step.

#include "kernels/isa.hpp"
#include "kernels/spatial/rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

namespace stylobate::spatial {

using Vec = Vector<double>;

/// Memory of the scene, aligned as the kernels want it.
using SceneMemory = std::unique_ptr<double[], decltype(&std::free)>;
inline SceneMemory scene_memory(std::size_t numbers)
{
    double* const memory = static_cast<double*>(std::aligned_alloc(64, (numbers * sizeof(double) + 63) / 64 * 64));
    std::fill_n(memory, numbers, 0.0);
    return SceneMemory(memory, &std::free);
}

inline double length(const Vec& v)
{
    return std::sqrt(dot(v, v));
}

/// One realization. Bodies first, the fixed ones before the others, then joints; `build`, and then states and steps.
class Scene {
public:
    static constexpr double gravity_m_s2 = 9.81;

    struct Law {
        double stiffness = 1e9; ///< k [N/m3]
        double K_t = 1e9;       ///< [N/m]
        double mu = 0.7;
        double C_n = 0, C_t = 0; ///< dashpots of the full face [N s/m]
        bool hollow = false;
        double inner_ratio = 0; ///< of a hollow bed
        double gap = 0;         ///< of a butt joint: the upper face is so far from the point [m]
    };
    struct Face {
        double half_1 = 0, half_2 = 0, centre_1 = 0, centre_2 = 0;
    };

    explicit Scene(double step_s, Isa isa = Isa::scalar) : dt_(step_s), table_(&kernels(isa)) {}
    /// From the next `build` on. All are neutral then.
    void use_mechanisms(bool use = true) { model_.mechanisms = use; }

    /// @param centre in the reference state; @param height along y
    int drum(const Vec& centre, double radius, double height, double mass, bool fixed = false)
    {
        const double across = mass * (radius * radius / 4 + height * height / 12);
        return body({centre, {radius, height / 2, radius}, mass, {across, mass * radius * radius / 2, across}, fixed});
    }
    /// @param size along x, y and z
    int box(const Vec& centre, const Vec& size, double mass, bool fixed = false)
    {
        const double x = size.x * size.x, y = size.y * size.y, z = size.z * size.z;
        return body({centre, 0.5 * size, mass, {mass * (y + z) / 12, mass * (x + z) / 12, mass * (x + y) / 12}, fixed});
    }
    /// A joint of two bodies that touch at `point` in the reference state; its faces are those of the bodies there.
    int joint(int lower, int upper, BedKind kind, const Vec& point, const Law& law, Axis normal = Axis::y,
              bool reversed = false)
    {
        joints_.push_back({lower, upper, kind, normal, reversed, law.hollow});
        points_.push_back(point);
        laws_.push_back(law);
        return static_cast<int>(joints_.size()) - 1;
    }

    /// At rest in the reference state.
    void build()
    {
        topology_ = Topology{};
        topology_.bodies = static_cast<int>(bodies_.size());
        topology_.top = topology_.bodies - 1;
        topology_.joints = static_cast<int>(joints_.size());
        topology_.joint = joints_.data();
        topology_.model = model_;
        correction_.clear();
        for (const BodySpec& b : bodies_) {
            topology_.fixed += b.fixed;
            correction_.push_back(correction_axis(1 / b.inertia.x, 1 / b.inertia.y, 1 / b.inertia.z));
        }
        topology_.correction = correction_.data();
        lists_.resize(static_cast<std::size_t>(joint_lists_size(topology_)));
        list_joints(topology_, lists_.data());
        memory_ = scene_memory(bundle_registers(topology_));
        bundle_ = bind_bundle(topology_, 1, memory_.get());
        for (int i = 0; i < topology_.bodies; ++i)
            store_body(i);
        for (int j = 0; j < topology_.joints; ++j)
            store_joint(j);
        at(OfRealization::dt2) = dt_ * dt_;
        at(OfRealization::gravity_dy) = -dt_ * dt_ * gravity_m_s2;
        steps_ = 0;
    }

    // ---- state ----

    double step_s() const { return dt_; }
    double time_s() const { return dt_ * static_cast<double>(steps_); }
    const Topology& topology() const { return topology_; }
    const Bundle& bundle() const { return bundle_; }
    std::vector<double> state() const { return {memory_.get(), memory_.get() + bundle_registers(topology_)}; }
    double& at(OfBody::Field field, int i) { return bundle_.at(field, i, 0); }
    double& at(OfJoint::Field field, int j) { return bundle_.at(field, j, 0); }
    double& at(OfRealization::Field field) { return bundle_.at(field, 0); }
    double& at(OfBodyMechanisms::Field field, int i) { return bundle_.at(field, i, 0); }
    double& at(OfJointMechanisms::Field field, int j, int k = 0)
    {
        return bundle_.at(static_cast<OfJointMechanisms::Field>(field + k), j, 0);
    }
    template <class Field>
    Vec vector(Field field, int i)
    {
        const auto k = [&](int n) { return bundle_.at(static_cast<Field>(field + n), i, 0); };
        return {k(0), k(1), k(2)};
    }
    template <class Field>
    void set_vector(Field field, int i, const Vec& v)
    {
        bundle_.at(field, i, 0) = v.x;
        bundle_.at(static_cast<Field>(field + 1), i, 0) = v.y;
        bundle_.at(static_cast<Field>(field + 2), i, 0) = v.z;
    }
    Vec centre(int i) { return bodies_[index(i)].centre + vector(OfBody::x, i); }
    double mass(int i) const { return bodies_[index(i)].mass; }
    Vec inertia(int i) const { return bodies_[index(i)].inertia; }
    Quaternion<double> attitude(int i)
    {
        return {at(OfBody::q_w, i), at(OfBody::q_x, i), at(OfBody::q_y, i), at(OfBody::q_z, i)};
    }
    /// A turn by `angle` about a unit vector.
    void set_attitude(int i, const Vec& axis, double angle)
    {
        at(OfBody::q_w, i) = std::cos(angle / 2);
        set_vector(OfBody::q_x, i, std::sin(angle / 2) * axis);
    }
    Vec rotate(int i, const Vec& own) { return rotated(minus_identity(attitude(i)), own); }
    Vec rotate_back(int i, const Vec& of_base) { return rotated_back(minus_identity(attitude(i)), of_base); }
    /// Velocity of the centre of mass [m/s] and angular velocity [rad/s], frame of the base.
    void set_motion(int i, const Vec& velocity, const Vec& omega)
    {
        set_vector(OfBody::dx, i, dt_ * velocity);
        const Vec own = rotate_back(i, omega), of = inertia(i);
        set_vector(OfBody::l_x, i, dt_ * rotate(i, {of.x * own.x, of.y * own.y, of.z * own.z}));
    }
    Vec velocity(int i) { return 1 / dt_ * vector(OfBody::dx, i); }
    Vec omega(int i) { return 1 / dt_ * vector(OfBody::turn_x, i); }
    /// The axis of a drum: where its y axis points.
    Vec axis(int i) { return rotate(i, {0, 1, 0}); }
    double tilt(int i) { return std::atan2(std::hypot(axis(i).x, axis(i).z), axis(i).y); }

    // ---- steps ----

    /// @param base acceleration of the base at a time [m/s2]
    void run(long steps, const std::function<Vec(double)>& base = {})
    {
        for (long done = 0; done < steps;) {
            const int count = static_cast<int>(std::min<long>(chunk_steps, steps - done));
            for (int k = 0; k < count; ++k) {
                const Vec a = base ? base(dt_ * static_cast<double>(steps_ + k)) : Vec{0, 0, 0};
                bundle_.rows<OfBaseX::Field>()[k] = dt_ * dt_ * a.x;
                bundle_.rows<OfBaseY::Field>()[k] = dt_ * dt_ * a.y;
                bundle_.rows<OfBaseZ::Field>()[k] = dt_ * dt_ * a.z;
            }
            table_->spatial.run(topology_, bundle_, 0, count);
            done += count;
            steps_ += count;
        }
    }
    /// The first step of a motion from rest: half of what the forces give.
    void start_from_rest()
    {
        run(1);
        for (int i = topology_.fixed; i < topology_.bodies; ++i) {
            set_vector(OfBody::dx, i, 0.5 * vector(OfBody::dx, i));
            set_vector(OfBody::l_x, i, 0.5 * vector(OfBody::l_x, i));
        }
    }
    /// Joint forces in the present state: what a step computes, without its motion.
    double normal_force(int j)
    {
        const std::vector<double> kept = state();
        const long steps = steps_;
        run(1);
        const double force = at(OfJoint::normal, j);
        std::copy(kept.begin(), kept.end(), memory_.get());
        steps_ = steps;
        return force;
    }

    // ---- energies at the position that the last step started from [J] ----

    double kinetic() { return at(OfRealization::kinetic) / (2 * dt_ * dt_); }
    double potential() { return at(OfRealization::potential) / (dt_ * dt_); }
    double elastic()
    {
        double sum = 0;
        for (int j = 0; j < topology_.joints; ++j)
            sum += at(OfJoint::elastic, j);
        return sum;
    }
    /// Of the springs of friction; that of the twist has 9/8 of the stiffness.
    double springs()
    {
        double sum = 0;
        for (int j = 0; j < topology_.joints; ++j) {
            const double one = at(OfJoint::spring_1, j), two = at(OfJoint::spring_2, j),
                         twist = at(OfJoint::spring_twist, j);
            sum += 0.5 * at(OfJoint::per_K_t, j) * (one * one + two * two + twist * twist / 1.125);
        }
        return sum;
    }
    double friction() { return at(OfRealization::friction_energy); }
    double dashpots() { return at(OfRealization::dashpot_energy); }
    double base_work() { return at(OfRealization::base_energy) / (2 * dt_ * dt_); }
    /// Work against dowels, and against the dashpots of ties.
    double mechanisms()
    {
        using W = OfRealizationMechanisms;
        return model_.mechanisms ? 0.5 * (bundle_.at(W::joint_energy, 0) + bundle_.at(W::tie_energy, 0) / (dt_ * dt_))
                                 : 0;
    }
    /// What stays constant.
    double balance()
    {
        return kinetic() + potential() + elastic() + springs() + friction() + dashpots() + mechanisms() - base_work();
    }

    Vec momentum()
    {
        Vec sum{0, 0, 0};
        for (int i = topology_.fixed; i < topology_.bodies; ++i)
            sum = sum + mass(i) * velocity(i);
        return sum;
    }
    /// About the origin.
    Vec angular_momentum()
    {
        Vec sum{0, 0, 0};
        for (int i = topology_.fixed; i < topology_.bodies; ++i)
            sum = sum + 1 / dt_ * vector(OfBody::l_x, i) + mass(i) * cross(centre(i), velocity(i));
        return sum;
    }

private:
    struct BodySpec {
        Vec centre, half;
        double mass;
        Vec inertia;
        bool fixed;
    };

    static std::size_t index(int i) { return static_cast<std::size_t>(i); }
    int body(const BodySpec& b)
    {
        bodies_.push_back(b);
        return static_cast<int>(bodies_.size()) - 1;
    }

    void store_body(int i)
    {
        const BodySpec& b = bodies_[index(i)];
        at(OfBody::q_w, i) = 1;
        at(OfBody::mass, i) = b.mass;
        at(OfBody::least_y, i) = -1e9;
        at(OfBody::least_upright, i) = -2;
        if (b.fixed)
            return;
        at(OfBody::dt2_per_mass, i) = dt_ * dt_ / b.mass;
        const Inertia<double> inertia =
            inertia_of(1 / b.inertia.x, 1 / b.inertia.y, 1 / b.inertia.z, correction_[index(i)]);
        at(OfBody::per_sphere, i) = inertia.sphere;
        at(OfBody::per_top, i) = inertia.top;
        at(OfBody::per_correction, i) = inertia.correction;
    }

    void store_joint(int j)
    {
        const TopologyJoint& joint = joints_[index(j)];
        const Law& law = laws_[index(j)];
        const BodySpec &lower = bodies_[index(joint.lower)], &upper = bodies_[index(joint.upper)];
        const Vec point = points_[index(j)];
        set_vector(OfJoint::lower_anchor, j, point - lower.centre);
        const Vec off = law.gap * Vec{joint.normal == Axis::x ? 1.0 : 0, 0, joint.normal == Axis::z ? 1.0 : 0};
        set_vector(OfJoint::upper_anchor, j, point + off - upper.centre);
        at(OfJoint::gap, j) = law.gap;
        at(OfJoint::inner_ratio, j) = law.inner_ratio;
        const auto along = [&](const Vec& v) { return to_axes(v, joint.normal); };
        const double sign = joint.reversed ? -1 : 1;
        const bool round = joint.kind != BedKind::rectangle;
        const Vec half_l = along(lower.half), half_u = along(upper.half), from_l = along(lower.centre - point),
                  from_u = along(upper.centre - point);
        at(OfJoint::lower_half_1, j) = half_l.x;
        at(OfJoint::lower_half_2, j) = half_l.y;
        at(OfJoint::upper_half_1, j) = half_u.x;
        at(OfJoint::upper_half_2, j) = half_u.y;
        at(OfJoint::lower_centre_1, j) = from_l.x;
        at(OfJoint::lower_centre_2, j) = sign * from_l.y;
        at(OfJoint::upper_centre_1, j) = from_u.x;
        at(OfJoint::upper_centre_2, j) = sign * from_u.y;
        const double area = round ? std::numbers::pi * half_u.x * half_u.x : 4 * half_u.x * half_u.y;
        at(OfJoint::stiffness, j) = law.stiffness;
        at(OfJoint::K_t, j) = law.K_t;
        at(OfJoint::per_K_t, j) = 1 / law.K_t;
        at(OfJoint::mu, j) = law.mu;
        at(OfJoint::C_n, j) = law.C_n / (area * dt_);
        at(OfJoint::C_t, j) = law.C_t / (area * dt_);
        at(OfJoint::depth_limit, j) = 0.2 * std::min(half_l.z, half_u.z);
    }

    static Vec to_axes(const Vec& v, Axis normal)
    {
        return normal == Axis::x ? Vec{v.y, v.z, v.x} : normal == Axis::y ? Vec{v.z, v.x, v.y} : v;
    }

    double dt_;
    const KernelTable* table_;
    std::vector<BodySpec> bodies_;
    std::vector<TopologyJoint> joints_;
    std::vector<Vec> points_;
    std::vector<Law> laws_;
    std::vector<Axis> correction_;
    std::vector<int> lists_;
    Topology topology_;
    StepModel model_;
    SceneMemory memory_{nullptr, &std::free};
    Bundle bundle_;
    long steps_ = 0;
};

} // namespace stylobate::spatial

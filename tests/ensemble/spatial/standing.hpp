#pragma once
/// Structures in space, put together by hand and stepped alone: for tests of their statics and of their step.

#include "ensemble/numerics/aligned.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/spatial/structure/settle.hpp"
#include "kernels/isa.hpp"
#include "kernels/spatial/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace stylobate {

/// Laws of a bed per area.
struct BedLaw {
    double k = 3e9; ///< [N/m3]
    double friction = 0.7;
    double damping = 0; ///< ratio of the critical one for `mass_kg`, along and across the normal
    double mass_kg = 0;
};

class Standing {
public:
    using Vec = spatial::Vector<double>;
    static constexpr double g = 9.81;

    Standing()
    {
        r.gravity_m_s2 = g;
        r.step_s = 1e-5;
    }

    /// A drum, or with `round` false a prism. @param bottom the middle of its bottom face @param half_x of a drum its
    /// radius
    int body(const Vec& bottom, double half_x, double half_z, double height, double mass, bool round = true,
             bool fixed = false)
    {
        Solid s;
        s.bottom = s.top = {round, half_x, half_z};
        s.height_m = height;
        s.mass_kg = mass;
        const double x = half_x * half_x, z = half_z * half_z, y = height * height / 12, part = round ? 4 : 3;
        s.inertia_kg_m2 = {mass * (z / part + y), mass * (x + z) / part, mass * (x / part + y)};
        s.centre_height_m = height / 2;
        s.centre_m = {bottom.x, bottom.y + height / 2, bottom.z};
        s.fixed = fixed;
        r.space.solids.push_back(s);
        r.space.drums = static_cast<int>(r.space.solids.size());
        return r.space.drums - 1;
    }
    int drum(const Vec& bottom, double radius, double height, double mass, bool fixed = false)
    {
        return body(bottom, radius, radius, height, mass, true, fixed);
    }
    /// A beam along x. @param bottom the middle of its bottom face
    int beam(const Vec& bottom, double half_length, double half_width, double height, double mass)
    {
        const int i = body(bottom, half_length, half_width, height, mass, false);
        solid(i).role = BlockRole::epistyle;
        solid(i).column = -1;
        return i;
    }
    /// The bed between two bodies that touch in the reference state. Seats of a beam are the common part of two
    /// rectangles.
    int bed(int lower, int upper, const BedLaw& law)
    {
        const Solid &below = solid(lower), &above = solid(upper);
        SolidJoint j;
        j.lower = lower;
        j.upper = upper;
        const auto l = below.middle_m(), u = above.middle_m();
        double x = u[0], z = u[2];
        double area = above.bottom.round
                          ? std::numbers::pi * std::pow(std::min(below.top.half_x_m, above.bottom.half_x_m), 2)
                          : 4 * above.bottom.half_x_m * above.bottom.half_z_m;
        if (above.role == BlockRole::epistyle) {
            const double from = std::max(l[0] - below.top.half_x_m, u[0] - above.bottom.half_x_m),
                         to = std::min(l[0] + below.top.half_x_m, u[0] + above.bottom.half_x_m);
            x = (from + to) / 2;
            area = (to - from) * 2 * std::min(below.top.half_z_m, above.bottom.half_z_m);
        }
        j.point_m = {x, u[1] - above.height_m / 2, z};
        j.lower_face = below.top;
        j.upper_face = above.bottom;
        j.lower_middle_m = {l[2] - z, l[0] - x};
        j.upper_middle_m = {u[2] - z, u[0] - x};
        give(law, area, j);
        return add(j);
    }
    /// The butt joint between two beams that follow each other along x.
    int butt(int left, int right, const BedLaw& law)
    {
        const Solid& from = solid(left);
        SolidJoint j;
        j.lower = left;
        j.upper = right;
        j.normal = Normal::x;
        const auto middle = from.middle_m();
        j.point_m = {middle[0] + from.bottom.half_x_m, middle[1], middle[2]};
        j.lower_face = j.upper_face = {false, from.height_m / 2, from.bottom.half_z_m};
        give(law, 2 * from.height_m * from.bottom.half_z_m, j);
        return add(j);
    }
    Solid& solid(int i) { return r.space.solids[static_cast<std::size_t>(i)]; }

    /// Into a lane of its own, at rest.
    void settle()
    {
        topology_ = std::make_unique<SolidTopology>(r.space);
        memory_ = aligned_array<double>(spatial::bundle_registers(topology_->kernel()));
        bundle_ = spatial::bind_bundle(topology_->kernel(), 1, memory_.get());
        store_solids(r, *topology_, bundle_, 0);
        stylobate::settle(r, *topology_, bundle_, 0);
        for (int i = 0; i < topology_->kernel().bodies; ++i) {
            bundle_.at(spatial::OfBody::least_y, i, 0) = -1e9;
            bundle_.at(spatial::OfBody::least_upright, i, 0) = -2;
        }
    }
    /// On a still base.
    void run(int steps, const KernelTable& table = kernels(Isa::scalar))
    {
        for (; steps > 0; steps -= chunk_steps)
            table.spatial.run(topology_->kernel(), bundle_, 0, std::min(steps, chunk_steps));
    }

    double& at(spatial::OfBody::Field f, int i)
    {
        return bundle_.at(f, topology_->place_of(static_cast<std::size_t>(i)), 0);
    }
    double& at(spatial::OfJoint::Field f, int j) { return bundle_.at(f, j, 0); }
    double& at(spatial::OfRealization::Field f) { return bundle_.at(f, 0); }
    /// Displacement of the centre of mass.
    Vec u(int i) { return {at(spatial::OfBody::x, i), at(spatial::OfBody::y, i), at(spatial::OfBody::z, i)}; }
    spatial::Quaternion<double> q(int i)
    {
        return {at(spatial::OfBody::q_w, i), at(spatial::OfBody::q_x, i), at(spatial::OfBody::q_y, i),
                at(spatial::OfBody::q_z, i)};
    }
    /// Small rotations about x, y, z.
    Vec turn(int i) { return 2 * Vec{q(i).x, q(i).y, q(i).z}; }
    /// Where a point of a body is. @param own from its centre of mass in the reference state
    Vec point(int i, const Vec& own)
    {
        const auto& c = solid(i).centre_m;
        return Vec{c[0], c[1], c[2]} + u(i) + rotated(spatial::minus_identity(q(i)), own);
    }
    double kinetic_j() { return at(spatial::OfRealization::kinetic) / (2 * r.step_s * r.step_s); }
    const spatial::Topology& topology() const { return topology_->kernel(); }
    const spatial::Bundle& bundle() const { return bundle_; }

    Realization r;

private:
    int add(const SolidJoint& joint)
    {
        r.space.joints.push_back(joint);
        return static_cast<int>(r.space.joints.size()) - 1;
    }
    static void give(const BedLaw& law, double area, SolidJoint& j)
    {
        j.area_m2 = area;
        j.normal_stiffness_n_m3 = law.k;
        j.tangential_stiffness_n_m = law.k * area;
        j.friction = law.friction;
        j.normal_damping_n_s_m3 = j.tangential_damping_n_s_m3 = 2 * law.damping * std::sqrt(law.k * law.mass_kg / area);
    }

    std::unique_ptr<SolidTopology> topology_;
    AlignedArray<double> memory_;
    spatial::Bundle bundle_;
};

} // namespace stylobate

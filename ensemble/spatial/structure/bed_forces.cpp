#include "ensemble/spatial/structure/bed_forces.hpp"

#include <cmath>

namespace stylobate {
namespace {

using B = spatial::OfBody;
using J = spatial::OfJoint;
using W = spatial::OfRealization; // the whole
using M = spatial::OfJointMechanisms;
using Vector = spatial::Vector<double>;

/// The rotation vector of an attitude [rad].
Vector turn_of(const spatial::Quaternion<double>& q)
{
    const double sine = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
    const double scale = sine > 0 ? 2 * std::atan2(sine, q.w) / sine : 2;
    return {scale * q.x, scale * q.y, scale * q.z};
}

template <class Field>
Vector vector_at(const spatial::Bundle& b, Field first, int row)
{
    const auto at = [&](int k) { return b.at(static_cast<Field>(first + k), row, 0); };
    return {at(0), at(1), at(2)};
}

template <class Field>
void put_vector(const spatial::Bundle& b, Field first, int row, const Vector& v)
{
    int k = 0;
    for (const double each : {v.x, v.y, v.z})
        b.at(static_cast<Field>(first + k++), row, 0) = each;
}

template <class Field>
void copy_rows(const spatial::Bundle& from, int lane, const spatial::Bundle& to, int rows)
{
    for (int row = 0; row < rows; ++row)
        for (int f = 0; f < spatial::Bundle::fields<Field>; ++f)
            to.at(static_cast<Field>(f), row, 0) = from.at(static_cast<Field>(f), row, lane);
}

} // namespace

spatial::Quaternion<double> after_turn(const spatial::Quaternion<double>& q, const Vector& turn)
{
    const double angle = std::sqrt(dot(turn, turn));
    const double scale = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
    const Vector e = scale * turn, of{q.x, q.y, q.z};
    const double w = std::cos(angle / 2);
    const Vector v = w * of + q.w * e + cross(e, of);
    return {w * q.w - dot(e, of), v.x, v.y, v.z};
}

ForcesAtRest::ForcesAtRest(const SpatialStructure& structure, const SolidTopology& topology,
                           const spatial::Bundle& bundle, int lane)
    : topology_(topology.kernel()), memory_(aligned_array<double>(spatial::bundle_registers(topology_))),
      bundle_(spatial::bind_bundle(topology_, 1, memory_.get()))
{
    copy_rows<B::Field>(bundle, lane, bundle_, topology_.bodies);
    copy_rows<J::Field>(bundle, lane, bundle_, topology_.joints);
    copy_rows<W::Field>(bundle, lane, bundle_, 1);
    if (topology_.model.mechanisms) {
        copy_rows<M::Field>(bundle, lane, bundle_, topology_.joints);
        for (int j = 0; j < topology_.joints; ++j) // the way from the reference state is no slide and no impact
            for (const M::Field field : {M::friction_drop, M::wear, M::adhesion, M::face_share, M::face_dashpot})
                bundle_.at(field, j, 0) = 0;
    }
    for (const int solid : topology.order()) {
        const auto& I = structure.solids[static_cast<std::size_t>(solid)].inertia_kg_m2;
        inertia_.push_back({I[0], I[1], I[2]});
    }
    for (int j = 0; j < topology_.joints; ++j) {
        depth_limit_m_.push_back(bundle_.at(J::depth_limit, j, 0));
        friction_.push_back(bundle_.at(J::mu, j, 0));
        bundle_.at(J::C_n, j, 0) = bundle_.at(J::C_t, j, 0) = 0;
    }
    gravity_ = 1 / bundle_.at(W::dt2, 0) * vector_at(bundle_, W::gravity_dx, 0);
}

void ForcesAtRest::limit_depth(bool limited)
{
    constexpr double none_m = 1e6;
    for (int j = 0; j < topology_.joints; ++j)
        bundle_.at(J::depth_limit, j, 0) = limited ? depth_limit_m_[static_cast<std::size_t>(j)] : none_m;
}

void ForcesAtRest::limit_friction(bool limited)
{
    constexpr double none = 1e9;
    for (int j = 0; j < topology_.joints; ++j)
        bundle_.at(J::mu, j, 0) = limited ? friction_[static_cast<std::size_t>(j)] : none;
}

void ForcesAtRest::put(const std::vector<SolidPose>& poses)
{
    for (int i = topology_.fixed; i < topology_.bodies; ++i) {
        const auto& [u, q] = poses[static_cast<std::size_t>(i)];
        const Vector turn = turn_of(q), I = inertia_[static_cast<std::size_t>(i)];
        const spatial::Matrix<double> m = spatial::minus_identity(q);
        const Vector own = rotated_back(m, turn);
        put_vector(bundle_, B::x, i, u);
        put_vector(bundle_, B::dx, i, u);
        put_vector(bundle_, B::l_x, i, rotated(m, Vector{I.x * own.x, I.y * own.y, I.z * own.z}));
        bundle_.at(B::q_w, i, 0) = q.w;
        put_vector(bundle_, B::q_x, i, {q.x, q.y, q.z});
    }
    for (int j = 0; j < topology_.joints; ++j) {
        put_vector(bundle_, J::spring_1, j, {0, 0, 0});
        for (int field = M::broken; topology_.model.mechanisms && field < M::count; ++field)
            bundle_.at(static_cast<M::Field>(field), j, 0) = 0;
    }
    kernels(Isa::scalar).spatial.run(topology_, bundle_, 0, 1);
}

BedForces ForcesAtRest::forces(int j) const
{
    return {vector_at(bundle_, J::force, j), vector_at(bundle_, J::upper_moment, j),
            vector_at(bundle_, J::lower_moment, j)};
}

SolidLoad ForcesAtRest::unbalanced(int body) const
{
    SolidLoad load{bundle_.at(B::mass, body, 0) * gravity_, {0, 0, 0}};
    for (int at = topology_.joint_lists[body]; at < topology_.joint_lists[body + 1]; ++at) {
        const int j = topology_.joint_lists[at] / 2;
        const bool lower = topology_.joint_lists[at] % 2 != 0;
        const BedForces f = forces(j);
        load.force = lower ? load.force - f.force : load.force + f.force;
        load.moment = lower ? load.moment - f.lower_moment : load.moment + f.upper_moment;
    }
    return load;
}

double ForcesAtRest::spring_n(int j, int k) const
{
    return bundle_.at(static_cast<J::Field>(J::spring_1 + k), j, 0);
}

bool ForcesAtRest::slips(int j) const
{
    constexpr double rounding = 1e-9;
    const double limit = bundle_.at(J::mu, j, 0) * normal_n(j);
    return normal_n(j) > 0 && std::hypot(spring_n(j, 0), spring_n(j, 1), spring_n(j, 2)) >= (1 - rounding) * limit;
}

} // namespace stylobate

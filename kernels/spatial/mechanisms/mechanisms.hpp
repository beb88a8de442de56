#pragma once
/// How the mechanisms act together: the pose of a bed, the limit of its friction, its dowel, and the ties of a body.
/// Laws that are the same in the plane are those of `planar/mechanisms/`.
///
/// Expensive mechanisms are skipped where they are neutral in all realizations of the register: at its neutral value
/// each gives the same bits, so a neighbour's mechanism changes nothing.

#include "kernels/planar/mechanisms/adhesion.hpp"
#include "kernels/planar/mechanisms/friction_wear.hpp"
#include "kernels/planar/mechanisms/stribeck.hpp"
#include "kernels/planar/mechanisms/tie.hpp"
#include "kernels/spatial/mechanisms/dowel.hpp"
#include "kernels/spatial/mechanisms/face_damping.hpp"
#include "kernels/spatial/mechanisms/wedge.hpp"
#include "kernels/spatial/rows.hpp"

#include <initializer_list>

namespace stylobate::spatial {

namespace detail {

template <class Mask, class Real>
STYLOBATE_INLINE Vector<Real> select_vector(Mask mask, const Vector<Real>& yes, const Vector<Real>& no)
{
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

template <class Mask, class Real>
STYLOBATE_INLINE Matrix<Real> select_matrix(Mask mask, const Matrix<Real>& yes, const Matrix<Real>& no)
{
    return {select(mask, yes.m11, no.m11), select(mask, yes.m12, no.m12), select(mask, yes.m13, no.m13),
            select(mask, yes.m21, no.m21), select(mask, yes.m22, no.m22), select(mask, yes.m23, no.m23),
            select(mask, yes.m31, no.m31), select(mask, yes.m32, no.m32), select(mask, yes.m33, no.m33)};
}

} // namespace detail

/// The mechanisms of one joint.
template <class Real, class Layout>
class JointMechanism {
    using J = OfJointMechanisms;

public:
    STYLOBATE_INLINE JointMechanism(const Rows<Real, Layout>& rows, int joint) : rows_(rows), joint_(joint) {}

    /// Pose and motion of the upper face as seen from the turned lower one.
    /// @param r as of `onto_wedge`
    STYLOBATE_INLINE void onto_face(const Quaternion<Real>& r, BedPose<Real>& pose, BedMotion<Real>& motion) const
    {
        const Wedge<Real> w = wedge();
        const auto turned = is_wedge(w);
        if (!any(turned))
            return;
        const BedPose<Real> seen = onto_wedge(pose, r, w);
        pose.turn = detail::select_matrix(turned, seen.turn, pose.turn);
        pose.place = detail::select_vector(turned, seen.place, pose.place);
        const Matrix<Real> face = minus_identity(w.rotation());
        for (Vector<Real>* each : {&motion.displacement, &motion.rotation})
            *each = detail::select_vector(turned, rotated_back(face, *each), *each);
    }

    /// A force and a torque of the turned face, along the axes of the lower body.
    STYLOBATE_INLINE void off_face(Vector<Real>& force, Vector<Real>& torque) const
    {
        const Wedge<Real> w = wedge();
        const auto turned = is_wedge(w);
        if (!any(turned))
            return;
        const Matrix<Real> face = minus_identity(w.rotation());
        for (Vector<Real>* each : {&force, &torque})
            *each = detail::select_vector(turned, rotated(face, *each), *each);
    }

    /// The dashpot along the normal.
    STYLOBATE_INLINE void dashpot(const BedLoad<Real>& load, Real C_n, const TopologyJoint& joint,
                                  const BedComponents<Real>& rates, BedComponents<Real>& resistance) const
    {
        spread_dashpot(load, C_n, rates, resistance);
        const Real share = get(J::face_share);
        const auto has = (share != Real(0.0)) & (load.force > Real(0.0));
        if (!any(has))
            return;
        Real each = get(J::face_dashpot);
        if (joint.kind != BedKind::rectangle)
            each = min_of(share * C_n * load.area, each);
        BedComponents<Real> other = resistance;
        face_dashpot(load, FaceDamping<Real>{share, each, reach2(load, joint)}, C_n, rates, other);
        resistance.normal = select(has, other.normal, resistance.normal);
        resistance.tilt_x = select(has, other.tilt_x, resistance.tilt_x);
        resistance.tilt_y = select(has, other.tilt_y, resistance.tilt_y);
    }

    /// Largest force of friction.
    STYLOBATE_INLINE Real friction_limit(const BedLoad<Real>& load, Real mu, Real normal,
                                         const BedComponents<Real>& rates) const
    {
        const Real drop = get(J::friction_drop);
        if (any(drop != Real(0.0)))
            mu = mu * stribeck_factor(drop, get(J::per_stribeck_step), sliding_of(rates));
        mu = mu * wear_factor(get(J::wear), rows_.get(OfJoint::slip, joint_));
        const Real limit = adhesion_limit(mu * normal, get(J::adhesion), load.area, get(J::broken));
        return select(load.force > Real(0.0), limit, Real(0.0));
    }

    /// Adds the dowel's force to that of the bed.
    /// @param place P, along the axes of the lower body
    /// @return 2 x the work of this step against it [J]
    STYLOBATE_INLINE Real add_dowel(const Vector<Real>& place, Vector<Real>& force) const
    {
        const Real zero(0.0), stiffness = get(J::dowel_stiffness);
        const auto has = stiffness != zero;
        if (!any(has))
            return zero;
        const Real set_x = get(J::dowel_set), set_y = get(J::dowel_set, 1);
        const DowelForce<Real> f = dowel_force(stiffness, get(J::per_dowel_stiffness), get(J::dowel_yield),
                                               get(J::dowel_gap), place.x, place.y, set_x, set_y);
        const auto holds = has & (place.z < Real(dowel_reach) * rows_.get(OfJoint::depth_limit, joint_));
        const Real x = select(holds, f.x, zero), y = select(holds, f.y, zero);
        const Real at_x = select(has, place.x, zero), at_y = select(has, place.y, zero);
        const Real work = fma(x + get(J::dowel_force), at_x - get(J::dowel_at),
                              (y + get(J::dowel_force, 1)) * (at_y - get(J::dowel_at, 1)));
        put(J::dowel_set, select(holds, f.set_x, set_x));
        put(J::dowel_set, select(holds, f.set_y, set_y), 1);
        put(J::dowel_force, x);
        put(J::dowel_force, y, 1);
        put(J::dowel_at, at_x);
        put(J::dowel_at, at_y, 1);
        force.x = force.x - x;
        force.y = force.y - y;
        return work;
    }

    /// @param slip of this step [m]
    STYLOBATE_INLINE void end(const BedLoad<Real>& load, Real slip) const
    {
        put(J::broken, adhesion_broken(get(J::broken), load.force > Real(0.0), slip));
    }

private:
    STYLOBATE_INLINE Real get(J::Field f, int k = 0) const { return rows_.get(f, joint_, k); }
    STYLOBATE_INLINE void put(J::Field f, Real value, int k = 0) const { rows_.put(f, joint_, value, k); }
    STYLOBATE_INLINE Wedge<Real> wedge() const
    {
        return {get(J::wedge), get(J::wedge, 1), get(J::wedge_at), get(J::wedge_at, 1)};
    }
    STYLOBATE_INLINE Real reach2(const BedLoad<Real>& load, const TopologyJoint& joint) const
    {
        const Real inner = joint.hollow ? rows_.get(OfJoint::inner_ratio, joint_) : Real(0.0);
        if (joint.kind != BedKind::rectangle)
            return disc_reach2(inner);
        const auto half = [&](OfJoint::Field upper, OfJoint::Field lower) {
            return min_of(rows_.get(upper, joint_), rows_.get(lower, joint_));
        };
        return rectangle_reach2(load.slope_x, load.slope_y, half(OfJoint::upper_half_1, OfJoint::lower_half_1),
                                half(OfJoint::upper_half_2, OfJoint::lower_half_2), inner);
    }
    STYLOBATE_INLINE static auto is_wedge(const Wedge<Real>& w) { return (w.e_1 != Real(0.0)) | (w.e_2 != Real(0.0)); }

    const Rows<Real, Layout>& rows_;
    const int joint_;
};

/// The ties of all bodies in one step: horizontal springs, dashpots and a pull along x, and a dashpot of rotation.
template <class Real, class Layout>
class Ties {
    using B = OfBodyMechanisms;

public:
    STYLOBATE_INLINE explicit Ties(const Rows<Real, Layout>& rows)
        : rows_(rows), energy_(rows.get(OfRealizationMechanisms::tie_pending))
    {
    }

    /// Slows body `i`, which is at u and moved by d and turned by `turn` in the last step.
    /// @param e increment of this step so far;  @param l angular momentum of this step so far
    STYLOBATE_INLINE void slow(int i, const Vector<Real>& u, const Vector<Real>& d, const Vector<Real>& turn,
                               Vector<Real>& e, Vector<Real>& l)
    {
        const Real zero(0.0);
        spring_ = rows_.get(B::tie_spring, i), pull_ = rows_.get(B::tie_pull, i);
        const Real dashpot = rows_.get(B::tie_dashpot, i), turning = rows_.get(B::tie_turning, i);
        tied_ = any((spring_ != zero) | (dashpot != zero) | (pull_ != zero) | (turning != zero));
        if (!tied_)
            return;
        e.x = e.x - tie_resistance(spring_, dashpot, pull_, u.x, d.x, zero);
        e.z = e.z - tie_resistance(spring_, dashpot, zero, u.z, d.z, zero);
        slow_ = {dashpot * d.x, zero, dashpot * d.z};
        slow_turn_ = {fma(turning, turn.x, zero), fma(turning, turn.y, zero), fma(turning, turn.z, zero)};
        l = l - slow_turn_;
        energy_ = fma(rows_.get(OfBody::mass, i), dot(slow_, d), energy_) + dot(slow_turn_, turn);
    }
    /// What the same body's dashpots take with the increments of this step.
    STYLOBATE_INLINE void moved(int i, const Vector<Real>& e, const Vector<Real>& turn)
    {
        if (tied_)
            pending_ = fma(rows_.get(OfBody::mass, i), dot(slow_, e), pending_) + dot(slow_turn_, turn);
    }
    /// dt2 x the energy of the same body's spring and pull at u.
    STYLOBATE_INLINE Real held(int i, const Vector<Real>& u) const
    {
        if (!tied_)
            return Real(0.0);
        const Real square = fma(u.x, u.x, u.z * u.z);
        return rows_.get(OfBody::mass, i) * fma(Real(0.5) * spring_, square, Real(0.0) - pull_ * u.x);
    }
    STYLOBATE_INLINE void end() const
    {
        using W = OfRealizationMechanisms;
        rows_.put(W::tie_energy, rows_.get(W::tie_energy) + energy_);
        rows_.put(W::tie_pending, pending_);
    }

private:
    const Rows<Real, Layout>& rows_;
    Real energy_, pending_{0.0}; ///< 2 dt2 x the work against dashpots, of the steps up to this one and of the next
    Vector<Real> slow_{zero_vector<Real>()}, slow_turn_{zero_vector<Real>()};
    Real spring_{0.0}, pull_{0.0};
    bool tied_ = false;
};

} // namespace stylobate::spatial

#pragma once
/// One step of all realizations of a spatial bundle. `THEORY.md` derives every formula, with sources.
///
///   pose      where each joint's upper face lies, relative to the lower body, and how it moved in the last step
///   bed       the elastic load of the faces on each other, and the patch that presses (one law for each kind of bed)
///   forces    dashpot and friction, the energy terms, and the force and moments in the frame of the base
///   update    sums over the bodies, d += dt2 F / m, u += d, l += dt2 M, and the turn of a free body with that l
///
/// The phases run over all joints (in groups that fit the first-level cache) with their intermediate values in memory:
/// joints are independent within a phase, so the processor works on several at once.
///
/// With a model with mechanisms (`StepModel`) the bundle has their rows, and the phases their instructions.

#include "kernels/spatial/bed.hpp"
#include "kernels/spatial/disc_bed.hpp"
#include "kernels/spatial/friction.hpp"
#include "kernels/spatial/hollow_bed.hpp"
#include "kernels/spatial/mechanisms/mechanisms.hpp"
#include "kernels/spatial/polygon_bed.hpp"
#include "kernels/spatial/rows.hpp"

#include <initializer_list>
#include <type_traits>

namespace stylobate::spatial {

namespace detail {

/// The intermediate values of one joint, in the order of its axes.
template <class Real, bool mechanisms>
struct JointScratch {
    BedPose<Real> pose;
    Vector<Real> upper_arm, lower_arm; ///< from the centres of mass to the upper anchor, frame of the base [m]
    BedMotion<Real> motion;
    BedLoad<Real> load;
};
template <class Real>
struct JointScratch<Real, true> : JointScratch<Real, false> {
    Vector<Real> place; ///< P along the axes of the lower body: `pose` is that of the face [m]
};

/// No ties: what the plain step has in their place.
struct NoTies {
    template <class Rows>
    STYLOBATE_INLINE explicit NoTies(const Rows&)
    {
    }
};

} // namespace detail

/// @tparam Here see `kernel_table`
/// @tparam mechanisms `StepModel::mechanisms`
/// @tparam Layout how the rows lie, and how many joints go through the phases together (`kernels/rows.hpp`)
template <class Real, class Here = void, bool mechanisms = false, class Layout = Packed>
class Stepper : Rows<Real, Layout> {
    using Base = Rows<Real, Layout>;

public:
    STYLOBATE_INLINE Stepper(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle)
        : Base(bundle), topology_(topology)
    {
    }

    /// Steps `first` to `last - 1` of the tables of base motion; the energies are those of the last one.
    STYLOBATE_INLINE void run(int first, int last) const
    {
        Scratch scratch[joint_group];
        for (int i = 0; i < topology_.bodies; ++i) {
            put_rotation(i, this->attitude(i), this->vector(OfBody::l_x, i));
            if (first == 0)
                put(OfBody::inside, i, Real(-1.0));
        }
        for (int step = first; step < last; ++step) {
            const bool audit = step + 1 == last;
            for (int begin = 0; begin < topology_.joints; begin += joint_group) {
                const int end = begin + joint_group < topology_.joints ? begin + joint_group : topology_.joints;
                for (int j = begin; j < end; ++j)
                    pose(j, scratch[j - begin]);
                for (int j = begin; j < end; ++j)
                    bed(j, scratch[j - begin], audit);
                forces(begin, end, scratch);
            }
            update(step, audit);
            this->trace(step - first, topology_.fixed, topology_.bodies);
        }
    }

private:
    static constexpr int joint_group = Layout::joint_group;
    using Scratch = detail::JointScratch<Real, mechanisms>;
    using Base::get;
    using Base::put;

    STYLOBATE_INLINE Axis correction(int body) const { return topology_.correction[body]; }
    STYLOBATE_INLINE Inertia<Real> inertia(int body) const
    {
        return {get(OfBody::per_sphere, body), get(OfBody::per_top, body), get(OfBody::per_correction, body)};
    }

    /// What the joints need of an attitude: the matrix, and the angular increment.
    /// @return the angular increment
    STYLOBATE_INLINE Vector<Real> put_rotation(int body, const Quaternion<Real>& q, const Vector<Real>& l) const
    {
        const Matrix<Real> m = minus_identity(q);
        const Real fields[] = {m.m11, m.m12, m.m13, m.m21, m.m22, m.m23, m.m31, m.m32, m.m33};
        for (int f = 0; f < 9; ++f)
            put(OfBody::matrix, body, fields[f], f);
        const Vector<Real> turn = angular_increment(q, l, inertia(body), correction(body));
        this->put_vector(OfBody::turn_x, body, turn);
        return turn;
    }

    STYLOBATE_INLINE void pose(int j, Scratch& s) const
    {
        topology_.joint[j].reversed ? pose<true>(j, s) : pose<false>(j, s);
    }

    // All vectors are in the order of the joint's axes, those in the frame of the base, too.
    template <bool reversed>
    STYLOBATE_INLINE void pose(int j, Scratch& s) const
    {
        const TopologyJoint joint = topology_.joint[j];
        const JointAxes axes(joint.normal);
        const auto body = [&](int i, OfJoint::Field anchor) {
            return BedBody<Real>{this->template vector_along<reversed>(axes, OfBody::x, i),
                                 this->template attitude_along<reversed>(axes, i),
                                 this->template matrix_along<reversed>(axes, i),
                                 this->template vector_along<reversed>(axes, anchor, j)};
        };
        const BedBody<Real> lower = body(joint.lower, OfJoint::lower_anchor),
                            upper = body(joint.upper, OfJoint::upper_anchor);
        const Vector<Real> upper_anchor = displaced(upper.turn, upper.anchor),
                           lower_anchor = displaced(lower.turn, lower.anchor);
        Vector<Real> apart = upper.displacement - lower.displacement;
        if (joint.normal != Axis::y)
            apart.z = apart.z + get(OfJoint::gap, j);
        const Quaternion<Real> r = relative_rotation(lower.q, upper.q);
        s.pose = bed_pose(apart + (upper_anchor - lower_anchor), r, lower.turn, Axis::z);
        s.upper_arm = upper.anchor + upper_anchor;
        s.lower_arm = lower.anchor + (upper_anchor + apart);
        const auto moved = [&](int i, const Vector<Real>& turn, const Vector<Real>& arm) {
            return this->template vector_along<reversed>(axes, OfBody::dx, i) + cross(turn, arm);
        };
        const Vector<Real> lower_turn = this->template vector_along<reversed>(axes, OfBody::turn_x, joint.lower),
                           upper_turn = this->template vector_along<reversed>(axes, OfBody::turn_x, joint.upper);
        s.motion.displacement = rotated_back(lower.turn, moved(joint.upper, upper_turn, s.upper_arm) -
                                                             moved(joint.lower, lower_turn, s.lower_arm));
        s.motion.rotation = rotated_back(lower.turn, upper_turn - lower_turn);

        const Real tilt = Real(0.0) - s.pose.turn.m33; // of the bodies, also where a face is turned
        if constexpr (mechanisms) {
            s.place = s.pose.place;
            mechanism(j).onto_face(r, s.pose, s.motion);
        }
        put(OfJoint::most_tilt, j, max_of(get(OfJoint::most_tilt, j), tilt));
        put(OfJoint::most_twist, j, max_of(get(OfJoint::most_twist, j), abs_of(r.z)));
    }

    STYLOBATE_INLINE Rectangle<Real> face(int j, OfJoint::Field first) const
    {
        return {get(first, j, 2), get(first, j, 3), get(first, j), get(first, j, 1)};
    }
    /// @tparam inner of the recesses of hollow faces on each other, instead of the whole faces
    template <bool inner>
    STYLOBATE_INLINE BedLoad<Real> law(int j, const BedPose<Real>& pose) const
    {
        const auto sized = [&](Real half) {
            if constexpr (inner)
                return get(OfJoint::inner_ratio, j) * half;
            else
                return half;
        };
        const Real stiffness = get(OfJoint::stiffness, j);
        if (topology_.joint[j].kind == BedKind::disc) {
            BedPose<Real> centres = pose; // seen from the centre of the lower face
            centres.place.x = pose.place.x - get(OfJoint::lower_centre_1, j);
            centres.place.y = pose.place.y - get(OfJoint::lower_centre_2, j);
            return disc_bed(centres, DiscBed<Real>{stiffness, sized(get(OfJoint::upper_half_1, j)),
                                                   sized(get(OfJoint::lower_half_1, j))});
        }
        Rectangle<Real> lower = face(j, OfJoint::lower_half_1), upper = face(j, OfJoint::upper_half_1);
        upper.half_x = sized(upper.half_x), upper.half_y = sized(upper.half_y);
        if (topology_.joint[j].kind == BedKind::rectangle) {
            lower.half_x = sized(lower.half_x), lower.half_y = sized(lower.half_y);
            return polygon_bed(pose, PolygonBed<Real, 4>{stiffness, polygon_of(upper), lower});
        }
        // a recess in the disc alone
        const Polygon<Real, 16> round = sixteen_corners(upper.centre_x, upper.centre_y, upper.half_x);
        return polygon_bed(pose, PolygonBed<Real, 16>{stiffness, round, lower});
    }

    /// Apart: few structures have hollow beds.
    STYLOBATE_APART static void hollow_out(Stepper self, int j, const BedPose<Real>& pose, BedLoad<Real>& load)
    {
        load = hollow_load(load, self.template law<true>(j, pose));
    }

    /// Faces that look away from each other, or lie deeper in each other than any load could press them, carry nothing:
    /// a body that has fallen past another one would be thrown out.
    STYLOBATE_INLINE void bed(int j, Scratch& s, bool audit) const
    {
        const Real zero(0.0), one(1.0);
        BedLoad<Real> load = law<false>(j, s.pose);
        if (topology_.joint[j].hollow)
            hollow_out(*this, j, s.pose, load);
        const Real most = get(OfJoint::stiffness, j) * get(OfJoint::depth_limit, j) * load.area;
        const auto presses = (load.force > zero) & (load.force < most) & (one + s.pose.turn.m33 > zero);
        for (Real* each : {&load.force, &load.lateral_x, &load.lateral_y, &load.torque.x, &load.torque.y,
                           &load.torque.z, &load.energy})
            *each = select(presses, *each, zero);
        s.load = load;
        if (audit)
            put(OfJoint::elastic, j, load.energy);
    }

    STYLOBATE_INLINE void forces(int begin, int end, const Scratch* scratch) const
    {
        Real friction_energy = get(OfRealization::friction_energy), dashpot_energy = get(OfRealization::dashpot_energy);
        Real slip = get(OfRealization::slip);
        [[maybe_unused]] Real joint_energy(0.0);
        for (int j = begin; j < end; ++j) {
            const Scratch& s = scratch[j - begin];
            const FrictionLaw<Real> law{get(OfJoint::K_t, j), get(OfJoint::per_K_t, j), get(OfJoint::C_n, j),
                                        get(OfJoint::C_t, j), get(OfJoint::mu, j)};
            const Vector<Real> kept = this->vector(OfJoint::spring_1, j);
            const FrictionSprings<Real> springs{kept.x, kept.y, kept.z};
            const auto memory = [&](int k) { return get(OfJoint::dashpot, j, k); };
            const BedComponents<Real> before{memory(0), memory(1), memory(2), memory(3), memory(4), memory(5)};
            const BedForce<Real> f = bed_force_of(j, s, law, springs);
            Vector<Real> on_upper = f.force, torque = f.torque;
            if constexpr (mechanisms) {
                const JointMechanism<Real, Layout> own = mechanism(j);
                own.off_face(on_upper, torque);
                joint_energy = joint_energy + own.add_dowel(s.place, on_upper);
                own.end(s.load, f.slip);
            }

            friction_energy = friction_energy + slip_loss(f, springs, law.per_K_t);
            dashpot_energy = dashpot_energy + dashpot_loss(f, before);
            slip = slip + f.slip;
            put(OfJoint::slip, j, get(OfJoint::slip, j) + f.slip);
            put(OfJoint::normal, j, f.normal);
            this->put_vector(OfJoint::spring_1, j, {f.springs.x, f.springs.y, f.springs.twist});
            const BedComponents<Real>& now = f.dashpots;
            const Real fields[] = {now.normal, now.tilt_x, now.tilt_y, now.x, now.y, now.twist};
            for (int k = 0; k < 6; ++k)
                put(OfJoint::dashpot, j, fields[k], k);
            topology_.joint[j].reversed ? put_forces<true>(j, s, on_upper, torque)
                                        : put_forces<false>(j, s, on_upper, torque);
        }
        put(OfRealization::friction_energy, friction_energy);
        put(OfRealization::dashpot_energy, dashpot_energy);
        put(OfRealization::slip, slip);
        if constexpr (mechanisms)
            put(OfRealizationMechanisms::joint_energy, get(OfRealizationMechanisms::joint_energy) + joint_energy);
    }

    STYLOBATE_INLINE JointMechanism<Real, Layout> mechanism(int j) const { return {*this, j}; }

    STYLOBATE_INLINE BedForce<Real> bed_force_of(int j, const Scratch& s, const FrictionLaw<Real>& law,
                                                 const FrictionSprings<Real>& springs) const
    {
        if constexpr (mechanisms)
            return bed_force(
                s.load, law, s.motion, springs,
                [&](const BedComponents<Real>& rates, BedComponents<Real>& resistance) {
                    mechanism(j).dashpot(s.load, law.C_n_per_dt, topology_.joint[j], rates, resistance);
                },
                [&](Real normal, const BedComponents<Real>& rates) {
                    return mechanism(j).friction_limit(s.load, law.mu, normal, rates);
                });
        else
            return bed_force(s.load, law, s.motion, springs);
    }

    /// @param on_upper, own_torque on the upper body at P, in the joint's frame
    template <bool reversed>
    STYLOBATE_INLINE void put_forces(int j, const Scratch& s, const Vector<Real>& on_upper,
                                     const Vector<Real>& own_torque) const
    {
        const TopologyJoint joint = topology_.joint[j];
        const JointAxes axes(joint.normal);
        const Matrix<Real> turn = this->template matrix_along<reversed>(axes, joint.lower);
        const Vector<Real> force = rotated(turn, on_upper), torque = rotated(turn, own_torque);
        this->template put_along<reversed>(axes, OfJoint::force, j, force);
        this->template put_along<reversed>(axes, OfJoint::upper_moment, j, torque + cross(s.upper_arm, force));
        this->template put_along<reversed>(axes, OfJoint::lower_moment, j, torque + cross(s.lower_arm, force));
    }

    struct Load {
        Vector<Real> force, moment;
    };
    /// Sum of the joints' forces on a body, in the order of the list.
    STYLOBATE_INLINE Load sum(int body) const
    {
        Load of{zero_vector<Real>(), zero_vector<Real>()};
        const int* const lists = topology_.joint_lists;
        for (int at = lists[body]; at < lists[body + 1]; ++at) {
            const int j = lists[at] >> 1;
            const Vector<Real> force = this->vector(OfJoint::force, j);
            if (lists[at] & 1) {
                of.force = of.force - force;
                of.moment = of.moment - this->vector(OfJoint::lower_moment, j);
            } else {
                of.force = of.force + force;
                of.moment = of.moment + this->vector(OfJoint::upper_moment, j);
            }
        }
        return of;
    }

    /// Energies at the positions that the step starts from. The kinetic one is the product of the velocities half a
    /// step before and after.
    STYLOBATE_INLINE void update(int step, bool audit) const
    {
        const Real zero(0.0), one(1.0);
        const Vector<Real> base{this->get(OfBaseX::second, step), this->get(OfBaseY::second, step),
                                this->get(OfBaseZ::second, step)};
        const Vector<Real> gravity = this->vector(OfRealization::gravity_dx), push = gravity - base;
        const Real now(static_cast<NumberOf<Real>>(step)), dt2 = get(OfRealization::dt2);
        Real kinetic = zero, potential = zero;
        Vector<Real> momentum = zero_vector<Real>();
        [[maybe_unused]] std::conditional_t<mechanisms, Ties<Real, Layout>, detail::NoTies> ties(*this);
        for (int i = topology_.fixed; i < topology_.bodies; ++i) {
            const Load load = sum(i);
            const Real mass = get(OfBody::mass, i);
            const Vector<Real> u = this->vector(OfBody::x, i), d = this->vector(OfBody::dx, i);
            Vector<Real> l = this->vector(OfBody::l_x, i), drift = d + push;
            if constexpr (mechanisms)
                ties.slow(i, u, d, this->vector(OfBody::turn_x, i), drift, l);
            l = multiply_add(dt2, load.moment, l);
            const Vector<Real> e = multiply_add(get(OfBody::dt2_per_mass, i), load.force, drift);
            momentum = multiply_add(mass, d, momentum);
            if (audit) {
                kinetic = kinetic + fma(mass, dot(d, e), dot(l, this->vector(OfBody::turn_x, i)));
                potential = fnma(mass, dot(gravity, u), potential);
                if constexpr (mechanisms)
                    potential = potential + ties.held(i, u);
            }
            const Vector<Real> next = u + e;
            const Quaternion<Real> q = turned(this->attitude(i), l, inertia(i), correction(i));
            this->put_vector(OfBody::dx, i, e);
            this->put_vector(OfBody::l_x, i, l);
            this->put_vector(OfBody::x, i, next);
            put(OfBody::q_w, i, q.w);
            this->put_vector(OfBody::q_x, i, {q.x, q.y, q.z});
            [[maybe_unused]] const Vector<Real> turn = put_rotation(i, q, l);
            if constexpr (mechanisms)
                ties.moved(i, e, turn);
            const Real upright = one + get(OfBody::matrix, i, 4);
            const auto out = (upright < get(OfBody::least_upright, i)) | (next.y < get(OfBody::least_y, i));
            put(OfBody::inside, i, select(out, get(OfBody::inside, i), now));
        }
        if constexpr (mechanisms)
            ties.end();
        const Vector<Real> both = this->vector(OfRealization::base_step_x) + base;
        put(OfRealization::base_energy, get(OfRealization::base_energy) - dot(both, momentum));
        this->put_vector(OfRealization::base_step_x, 0, base);
        const Real x = get(OfBody::x, topology_.top), z = get(OfBody::z, topology_.top);
        const auto keep_most = [&](OfRealization::Field field, Real value) { put(field, max_of(get(field), value)); };
        keep_most(OfRealization::peak_radial, fma(x, x, z * z));
        keep_most(OfRealization::peak_across,
                  abs_of(fma(get(OfRealization::across_x), x, get(OfRealization::across_z) * z)));
        if (audit) {
            put(OfRealization::kinetic, kinetic);
            put(OfRealization::potential, potential);
        }
    }

    const Topology topology_; ///< a copy: what stores might change would be read again after each of them
};

/// Runs steps `first` to `last - 1` of the chunk for all realizations of the bundle.
template <class Real, class Here = void>
void run_steps(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle, int first, int last)
{
    if (topology.model.mechanisms)
        Stepper<Real, Here, true>(topology, bundle).run(first, last);
    else
        Stepper<Real, Here>(topology, bundle).run(first, last);
}

} // namespace stylobate::spatial

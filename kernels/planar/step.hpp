#pragma once
/// One step of all realizations of a bundle: the centre of Stylobate. `THEORY.md` derives every formula, with sources.
///
///   geometry    where each joint's upper block lies, relative to its lower one
///   overlap     area, moments and direction of the contact (closed form; general where that does not hold)
///   faces       centroid and unit normal, and how the faces moved relative to each other there in the last step
///   forces      Eqs. 1 to 3 and the energy terms
///   update      sums over the blocks, Eqs. 4 to 6 as d += dt2 F / m, u += d, and sine and versine of the new rotation
///
/// The phases run over all joints (in groups that fit the first-level cache) with their intermediate values in memory.
/// Neighbouring joints are independent within a phase, so the processor works on several at once; one pass from
/// geometry to force would wait for each result in turn. A phase is fast if its chain of operations is short: the
/// divisions and the root are in different phases, and independent of each other (`docs/performance.md`).
///
/// Beds go through the phases in every step, watched pairs (`topology.hpp`) where their bounding boxes meet; which
/// pairs come so close is determined only when a block has strayed. A pair that does not touch changes no bit.
///
/// What is not inlined gets a copy of the stepper: if its address were known elsewhere, the compiler would read its
/// pointers again after every store.

#include "kernels/planar/bed.hpp"
#include "kernels/planar/mechanism.hpp"
#include "kernels/planar/mechanisms/mechanisms.hpp"
#include "kernels/planar/neighbours.hpp"
#include "kernels/planar/overlap_full.hpp"
#include "kernels/planar/rows.hpp"
#include "kernels/planar/scratch.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

/// @tparam watching whether there are watched pairs
/// @tparam stack `Topology::stack`: the blocks of each joint are then known beforehand, without look-up
/// @tparam Layout how the rows lie, and how many joints go through the phases together (`rows.hpp`)
template <class Real, class Mechanism, bool watching, bool stack, class Layout = Packed>
class Stepper : Neighbours<Real, Mechanism, Layout> {
    using Near = Neighbours<Real, Mechanism, Layout>;

public:
    STYLOBATE_INLINE Stepper(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle) : Near(topology, bundle)
    {
    }

    /// Steps `first` to `last - 1` of the table of base motion; the energies are those of the last one.
    STYLOBATE_INLINE void run(int first, int last) const
    {
        Scratch scratch[joint_group];
        const int beds = topology_.beds();
        [[maybe_unused]] int close = -1;
        [[maybe_unused]] typename Near::Path path(*this);
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            turn(i, get(OfBlock::theta, i));
            if (first == 0)
                put(OfBlock::inside, i, Real(-1.0));
        }
        for (int step = first; step < last; ++step) {
            const bool audit = step + 1 == last;
            [[maybe_unused]] bool others = Mechanism::mechanisms;
            if constexpr (Mechanism::mechanisms)
                Near::clear_forces();
            for (int begin = 0; begin < beds; begin += joint_group)
                contacts<detail::Bed>(
                    beds - begin < joint_group ? beds - begin : joint_group, [begin](int j) { return begin + j; },
                    scratch, audit);
            if constexpr (watching) {
                if (close < 0 || path.strayed()) {
                    close = Near::look_around();
                    path.restart();
                }
                if (close > 0 || audit)
                    others |= pairs(*this, close, scratch, audit);
            }
            update(step, audit, others, path);
            if constexpr (Mechanism::mechanisms)
                this->trace(step - first, topology_.fixed, topology_.blocks);
        }
    }

private:
    static constexpr int joint_group = Layout::joint_group;
    using Scratch = detail::JointScratch<Real, Mechanism::points>;

    /// Whether beds use the paper's contact: the closed form of their overlap.
    static constexpr bool paper = !Mechanism::mechanisms && Mechanism::form == ContactForm::area;

    using Rows<Real, Layout>::add;
    using Rows<Real, Layout>::get;
    using Rows<Real, Layout>::put;
    using Rows<Real, Layout>::b_;
    using Near::centre_x;
    using Near::centre_y;
    using Near::topology_;

    /// In a stack: blocks below the lowest bed's lower one. Without watched pairs there are none (a number that the
    /// compiler is to know).
    STYLOBATE_INLINE int below_beds() const { return watching ? topology_.fixed - 1 : 0; }

    /// The blocks of a joint.
    template <class Kind>
    STYLOBATE_INLINE TopologyJoint ends(int joint) const
    {
        if constexpr (stack && Kind::at_rest)
            return {below_beds() + joint, below_beds() + joint + 1};
        else
            return topology_.joint[joint];
    }

    using Pose = stylobate::Pose<Real>;
    STYLOBATE_INLINE Pose pose(int i) const
    {
        return {get(OfBlock::sine, i), get(OfBlock::versine, i), get(OfBlock::theta, i), centre_x(i), centre_y(i)};
    }

    /// From geometry to forces, for `count` joints; `joint(j)` is the j-th of them.
    template <class Kind, class JointOf>
    STYLOBATE_INLINE void contacts(int count, JointOf joint, Scratch* scratch, bool audit) const
    {
        geometry<Kind>(count, joint, scratch);
        for (int j = 0; j < count; ++j)
            overlap<Kind>(joint(j), scratch[j], audit);
        for (int j = 0; j < count; ++j)
            faces<Kind>(joint(j), scratch[j], audit);
        forces<Kind>(count, joint, scratch);
    }

    STYLOBATE_INLINE Planar<Real> motion(int i) const
    {
        return {get(OfBlock::dx, i), get(OfBlock::dy, i), get(OfBlock::dtheta, i)};
    }

    STYLOBATE_INLINE void turn(int i, Real theta) const
    {
        const Angle<Real> a = angle(theta);
        put(OfBlock::sine, i, a.sine);
        put(OfBlock::versine, i, a.versine);
    }

    /// Relative placement; for a bed from relative displacements and versines, without cancellation of large numbers.
    /// @param x, y upper centre - lower centre, frame of the base
    template <class Kind>
    STYLOBATE_INLINE Placement<Real> placement(int joint, const Pose& lower, const Pose& upper, Real& x, Real& y) const
    {
        const Real sl = lower.sine, vl = lower.versine, su = upper.sine, vu = upper.versine;
        const auto [below, above] = ends<Kind>(joint);
        x = get(OfJoint::reference_x, joint) + (upper.x - lower.x);
        Real rise = upper.y - lower.y;
        if constexpr (compensated<NumberOf<Real>>)
            rise = rise + (get(OfRemainder::y, above) - get(OfRemainder::y, below));
        const Real height = get(OfJoint::height, joint);
        y = rise + height;
        const Real hu = get(OfBlock::half_height, above);
        Placement<Real> place = bed_placement(sl, vl, su, vu, x, rise, height, hu);
        if constexpr (!Kind::at_rest)
            place.depth = pair_depth(place.cosine, sl, vl, x, y, get(OfBlock::half_height, below), hu);
        return place;
    }

    /// In a stack, a joint's upper block is the next one's lower one, and its pose is reused.
    template <class Kind, class JointOf>
    STYLOBATE_INLINE void geometry(int count, JointOf joint, Scratch* scratch) const
    {
        if (count == 0)
            return;
        Pose lower = pose(ends<Kind>(joint(0)).lower);
        for (int j = 0; j < count; ++j) {
            const auto [below, above] = ends<Kind>(joint(j));
            if constexpr (!(stack && Kind::at_rest))
                lower = pose(below);
            const Pose upper = pose(above);
            geometry<Kind>(joint(j), lower, upper, scratch[j]);
            lower = upper;
        }
    }

    template <class Kind>
    STYLOBATE_INLINE void geometry(int joint, const Pose& lower, const Pose& upper, Scratch& s) const
    {
        const auto [below, above] = ends<Kind>(joint);
        Real x, y;
        const Placement<Real> place = placement<Kind>(joint, lower, upper, x, y);
        if constexpr (Kind::at_rest && paper)
            pentagon_frame(place, get(OfBlock::half_width, above), s.frame);
        else
            s.place = place;
        if constexpr (Mechanism::mechanisms) { // from centre of mass to centre of mass
            const Real el = get(OfBlockMechanisms::eccentricity, below),
                       eu = get(OfBlockMechanisms::eccentricity, above);
            const Real one(1.0);
            x = fma(eu, one - upper.versine, fnma(el, one - lower.versine, x));
            y = fma(eu, upper.sine, fnma(el, lower.sine, y));
        }
        s.apart_x = x;
        s.apart_y = y;
        if constexpr (Kind::at_rest) {
            const Real rotation = abs_of(upper.theta - lower.theta);
            put(OfJoint::max_rotation, joint, max_of(get(OfJoint::max_rotation, joint), rotation));
        }
    }

    template <class Kind>
    STYLOBATE_INLINE void overlap(int joint, Scratch& s, [[maybe_unused]] bool audit) const
    {
        if constexpr (!Kind::at_rest) {
            s.met = general(joint, s.place);
        } else if constexpr (Mechanism::mechanisms) {
            s.met = meet_with_mechanisms(joint, s);
        } else if constexpr (!paper) {
            meet_points(joint, s);
        } else {
            auto fits = s.frame.slope < s.frame.slope;
            pentagon(s.frame, get(OfBlock::half_width, ends<Kind>(joint).lower), get(OfJoint::depth_limit, joint), fits,
                     s.met);
            if (audit)
                s.met.elastic = s.met.moment_depth;
            if (any(!fits)) [[unlikely]]
                fall_back(*this, joint, fits, s.met);
        }
    }

    STYLOBATE_INLINE void meet_points(int joint, Scratch& s) const
    {
        const auto [lower, upper] = ends<detail::Bed>(joint);
        const Real bl = get(OfBlock::half_width, lower), bu = get(OfBlock::half_width, upper);
        const Real limit = get(OfJoint::depth_limit, joint);
        auto fits = bl < bl;
        if constexpr (Mechanism::form == ContactForm::two_corner)
            s.met = two_corner_overlap(s.place, bl, bu, limit, s.points, fits);
        else
            s.met =
                points_overlap(s.place, bl, bu, limit, get(OfJointMechanisms::per_root_depth, joint), s.points, fits);
        if (any(!fits)) [[unlikely]]
            fall_back(s.place, {bl, get(OfBlock::half_height, lower), bu, get(OfBlock::half_height, upper)}, fits,
                      s.met, s.points);
    }

    STYLOBATE_INLINE Overlap<Real> meet_with_mechanisms(int joint, Scratch& s) const
    {
        using J = OfJointMechanisms;
        const auto [lower, upper] = topology_.joint[joint];
        const PairSizes<Real> sizes{get(OfBlock::half_width, lower), get(OfBlock::half_height, lower),
                                    get(OfBlock::half_width, upper), get(OfBlock::half_height, upper)};
        const Real narrow = min_of(sizes.lower_half_width, sizes.upper_half_width);
        const Real wear = get(J::corner_wear, joint), turned = get(J::turned, joint);
        const BedFaces<Real> faces{sizes,
                                   get(OfJoint::depth_limit, joint),
                                   face_loss(worn_corner(get(J::chip_left, joint), wear, turned, narrow),
                                             worn_corner(get(J::chip_right, joint), wear, turned, narrow),
                                             get(J::left_of_lower, joint), get(J::right_of_lower, joint)),
                                   get(J::wedge_sine, joint),
                                   get(J::wedge_versine, joint),
                                   get(J::per_root_depth, joint)};
        const auto far = [&](const Placement<Real>& place, const PairSizes<Real>& left, auto fits, Overlap<Real>& o,
                             auto& points) { fall_back(place, left, fits, o, points); };
        if constexpr (Mechanism::points > 0) {
            return bed_overlap<Mechanism::form>(s.place, faces, s.place.sine < s.place.sine, s.points, far);
        } else {
            FormPoints<Real, 0> none;
            return bed_overlap<Mechanism::form>(s.place, faces, s.place.sine < s.place.sine, none, far);
        }
    }

    template <class Mask, int count>
    STYLOBATE_APART static void fall_back(const Placement<Real>& place, const PairSizes<Real>& sizes, Mask fits,
                                          Overlap<Real>& o, FormPoints<Real, count>& points)
    {
        take_general(place, sizes, fits, o, points);
    }

    STYLOBATE_INLINE Overlap<Real> general(int joint, const Placement<Real>& place) const
    {
        const auto [lower, upper] = topology_.joint[joint];
        return full_general_overlap(place,
                                    PairSizes<Real>{get(OfBlock::half_width, lower), get(OfBlock::half_height, lower),
                                                    get(OfBlock::half_width, upper), get(OfBlock::half_height, upper)});
    }

    /// The general overlap, for the realizations whose closed form does not hold. Rare, so it is not inlined.
    template <class Mask>
    STYLOBATE_APART static void fall_back(Stepper self, int joint, Mask fits, Overlap<Real>& o)
    {
        Real x, y;
        const auto [lower, upper] = self.topology_.joint[joint];
        o = select(
            fits, o,
            self.general(joint, self.template placement<detail::Bed>(joint, self.pose(lower), self.pose(upper), x, y)));
    }

    template <class Kind>
    STYLOBATE_INLINE void faces(int joint, Scratch& s, bool audit) const
    {
        const auto [lower, upper] = ends<Kind>(joint);
        const Overlap<Real>& o = s.met;
        const ContactSize<Real> size = contact_size(o);
        // centroid in the lower block's frame
        Real arm_x = o.moment_x * size.per_area;
        const Real arm_y = fnma(o.moment_depth, size.per_area, get(OfBlock::half_height, lower));
        if constexpr (Mechanism::mechanisms)
            arm_x = arm_x - get(OfBlockMechanisms::eccentricity, lower);
        if constexpr (Mechanism::points > 0 && Kind::at_rest) {
            const Real middle = s.points.moment * size.per_area;
            for (int i = 0; i < Mechanism::points; ++i) {
                s.points.x[i] = s.points.x[i] - middle;
                s.points.area[i] = s.points.area[i] * size.per_area;
            }
        }
        touch<Real>(size, o, arm_x, arm_y, get(OfBlock::sine, lower), get(OfBlock::versine, lower), s.apart_x,
                    s.apart_y, motion(lower), motion(upper), s);
        if (audit)
            put(OfJoint::elastic, joint, select(size.pressed, get(OfJoint::K_n, joint) * o.elastic, Real(0.0)));
    }

    /// A bed's force is stored with it until its blocks sum theirs up. A pair adds to them at once, and only where it
    /// touches: so they have the same bits whether or not it was evaluated.
    // long: one loop whose sums stay in registers; a part of it as a function would hand a dozen of them to and fro
    template <class Kind, class JointOf>
    STYLOBATE_INLINE void forces(int count, JointOf joint_of, const Scratch* scratch) const
    {
        Real dashpot_energy = get(OfRealization::dashpot_energy), shear_energy = get(OfRealization::shear_energy);
        Real friction_energy = get(OfRealization::friction_energy);
        Real slip_sum = get(OfRealization::slip), path = get(OfRealization::path);
        Real rocking_path = get(OfRealization::rocking_path);
        [[maybe_unused]] Real joint_energy(0.0); // from what there is on, so that groups of any size sum up alike
        if constexpr (Mechanism::mechanisms && Kind::at_rest)
            joint_energy = get(OfRealizationMechanisms::joint_energy);
        for (int j = 0; j < count; ++j) {
            const int joint = joint_of(j);
            const Scratch& s = scratch[j];
            const auto [lower, upper] = ends<Kind>(joint);
            const JointLaw<Real> law{get(OfJoint::K_n, joint),        get(OfJoint::K_t, joint),
                                     get(OfJoint::C_n_per_dt, joint), get(OfJoint::C_t_per_dt, joint),
                                     get(OfJoint::C_n_chord, joint),  get(OfJoint::C_t_chord, joint),
                                     get(OfJoint::mu, joint)};
            const Real spring = get(OfJoint::spring, joint);
            constexpr bool mechanisms = Mechanism::mechanisms && Kind::at_rest;
            constexpr bool coupled = Kind::at_rest && (Mechanism::mechanisms || Mechanism::points > 0);
            ContactForce<Real> f;
            [[maybe_unused]] Real couple(0.0), mu = law.mu;
            [[maybe_unused]] const Real turning = get(OfBlock::dtheta, upper) - get(OfBlock::dtheta, lower);
            if constexpr (mechanisms) {
                const BedMotion<Real> motion{s.area,  s.chord,      s.closing,     s.sliding,
                                             turning, s.place.sine, s.place.cosine};
                BedForce<Real> bed;
                if constexpr (Mechanism::points > 0)
                    bed = bed_force(*this, joint, law, spring, motion, s.points);
                else
                    bed = bed_force(*this, joint, law, spring, motion, FormPoints<Real, 0>{});
                f = bed.contact;
                couple = bed.couple;
                mu = bed.mu;
            } else if constexpr (coupled) {
                f = points_force(get(OfJointMechanisms::face_dashpot, joint), law, s.area, s.chord, s.closing,
                                 s.sliding, turning, spring, s.points, couple);
            } else {
                f = contact_force(law, s.area, s.chord, s.closing, s.sliding, spring);
            }
            put(OfJoint::spring, joint, f.spring);

            BedLoad<Real> load = bed_load(f, s, s.apart_x, s.apart_y);
            if constexpr (coupled) {
                load.upper_moment = load.upper_moment + couple;
                load.lower_moment = load.lower_moment + couple;
            }
            if constexpr (Kind::at_rest) {
                put(OfJoint::force_x, joint, load.x);
                put(OfJoint::force_y, joint, load.y);
                put(OfJoint::upper_moment, joint, load.upper_moment);
                put(OfJoint::lower_moment, joint, load.lower_moment);
            } else {
                const auto pressed = s.area > Real(0.0);
                const auto sum = [&](OfBlock::Field field, int block, Real with) {
                    put(field, block, select(pressed, get(field, block) + with, get(field, block)));
                };
                const Real zero(0.0);
                sum(OfBlock::force_x, upper, load.x);
                sum(OfBlock::force_y, upper, load.y);
                sum(OfBlock::moment, upper, load.upper_moment);
                sum(OfBlock::force_x, lower, zero - load.x);
                sum(OfBlock::force_y, lower, zero - load.y);
                sum(OfBlock::moment, lower, zero - load.lower_moment);
            }

            // energy: the work of this step is its displacement times the mean of the forces at its two ends
            const Real dashpot = fnma(law.K_n, s.area, f.normal);
            dashpot_energy = fma(dashpot + get(OfJoint::dashpot_force, joint), s.closing, dashpot_energy);
            if constexpr (coupled) {
                dashpot_energy = fnma(couple + get(OfJointMechanisms::couple, joint), turning, dashpot_energy);
                put(OfJointMechanisms::couple, joint, couple);
            }
            if constexpr (mechanisms)
                joint_energy =
                    joint_energy + after_force<Mechanism>(*this, topology_.joint[joint], joint, s, f, turning);
            put(OfJoint::dashpot_force, joint, dashpot);
            shear_energy = fma(f.tangential + get(OfJoint::shear_force, joint), s.sliding, shear_energy);
            put(OfJoint::shear_force, joint, f.tangential);
            const Real slip = f.excess * get(OfJoint::per_K_t, joint);
            friction_energy = fma(slip, (mechanisms ? mu : law.mu) * f.normal, friction_energy);
            if constexpr (Kind::at_rest) {
                slip_sum = slip_sum + slip;
                path = path + abs_of(s.sliding);
                rocking_path = rocking_path + abs_of(get(OfBlock::dtheta, upper) - get(OfBlock::dtheta, lower));
            }
        }
        put(OfRealization::dashpot_energy, dashpot_energy);
        put(OfRealization::shear_energy, shear_energy);
        put(OfRealization::friction_energy, friction_energy);
        put(OfRealization::slip, slip_sum);
        put(OfRealization::path, path);
        put(OfRealization::rocking_path, rocking_path);
        if constexpr (Mechanism::mechanisms && Kind::at_rest)
            put(OfRealizationMechanisms::joint_energy, joint_energy);
    }

    /// The watched pairs that meet, in the order of the list. Separate from the beds, so as not to slow them down.
    /// @param close number of pairs listed as close
    /// @return whether one met: there are then forces in the blocks' rows
    STYLOBATE_APART static bool pairs(Stepper self, int close, Scratch* scratch, bool audit)
    {
        bool met = false;
        if (audit)
            for (int joint = self.topology_.beds(); joint < self.topology_.joints; ++joint)
                self.put(OfJoint::elastic, joint, Real(0.0));
        // boxes that touch to rounding are included
        const Real margin = self.get(OfRealization::skin) * Real(1e-3);
        for (int next = 0; next < close;) {
            int group[joint_group] = {}, count = 0;
            for (; next < close && count < joint_group; ++next)
                if (any(self.meets(self.listed(next), margin)))
                    group[count++] = self.listed(next);
            if (count == 0)
                continue;
            if (!Mechanism::mechanisms && !met)
                self.clear_forces();
            met = true;
            self.template contacts<detail::Pair>(
                count, [&group](int j) { return group[j]; }, scratch, audit);
        }
        return met;
    }

    /// Sum of the contact forces on a block, its beds in the order of the list.
    /// @param others whether there are forces besides those of the beds, in the blocks' rows
    STYLOBATE_INLINE Planar<Real> sum(int i, bool others) const
    {
        Planar<Real> force{Real(0.0), Real(0.0), Real(0.0)};
        if (others)
            force = {get(OfBlock::force_x, i), get(OfBlock::force_y, i), get(OfBlock::moment, i)};
        const auto rests_on = [&](int bed) {
            force.x = force.x + get(OfJoint::force_x, bed);
            force.y = force.y + get(OfJoint::force_y, bed);
            force.theta = force.theta + get(OfJoint::upper_moment, bed);
        };
        const auto carries = [&](int bed) {
            force.x = force.x - get(OfJoint::force_x, bed);
            force.y = force.y - get(OfJoint::force_y, bed);
            force.theta = force.theta - get(OfJoint::lower_moment, bed);
        };
        if constexpr (stack) {
            rests_on(i - below_beds() - 1);
            if (i + 1 < topology_.blocks)
                carries(i - below_beds());
            return force;
        }
        const int* const lists = topology_.bed_lists;
        for (int at = lists[i]; at < lists[i + 1]; ++at) {
            const int bed = lists[at] >> 1;
            if (lists[at] & 1)
                carries(bed);
            else
                rests_on(bed);
        }
        return force;
    }

    /// Energies at the positions that the step starts from. The kinetic one is the product of the velocities half a
    /// step before and after: with it, and the works as above, the balance of the scheme is exact.
    /// @param path of the blocks since the close pairs were listed
    STYLOBATE_INLINE void update(int step, bool audit, bool others, typename Near::Path& path) const
    {
        const Real gx = get(OfRealization::gravity_dx), gy = get(OfRealization::gravity_dy);
        const Real base = this->get(OfBase::second, step);
        const Real push = gx - base;
        if constexpr (Mechanism::mechanisms)
            strengthen_blocks<Mechanism>(*this, topology_);
        [[maybe_unused]] auto pull = [&] {
            if constexpr (Mechanism::mechanisms)
                return MechanismPull<Real, Layout>(*this, step);
            else
                return 0;
        }();
        const Real now(static_cast<NumberOf<Real>>(step));
        Real kinetic(0.0), potential(0.0), momentum(0.0);
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Planar<Real> force = sum(i, others);
            const Real dx = get(OfBlock::dx, i), dy = get(OfBlock::dy, i), dtheta = get(OfBlock::dtheta, i);
            const Real x = get(OfBlock::x, i), y = get(OfBlock::y, i);
            const Real per_mass = get(OfBlock::dt2_per_mass, i), mass = get(OfBlock::mass, i);
            Planar<Real> e;
            if constexpr (Mechanism::mechanisms) {
                pull.step(i, force, dx, dy, dtheta, e);
            } else if constexpr (compensated<NumberOf<Real>>) {
                e.x = add(OfRemainder::dx, i, dx, fma(per_mass, force.x, push));
                e.y = add(OfRemainder::dy, i, dy, fma(per_mass, force.y, gy));
                e.theta = add(OfRemainder::dtheta, i, dtheta, get(OfBlock::dt2_per_inertia, i) * force.theta);
            } else {
                e = next_motion(force, Planar<Real>{dx, dy, dtheta}, per_mass, get(OfBlock::dt2_per_inertia, i), push,
                                gy);
            }
            momentum = fma(mass, dx, momentum);
            if (audit) {
                const Real twice = fma(dx, e.x, dy * e.y);
                kinetic = fma(mass, twice, fma(get(OfBlock::inertia, i), dtheta * e.theta, kinetic));
                potential = fnma(mass, fma(gx, x, gy * y), potential);
                put(OfBlock::force_x, i, force.x);
                put(OfBlock::force_y, i, force.y);
                put(OfBlock::moment, i, force.theta);
            }
            if constexpr (watching)
                path.add(e);
            put(OfBlock::dx, i, e.x);
            put(OfBlock::dy, i, e.y);
            put(OfBlock::dtheta, i, e.theta);
            put(OfBlock::x, i, add(OfRemainder::x, i, x, e.x));
            put(OfBlock::y, i, add(OfRemainder::y, i, y, e.y));
            const Real theta = add(OfRemainder::theta, i, get(OfBlock::theta, i), e.theta);
            put(OfBlock::theta, i, theta);
            turn(i, theta);
            const auto out = (abs_of(theta) > get(OfBlock::most_turn, i)) | (centre_y(i) < get(OfBlock::least_y, i));
            put(OfBlock::inside, i, select(out, get(OfBlock::inside, i), now));
        }
        const Real both = get(OfRealization::base_step) + base;
        Real base_energy = fnma(both, momentum, get(OfRealization::base_energy));
        if constexpr (Mechanism::mechanisms) {
            base_energy = base_energy + pull.drive_energy();
            pull.end();
        }
        put(OfRealization::base_energy, base_energy);
        put(OfRealization::base_step, base);
        put(OfRealization::peak_top, max_of(get(OfRealization::peak_top), abs_of(get(OfBlock::x, topology_.top))));
        put(OfRealization::top_path, get(OfRealization::top_path) + abs_of(get(OfBlock::dx, topology_.top)));
        if (audit) {
            put(OfRealization::kinetic, kinetic);
            put(OfRealization::potential, potential);
        }
        if constexpr (watching)
            path.end_step();
    }
};

/// Runs steps `first` to `last - 1` of the chunk for all realizations of the bundle.
template <class Real, class Mechanism = Baseline>
void run_steps(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle, int first, int last)
{
    const auto run = [&]<bool watching, bool stack>() {
        Stepper<Real, Mechanism, watching, stack>(topology, bundle).run(first, last);
    };
    if (topology.watched > 0)
        topology.stack ? run.template operator()<true, true>() : run.template operator()<true, false>();
    else
        topology.stack ? run.template operator()<false, true>() : run.template operator()<false, false>();
}

} // namespace stylobate

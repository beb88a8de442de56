#pragma once
/// One step of the rigid form: blocks without compliance, whose faces may touch but not enter each other.
///
/// The unknowns are the forces of each bed: two normal ones at the ends of the faces' common part, as in the form
/// `two_corner`, and one along the face. What they do to the increments of the blocks is linear, so that the conditions
/// of all beds (an end that carries stays on its face; friction holds, or is at its limit) are one system of equations.
/// Which ends carry and which slip is found with it (`rigid_contacts.hpp`). `THEORY.md` section 10 derives the
/// formulas.
///
///   geometry    the ends of each bed, their gaps, and what the last increments did to them
///   strike      when within the step the fastest open end meets its face
///   responses   of the conditions to the forces
///   solve       the forces, and which ends carry
///   update      increments with the forces, and positions; what is left of the gaps is closed by a displacement that
///               has no part in the velocities
///
/// Sources: velocity-level time stepping with impacts in the sense of Moreau, "Unilateral contact and dry friction in
/// finite freedom dynamics", in: Nonsmooth Mechanics and Applications (1988), as in Jean, "The non-smooth contact
/// dynamics method", Computer Methods in Applied Mechanics and Engineering 177 (1999) 235; the separate correction of
/// positions after Acary, "Projected event-capturing time-stepping schemes for nonsmooth mechanical systems with
/// unilateral contact and Coulomb's friction", ibid. 256 (2013) 224. Own: the time of impact within the step, the
/// second-order terms.

#include "kernels/planar/overlap.hpp"
#include "kernels/planar/rigid/rigid_contacts.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

namespace detail {

/// Faces that are turned more than this against each other are no bed: cosine.
inline constexpr double least_bed_cosine = 0.2;

} // namespace detail

/// @tparam Here a type of the file that this is compiled for (`instantiate.hpp`)
template <class Real, class Here, class Layout = Packed>
class RigidStepper : RigidContacts<Real, Here, Layout> {
    using Contacts = RigidContacts<Real, Here, Layout>;

public:
    STYLOBATE_INLINE RigidStepper(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle)
        : Contacts(topology, bundle)
    {
    }

    /// Steps `begin` to `end - 1` of the table of base motion; the energies are those of the last one.
    STYLOBATE_INLINE void run(int begin, int end) const
    {
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            turn(i, get(OfBlock::theta, i));
            if (begin == 0)
                put(OfBlock::inside, i, Real(-1.0));
        }
        for (int step = begin; step < end; ++step) {
            for (int j = 0; j < topology_.beds(); ++j)
                geometry(j);
            strike();
            fall_freely(step);
            set_goals();
            for (int j = 0; j < topology_.beds(); ++j)
                put_own_response(j);
            for (int e = 0; e < topology_.rigid_edges; ++e)
                put_response(e);
            solve();
            update(step, step + 1 == end);
        }
    }

private:
    using Contacts::add;
    using Contacts::bed;
    using Contacts::free;
    using Contacts::get;
    using Contacts::last;
    using Contacts::load_three;
    using Contacts::next;
    using Contacts::part_late;
    using Contacts::push_free;
    using Contacts::put;
    using Contacts::put_free;
    using Contacts::put_next;
    using Contacts::put_own_response;
    using Contacts::put_response;
    using Contacts::rates;
    using Contacts::solve;
    using Contacts::topology_;
    using B = OfRigidBlock;
    using typename Contacts::Bed;
    using J = OfRigidJoint;
    using V = Vector3<Real>;

    STYLOBATE_INLINE void turn(int i, Real theta) const
    {
        const Angle<Real> a = angle(theta);
        put(OfBlock::sine, i, a.sine);
        put(OfBlock::versine, i, a.versine);
    }

    STYLOBATE_INLINE void geometry(int j) const
    {
        const auto [lower, upper] = topology_.joint[j];
        const Real zero(0.0), one(1.0), half(0.5);
        const Real x = get(OfJoint::reference_x, j) + (get(OfBlock::x, upper) - get(OfBlock::x, lower));
        const Placement<Real> p =
            bed_placement(get(OfBlock::sine, lower), get(OfBlock::versine, lower), get(OfBlock::sine, upper),
                          get(OfBlock::versine, upper), x, get(OfBlock::y, upper) - get(OfBlock::y, lower),
                          get(OfJoint::height, j), get(OfBlock::half_height, upper));
        const Real bl = get(OfBlock::half_width, lower), reach = get(OfBlock::half_width, upper) * p.cosine;
        const Real left = max_of(p.x - reach, zero - bl), right = min_of(p.x + reach, bl);
        const auto usable = (p.cosine > Real(detail::least_bed_cosine)) & (right > left);
        const Real slope = p.sine / select(usable, p.cosine, one);
        const Real from_middle = get(OfBlock::half_height, upper) * p.sine - p.x;
        put(J::left_x, j, left);
        put(J::right_x, j, right);
        put(J::left_arm, j, left + from_middle);
        put(J::right_arm, j, right + from_middle);
        put(J::upper_arm, j, fms(get(OfBlock::half_height, upper), p.cosine, p.depth));
        const Real left_gap = fms(left - p.x, slope, p.depth), right_gap = fms(right - p.x, slope, p.depth);
        put(J::left_gap, j, left_gap);
        put(J::right_gap, j, right_gap);
        put(J::usable, j, select(usable, one, zero));
        put(J::left, j, select(usable, get(J::left, j), zero));
        put(J::right, j, select(usable, get(J::right, j), zero));

        const auto nearer = left_gap < right_gap;
        const Real left_tilt = select(usable & (p.x - reach < zero - bl), slope, zero);
        const Real right_tilt = select(usable & (p.x + reach > bl), slope, zero);
        put(J::left_tilt, j, left_tilt);
        put(J::right_tilt, j, right_tilt);
        put(J::left_lift, j, select(nearer, left_tilt, zero));
        put(J::right_lift, j, select(nearer, zero, right_tilt));

        const Bed b = bed(j);
        const Planar<Real> dl = last(lower), du = last(upper);
        const V rate = rates(b, dl, du);
        put(J::left_rate, j, rate.v[0]);
        put(J::right_rate, j, rate.v[1]);
        put(J::sliding, j, rate.v[2]);
        // of a point of the upper face; while a corner of the lower block slides along it, it turns, too
        const Real wl = dl.theta * dl.theta, wu = du.theta * du.theta;
        const Real gaps = half * fma(wu, b.upper_arm, fma(wl, b.lower_arm, zero - Real(2.0) * dl.theta * rate.v[2]));
        const Real along_left = half * fms(wl, left, wu * b.left_arm),
                   along_right = half * fms(wl, right, wu * b.right_arm);
        put(J::left_bend, j, fnma(b.left_tilt, along_left, gaps));
        put(J::right_bend, j, fnma(b.right_tilt, along_right, gaps));
        const Real lift = b.left_lift + b.right_lift;
        put(J::bend_sliding, j, fma(lift, gaps, select(nearer, along_left, along_right)));
        const Real turned = abs_of(get(OfBlock::theta, upper) - get(OfBlock::theta, lower));
        put(OfJoint::max_rotation, j, max_of(get(OfJoint::max_rotation, j), turned));
    }

    /// An open end that closes by more than half a step's path meets its face within this step's velocities. Its blocks
    /// go on until then as in the step before, and only after that as the forces of this step have it: what decides the
    /// loss at an impact. The fastest end of the structure counts, and none right after another one.
    STYLOBATE_INLINE void strike() const
    {
        const Real zero(0.0), half(0.5), one(1.0);
        const Real still = this->still();
        Real fastest = still, its_gap(0.0);
        for (int j = 0; j < topology_.beds(); ++j) {
            const auto usable = get(J::usable, j) > half;
            const auto look_at = [&](J::Field carries, J::Field of_rate, J::Field of_gap) {
                const Real rate = get(of_rate, j), gap = get(of_gap, j);
                // (`fastest` is never above `still`)
                const auto hits = usable & (get(carries, j) < half) & (gap < zero - half * rate) & (rate < fastest);
                its_gap = select(hits, gap, its_gap);
                fastest = select(hits, rate, fastest);
            };
            look_at(J::left, J::left_rate, J::left_gap);
            look_at(J::right, J::right_rate, J::right_gap);
        }
        const auto struck = (get(OfRigid::struck) < half) & (fastest < still);
        const Real when = clamp(half - its_gap / select(struck, fastest, one), zero, one);
        put(OfRigid::struck, select(struck, one, zero));
        put(OfRigid::share, select(struck, when, zero));
    }

    /// The increments without the forces of the beds, but with those of an expansion.
    STYLOBATE_INLINE void fall_freely(int step) const
    {
        const Real share = get(OfRigid::share), rest = Real(1.0) - share;
        const Real push = rest * (get(OfRealization::gravity_dx) - this->get(OfBase::second, step));
        const Real fall = rest * get(OfRealization::gravity_dy);
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            put_free(i, {get(OfBlock::dx, i) + fma(share, get(B::change_x, i), push),
                         get(OfBlock::dy, i) + fma(share, get(B::change_y, i), fall),
                         fma(share, get(B::change_theta, i), get(OfBlock::dtheta, i))});
        }
        for (int i = 0; i < topology_.fixed; ++i)
            put_next(i, {Real(0.0), Real(0.0), Real(0.0)});
        if (expands())
            for (int j = 0; j < topology_.beds(); ++j)
                push_free(j, {{get(J::left_back, j), get(J::right_back, j), Real(0.0)}});
    }
    STYLOBATE_INLINE bool expands() const { return any(get(OfRigid::expands) > Real(0.5)); }
    /// What the forces of the beds have to achieve.
    STYLOBATE_INLINE void set_goals() const
    {
        const Real zero(0.0);
        const Real least = get(OfRealization::gravity_dy); // slower ends do not rebound: they would not leave
        for (int j = 0; j < topology_.beds(); ++j) {
            const Bed b = bed(j);
            const V rate = rates(b, free(b.lower), free(b.upper));
            const Real restitution = get(J::restitution, j);
            const auto rebound = [&](J::Field carries, J::Field last_rate) {
                const Real closing = get(last_rate, j);
                return select((get(carries, j) < Real(0.5)) & (closing < least), restitution * closing, zero);
            };
            put(J::left_goal, j, zero - rate.v[0] - get(J::left_bend, j) - rebound(J::left, J::left_rate));
            put(J::right_goal, j, zero - rate.v[1] - get(J::right_bend, j) - rebound(J::right, J::right_rate));
            put(J::sliding_goal, j, zero - rate.v[2] - get(J::bend_sliding, j));
        }
    }

    // ---- the new state ----

    /// Displacements beside the increments, into the rows of the free ones: until an end meets its face the blocks go
    /// on with their old increments; what is left of the gaps of the ends that carry is closed.
    STYLOBATE_INLINE void close_gaps() const
    {
        const Real late = part_late();
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Planar<Real> before = last(i), after = next(i);
            put_free(i,
                     {late * (before.x - after.x), late * (before.y - after.y), late * (before.theta - after.theta)});
        }
        for (int j = 0; j < topology_.beds(); ++j)
            push_free(j, load_three(J::closing, j));
    }

    /// Losses of the beds: each force's work is its force times the mean of the increments before and after it.
    STYLOBATE_INLINE void count_losses() const
    {
        Real impact = get(OfRealization::dashpot_energy), shear_work = get(OfRealization::shear_energy);
        Real friction = get(OfRealization::friction_energy);
        Real slip = get(OfRealization::slip), path = get(OfRealization::path);
        Real rocking = get(OfRealization::rocking_path);
        const Real zero(0.0), half(0.5);
        for (int j = 0; j < topology_.beds(); ++j) {
            const auto [lower, upper] = topology_.joint[j];
            const Real back = get(J::left_back, j) + get(J::right_back, j), shear = get(J::force, j, 2);
            const Real f1 = get(J::force, j, 0) + get(J::left_back, j),
                       f2 = get(J::force, j, 1) + get(J::right_back, j);
            const Real sliding = get(J::next_sliding, j);
            impact = fnma(f1, get(J::left_rate, j) + get(J::next_left, j), impact);
            impact = fnma(f2, get(J::right_rate, j) + get(J::next_right, j), impact);
            const Real work = zero - shear * (get(J::sliding, j) + sliding);
            shear_work = shear_work + work;
            friction = fma(half, work, friction);
            const auto touches = get(J::left, j) + get(J::right, j) + back > zero;
            slip = slip + select(touches & (abs_of(get(J::slips, j)) > half), abs_of(sliding), zero);
            path = path + select(touches, abs_of(sliding), zero);
            const Planar<Real> du = next(upper), dl = next(lower);
            rocking = rocking + abs_of(du.theta - dl.theta);
        }
        put(OfRealization::dashpot_energy, impact);
        put(OfRealization::shear_energy, shear_work);
        put(OfRealization::friction_energy, friction);
        put(OfRealization::slip, slip);
        put(OfRealization::path, path);
        put(OfRealization::rocking_path, rocking);
    }

    /// After an impact the ends give back a part of the impulse with which they were compressed (Poisson): in the next
    /// step, by which time the compression has ended at all of them.
    STYLOBATE_INLINE void give_back() const
    {
        const Real zero(0.0);
        const auto struck = get(OfRigid::struck) > Real(0.5);
        for (int j = 0; j < topology_.beds(); ++j) {
            const Real part = get(J::expansion, j);
            const auto each = [&](J::Field back, int end) {
                const Real more = get(J::force, j, end) - get(J::before, j, end);
                put(back, j, select(struck, part * max_of(more, zero), zero));
            };
            each(J::left_back, 0);
            each(J::right_back, 1);
        }
    }

    STYLOBATE_INLINE void update(int step, bool audit) const
    {
        count_losses();
        if (expands())
            give_back();
        close_gaps();
        const Real gx = get(OfRealization::gravity_dx), gy = get(OfRealization::gravity_dy);
        const Real base = this->get(OfBase::second, step), share = get(OfRigid::share), half(0.5);
        const Real now(static_cast<NumberOf<Real>>(step));
        Real kinetic(0.0), potential(0.0), momentum(0.0), losses = get(OfRealization::dashpot_energy);
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Planar<Real> before = last(i), d = next(i), shift = free(i);
            const Real x = get(OfBlock::x, i), y = get(OfBlock::y, i), mass = get(OfBlock::mass, i);
            const Planar<Real> sum{before.x + d.x, before.y + d.y, before.theta + d.theta};
            momentum = fma(mass, sum.x, momentum);
            // until an end meets its face the forces of the step before go on: of these, gravity and the base are
            // counted
            const Real m = get(B::mass_per_dt2, i);
            const Real ex = share * (get(B::change_x, i) - (gx - base)), ey = share * (get(B::change_y, i) - gy);
            const Real turn_work = get(B::inertia_per_dt2, i) * share * get(B::change_theta, i);
            losses = fnma(m, fma(ex, sum.x, ey * sum.y), fnma(turn_work, sum.theta, losses));
            losses = fma(m, Real(2.0) * fma(gx, shift.x, gy * shift.y), losses);
            if (audit) {
                kinetic =
                    fma(mass, fma(d.x, d.x, d.y * d.y), fma(get(OfBlock::inertia, i), d.theta * d.theta, kinetic));
                potential = fnma(mass, fma(gx, fma(half, d.x, x), gy * fma(half, d.y, y)), potential);
            }
            put(B::change_x, i, d.x - before.x);
            put(B::change_y, i, d.y - before.y);
            put(B::change_theta, i, d.theta - before.theta);
            put(OfBlock::dx, i, d.x);
            put(OfBlock::dy, i, d.y);
            put(OfBlock::dtheta, i, d.theta);
            const Real new_y = add(OfRemainder::y, i, y, d.y + shift.y);
            const Real theta = add(OfRemainder::theta, i, get(OfBlock::theta, i), d.theta + shift.theta);
            put(OfBlock::x, i, add(OfRemainder::x, i, x, d.x + shift.x));
            put(OfBlock::y, i, new_y);
            put(OfBlock::theta, i, theta);
            turn(i, theta);
            const auto out = (abs_of(theta) > get(OfBlock::most_turn, i)) | (new_y < get(OfBlock::least_y, i));
            put(OfBlock::inside, i, select(out, get(OfBlock::inside, i), now));
        }
        put(OfRealization::dashpot_energy, losses);
        put(OfRealization::base_energy, fnma(base, momentum, get(OfRealization::base_energy)));
        put(OfRealization::base_step, base);
        put(OfRealization::peak_top, max_of(get(OfRealization::peak_top), abs_of(get(OfBlock::x, topology_.top))));
        put(OfRealization::top_path, get(OfRealization::top_path) + abs_of(get(OfBlock::dx, topology_.top)));
        if (audit) {
            put(OfRealization::kinetic, kinetic);
            put(OfRealization::potential, potential);
        }
    }
};

/// Runs steps `first` to `last - 1` of the chunk for all realizations of the bundle.
template <class Real, class Here>
void run_rigid(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle, int first, int last)
{
    RigidStepper<Real, Here>(topology, bundle).run(first, last);
}

} // namespace stylobate

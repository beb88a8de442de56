#pragma once
/// One step of the rigid form: blocks without compliance, whose faces may touch but not enter each other.
///
/// The unknowns are the forces of each bed: two normal ones at the ends of the faces' common part, as in the form
/// `two_corner`, and one along the face. What they do to the increments of the blocks is linear, so that the conditions
/// of all beds (an end that carries stays on its face; friction holds, or is at its limit) are one system of equations.
/// In a column it is block-tridiagonal. It is solved directly, and again with other ends that carry or slip, until
/// every condition holds. `THEORY.md` section 10 derives the formulas.
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
/// second-order terms, the direct solution with an active set in lockstep.

#include "kernels/overlap.hpp"
#include "kernels/rigid_equations.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

namespace detail {

/// Solutions of a round in which all conditions may change; those of the last round in which the first one that would
/// change does: without friction that ends (Murty, "Note on a Bard-type scheme for solving the complementarity
/// problem", Opsearch 11 (1974) 123).
inline constexpr int passes_of_all = 8, passes_of_one = 40;
/// Rounds of solutions, each of which is followed by a relaxation of what has not been found, and its sweeps.
inline constexpr int rounds = 3, relaxation_sweeps = 10;
/// Sweeps in frames, before each of which but the first the equations are solved, and the change of a rate at which
/// they end, as a part of what gravity adds in a step.
inline constexpr int frame_stages = 3;
constexpr int frame_sweeps(int stage)
{
    return stage == 0 ? 15 : stage == 1 ? 35 : 150;
}
template <class Number>
inline constexpr Number settled_rate = 1e-6;
template <>
inline constexpr float settled_rate<float> = 1e-4F;
/// Faces that are turned more than this against each other are no bed: cosine.
inline constexpr double least_bed_cosine = 0.2;
/// Rates below this part of what gravity adds in a step are rounding.
template <class Number>
inline constexpr Number still_rate = 1e-10;
template <>
inline constexpr float still_rate<float> = 2e-4F;

} // namespace detail

/// @tparam Here a type of the file that this is compiled for (`instantiate.hpp`)
template <class Real, class Here, class Layout = Packed>
class RigidStepper : RigidEquations<Real, Layout> {
    using Equations = RigidEquations<Real, Layout>;

public:
    STYLOBATE_INLINE RigidStepper(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle)
        : Equations(topology, bundle)
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
    using Equations::add;
    using Equations::bed;
    using Equations::free;
    using Equations::get;
    using Equations::is_free;
    using Equations::last;
    using Equations::load_three;
    using Equations::moved_by;
    using Equations::next;
    using Equations::part_late;
    using Equations::pull;
    using Equations::put;
    using Equations::put_next;
    using Equations::put_own_response;
    using Equations::put_response;
    using Equations::rates;
    using Equations::solve_equations;
    using Equations::store_three;
    using Equations::topology_;
    using B = OfRigidBlock;
    using typename Equations::Bed;
    using J = OfRigidJoint;
    using typename Equations::Pull;
    using typename Equations::Rule;
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
        const Real push = rest * (get(OfRealization::gravity_dx) - this->base(step));
        const Real fall = rest * get(OfRealization::gravity_dy);
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            put(B::free_x, i, get(OfBlock::dx, i) + fma(share, get(B::change_x, i), push));
            put(B::free_y, i, get(OfBlock::dy, i) + fma(share, get(B::change_y, i), fall));
            put(B::free_theta, i, fma(share, get(B::change_theta, i), get(OfBlock::dtheta, i)));
        }
        for (int i = 0; i < topology_.fixed; ++i)
            put_next(i, {Real(0.0), Real(0.0), Real(0.0)});
        if (expands())
            for (int j = 0; j < topology_.beds(); ++j) {
                const Bed b = bed(j);
                const Pull p = pull(b, {{get(J::left_back, j), get(J::right_back, j), Real(0.0)}});
                if (is_free(b.lower))
                    put_free(b.lower, moved_by(b.lower, free(b.lower), p.lower));
                put_free(b.upper, moved_by(b.upper, free(b.upper), p.upper));
            }
    }
    STYLOBATE_INLINE bool expands() const { return any(get(OfRigid::expands) > Real(0.5)); }
    STYLOBATE_INLINE void put_free(int i, const Planar<Real>& d) const
    {
        put(B::free_x, i, d.x);
        put(B::free_y, i, d.y);
        put(B::free_theta, i, d.theta);
    }
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

    // ---- which ends carry ----

    STYLOBATE_INLINE void solve() const
    {
        const Real half(0.5);
        for (int j = 0; j < topology_.beds(); ++j)
            store_three(J::before, j, load_three(J::force, j));
        if (!topology_.stack) {
            solve_frame();
            return;
        }
        for (int round = 0; round < detail::rounds; ++round) {
            const Real open = find_contacts(round + 1 == detail::rounds);
            if (!any(open > half))
                return;
            relax(open > half, detail::relaxation_sweeps, false);
        }
    }

    /// Of frames: friction in their loops admits solutions with large forces that no motion has caused. So the
    /// relaxation comes first, which goes on from the forces of the last step; where it has not ended, the equations
    /// are solved for the ends that it has found, and the solution is taken if nothing moves faster with it.
    STYLOBATE_INLINE void solve_frame() const
    {
        const Real half(0.5), zero(0.0), one(1.0);
        auto busy = half > zero;
        Real solved(0.0); // 1 where the equations' solution is taken
        for (int stage = 0; stage < detail::frame_stages; ++stage) {
            busy = relax(busy, detail::frame_sweeps(stage), stage > 0);
            if (!any(busy))
                break;
            keep_relaxed();
            const Real most = kinetic() + slow();
            const Real open = find_contacts(false);
            const auto taken = busy & (open < half) & (kinetic() < most);
            put_relaxed(taken);
            apply_forces();
            solved = select(taken, one, solved);
            busy = busy & (solved < half);
        }
        for (int j = 0; j < topology_.beds(); ++j)
            for (int k = 0; k < 3; ++k)
                put(J::closing, j, zero, k);
        if (!any(solved > half))
            return apply_forces();
        // what closes the gaps of those, which the others' solutions have overwritten
        keep_relaxed();
        solve_equations();
        put_relaxed(solved > half);
        for (int j = 0; j < topology_.beds(); ++j)
            for (int k = 0; k < 3; ++k)
                put(J::closing, j, select(solved > half, get(J::closing, j, k), zero), k);
        apply_forces();
    }
    /// Keeps forces and ends, and puts them back but for some realizations.
    STYLOBATE_INLINE void keep_relaxed() const
    {
        for (int j = 0; j < topology_.beds(); ++j)
            for (int k = 0; k < 6; ++k)
                put(J::relaxed, j, k < 3 ? get(J::force, j, k) : get(flag(k - 3), j), k);
    }
    template <class Mask>
    STYLOBATE_INLINE void put_relaxed(Mask but_for) const
    {
        for (int j = 0; j < topology_.beds(); ++j)
            for (int k = 0; k < 6; ++k) {
                const Real relaxed = get(J::relaxed, j, k);
                if (k < 3)
                    put(J::force, j, select(but_for, get(J::force, j, k), relaxed), k);
                else
                    put(flag(k - 3), j, select(but_for, get(flag(k - 3), j), relaxed));
            }
    }
    STYLOBATE_INLINE static J::Field flag(int k) { return k == 0 ? J::left : k == 1 ? J::right : J::slips; }
    /// Of the increments with the forces found, twice.
    STYLOBATE_INLINE Real kinetic() const
    {
        Real sum(0.0);
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Planar<Real> d = next(i);
            sum = fma(get(OfBlock::mass, i), fma(d.x, d.x, d.y * d.y),
                      fma(get(OfBlock::inertia, i), d.theta * d.theta, sum));
        }
        return sum;
    }
    /// The same of blocks that move by 1e-4 of what gravity adds in a step.
    STYLOBATE_INLINE Real slow() const
    {
        const Real rate = get(OfRealization::gravity_dy) * Real(NumberOf<Real>(1e-4));
        Real sum(0.0);
        for (int i = topology_.fixed; i < topology_.blocks; ++i)
            sum = fma(get(OfBlock::mass, i), rate * rate, sum);
        return sum;
    }

    /// Slower ones are rounding: negative.
    STYLOBATE_INLINE Real still() const
    {
        return Real(0.0) - abs_of(get(OfRealization::gravity_dy)) * Real(detail::still_rate<NumberOf<Real>>);
    }

    /// Solutions with other ends that carry, until none contradicts itself.
    /// @param patient goes on with one condition at a time   @return 1 where they have not been found
    STYLOBATE_INLINE Real find_contacts(bool patient) const
    {
        const Real zero(0.0), half(0.5), one(1.0);
        const Real still = this->still();
        Real open(1.0);
        for (int pass = 0; pass < detail::passes_of_all + (patient ? detail::passes_of_one : 0); ++pass) {
            solve_equations();
            apply_forces();
            const bool one_at_a_time = pass >= detail::passes_of_all;
            open = zero;
            for (int j = 0; j < topology_.beds(); ++j) {
                const auto may = one_at_a_time ? open < half : zero < one;
                open = select(reconsider(j, still, may, one_at_a_time), one, open);
            }
            if (!any(open > half))
                break;
        }
        return open;
    }

    /// The forces found, and the increments with them.
    STYLOBATE_INLINE void apply_forces() const
    {
        for (int i = topology_.fixed; i < topology_.blocks; ++i)
            put_next(i, free(i));
        for (int j = 0; j < topology_.beds(); ++j) {
            const Bed b = bed(j);
            const Pull p = pull(b, load_three(J::force, j));
            if (is_free(b.lower))
                put_next(b.lower, moved_by(b.lower, next(b.lower), p.lower));
            put_next(b.upper, moved_by(b.upper, next(b.upper), p.upper));
        }
        for (int j = 0; j < topology_.beds(); ++j)
            put_next_rates(j);
    }
    STYLOBATE_INLINE void put_next_rates(int j) const
    {
        const Bed b = bed(j);
        const V rate = rates(b, next(b.lower), next(b.upper));
        put(J::next_left, j, rate.v[0]);
        put(J::next_right, j, rate.v[1]);
        put(J::next_sliding, j, rate.v[2]);
    }

    /// Changes what contradicts itself: an end that pulls, an open one that enters, friction beyond its limit or along
    /// the sliding.
    /// @return where something has changed
    template <class Mask>
    STYLOBATE_INLINE Mask reconsider(int j, Real still, Mask may, bool one_at_a_time) const
    {
        const Real zero(0.0), half(0.5), one(1.0);
        const Real f1 = get(J::force, j, 0), f2 = get(J::force, j, 1), shear = get(J::force, j, 2);
        const Real left = get(J::left, j), right = get(J::right, j), slips = get(J::slips, j);
        // A fast end that `strike` has found to be late does not meet its face in this step, but in the next one: it
        // would meet it without a time of impact.
        const Real fast = Real(2.0) * get(OfRealization::gravity_dy);
        const auto enters = [&](J::Field next_rate, J::Field bend, J::Field last_rate, J::Field gap) {
            const Real rate = get(next_rate, j) + get(bend, j), before = get(last_rate, j);
            const Real reach = select(before < fast, max_of(rate, before), rate);
            return (get(J::usable, j) > half) & (rate < still) & (get(gap, j) < zero - half * reach);
        };
        const Real meets_left = select(enters(J::next_left, J::left_bend, J::left_rate, J::left_gap), one, zero);
        const Real meets_right = select(enters(J::next_right, J::right_bend, J::right_rate, J::right_gap), one, zero);
        const Real new_left = select(left > half, select(f1 > zero, one, zero), meets_left);
        Real new_right = select(right > half, select(f2 > zero, one, zero), meets_right);
        const Real back = get(J::left_back, j) + get(J::right_back, j);
        const Real limit = get(OfJoint::mu, j) * (f1 + f2 + back);
        const Real along = get(J::next_sliding, j) * slips;
        const Real slipping = select(shear > zero, one, zero - one);
        Real new_slips = select(abs_of(slips) > half, select(along > zero - still, zero, slips),
                                select(abs_of(shear) > limit, slipping, zero));
        new_slips = select(new_left + new_right + back > zero, new_slips, zero); // what has parted holds when it meets
        new_slips = select(left + right + back > zero, new_slips, zero);
        if (one_at_a_time) {
            new_right = select(new_left != left, right, new_right);
            new_slips = select((new_left != left) | (new_right != right), slips, new_slips);
        }
        const auto changes = may & ((new_left != left) | (new_right != right) | (new_slips != slips));
        put(J::left, j, select(changes, new_left, left));
        put(J::right, j, select(changes, new_right, right));
        put(J::slips, j, select(changes, new_slips, slips));
        return changes;
    }

    /// Projected Gauss and Seidel, bed by bed, up and down in turn, from the forces of the last step: of frames, and of
    /// the stacks whose contacts have not been found. A realization ends when no rate changes any more. Not inlined, as
    /// it is rare in stacks.
    /// @return where it has not ended
    template <class Mask>
    STYLOBATE_APART Mask relax(Mask which, int sweeps, bool goes_on) const
    {
        const Real zero(0.0);
        if (!goes_on)
            for (int j = 0; j < topology_.beds(); ++j)
                put_first_forces(j, which);
        apply_forces();
        const Real settled = abs_of(get(OfRealization::gravity_dy)) * Real(detail::settled_rate<NumberOf<Real>>);
        Mask busy = which;
        for (int sweep = 0; sweep < sweeps && any(busy); ++sweep) {
            Real most(0.0);
            for (int i = 0; i < topology_.beds(); ++i)
                most = max_of(most, relax_bed(sweep % 2 == 0 ? i : topology_.beds() - 1 - i, busy));
            busy = busy & (most > settled);
        }
        for (int j = 0; j < topology_.beds(); ++j) {
            put_next_rates(j);
            for (int k = 0; k < 2; ++k)
                put(J::closing, j, select(which, zero, get(J::closing, j, k)), k);
        }
        return busy;
    }
    /// What a relaxation begins with: in frames the forces of the last step, in stacks what may be of the solution that
    /// contradicts itself.
    template <class Mask>
    STYLOBATE_INLINE void put_first_forces(int j, Mask which) const
    {
        const Real zero(0.0);
        const V solved = load_three(J::force, j);
        V first = topology_.stack ? solved : load_three(J::before, j);
        first.v[0] = select(may_carry(j, J::left_gap), max_of(first.v[0], zero), zero);
        first.v[1] = select(may_carry(j, J::right_gap), max_of(first.v[1], zero), zero);
        const Real limit = friction_limit(j, first);
        first.v[2] = clamp(first.v[2], zero - limit, limit);
        for (int k = 0; k < 3; ++k)
            put(J::force, j, select(which, first.v[k], solved.v[k]), k);
    }
    STYLOBATE_INLINE auto may_carry(int j, J::Field gap) const
    {
        const Real reach =
            abs_of(get(OfRealization::gravity_dy)) + abs_of(get(J::left_rate, j)) + abs_of(get(J::right_rate, j));
        return (get(J::usable, j) > Real(0.5)) & (get(gap, j) < reach);
    }
    STYLOBATE_INLINE Real friction_limit(int j, const V& force) const
    {
        return get(OfJoint::mu, j) * (force.v[0] + force.v[1] + get(J::left_back, j) + get(J::right_back, j));
    }
    /// @return largest change of a rate
    template <class Mask>
    STYLOBATE_INLINE Real relax_bed(int j, Mask which) const
    {
        const Real zero(0.0), one(1.0);
        const Bed b = bed(j);
        const V before = load_three(J::force, j);
        const V from = rates(b, free(b.lower), free(b.upper));
        V force = before;
        Real most(0.0);
        const auto own = [&](int row) { return get(J::own, j, row == 0 ? 0 : row == 1 ? 3 : 5); };
        const auto wanted = [&](int row, Real goal) {
            const V rate = rates(b, next(b.lower), next(b.upper));
            return force.v[row] + (goal - (rate.v[row] - from.v[row])) / select(own(row) > zero, own(row), one);
        };
        const auto take = [&](int row, Real now) {
            V change{{zero, zero, zero}};
            change.v[row] = now - force.v[row];
            most = max_of(most, abs_of(change.v[row]) * own(row));
            const Pull p = pull(b, change);
            if (is_free(b.lower))
                put_chosen(which, b.lower, moved_by(b.lower, next(b.lower), p.lower));
            put_chosen(which, b.upper, moved_by(b.upper, next(b.upper), p.upper));
            force.v[row] = now;
        };
        take(0, select(may_carry(j, J::left_gap), max_of(wanted(0, get(J::left_goal, j)), zero), zero));
        take(1, select(may_carry(j, J::right_gap), max_of(wanted(1, get(J::right_goal, j)), zero), zero));
        const Real limit = friction_limit(j, force);
        take(2, clamp(wanted(2, get(J::sliding_goal, j)), zero - limit, limit));
        for (int k = 0; k < 3; ++k)
            put(J::force, j, select(which, force.v[k], before.v[k]), k);
        put(J::left, j, select(which, select(force.v[0] > zero, one, zero), get(J::left, j)));
        put(J::right, j, select(which, select(force.v[1] > zero, one, zero), get(J::right, j)));
        const Real way = select(force.v[2] > zero, one, zero - one);
        const auto slips = (abs_of(force.v[2]) >= limit) & (limit > zero);
        put(J::slips, j, select(which, select(slips, way, zero), get(J::slips, j)));
        return most;
    }
    template <class Mask>
    STYLOBATE_INLINE void put_chosen(Mask which, int i, const Planar<Real>& d) const
    {
        const Planar<Real> old = next(i);
        put_next(i, {select(which, d.x, old.x), select(which, d.y, old.y), select(which, d.theta, old.theta)});
    }

    // ---- the new state ----

    /// Displacements beside the increments, into the rows of the free ones: until an end meets its face the blocks go
    /// on with their old increments; what is left of the gaps of the ends that carry is closed.
    STYLOBATE_INLINE void close_gaps() const
    {
        const Real late = part_late();
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Planar<Real> before = last(i), after = next(i);
            put(B::free_x, i, late * (before.x - after.x));
            put(B::free_y, i, late * (before.y - after.y));
            put(B::free_theta, i, late * (before.theta - after.theta));
        }
        for (int j = 0; j < topology_.beds(); ++j) {
            const Bed b = bed(j);
            const Pull p = pull(b, load_three(J::closing, j));
            if (is_free(b.lower))
                put_free(b.lower, moved_by(b.lower, free(b.lower), p.lower));
            put_free(b.upper, moved_by(b.upper, free(b.upper), p.upper));
        }
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
        const Real base = this->base(step), share = get(OfRigid::share), half(0.5);
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

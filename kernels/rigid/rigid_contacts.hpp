#pragma once
/// Which ends of the beds carry and which slip, and the forces with that: the solution of the rigid form's conditions.
///
/// In a stack the equations are block-tridiagonal. They are solved directly, and again with other ends that carry or
/// slip, until every condition holds (own: in lockstep). In a frame a relaxation comes first. `THEORY.md` section 10
/// says why.

#include "kernels/rigid/rigid_equations.hpp"

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
/// Rates below this part of what gravity adds in a step are rounding.
template <class Number>
inline constexpr Number still_rate = 1e-10;
template <>
inline constexpr float still_rate<float> = 2e-4F;

} // namespace detail

/// @tparam Here a type of the file that this is compiled for (`instantiate.hpp`): the relaxation is a function of its
/// own
template <class Real, class Here, class Layout>
class RigidContacts : protected RigidEquations<Real, Layout> {
protected:
    using Equations = RigidEquations<Real, Layout>;
    using Equations::bed;
    using Equations::free;
    using Equations::get;
    using Equations::is_free;
    using Equations::load_three;
    using Equations::moved_by;
    using Equations::next;
    using Equations::pull;
    using Equations::push_next;
    using Equations::put;
    using Equations::put_next;
    using Equations::rates;
    using Equations::Equations;
    using Equations::solve_equations;
    using Equations::store_three;
    using Equations::topology_;
    using typename Equations::Bed;
    using J = OfRigidJoint;
    using typename Equations::Pull;
    using V = Vector3<Real>;

    /// The forces of the beds, and the increments with them.
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

    /// Slower ones are rounding: negative.
    STYLOBATE_INLINE Real still() const
    {
        return Real(0.0) - abs_of(get(OfRealization::gravity_dy)) * Real(detail::still_rate<NumberOf<Real>>);
    }

private:
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
        for (int j = 0; j < topology_.beds(); ++j)
            push_next(j, load_three(J::force, j));
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
};

} // namespace stylobate

#pragma once
/// Which ends of the beds carry and which slip, and the forces with that: the solution of the rigid form's conditions.
///
/// In a stack the equations are block-tridiagonal. They are solved directly, and again with other ends that carry or
/// slip, until every condition holds (own: in lockstep). In a frame friction is held to bounds first. `THEORY.md`
/// section 10 gives the reason.

#include "kernels/planar/rigid/rigid_equations.hpp"

#include <utility>

namespace stylobate {

namespace detail {

/// Solutions of a round in which all conditions may change; those of the last round in which the first one that would
/// change does: without friction that ends (Murty, "Note on a Bard-type scheme for solving the complementarity
/// problem", Opsearch 11 (1974) 123).
inline constexpr int passes_of_all = 8, passes_of_one = 40;
/// Rounds of solutions, each of which is followed by a relaxation of what has not been found, and its sweeps.
inline constexpr int rounds = 3, relaxation_sweeps = 10;
/// In frames: bounds of the friction, one after the other, and sweeps where that has not found the contacts.
inline constexpr int frame_rounds = 8, frame_sweeps = 150;
/// A relaxation ends when no rate changes by more than this part of what gravity adds in a step.
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
    using Equations::Equations;
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
    using Equations::solve_equations;
    using Equations::store_three;
    using Equations::topology_;
    using typename Equations::Bed;
    using J = OfRigidJoint;
    using typename Equations::Pull;
    using V = Vector3<Real>;
    using Mask = decltype(std::declval<Real>() < std::declval<Real>());

    /// The forces of the beds, and the increments with them.
    STYLOBATE_INLINE void solve() const
    {
        for (int j = 0; j < topology_.beds(); ++j)
            store_three(J::before, j, load_three(J::force, j));
        if (!topology_.stack) {
            solve_frame();
            return;
        }
        for (int round = 0; round < detail::rounds; ++round) {
            const Mask open = find_contacts(round + 1 == detail::rounds);
            if (!any(open))
                return;
            relax(open, detail::relaxation_sweeps);
        }
    }

    /// Slower rates are rounding, or in frames what the softness of the equations makes: negative.
    STYLOBATE_INLINE Real still() const
    {
        using Number = NumberOf<Real>;
        const Number rate = topology_.stack ? detail::still_rate<Number> : 10 * detail::softness<Number>;
        return Real(0.0) - abs_of(get(OfRealization::gravity_dy)) * Real(rate);
    }

private:
    /// Of frames: friction in their loops admits false solutions, with large forces that no motion has caused. Where
    /// nothing slips there are none, and the first solution is taken if it contradicts nothing. Else friction is held
    /// to a bound, the limit mu N of the last step's forces, and then of the forces found with the bound before. With
    /// the ends that carry and slip under a bound the equations are solved for friction mu N itself. Their solution is
    /// taken if it contradicts nothing and the bounds lead to it. What is not found so is relaxed.
    STYLOBATE_INLINE void solve_frame() const
    {
        const Real half(0.5), zero(0.0);
        const Mask none = half < zero;
        couple_friction(!none);
        Mask busy = solve_once(none, false);
        for (int j = 0; j < topology_.beds(); ++j)
            busy = busy | (abs_of(get(J::slips, j)) > half);
        for (int round = 0; round < detail::frame_rounds && any(busy); ++round) {
            for (int j = 0; j < topology_.beds(); ++j)
                put_chosen(busy, J::bound, j, limit_of(j, load_three(round == 0 ? J::before : J::force, j)));
            bound_friction(busy);
            Mask wrong = busy;
            for (int pass = 0; pass < detail::passes_of_all + detail::passes_of_one && any(wrong); ++pass)
                wrong = wrong & solve_once(wrong, pass >= detail::passes_of_all);
            for (int j = 0; j < topology_.beds(); ++j)
                put_chosen(busy, J::after_bound, j, limit_of(j, load_three(J::force, j)));
            couple_friction(busy);
            const Mask contradicts = solve_once(none, false);
            busy = busy & (contradicts | !comes_nearer());
            if (!any(busy))
                return;
            bound_friction(busy);
            solve_once(none, false);
        }
        if (any(busy))
            relax(busy, detail::frame_sweeps);
    }
    /// Friction at its limit is mu N.
    STYLOBATE_INLINE void couple_friction(Mask which) const
    {
        for (int j = 0; j < topology_.beds(); ++j) {
            const Real mu = get(OfJoint::mu, j), back = get(J::left_back, j) + get(J::right_back, j);
            put_chosen(which, J::slope, j, mu);
            put_chosen(which, J::rest, j, mu * back);
            const auto parted = get(J::left, j) + get(J::right, j) + back <= Real(0.0);
            put_chosen(which & parted, J::slips, j, Real(0.0));
        }
    }
    /// Friction at its limit is that of the bound.
    STYLOBATE_INLINE void bound_friction(Mask which) const
    {
        for (int j = 0; j < topology_.beds(); ++j) {
            put_chosen(which, J::slope, j, Real(0.0));
            put_chosen(which, J::rest, j, get(J::bound, j));
        }
    }
    /// Whether the limits of the forces with a bound are nearer to those of the solution than the bound was. Else the
    /// solution is none that a sequence of bounds comes to: friction holds itself there.
    STYLOBATE_INLINE Mask comes_nearer() const
    {
        const Real zero(0.0), half(0.5);
        Real from(0.0), to(0.0);
        for (int j = 0; j < topology_.beds(); ++j) {
            const Real limit = limit_of(j, load_three(J::force, j));
            const Real per_force = select(abs_of(get(J::slips, j)) > half, get(J::own, j, 5), zero);
            from = fma(per_force, abs_of(limit - get(J::bound, j)), from);
            to = fma(per_force, abs_of(limit - get(J::after_bound, j)), to);
        }
        return (to < from) | (to < settled());
    }
    STYLOBATE_INLINE void put_chosen(Mask which, J::Field f, int j, Real value) const
    {
        put(f, j, select(which, value, get(f, j)));
    }

    /// Not inlined: frames need it in several places.
    STYLOBATE_APART Mask solve_once(Mask change, bool one_at_a_time) const { return attempt(change, one_at_a_time); }

    /// Solutions with other ends that carry, until none contradicts itself.
    /// @param patient goes on with one condition at a time   @return where they have not been found
    STYLOBATE_INLINE Mask find_contacts(bool patient) const
    {
        const Real zero(0.0), one(1.0);
        Mask open = zero < one;
        for (int pass = 0; pass < detail::passes_of_all + (patient ? detail::passes_of_one : 0); ++pass) {
            open = attempt(zero < one, pass >= detail::passes_of_all);
            if (!any(open))
                break;
        }
        return open;
    }
    /// One solution.
    /// @param change where conditions that contradict themselves are changed
    /// @return where there are some
    STYLOBATE_INLINE Mask attempt(Mask change, bool one_at_a_time) const
    {
        const Real half(0.5), one(1.0);
        const Real still = this->still();
        solve_equations();
        apply_forces();
        Real open(0.0);
        for (int j = 0; j < topology_.beds(); ++j) {
            const Mask may = one_at_a_time ? change & (open < half) : change;
            open = select(reconsider(j, still, may, one_at_a_time), one, open);
        }
        return open > half;
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
    /// @param may where it may   @return where something contradicts itself, or would
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
        const auto rule = this->rule(j);
        Real limit = rule.slope * (f1 + f2) + rule.rest, sliding = get(J::next_sliding, j);
        if (!topology_.stack) { // what yields: else friction that just holds would change on and on
            const Real softness(detail::softness<NumberOf<Real>>);
            limit = fma(softness, limit, limit);
            sliding = fma(softness * get(J::own, j, 5), shear, sliding + get(J::bend_sliding, j));
        }
        const Real along = sliding * slips;
        const Real slipping = select(shear > zero, one, zero - one);
        Real new_slips = select(abs_of(slips) > half, select(along > zero - still, zero, slips),
                                select(abs_of(shear) > limit, slipping, zero));
        const auto bounded = rule.slope <= zero;
        new_slips =
            select((new_left + new_right + back > zero) | bounded, new_slips, zero); // parted: holds when it meets
        new_slips = select((left + right + back > zero) | bounded, new_slips, zero);
        if (one_at_a_time) {
            new_right = select(new_left != left, right, new_right);
            new_slips = select((new_left != left) | (new_right != right), slips, new_slips);
        }
        const auto wrong = (new_left != left) | (new_right != right) | (new_slips != slips);
        const auto changes = may & wrong;
        put(J::left, j, select(changes, new_left, left));
        put(J::right, j, select(changes, new_right, right));
        put(J::slips, j, select(changes, new_slips, slips));
        return wrong;
    }

    /// Projected Gauss and Seidel, bed by bed, up and down in turn, of what has not been found. A realization ends when
    /// no rate changes any more. Not inlined, as it is rare.
    STYLOBATE_APART void relax(Mask which, int sweeps) const
    {
        const Real zero(0.0);
        for (int j = 0; j < topology_.beds(); ++j)
            put_first_forces(j, which);
        apply_forces();
        Mask busy = which;
        for (int sweep = 0; sweep < sweeps && any(busy); ++sweep) {
            Real most(0.0);
            for (int i = 0; i < topology_.beds(); ++i)
                most = max_of(most, relax_bed(sweep % 2 == 0 ? i : topology_.beds() - 1 - i, busy));
            busy = busy & (most > settled());
        }
        for (int j = 0; j < topology_.beds(); ++j) {
            put_next_rates(j);
            for (int k = 0; k < 3; ++k)
                put(J::closing, j, select(which, zero, get(J::closing, j, k)), k);
        }
    }
    STYLOBATE_INLINE Real settled() const
    {
        return abs_of(get(OfRealization::gravity_dy)) * Real(detail::settled_rate<NumberOf<Real>>);
    }
    STYLOBATE_INLINE void put_first_forces(int j, Mask which) const
    {
        const Real zero(0.0);
        const V solved = load_three(J::force, j);
        V first = topology_.stack ? solved : load_three(J::before, j);
        first.v[0] = select(may_carry(j, J::left_gap), max_of(first.v[0], zero), zero);
        first.v[1] = select(may_carry(j, J::right_gap), max_of(first.v[1], zero), zero);
        const Real limit = limit_of(j, first);
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
    /// mu N.
    STYLOBATE_INLINE Real limit_of(int j, const V& force) const
    {
        return get(OfJoint::mu, j) * (force.v[0] + force.v[1] + get(J::left_back, j) + get(J::right_back, j));
    }
    /// @return largest change of a rate
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
                put_next_chosen(which, b.lower, moved_by(b.lower, next(b.lower), p.lower));
            put_next_chosen(which, b.upper, moved_by(b.upper, next(b.upper), p.upper));
            force.v[row] = now;
        };
        take(0, select(may_carry(j, J::left_gap), max_of(wanted(0, get(J::left_goal, j)), zero), zero));
        take(1, select(may_carry(j, J::right_gap), max_of(wanted(1, get(J::right_goal, j)), zero), zero));
        const Real limit = limit_of(j, force);
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
    STYLOBATE_INLINE void put_next_chosen(Mask which, int i, const Planar<Real>& d) const
    {
        const Planar<Real> old = next(i);
        put_next(i, {select(which, d.x, old.x), select(which, d.y, old.y), select(which, d.theta, old.theta)});
    }
};

} // namespace stylobate

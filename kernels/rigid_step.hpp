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

#include "kernels/matrix3.hpp"
#include "kernels/overlap.hpp"
#include "kernels/rows.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

namespace detail {

/// Solutions of a step in which all beds may change; as many more in which the lowest of those that would change does.
inline constexpr int passes_of_all = 8, passes_of_one = 12;
/// Sweeps of the relaxation for what is then left, and how often both are tried.
inline constexpr int relaxation_sweeps = 10, rounds = 3;
/// Faces that are turned more than this against each other are no bed: cosine.
inline constexpr double least_bed_cosine = 0.2;
/// Of rigid columns under an epistyle the forces are not unique. The diagonal of the system is larger by this part, as
/// if every bed yielded by so much of what its own blocks would: that makes them so.
inline constexpr double softness = 1e-9;
/// Rates below this part of what gravity adds in a step are rounding.
template <class Number>
inline constexpr double still_rate = 1e-10;
template <>
inline constexpr double still_rate<float> = 2e-4;

} // namespace detail

/// @tparam Here a type of the file that this is compiled for (`instantiate.hpp`)
template <class Real, class Here, class Layout = Packed>
class RigidStepper : Rows<Real, Layout> {
public:
    STYLOBATE_INLINE RigidStepper(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle)
        : Rows<Real, Layout>(bundle), topology_(topology)
    {
    }

    /// Steps `first` to `last - 1` of the table of base motion; the energies are those of the last one.
    STYLOBATE_INLINE void run(int first, int last) const
    {
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            turn(i, get(OfBlock::theta, i));
            if (first == 0)
                put(OfBlock::inside, i, Real(-1.0));
        }
        for (int step = first; step < last; ++step) {
            for (int j = 0; j < topology_.beds(); ++j)
                geometry(j);
            strike();
            fall_freely(step);
            for (int j = 0; j < topology_.beds(); ++j)
                put_own_response(j);
            for (int e = 0; e < topology_.rigid_edges; ++e)
                put_response(e);
            solve();
            update(step, step + 1 == last);
        }
    }

private:
    using J = OfRigidJoint;
    using B = OfRigidBlock;
    using E = OfRigidEdge;
    using M = Matrix3<Real>;
    using V = Vector3<Real>;
    using Rows<Real, Layout>::get;
    using Rows<Real, Layout>::put;

    STYLOBATE_INLINE void turn(int i, Real theta) const
    {
        const Angle<Real> a = angle(theta);
        put(OfBlock::sine, i, a.sine);
        put(OfBlock::versine, i, a.versine);
    }

    // ---- what a bed is ----

    /// The rows of a bed: a displacement of its blocks as changes of the two gaps, and as sliding of the upper one.
    struct Bed {
        int lower, upper;
        Real sine, cosine; ///< of the lower block
        Real left_x, right_x, left_arm, right_arm, upper_arm, lower_arm;
    };
    STYLOBATE_INLINE Bed bed(int j) const
    {
        const auto [lower, upper] = topology_.joint[j];
        return {lower,
                upper,
                get(OfBlock::sine, lower),
                Real(1.0) - get(OfBlock::versine, lower),
                get(J::left_x, j),
                get(J::right_x, j),
                get(J::left_arm, j),
                get(J::right_arm, j),
                get(J::upper_arm, j),
                get(OfBlock::half_height, lower)};
    }
    STYLOBATE_INLINE static V rates(const Bed& b, const Planar<Real>& lower, const Planar<Real>& upper)
    {
        const Real x = upper.x - lower.x, y = upper.y - lower.y;
        const Real away = fms(y, b.cosine, x * b.sine), along = fma(x, b.cosine, y * b.sine);
        return {fma(b.left_arm, upper.theta, fnma(b.left_x, lower.theta, away)),
                fma(b.right_arm, upper.theta, fnma(b.right_x, lower.theta, away)),
                fma(b.upper_arm, upper.theta, fma(b.lower_arm, lower.theta, along))};
    }
    struct Pull {
        Planar<Real> lower, upper;
    };
    /// Forces and moments of a bed's forces on its blocks.
    STYLOBATE_INLINE static Pull pull(const Bed& b, const V& force)
    {
        const Real normal = force.v[0] + force.v[1], shear = force.v[2], zero(0.0);
        const Real x = fms(shear, b.cosine, normal * b.sine), y = fma(shear, b.sine, normal * b.cosine);
        const Real on_lower = fms(b.lower_arm, shear, fma(b.left_x, force.v[0], b.right_x * force.v[1]));
        const Real on_upper = fma(b.upper_arm, shear, fma(b.left_arm, force.v[0], b.right_arm * force.v[1]));
        return {{zero - x, zero - y, on_lower}, {x, y, on_upper}};
    }
    STYLOBATE_INLINE Planar<Real> last(int i) const
    {
        return {get(OfBlock::dx, i), get(OfBlock::dy, i), get(OfBlock::dtheta, i)};
    }
    STYLOBATE_INLINE Planar<Real> next(int i) const
    {
        return {get(B::next_x, i), get(B::next_y, i), get(B::next_theta, i)};
    }
    STYLOBATE_INLINE void put_next(int i, const Planar<Real>& d) const
    {
        put(B::next_x, i, d.x);
        put(B::next_y, i, d.y);
        put(B::next_theta, i, d.theta);
    }
    STYLOBATE_INLINE Planar<Real> moved_by(int i, const Planar<Real>& d, const Planar<Real>& force) const
    {
        const Real per_mass = get(OfBlock::dt2_per_mass, i);
        return {fma(per_mass, force.x, d.x), fma(per_mass, force.y, d.y),
                fma(get(OfBlock::dt2_per_inertia, i), force.theta, d.theta)};
    }
    STYLOBATE_INLINE bool is_free(int i) const { return i >= topology_.fixed; }

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

        const Bed b = bed(j);
        const Planar<Real> dl = last(lower), du = last(upper);
        const V rate = rates(b, dl, du);
        put(J::left_rate, j, rate.v[0]);
        put(J::right_rate, j, rate.v[1]);
        put(J::sliding, j, rate.v[2]);
        const Real wl = dl.theta * dl.theta, wu = du.theta * du.theta;
        put(J::bend, j, half * fma(wu, b.upper_arm, fma(wl, b.lower_arm, zero - Real(2.0) * dl.theta * rate.v[2])));
        const auto nearer = left_gap < right_gap;
        put(J::bend_sliding, j,
            half * fms(wl, select(nearer, left, right), wu * select(nearer, b.left_arm, b.right_arm)));
        const Real turned = abs_of(get(OfBlock::theta, upper) - get(OfBlock::theta, lower));
        put(OfJoint::max_rotation, j, max_of(get(OfJoint::max_rotation, j), turned));
    }

    /// An open end that closes by more than half a step's path meets its face within this step's velocities. Its blocks
    /// go on until then as in the step before, and only after that as the forces of this step have it: what decides the
    /// loss at an impact. The fastest end of the structure counts, and none right after another one.
    STYLOBATE_INLINE void strike() const
    {
        const Real zero(0.0), half(0.5), one(1.0);
        Real fastest(0.0), its_gap(0.0);
        for (int j = 0; j < topology_.beds(); ++j) {
            const auto usable = get(J::usable, j) > half;
            const auto look_at = [&](J::Field carries, J::Field rates, J::Field gaps) {
                const Real rate = get(rates, j), gap = get(gaps, j);
                // (`fastest` is never above 0)
                const auto hits = usable & (get(carries, j) < half) & (gap < zero - half * rate) & (rate < fastest);
                its_gap = select(hits, gap, its_gap);
                fastest = select(hits, rate, fastest);
            };
            look_at(J::left, J::left_rate, J::left_gap);
            look_at(J::right, J::right_rate, J::right_gap);
        }
        const auto struck = (get(OfRigid::struck) < half) & (fastest < zero);
        const Real when = clamp(half - its_gap / select(struck, fastest, one), zero, one);
        put(OfRigid::struck, select(struck, one, zero));
        put(OfRigid::share, select(struck, when, zero));
    }

    /// The increments without the forces of the beds, and what these have to achieve.
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
        const Real zero(0.0);
        const Real least = get(OfRealization::gravity_dy); // slower ends do not rebound: they would not leave
        for (int j = 0; j < topology_.beds(); ++j) {
            const Bed b = bed(j);
            const V rate = rates(b, free(b.lower), free(b.upper));
            const Real bend = get(J::bend, j), restitution = get(J::restitution, j);
            const auto rebound = [&](J::Field carries, J::Field last_rate) {
                const Real closing = get(last_rate, j);
                return select((get(carries, j) < Real(0.5)) & (closing < least), restitution * closing, zero);
            };
            put(J::left_goal, j, zero - rate.v[0] - bend - rebound(J::left, J::left_rate));
            put(J::right_goal, j, zero - rate.v[1] - bend - rebound(J::right, J::right_rate));
            put(J::sliding_goal, j, zero - rate.v[2] - get(J::bend_sliding, j));
        }
    }
    STYLOBATE_INLINE Planar<Real> free(int i) const
    {
        if (!is_free(i))
            return {Real(0.0), Real(0.0), Real(0.0)};
        return {get(B::free_x, i), get(B::free_y, i), get(B::free_theta, i)};
    }

    // ---- responses ----

    STYLOBATE_INLINE void put_own_response(int j) const
    {
        const Bed b = bed(j);
        const Real zero(0.0);
        Real per_mass(0.0), lower_inertia(0.0);
        if (is_free(b.lower)) {
            per_mass = get(OfBlock::dt2_per_mass, b.lower);
            lower_inertia = get(OfBlock::dt2_per_inertia, b.lower);
        }
        per_mass = per_mass + get(OfBlock::dt2_per_mass, b.upper);
        const Real upper_inertia = get(OfBlock::dt2_per_inertia, b.upper);
        const Real u[3] = {b.left_arm, b.right_arm, b.upper_arm},
                   l[3] = {zero - b.left_x, zero - b.right_x, b.lower_arm};
        const Real softening(topology_.stack ? 1 : 1 + detail::softness);
        int at = 0;
        for (int row = 0; row < 3; ++row)
            for (int column = row; column < 3; ++column, ++at) {
                const Real shared = (row < 2) == (column < 2) ? per_mass : zero;
                const Real response =
                    fma(upper_inertia * u[row], u[column], fma(lower_inertia * l[row], l[column], shared));
                put(J::own, j, row == column ? response * softening : response, at);
            }
    }

    STYLOBATE_INLINE void put_response(int e) const
    {
        const int* const edge = topology_.rigid_order + 5 * e;
        const int block = edge[2];
        if (block < 0)
            return;
        const Bed p = bed(edge[0]), k = bed(edge[1]);
        const bool above = edge[3] > 0,
                   over = edge[4] > 0; // the block is the upper one of the earlier, of the later bed
        const Real zero(0.0);
        const Real per_mass = get(OfBlock::dt2_per_mass, block), per_inertia = get(OfBlock::dt2_per_inertia, block);
        const Real cosine = fma(p.cosine, k.cosine, p.sine * k.sine), sine = fms(p.cosine, k.sine, p.sine * k.cosine);
        const Real c = above == over ? per_mass * cosine : zero - per_mass * cosine;
        const Real s = above == over ? per_mass * sine : zero - per_mass * sine;
        const Real arm_p[3] = {above ? p.left_arm : zero - p.left_x, above ? p.right_arm : zero - p.right_x,
                               above ? p.upper_arm : p.lower_arm};
        const Real arm_k[3] = {over ? k.left_arm : zero - k.left_x, over ? k.right_arm : zero - k.right_x,
                               over ? k.upper_arm : k.lower_arm};
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) {
                // n.n' = t.t' = cosine, n.t' = sine, t.n' = -sine of the turn from one lower block to the other
                const Real linear = (row < 2) == (column < 2) ? c : row < 2 ? s : zero - s;
                put(E::response, e, fma(per_inertia * arm_p[row], arm_k[column], linear), 3 * row + column);
            }
    }

    // ---- the system of equations ----

    /// Which rows of a bed say what.
    struct Rule {
        Real left, right, slips, mu;
    };
    STYLOBATE_INLINE Rule rule(int j) const
    {
        return {get(J::left, j), get(J::right, j), get(J::slips, j), get(OfJoint::mu, j)};
    }
    /// Rows of conditions that do not hold are 0.
    STYLOBATE_INLINE static void keep_rows(const Rule& r, M& m)
    {
        const Real zero(0.0), half(0.5);
        const auto holds = (abs_of(r.slips) < half) & (r.left + r.right > half);
        for (int column = 0; column < 3; ++column) {
            m.m[0][column] = select(r.left > half, m.m[0][column], zero);
            m.m[1][column] = select(r.right > half, m.m[1][column], zero);
            m.m[2][column] = select(holds, m.m[2][column], zero);
        }
    }
    /// The pivot of a bed that is by itself: an end that does not carry has no force, friction at its limit is mu N.
    STYLOBATE_INLINE M own_rows(int j, const Rule& r) const
    {
        const Real a01 = get(J::own, j, 1), a02 = get(J::own, j, 2), a12 = get(J::own, j, 4);
        M m{{{get(J::own, j, 0), a01, a02}, {a01, get(J::own, j, 3), a12}, {a02, a12, get(J::own, j, 5)}}};
        keep_rows(r, m);
        const Real zero(0.0), one(1.0), half(0.5);
        const auto holds = (abs_of(r.slips) < half) & (r.left + r.right > half);
        m.m[0][0] = select(r.left > half, m.m[0][0], one);
        m.m[1][1] = select(r.right > half, m.m[1][1], one);
        const Real limit = zero - r.slips * r.mu;
        m.m[2][0] = select(holds, m.m[2][0], limit);
        m.m[2][1] = select(holds, m.m[2][1], limit);
        m.m[2][2] = select(holds, m.m[2][2], one);
        return m;
    }
    STYLOBATE_INLINE M load(J::Field f, int j) const
    {
        M m;
        for (int k = 0; k < 9; ++k)
            m.m[k / 3][k % 3] = get(f, j, k);
        return m;
    }
    STYLOBATE_INLINE M load(E::Field f, int e) const
    {
        M m;
        for (int k = 0; k < 9; ++k)
            m.m[k / 3][k % 3] = get(f, e, k);
        return m;
    }
    template <class Field>
    STYLOBATE_INLINE void store(Field f, int i, const M& m) const
    {
        for (int k = 0; k < 9; ++k)
            put(f, i, m.m[k / 3][k % 3], k);
    }
    STYLOBATE_INLINE V load_three(J::Field f, int j) const { return {{get(f, j, 0), get(f, j, 1), get(f, j, 2)}}; }
    STYLOBATE_INLINE void store_three(J::Field f, int j, const V& v) const
    {
        for (int k = 0; k < 3; ++k)
            put(f, j, v.v[k], k);
    }

    /// The rows of a bed and its two right-hand sides: what its forces are to achieve, and the gaps to be closed.
    STYLOBATE_INLINE void put_equations(int j, Real late) const
    {
        const Real zero(0.0), half(0.5);
        const Rule r = rule(j);
        store(J::pivot, j, own_rows(j, r));
        const auto left = r.left > half, right = r.right > half;
        const auto holds = (abs_of(r.slips) < half) & (r.left + r.right > half);
        store_three(J::force, j,
                    V{{select(left, get(J::left_goal, j), zero), select(right, get(J::right_goal, j), zero),
                       select(holds, get(J::sliding_goal, j), zero)}});
        // until an end meets its face the blocks go on with their old increments
        store_three(J::closing, j,
                    V{{select(left, zero - fma(late, get(J::left_rate, j), get(J::left_gap, j)), zero),
                       select(right, zero - fma(late, get(J::right_rate, j), get(J::right_gap, j)), zero), zero}});
    }
    STYLOBATE_INLINE void put_couplings(int e) const
    {
        const int* const edge = topology_.rigid_order + 5 * e;
        M m{}, t{};
        if (edge[2] >= 0) {
            m = load(E::response, e);
            t = transposed(m);
            keep_rows(rule(edge[0]), m);
            keep_rows(rule(edge[1]), t);
        }
        store(E::earlier, e, m);
        store(E::later, e, t);
    }

    /// Solves for both right-hand sides, in their place: block elimination in the order of the topology. Beds that are
    /// not related come one after another there, so that the processor works on two at once.
    STYLOBATE_INLINE void solve_equations() const
    {
        const Real late = part_late();
        for (int j = 0; j < topology_.beds(); ++j)
            put_equations(j, late);
        for (int e = 0; e < topology_.rigid_edges; ++e)
            put_couplings(e);
        const int* at = topology_.rigid_order + 5 * topology_.rigid_edges;
        for (int pivot = 0; pivot < topology_.beds(); ++pivot) {
            const int j = *at++, count = *at++;
            const int* const related = at;
            const int* const targets = at + 2 * count;
            at = targets + count * count;
            const M inverse = inverse_of(load(J::pivot, j));
            const V force = inverse * load_three(J::force, j), closing = inverse * load_three(J::closing, j);
            store(J::inverse, j, inverse);
            store_three(J::force, j, force);
            store_three(J::closing, j, closing);
            for (int row = 0; row < count; ++row) {
                const int other = related[2 * row];
                const M rows = load(E::later, related[2 * row + 1]);
                store_three(J::force, other, load_three(J::force, other) - rows * force);
                store_three(J::closing, other, load_three(J::closing, other) - rows * closing);
                const M factor = rows * inverse;
                for (int column = 0; column < count; ++column) {
                    const M less = factor * load(E::earlier, related[2 * column + 1]);
                    const int target = targets[row * count + column];
                    if (target < 0)
                        store(J::pivot, other, load(J::pivot, other) - less);
                    else if (target & 1)
                        store(E::later, target >> 1, load(E::later, target >> 1) - less);
                    else
                        store(E::earlier, target >> 1, load(E::earlier, target >> 1) - less);
                }
            }
        }
        substitute_back(at);
    }
    /// @param begins of the pivots in the order's list, the last one first
    STYLOBATE_INLINE void substitute_back(const int* begins) const
    {
        for (int pivot = 0; pivot < topology_.beds(); ++pivot) {
            const int* const begin = topology_.rigid_order + begins[pivot];
            const int j = begin[0], count = begin[1];
            if (count == 0)
                continue;
            const V none{{Real(0.0), Real(0.0), Real(0.0)}};
            V force = none, closing = none;
            for (int column = 0; column < count; ++column) {
                const M rows = load(E::earlier, begin[3 + 2 * column]);
                force = force + rows * load_three(J::force, begin[2 + 2 * column]);
                closing = closing + rows * load_three(J::closing, begin[2 + 2 * column]);
            }
            const M inverse = load(J::inverse, j);
            store_three(J::force, j, load_three(J::force, j) - inverse * force);
            store_three(J::closing, j, load_three(J::closing, j) - inverse * closing);
        }
    }
    /// Part of a step by which the end that meets its face does so after the middle of the step.
    STYLOBATE_INLINE Real part_late() const
    {
        const Real half(0.5);
        return select(get(OfRigid::struck) > half, get(OfRigid::share) - half, Real(0.0));
    }

    // ---- which ends carry ----

    STYLOBATE_INLINE void solve() const
    {
        const Real half(0.5);
        for (int round = 0; round < detail::rounds; ++round) {
            const Real open = find_contacts(round + 1 == detail::rounds);
            if (!any(open > half))
                return;
            relax(open > half);
        }
    }

    /// Solutions with other ends that carry, until none contradicts itself.
    /// @param patient goes on with one bed at a time   @return 1 where they have not been found
    STYLOBATE_INLINE Real find_contacts(bool patient) const
    {
        const Real zero(0.0), half(0.5), one(1.0);
        const Real still = zero - abs_of(get(OfRealization::gravity_dy)) * Real(detail::still_rate<NumberOf<Real>>);
        Real open(1.0);
        for (int pass = 0; pass < detail::passes_of_all + (patient ? detail::passes_of_one : 0); ++pass) {
            solve_equations();
            apply_forces();
            put(OfRigid::passes, get(OfRigid::passes) + open);
            const bool one_at_a_time = pass >= detail::passes_of_all;
            open = zero;
            for (int j = 0; j < topology_.beds(); ++j) {
                const auto may = one_at_a_time ? open < half : zero < one;
                open = select(reconsider(j, still, may), one, open);
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
    STYLOBATE_INLINE Mask reconsider(int j, Real still, Mask may) const
    {
        const Real zero(0.0), half(0.5), one(1.0);
        const Real f1 = get(J::force, j, 0), f2 = get(J::force, j, 1), shear = get(J::force, j, 2);
        const Real left = get(J::left, j), right = get(J::right, j), slips = get(J::slips, j);
        const Real bend = get(J::bend, j);
        // A fast end that `strike` has found to be late does not meet its face in this step, but in the next one: it
        // would meet it without a time of impact.
        const Real fast = Real(2.0) * get(OfRealization::gravity_dy);
        const auto enters = [&](J::Field next_rate, J::Field last_rate, J::Field gap) {
            const Real rate = get(next_rate, j) + bend, before = get(last_rate, j);
            const Real reach = select(before < fast, max_of(rate, before), rate);
            return (get(J::usable, j) > half) & (rate < still) & (get(gap, j) < zero - half * reach);
        };
        const Real meets_left = select(enters(J::next_left, J::left_rate, J::left_gap), one, zero);
        const Real meets_right = select(enters(J::next_right, J::right_rate, J::right_gap), one, zero);
        const Real new_left = select(left > half, select(f1 > zero, one, zero), meets_left);
        const Real new_right = select(right > half, select(f2 > zero, one, zero), meets_right);
        const Real limit = get(OfJoint::mu, j) * (f1 + f2);
        const Real along = get(J::next_sliding, j) * slips;
        const Real slipping = select(shear > zero, one, zero - one);
        Real new_slips = select(abs_of(slips) > half, select(along > zero - still, zero, slips),
                                select(abs_of(shear) > limit, slipping, zero));
        new_slips = select(new_left + new_right > half, new_slips, zero); // what has parted holds when it meets again
        new_slips = select(left + right > half, new_slips, zero);
        const auto changes = may & ((new_left != left) | (new_right != right) | (new_slips != slips));
        put(J::left, j, select(changes, new_left, left));
        put(J::right, j, select(changes, new_right, right));
        put(J::slips, j, select(changes, new_slips, slips));
        return changes;
    }

    /// For the realizations whose contacts have not been found: forces clipped to what they may be, and relaxation bed
    /// by bed. Rare, so it is not inlined.
    template <class Mask>
    STYLOBATE_APART void relax(Mask which) const
    {
        const Real zero(0.0), half(0.5), one(1.0);
        put(OfRigid::left_over, get(OfRigid::left_over) + select(which, one, zero));
        for (int sweep = 0; sweep <= detail::relaxation_sweeps; ++sweep)
            for (int j = 0; j < topology_.beds(); ++j) {
                const Bed b = bed(j);
                const bool clip = sweep == 0;
                V force = load_three(J::force, j);
                const V before = force;
                const auto more = [&](int row, Real goal) {
                    const V rate = rates(b, next(b.lower), next(b.upper));
                    const V from = rates(b, free(b.lower), free(b.upper));
                    const Real own = get(J::own, j, row == 0 ? 0 : row == 1 ? 3 : 5);
                    return clip ? zero : (goal - (rate.v[row] - from.v[row])) / select(own > zero, own, one);
                };
                const auto take = [&](const V& now) {
                    const V change = now - force;
                    const Pull p = pull(b, change);
                    if (is_free(b.lower))
                        put_chosen(which, b.lower, moved_by(b.lower, next(b.lower), p.lower));
                    put_chosen(which, b.upper, moved_by(b.upper, next(b.upper), p.upper));
                    force = now;
                };
                const auto near = [&](J::Field gap) {
                    return (get(J::usable, j) > half) &
                           (get(gap, j) < abs_of(get(OfRealization::gravity_dy)) + abs_of(get(J::left_rate, j)) +
                                              abs_of(get(J::right_rate, j)));
                };
                V now = force;
                now.v[0] = select(near(J::left_gap), max_of(force.v[0] + more(0, get(J::left_goal, j)), zero), zero);
                take(now);
                now.v[1] = select(near(J::right_gap), max_of(force.v[1] + more(1, get(J::right_goal, j)), zero), zero);
                take(now);
                const Real limit = get(OfJoint::mu, j) * (now.v[0] + now.v[1]);
                now.v[2] = clamp(force.v[2] + more(2, get(J::sliding_goal, j)), zero - limit, limit);
                take(now);
                put(J::force, j, select(which, force.v[0], before.v[0]), 0);
                put(J::force, j, select(which, force.v[1], before.v[1]), 1);
                put(J::force, j, select(which, force.v[2], before.v[2]), 2);
                put(J::left, j, select(which, select(force.v[0] > zero, one, zero), get(J::left, j)));
                put(J::right, j, select(which, select(force.v[1] > zero, one, zero), get(J::right, j)));
                const Real way = select(force.v[2] > zero, one, zero - one);
                const auto slips = (abs_of(force.v[2]) >= limit) & (limit > zero);
                put(J::slips, j, select(which, select(slips, way, zero), get(J::slips, j)));
            }
        for (int j = 0; j < topology_.beds(); ++j) {
            put_next_rates(j);
            for (int k = 0; k < 2; ++k)
                put(J::closing, j, select(which, zero, get(J::closing, j, k)), k);
        }
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
            const auto shift = [&](int i, const Planar<Real>& force) {
                const Planar<Real> d = moved_by(i, free(i), force);
                put(B::free_x, i, d.x);
                put(B::free_y, i, d.y);
                put(B::free_theta, i, d.theta);
            };
            if (is_free(b.lower))
                shift(b.lower, p.lower);
            shift(b.upper, p.upper);
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
            const Real f1 = get(J::force, j, 0), f2 = get(J::force, j, 1), shear = get(J::force, j, 2);
            const Real sliding = get(J::next_sliding, j);
            impact = fnma(f1, get(J::left_rate, j) + get(J::next_left, j), impact);
            impact = fnma(f2, get(J::right_rate, j) + get(J::next_right, j), impact);
            const Real work = zero - shear * (get(J::sliding, j) + sliding);
            shear_work = shear_work + work;
            friction = fma(half, work, friction);
            const auto touches = get(J::left, j) + get(J::right, j) > half;
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

    STYLOBATE_INLINE void update(int step, bool audit) const
    {
        count_losses();
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
            const Real new_y = y + (d.y + shift.y), theta = get(OfBlock::theta, i) + (d.theta + shift.theta);
            put(OfBlock::x, i, x + (d.x + shift.x));
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

    const Topology& topology_;
};

/// Runs steps `first` to `last - 1` of the chunk for all realizations of the bundle.
template <class Real, class Here>
void run_rigid(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle, int first, int last)
{
    RigidStepper<Real, Here>(topology, bundle).run(first, last);
}

} // namespace stylobate

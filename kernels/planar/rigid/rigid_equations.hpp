#pragma once
/// The equations of all beds of the rigid form, and their direct solution. `THEORY.md` section 10 derives them.

#include "kernels/planar/rigid/rigid_bed.hpp"

namespace stylobate {

namespace detail {

/// Of rigid columns under an epistyle the forces are not unique. The diagonal of the system is larger by this part, as
/// if every bed yielded by so much of what its own blocks would: that makes them so.
template <class Number>
inline constexpr Number softness = 1e-9;
template <>
inline constexpr float softness<float> = 1e-5F;

} // namespace detail

template <class Real, class Layout>
class RigidEquations : protected RigidBeds<Real, Layout> {
protected:
    using Beds = RigidBeds<Real, Layout>;
    using E = OfRigidEdge;
    using M = Matrix3<Real>;
    using Beds::bed;
    using Beds::get;
    using Beds::is_free;
    using Beds::put;
    using Beds::RigidBeds;
    using Beds::topology_;
    using typename Beds::Bed;
    using J = OfRigidJoint;
    using V = Vector3<Real>;

    /// What the forces of a bed do to its own conditions.
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
        using Number = NumberOf<Real>;
        const Real softening(topology_.stack ? Number(1) : 1 + detail::softness<Number>);
        M m;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) {
                const Real shared = (row < 2) == (column < 2) ? per_mass : zero;
                m.m[row][column] =
                    fma(upper_inertia * u[row], u[column], fma(lower_inertia * l[row], l[column], shared));
            }
        const M own = rows_on_faces(b, columns_on_faces(b, m));
        int at = 0;
        for (int row = 0; row < 3; ++row)
            for (int column = row; column < 3; ++column, ++at)
                put(J::own, j, row == column ? own.m[row][column] * softening : own.m[row][column], at);
    }
    STYLOBATE_INLINE static M rows_on_faces(const Bed& b, const M& m)
    {
        M out;
        for (int k = 0; k < 3; ++k) {
            const V column = Beds::on_faces(b, m.m[0][k], m.m[1][k], m.m[2][k]);
            for (int i = 0; i < 3; ++i)
                out.m[i][k] = column.v[i];
        }
        return out;
    }
    STYLOBATE_INLINE static M columns_on_faces(const Bed& b, const M& m)
    {
        M out;
        for (int i = 0; i < 3; ++i) {
            const V row = Beds::on_faces(b, m.m[i][0], m.m[i][1], m.m[i][2]);
            for (int k = 0; k < 3; ++k)
                out.m[i][k] = row.v[k];
        }
        return out;
    }

    /// What the forces of the later bed of an edge do to the conditions of the earlier one.
    STYLOBATE_INLINE void put_response(int e) const
    {
        const int* const edge = topology_.rigid_order + rigid_edge_numbers * e;
        const int block = edge[2];
        if (block < 0)
            return;
        const Bed p = bed(edge[0]), k = bed(edge[1]);
        // whether the block is the upper one of the earlier, of the later bed
        const bool above = edge[3] > 0, over = edge[4] > 0;
        const Real zero(0.0);
        const Real per_mass = get(OfBlock::dt2_per_mass, block), per_inertia = get(OfBlock::dt2_per_inertia, block);
        const Real cosine = fma(p.cosine, k.cosine, p.sine * k.sine), sine = fms(p.cosine, k.sine, p.sine * k.cosine);
        const Real c = above == over ? per_mass * cosine : zero - per_mass * cosine;
        const Real s = above == over ? per_mass * sine : zero - per_mass * sine;
        const Real arm_p[3] = {above ? p.left_arm : zero - p.left_x, above ? p.right_arm : zero - p.right_x,
                               above ? p.upper_arm : p.lower_arm};
        const Real arm_k[3] = {over ? k.left_arm : zero - k.left_x, over ? k.right_arm : zero - k.right_x,
                               over ? k.upper_arm : k.lower_arm};
        M m;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) {
                // n.n' = t.t' = cosine, n.t' = sine, t.n' = -sine of the turn from one lower block to the other
                const Real linear = (row < 2) == (column < 2) ? c : row < 2 ? s : zero - s;
                m.m[row][column] = fma(per_inertia * arm_p[row], arm_k[column], linear);
            }
        store(E::response, e, rows_on_faces(p, columns_on_faces(k, m)));
    }

    // ---- the system of equations ----

    /// Meaning of the rows of a bed. Friction at its limit is slope * N + rest.
    struct Rule {
        Real left, right, slips, slope, rest;
        Real back; ///< normal force of the expansion
        /// A limit that does not depend on the normal force acts at an open bed, too.
        STYLOBATE_INLINE auto acts() const
        {
            const Real zero(0.0);
            return ((slope > zero) & (left + right + back > zero)) | ((slope <= zero) & (rest > zero));
        }
        STYLOBATE_INLINE auto holds() const { return (abs_of(slips) < Real(0.5)) & acts(); }
    };
    STYLOBATE_INLINE Rule rule(int j) const
    {
        const Real back = get(J::left_back, j) + get(J::right_back, j), mu = get(OfJoint::mu, j);
        return {get(J::left, j),
                get(J::right, j),
                get(J::slips, j),
                topology_.stack ? mu : get(J::slope, j),
                topology_.stack ? mu * back : get(J::rest, j),
                back};
    }
    /// Rows of conditions that do not hold are 0.
    STYLOBATE_INLINE static void keep_rows(const Rule& r, M& m)
    {
        const Real zero(0.0), half(0.5);
        const auto holds = r.holds();
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
        const Real a00 = m.m[0][0], a11 = m.m[1][1], a22 = m.m[2][2];
        keep_rows(r, m);
        // (each row has the size of its own response: in single precision other sizes would be lost)
        const Real zero(0.0), half(0.5);
        const auto holds = r.holds();
        m.m[0][0] = select(r.left > half, m.m[0][0], a00);
        m.m[1][1] = select(r.right > half, m.m[1][1], a11);
        const Real limit = zero - r.slips * r.slope * a22;
        m.m[2][0] = select(holds, m.m[2][0], limit);
        m.m[2][1] = select(holds, m.m[2][1], limit);
        m.m[2][2] = select(holds, m.m[2][2], a22);
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
        const Real friction = r.slips * get(J::own, j, 5) * r.rest;
        store_three(J::force, j,
                    V{{select(left, get(J::left_goal, j), zero), select(right, get(J::right_goal, j), zero),
                       select(r.holds(), get(J::sliding_goal, j), friction)}});
        // until an end meets its face the blocks go on with their old increments
        store_three(J::closing, j,
                    V{{select(left, zero - fma(late, get(J::left_rate, j), get(J::left_gap, j)), zero),
                       select(right, zero - fma(late, get(J::right_rate, j), get(J::right_gap, j)), zero), zero}});
    }
    STYLOBATE_INLINE void put_couplings(int e) const
    {
        const int* const edge = topology_.rigid_order + rigid_edge_numbers * e;
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
        const int* at = topology_.rigid_order + rigid_edge_numbers * topology_.rigid_edges;
        for (int pivot = 0; pivot < topology_.beds(); ++pivot) {
            const int j = *at++, count = *at++;
            const int* const related = at;
            const int* const targets = at + 2 * count;
            at = targets + count * count;
            const M inverse = scaled_inverse(load(J::pivot, j), get(J::own, j, 0));
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
    /// In single precision the determinant of what light and heavy blocks give is out of range.
    STYLOBATE_INLINE static M scaled_inverse(M m, Real size)
    {
        if constexpr (!compensated<NumberOf<Real>>)
            return inverse_of(m);
        const Real zero(0.0), one(1.0);
        const Real per = one / select(size > zero, size, one);
        const auto scale = [per](M& of) {
            for (auto& row : of.m)
                for (Real& x : row)
                    x = x * per;
        };
        scale(m);
        M inverse = inverse_of(m);
        scale(inverse);
        return inverse;
    }
    /// Part of a step by which the end that meets its face does so after the middle of the step.
    STYLOBATE_INLINE Real part_late() const
    {
        const Real half(0.5);
        return select(get(OfRigid::struck) > half, get(OfRigid::share) - half, Real(0.0));
    }
};

} // namespace stylobate

#pragma once
/// A bed of the rigid form: what a displacement of its two blocks does to the gaps at its ends and to the sliding, and
/// what its forces do to the blocks. `THEORY.md` section 10 derives the formulas.

#include "kernels/planar/rigid/matrix3.hpp"
#include "kernels/planar/rows.hpp"

namespace stylobate {

template <class Real, class Layout>
class RigidBeds : protected Rows<Real, Layout> {
protected:
    using J = OfRigidJoint;
    using B = OfRigidBlock;
    using V = Vector3<Real>;
    using Rows<Real, Layout>::get;
    using Rows<Real, Layout>::put;

    STYLOBATE_INLINE RigidBeds(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle)
        : Rows<Real, Layout>(bundle), topology_(topology)
    {
    }

    /// The rows of a bed: a displacement of its blocks as changes of the two gaps, and as sliding of the upper one.
    /// Where an end is a corner of the lower block, its normal is that of the upper face; if it is the nearer end, the
    /// sliding is along the upper face. `on_faces` marks rows of the lower block's directions.
    struct Bed {
        int lower, upper;
        Real sine, cosine; ///< of the lower block
        Real left_x, right_x, left_arm, right_arm, upper_arm, lower_arm;
        Real left_tilt, right_tilt, left_lift, right_lift;
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
                get(OfBlock::half_height, lower),
                get(J::left_tilt, j),
                get(J::right_tilt, j),
                get(J::left_lift, j),
                get(J::right_lift, j)};
    }
    STYLOBATE_INLINE static V on_faces(const Bed& b, Real left, Real right, Real along)
    {
        return {fnma(b.left_tilt, along, left), fnma(b.right_tilt, along, right),
                fma(b.left_lift, left, fma(b.right_lift, right, along))};
    }
    STYLOBATE_INLINE static V rates(const Bed& b, const Planar<Real>& lower, const Planar<Real>& upper)
    {
        const Real x = upper.x - lower.x, y = upper.y - lower.y;
        const Real away = fms(y, b.cosine, x * b.sine), along = fma(x, b.cosine, y * b.sine);
        return on_faces(b, fma(b.left_arm, upper.theta, fnma(b.left_x, lower.theta, away)),
                        fma(b.right_arm, upper.theta, fnma(b.right_x, lower.theta, away)),
                        fma(b.upper_arm, upper.theta, fma(b.lower_arm, lower.theta, along)));
    }
    struct Pull {
        Planar<Real> lower, upper;
    };
    /// Forces and moments of a bed's forces on its blocks.
    STYLOBATE_INLINE static Pull pull(const Bed& b, const V& force)
    {
        // along the lower block's directions
        const Real left = fma(b.left_lift, force.v[2], force.v[0]), right = fma(b.right_lift, force.v[2], force.v[1]);
        const Real shear = fnma(b.left_tilt, force.v[0], fnma(b.right_tilt, force.v[1], force.v[2]));
        const Real normal = left + right, zero(0.0);
        const Real x = fms(shear, b.cosine, normal * b.sine), y = fma(shear, b.sine, normal * b.cosine);
        const Real on_lower = fms(b.lower_arm, shear, fma(b.left_x, left, b.right_x * right));
        const Real on_upper = fma(b.upper_arm, shear, fma(b.left_arm, left, b.right_arm * right));
        return {{zero - x, zero - y, on_lower}, {x, y, on_upper}};
    }
    /// Increment of a block in the last step.
    STYLOBATE_INLINE Planar<Real> last(int i) const
    {
        return {get(OfBlock::dx, i), get(OfBlock::dy, i), get(OfBlock::dtheta, i)};
    }
    /// Increment of a block in this step, with the forces of the beds.
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
    /// An increment with what a force adds.
    STYLOBATE_INLINE Planar<Real> moved_by(int i, const Planar<Real>& d, const Planar<Real>& force) const
    {
        const Real per_mass = get(OfBlock::dt2_per_mass, i);
        return {fma(per_mass, force.x, d.x), fma(per_mass, force.y, d.y),
                fma(get(OfBlock::dt2_per_inertia, i), force.theta, d.theta)};
    }
    STYLOBATE_INLINE bool is_free(int i) const { return i >= topology_.fixed; }
    /// The increment in this step without the forces of the beds.
    STYLOBATE_INLINE Planar<Real> free(int i) const
    {
        if (!is_free(i))
            return {Real(0.0), Real(0.0), Real(0.0)};
        return {get(B::free_x, i), get(B::free_y, i), get(B::free_theta, i)};
    }

    STYLOBATE_INLINE void put_free(int i, const Planar<Real>& d) const
    {
        put(B::free_x, i, d.x);
        put(B::free_y, i, d.y);
        put(B::free_theta, i, d.theta);
    }
    /// Adds what forces of a bed do to the increments without them (`free`).
    STYLOBATE_INLINE void push_free(int j, const V& force) const
    {
        const Bed b = bed(j);
        const Pull p = pull(b, force);
        if (is_free(b.lower))
            put_free(b.lower, moved_by(b.lower, free(b.lower), p.lower));
        put_free(b.upper, moved_by(b.upper, free(b.upper), p.upper));
    }
    /// Adds a force of a bed to the increments with the forces of the beds (`next`).
    STYLOBATE_INLINE void push_next(int j, const V& force) const
    {
        const Bed b = bed(j);
        const Pull p = pull(b, force);
        if (is_free(b.lower))
            put_next(b.lower, moved_by(b.lower, next(b.lower), p.lower));
        put_next(b.upper, moved_by(b.upper, next(b.upper), p.upper));
    }

    const Topology& topology_;
};

} // namespace stylobate

#pragma once
/// The watched pairs that are close enough to be evaluated: a list that is valid until a block has strayed by the skin
/// (neighbour list: Verlet, Physical Review 159 (1967) 98; `THEORY.md`, section 2).

#include "kernels/mechanisms/eccentricity.hpp"
#include "kernels/rows.hpp"

namespace stylobate {

template <class Real, class Mechanism, class Layout = Packed>
class Neighbours : protected Rows<Real, Layout> {
protected:
    using Base = Rows<Real, Layout>;
    STYLOBATE_INLINE Neighbours(const Topology& topology, const BundleOf<NumberOf<Real>>& bundle)
        : Base(bundle), topology_(topology)
    {
    }

    using Base::b_;
    using Base::get;
    using Base::put;

    /// Displacement of a block's geometric centre.
    STYLOBATE_INLINE Real centre_x(int i) const
    {
        if constexpr (Mechanism::extended)
            return centre_from_mass_x(get(OfBlock::x, i), get(OfBlockExtension::eccentricity, i),
                                      get(OfBlock::versine, i));
        else
            return get(OfBlock::x, i);
    }
    STYLOBATE_INLINE Real centre_y(int i) const
    {
        if constexpr (Mechanism::extended)
            return centre_from_mass_y(get(OfBlock::y, i), get(OfBlockExtension::eccentricity, i),
                                      get(OfBlock::sine, i));
        else
            return get(OfBlock::y, i);
    }

    /// Whether a block of any realization has moved so far since `look_around` that an unlisted pair may be close.
    STYLOBATE_INLINE bool strayed() const
    {
        const Real skin = get(OfRealization::skin);
        auto far = skin < skin;
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            const Real x = abs_of(get(OfBlock::x, i) - get(OfNeighbourhood::x, i));
            const Real y = abs_of(get(OfBlock::y, i) - get(OfNeighbourhood::y, i));
            const Real turned = abs_of(get(OfBlock::theta, i) - get(OfNeighbourhood::theta, i));
            Real radius = get(OfBlock::half_width, i) + get(OfBlock::half_height, i);
            if constexpr (Mechanism::extended)
                radius = radius + abs_of(get(OfBlockExtension::eccentricity, i));
            far = far | (fma(radius, turned, max_of(x, y)) > skin);
        }
        return any(far);
    }

    /// Whether the bounding boxes of a pair are less than `margin` apart, or it still carries a force to be ended.
    STYLOBATE_INLINE auto meets(int joint, Real margin) const
    {
        const auto [lower, upper] = topology_.joint[joint];
        const Real one(1.0);
        const Real sl = abs_of(get(OfBlock::sine, lower)), cl = abs_of(one - get(OfBlock::versine, lower));
        const Real su = abs_of(get(OfBlock::sine, upper)), cu = abs_of(one - get(OfBlock::versine, upper));
        const Real bl = get(OfBlock::half_width, lower), hl = get(OfBlock::half_height, lower);
        const Real bu = get(OfBlock::half_width, upper), hu = get(OfBlock::half_height, upper);
        const Real x = abs_of(get(OfJoint::reference_x, joint) + (centre_x(upper) - centre_x(lower)));
        const Real y = abs_of(get(OfJoint::height, joint) + (centre_y(upper) - centre_y(lower)));
        const Real reach_x = fma(bl, cl, fma(hl, sl, fma(bu, cu, hu * su)));
        const Real reach_y = fma(bl, sl, fma(hl, cl, fma(bu, su, hu * cu)));
        const Real carried = abs_of(get(OfJoint::spring, joint)) + abs_of(get(OfJoint::shear_force, joint)) +
                             abs_of(get(OfJoint::dashpot_force, joint));
        return ((x - reach_x < margin) & (y - reach_y < margin)) | (carried > Real(0.0));
    }

    /// Lists the pairs that can meet before a block has strayed by the skin: those less than two skins apart.
    /// @return their number
    STYLOBATE_INLINE int look_around() const
    {
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            put(OfNeighbourhood::x, i, get(OfBlock::x, i));
            put(OfNeighbourhood::y, i, get(OfBlock::y, i));
            put(OfNeighbourhood::theta, i, get(OfBlock::theta, i));
        }
        const Real margin = get(OfRealization::skin) * Real(2.0);
        int close = 0;
        for (int joint = topology_.beds(); joint < topology_.joints; ++joint)
            if (any(meets(joint, margin)))
                listed(close++) = joint;
        return close;
    }

    /// The n-th pair of the list: one list for all realizations of a register, or one for each lane.
    STYLOBATE_INLINE int& listed(int n) const
    {
        if constexpr (Layout::strided)
            return b_.close[static_cast<long>(n) * b_.lanes];
        else
            return b_.close[n];
    }

    const Topology& topology_;
};

} // namespace stylobate

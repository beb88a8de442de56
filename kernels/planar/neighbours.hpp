#pragma once
/// The watched pairs that are close enough to be evaluated: a list that is valid until a block has strayed by the skin
/// (neighbour list: Verlet, Physical Review 159 (1967) 98; `THEORY.md`, section 2).

#include "kernels/planar/mechanisms/eccentricity.hpp"
#include "kernels/planar/rows.hpp"

namespace stylobate {

/// A rectangle that is turned: sine and cosine without their signs.
template <class Real>
struct TurnedBox {
    Real half_width, half_height, sine, cosine;
};
/// How far apart the upright boxes around two rectangles are; below 0 they have a part in common.
template <class Real>
struct BoxGap {
    Real x, y;
};
/// @param x, y distances of their centres, without sign
template <class Real>
STYLOBATE_INLINE BoxGap<Real> box_gap(Real x, Real y, const TurnedBox<Real>& a, const TurnedBox<Real>& b)
{
    const Real reach_x =
        fma(a.half_width, a.cosine, fma(a.half_height, a.sine, fma(b.half_width, b.cosine, b.half_height * b.sine)));
    const Real reach_y =
        fma(a.half_width, a.sine, fma(a.half_height, a.cosine, fma(b.half_width, b.sine, b.half_height * b.cosine)));
    return {x - reach_x, y - reach_y};
}

/// Whether the bounding boxes of a pair are less than `margin` apart, or it still carries a force to be ended.
/// @param x, y distances of their centres [m];  @param carried sum of the pair's forces, without their signs [N]
template <class Real>
STYLOBATE_INLINE auto pair_meets(Real x, Real y, const TurnedBox<Real>& a, const TurnedBox<Real>& b, Real carried,
                                 Real margin)
{
    const BoxGap<Real> gap = box_gap(abs_of(x), abs_of(y), a, b);
    return ((gap.x < margin) & (gap.y < margin)) | (carried > Real(0.0));
}

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
        if constexpr (Mechanism::mechanisms)
            return centre_from_mass_x(get(OfBlock::x, i), get(OfBlockMechanisms::eccentricity, i),
                                      get(OfBlock::versine, i));
        else
            return get(OfBlock::x, i);
    }
    STYLOBATE_INLINE Real centre_y(int i) const
    {
        if constexpr (Mechanism::mechanisms)
            return centre_from_mass_y(get(OfBlock::y, i), get(OfBlockMechanisms::eccentricity, i),
                                      get(OfBlock::sine, i));
        else
            return get(OfBlock::y, i);
    }

    /// How far the blocks may have strayed since the close pairs were listed. By Cauchy's inequality the path of any
    /// point in n steps is at the most the root of 2 n (sum of x2 + y2 + r2 theta2), over the increments of all blocks:
    /// three multiply-adds of a block and step.
    class Path {
    public:
        STYLOBATE_INLINE explicit Path(const Neighbours& blocks) : blocks_(blocks)
        {
            for (int i = blocks.topology_.fixed; i < blocks.topology_.blocks; ++i) {
                Real radius = blocks.get(OfBlock::half_width, i) + blocks.get(OfBlock::half_height, i);
                if constexpr (Mechanism::mechanisms)
                    radius = radius + abs_of(blocks.get(OfBlockMechanisms::eccentricity, i));
                radius_ = max_of(radius_, radius);
            }
        }
        STYLOBATE_INLINE void restart()
        {
            steps_ = 0;
            moved_ = turned_ = Real(0.0);
        }
        STYLOBATE_INLINE void add(const Planar<Real>& increment)
        {
            moved_ = fma(increment.x, increment.x, fma(increment.y, increment.y, moved_));
            turned_ = fma(increment.theta, increment.theta, turned_);
        }
        STYLOBATE_INLINE void end_step() { ++steps_; }
        /// Whether in any realization an unlisted pair may be close.
        STYLOBATE_INLINE bool strayed() const
        {
            const Real skin = blocks_.get(OfRealization::skin);
            const Real sum = fma(radius_ * radius_, turned_, moved_);
            return any(sum * Real(2.0 * steps_) > skin * skin);
        }

    private:
        const Neighbours& blocks_;
        int steps_ = 0;
        Real radius_{0.0}, moved_{0.0}, turned_{0.0};
    };

    /// `pair_meets`
    STYLOBATE_INLINE auto meets(int joint, Real margin) const
    {
        const auto [lower, upper] = topology_.joint[joint];
        return pair_meets(get(OfJoint::reference_x, joint) + (centre_x(upper) - centre_x(lower)),
                          get(OfJoint::height, joint) + (centre_y(upper) - centre_y(lower)), box(lower), box(upper),
                          abs_of(get(OfJoint::spring, joint)) + abs_of(get(OfJoint::shear_force, joint)) +
                              abs_of(get(OfJoint::dashpot_force, joint)),
                          margin);
    }

    STYLOBATE_INLINE TurnedBox<Real> box(int i) const
    {
        return {get(OfBlock::half_width, i), get(OfBlock::half_height, i), abs_of(get(OfBlock::sine, i)),
                abs_of(Real(1.0) - get(OfBlock::versine, i))};
    }

    /// Lists the pairs that can meet before a block has strayed by the skin: those less than two skins apart.
    /// @return their number
    STYLOBATE_INLINE int look_around() const
    {
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

    /// Forces besides those of the beds are summed up in the blocks' rows: from here on.
    STYLOBATE_INLINE void clear_forces() const
    {
        for (int i = topology_.fixed; i < topology_.blocks; ++i) {
            put(OfBlock::force_x, i, Real(0.0));
            put(OfBlock::force_y, i, Real(0.0));
            put(OfBlock::moment, i, Real(0.0));
        }
    }

    const Topology topology_; ///< a copy: what stores might change would be read again after each of them
};

} // namespace stylobate

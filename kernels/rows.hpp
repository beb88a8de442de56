#pragma once
/// The rows of a bundle, register by register.

#include "kernels/bundle.hpp"
#include "kernels/real.hpp"

namespace stylobate {

/// Two displacements and a rotation, or two forces and a moment.
template <class Real>
struct Planar {
    Real x, y, theta;
};

/// How a stepper finds its rows, and how many joints it takes through a phase at a time (`step.hpp`).
///
/// On a processor: register after register, a distance that the compiler knows; joints in groups, as neighbouring ones
/// are independent and the processor works on several at once.
struct Packed {
    static constexpr bool strided = false;
    static constexpr int joint_group = 8;
};
/// On a device, where a thread steps one realization: its numbers are `Bundle::lanes` apart, those of neighbouring
/// threads side by side; joint after joint, so that the intermediate values stay in registers (the other threads
/// provide the independent work).
struct Strided {
    static constexpr bool strided = true;
    static constexpr int joint_group = 1;
};

template <class Real, class Layout = Packed>
class Rows {
public:
    STYLOBATE_INLINE explicit Rows(const BundleOf<NumberOf<Real>>& bundle) : b_(bundle) {}

    STYLOBATE_INLINE Real get(OfBlock::Field f, int i) const { return L::load(&b_.blocks[row(i, OfBlock::count, f)]); }
    STYLOBATE_INLINE Real get(OfJoint::Field f, int i) const { return L::load(&b_.joints[row(i, OfJoint::count, f)]); }
    STYLOBATE_INLINE Real get(OfRealization::Field f) const { return L::load(&b_.realizations[f * stride()]); }
    STYLOBATE_INLINE Real get(OfBlockExtension::Field f, int i) const
    {
        return L::load(&b_.block_extensions[row(i, OfBlockExtension::count, f)]);
    }
    STYLOBATE_INLINE Real get(OfJointExtension::Field f, int i) const
    {
        return L::load(&b_.joint_extensions[row(i, OfJointExtension::count, f)]);
    }
    STYLOBATE_INLINE Real get(OfRealizationExtension::Field f) const
    {
        return L::load(&b_.realization_extensions[f * stride()]);
    }
    STYLOBATE_INLINE Real get(OfBlockReinforcement::Field f, int i) const
    {
        return L::load(&b_.block_reinforcements[row(i, OfBlockReinforcement::count, f)]);
    }
    STYLOBATE_INLINE Real get(OfJointReinforcement::Field f, int i) const
    {
        return L::load(&b_.joint_reinforcements[row(i, OfJointReinforcement::count, f)]);
    }
    /// Whether there are rows of reinforcements.
    STYLOBATE_INLINE bool reinforced() const { return b_.joint_reinforcements != nullptr; }
    STYLOBATE_INLINE Real get(OfPitch::Field f, int step) const
    {
        return L::load(&b_.pitch_table[row(step, OfPitch::count, f)]);
    }
    STYLOBATE_INLINE Real get(OfRemainder::Field f, int i) const
    {
        return L::load(&b_.remainders[row(i, OfRemainder::count, f)]);
    }
    STYLOBATE_INLINE Real get(OfRigidBlock::Field f, int i) const
    {
        return L::load(&b_.rigid_blocks[row(i, OfRigidBlock::count, f)]);
    }
    /// @param k of the fields that are several numbers
    STYLOBATE_INLINE Real get(OfRigidJoint::Field f, int i, int k = 0) const
    {
        return L::load(&b_.rigid_joints[row(i, OfRigidJoint::count, f + k)]);
    }
    STYLOBATE_INLINE Real get(OfRigidEdge::Field f, int i, int k) const
    {
        return L::load(&b_.rigid_edges[row(i, OfRigidEdge::count, f + k)]);
    }
    STYLOBATE_INLINE Real get(OfRigid::Field f) const { return L::load(&b_.rigid[f * stride()]); }
    STYLOBATE_INLINE Real base(int step) const { return L::load(&b_.base_table[step * stride()]); }
    STYLOBATE_INLINE Real vertical(int step) const { return L::load(&b_.vertical_table[step * stride()]); }

    STYLOBATE_INLINE void put(OfBlock::Field f, int i, Real v) const
    {
        L::store(&b_.blocks[row(i, OfBlock::count, f)], v);
    }
    STYLOBATE_INLINE void put(OfJoint::Field f, int i, Real v) const
    {
        L::store(&b_.joints[row(i, OfJoint::count, f)], v);
    }
    STYLOBATE_INLINE void put(OfRealization::Field f, Real v) const { L::store(&b_.realizations[f * stride()], v); }
    STYLOBATE_INLINE void put(OfJointExtension::Field f, int i, Real v) const
    {
        L::store(&b_.joint_extensions[row(i, OfJointExtension::count, f)], v);
    }
    STYLOBATE_INLINE void put(OfBlockReinforcement::Field f, int i, Real v) const
    {
        L::store(&b_.block_reinforcements[row(i, OfBlockReinforcement::count, f)], v);
    }
    STYLOBATE_INLINE void put(OfJointReinforcement::Field f, int i, Real v) const
    {
        L::store(&b_.joint_reinforcements[row(i, OfJointReinforcement::count, f)], v);
    }
    STYLOBATE_INLINE void put(OfRealizationExtension::Field f, Real v) const
    {
        L::store(&b_.realization_extensions[f * stride()], v);
    }
    STYLOBATE_INLINE void put(OfRigidBlock::Field f, int i, Real v) const
    {
        L::store(&b_.rigid_blocks[row(i, OfRigidBlock::count, f)], v);
    }
    STYLOBATE_INLINE void put(OfRigidJoint::Field f, int i, Real v, int k = 0) const
    {
        L::store(&b_.rigid_joints[row(i, OfRigidJoint::count, f + k)], v);
    }
    STYLOBATE_INLINE void put(OfRigidEdge::Field f, int i, Real v, int k) const
    {
        L::store(&b_.rigid_edges[row(i, OfRigidEdge::count, f + k)], v);
    }
    STYLOBATE_INLINE void put(OfRigid::Field f, Real v) const { L::store(&b_.rigid[f * stride()], v); }
    STYLOBATE_INLINE void put(OfRemainder::Field f, int i, Real v) const
    {
        L::store(&b_.remainders[row(i, OfRemainder::count, f)], v);
    }

    /// Leaves the motion of the blocks from `first` on in the trace, if there is one, as that after step `step` of the
    /// run.
    STYLOBATE_INLINE void trace(int step, int first, int blocks) const
    {
        for (int i = first; b_.trace != nullptr && i < blocks; ++i)
            for (int f = 0; f < OfBlock::traced; ++f)
                L::store(&b_.trace[row(step * blocks + i, OfBlock::traced, f)],
                         L::load(&b_.blocks[row(i, OfBlock::count, f)]));
    }

    /// sum + term. In single precision the remainder of the sum so far goes in, and the new one is kept (Kahan).
    STYLOBATE_INLINE Real add(OfRemainder::Field remainder, int i, Real sum, Real term) const
    {
        if constexpr (compensated<NumberOf<Real>>) {
            const Real whole = term + get(remainder, i);
            const Real next = sum + whole;
            put(remainder, i, whole - (next - sum));
            return next;
        } else {
            return sum + term;
        }
    }

protected:
    using L = Lanes<Real>;
    STYLOBATE_INLINE int stride() const
    {
        if constexpr (Layout::strided)
            return b_.lanes;
        else
            return L::count;
    }
    STYLOBATE_INLINE long row(int i, int fields, int f) const { return (static_cast<long>(i) * fields + f) * stride(); }

    const BundleOf<NumberOf<Real>> b_;
};

} // namespace stylobate

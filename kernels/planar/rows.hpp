#pragma once
/// The rows of a bundle, register by register.

#include "kernels/planar/bundle.hpp"
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

    /// @param i number of the block, joint or step; of a realization as a whole 0
    /// @param k of a field that is several numbers
    template <class Field>
    STYLOBATE_INLINE Real get(Field f, int i = 0, int k = 0) const
    {
        return L::load(place(f, i, k));
    }
    template <class Field>
    STYLOBATE_INLINE void put(Field f, int i, Real v, int k = 0) const
    {
        L::store(place(f, i, k), v);
    }
    /// Of a realization as a whole.
    template <class Field>
    STYLOBATE_INLINE void put(Field f, Real v) const
    {
        put(f, 0, v);
    }
    /// Whether there are rows of strengthening.
    STYLOBATE_INLINE bool strengthened() const { return b_.template rows<OfJointStrengthening::Field>() != nullptr; }

    /// Leaves the motion of the blocks from `first` on in the trace, if there is one, as that after step `step` of the
    /// run.
    STYLOBATE_INLINE void trace(int step, int first, int blocks) const
    {
        for (int i = first; b_.trace != nullptr && i < blocks; ++i)
            for (int f = 0; f < OfBlock::traced; ++f)
                L::store(&b_.trace[row(step * blocks + i, OfBlock::traced, f)], get(static_cast<OfBlock::Field>(f), i));
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
    template <class Field>
    STYLOBATE_INLINE NumberOf<Real>* place(Field f, int i, int k) const
    {
        using B = BundleOf<NumberOf<Real>>;
        return b_.template rows<Field>() + row(i, B::template fields<Field>, f + k);
    }

    const BundleOf<NumberOf<Real>> b_;
};

} // namespace stylobate

#pragma once
/// The rows of a bundle, register by register, for every model.

#include "kernels/row_list.hpp"

namespace stylobate {

/// How a stepper finds its rows, and how many joints it takes through a phase at a time (`planar/step.hpp`).
///
/// On a processor: register after register, a distance that the compiler knows; joints in groups, as neighbouring ones
/// are independent and the processor works on several at once.
struct Packed {
    static constexpr bool strided = false;
    static constexpr int joint_group = 8;
};
/// On a device, where a thread steps one realization: its numbers are `lanes` of the bundle apart, those of
/// neighbouring threads side by side; joint after joint, so that the intermediate values stay in registers (the other
/// threads provide the independent work).
struct Strided {
    static constexpr bool strided = true;
    static constexpr int joint_group = 1;
};

/// @tparam Bundle a `RowList` of `NumberOf<Real>`
template <class Real, class Bundle, class Layout = Packed>
class RowsOf {
public:
    STYLOBATE_INLINE explicit RowsOf(const Bundle& bundle) : b_(bundle) {}

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
        return b_.template rows<Field>() + row(i, Bundle::template fields<Field>, f + k);
    }

    /// Leaves the motion of the blocks from `first` on in the trace, if there is one, as that after step `step` of the
    /// run.
    /// @tparam Of a list whose first `Of::traced` fields the trace keeps
    template <class Of>
    STYLOBATE_INLINE void trace_of(int step, int first, int blocks) const
    {
        for (int i = first; b_.trace != nullptr && i < blocks; ++i)
            for (int f = 0; f < Of::traced; ++f)
                L::store(&b_.trace[row(step * blocks + i, Of::traced, f)], get(static_cast<typename Of::Field>(f), i));
    }

    const Bundle b_;
};

} // namespace stylobate

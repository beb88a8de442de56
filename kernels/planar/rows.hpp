#pragma once
/// The rows of a planar bundle.

#include "kernels/planar/bundle.hpp"
#include "kernels/rows.hpp"

namespace stylobate {

/// Two displacements and a rotation, or two forces and a moment.
template <class Real>
struct Planar {
    Real x, y, theta;
};

template <class Real, class Layout = Packed>
class Rows : public RowsOf<Real, BundleOf<NumberOf<Real>>, Layout> {
    using Base = RowsOf<Real, BundleOf<NumberOf<Real>>, Layout>;

public:
    STYLOBATE_INLINE explicit Rows(const BundleOf<NumberOf<Real>>& bundle) : Base(bundle) {}
    using Base::get;
    using Base::put;

    /// Whether there are rows of strengthening.
    STYLOBATE_INLINE bool strengthened() const { return b_.template rows<OfJointStrengthening::Field>() != nullptr; }

    /// Leaves the motion of the blocks from `first` on in the trace, if there is one, as that after step `step` of the
    /// run.
    STYLOBATE_INLINE void trace(int step, int first, int blocks) const
    {
        this->template trace_of<OfBlock>(step, first, blocks);
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
    using Base::b_;
};

} // namespace stylobate

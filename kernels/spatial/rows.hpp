#pragma once
/// The rows of a spatial bundle, also as vectors, quaternions and matrices.

#include "kernels/rows.hpp"
#include "kernels/spatial/bundle.hpp"
#include "kernels/spatial/rotation.hpp"

namespace stylobate::spatial {

/// The axes of a joint's frame: which axis of the base, or of a body, is its first, second and third one. All that is
/// read and written in this order is in the base frame, or in a body's frame, with renamed axes: nothing is computed.
struct JointAxes {
    int first, second, third;

    STYLOBATE_INLINE explicit JointAxes(Axis normal)
        : first(normal == Axis::z   ? 0
                : normal == Axis::x ? 1
                                    : 2),
          second(normal == Axis::z   ? 1
                 : normal == Axis::x ? 2
                                     : 0),
          third(static_cast<int>(normal))
    {
    }
};

template <class Real, class Layout = Packed>
class Rows : public RowsOf<Real, BundleOf<NumberOf<Real>>, Layout> {
    using Base = RowsOf<Real, BundleOf<NumberOf<Real>>, Layout>;

public:
    STYLOBATE_INLINE explicit Rows(const BundleOf<NumberOf<Real>>& bundle) : Base(bundle) {}
    using Base::get;
    using Base::put;

    /// Three fields, from `f` on.
    template <class Field>
    STYLOBATE_INLINE Vector<Real> vector(Field f, int i = 0) const
    {
        return {get(f, i), get(f, i, 1), get(f, i, 2)};
    }
    template <class Field>
    STYLOBATE_INLINE void put_vector(Field f, int i, const Vector<Real>& v) const
    {
        put(f, i, v.x);
        put(f, i, v.y, 1);
        put(f, i, v.z, 2);
    }
    STYLOBATE_INLINE Quaternion<Real> attitude(int body) const
    {
        return {get(OfBody::q_w, body), get(OfBody::q_x, body), get(OfBody::q_y, body), get(OfBody::q_z, body)};
    }

    /// A vector in the order of a joint's axes.
    /// @tparam reversed the second and third axis of the joint point in the opposite directions
    template <bool reversed, class Field>
    STYLOBATE_INLINE Vector<Real> vector_along(const JointAxes& axes, Field f, int i) const
    {
        return turned_over<reversed>(
            Vector<Real>{get(f, i, axes.first), get(f, i, axes.second), get(f, i, axes.third)});
    }
    template <bool reversed, class Field>
    STYLOBATE_INLINE void put_along(const JointAxes& axes, Field f, int i, const Vector<Real>& vector) const
    {
        const Vector<Real> v = turned_over<reversed>(vector);
        put(f, i, v.x, axes.first);
        put(f, i, v.y, axes.second);
        put(f, i, v.z, axes.third);
    }
    template <bool reversed>
    STYLOBATE_INLINE Quaternion<Real> attitude_along(const JointAxes& axes, int body) const
    {
        const Vector<Real> e = vector_along<reversed>(axes, OfBody::q_x, body);
        return {get(OfBody::q_w, body), e.x, e.y, e.z};
    }
    template <bool reversed>
    STYLOBATE_INLINE Matrix<Real> matrix_along(const JointAxes& axes, int body) const
    {
        const auto row = [&](int of) {
            return turned_over<reversed>(Vector<Real>{get(OfBody::matrix, body, 3 * of + axes.first),
                                                      get(OfBody::matrix, body, 3 * of + axes.second),
                                                      get(OfBody::matrix, body, 3 * of + axes.third)});
        };
        const Vector<Real> one = row(axes.first), two = negated<reversed>(row(axes.second)),
                           three = negated<reversed>(row(axes.third));
        return {one.x, one.y, one.z, two.x, two.y, two.z, three.x, three.y, three.z};
    }

    /// Leaves the motion of the bodies from `first` on in the trace, if there is one, as that after step `step` of the
    /// run.
    STYLOBATE_INLINE void trace(int step, int first, int bodies) const
    {
        this->template trace_of<OfBody>(step, first, bodies);
    }

protected:
    using Base::b_;

private:
    /// By half a turn about the first axis.
    template <bool over>
    STYLOBATE_INLINE static Vector<Real> turned_over(const Vector<Real>& v)
    {
        if constexpr (over)
            return {v.x, Real(0.0) - v.y, Real(0.0) - v.z};
        else
            return v;
    }
    template <bool really>
    STYLOBATE_INLINE static Vector<Real> negated(const Vector<Real>& v)
    {
        if constexpr (really)
            return {Real(0.0) - v.x, Real(0.0) - v.y, Real(0.0) - v.z};
        else
            return v;
    }
};

} // namespace stylobate::spatial

#pragma once
/// Rotation of a rigid body in space: its attitude as a unit quaternion, and the turn of one step.
///
/// The state is the attitude q and the angular momentum l = dt L, both in the base frame. With the principal inertias
/// I_x, I_y, I_z the energy of rotation is that of a sphere and of two axes,
///
///   H = L.L / 2 I_r  +  (1/I_y - 1/I_r) L_y^2 / 2  +  (1/I_c - 1/I_r) L_c^2 / 2
///
/// where L_y, L_c are components along the body's axes, c is one of x and z, and r is the other one. Without the last
/// term the body is a symmetric top about y, whose free motion is a turn about L and one about y, in closed form. The
/// last term is a turn about c. Half of it, the whole top, and the other half (Strang's splitting) is a step of second
/// order that keeps the angular momentum exactly; it is the exact motion where I_c = I_r or I_y = I_r.
///
/// The two coefficients have the magnitude of the error as their product, so c must be the long axis of a beam:
/// `correction_axis` finds it.

#include "kernels/spatial/vector.hpp"

namespace stylobate::spatial {

/// w + x i + y j + z k with w = cos(angle / 2): the rotation from the body's frame to the base frame.
template <class Real>
struct Quaternion {
    Real w, x, y, z;
};

template <class Real>
STYLOBATE_INLINE Quaternion<Real> no_rotation()
{
    return {Real(1.0), Real(0.0), Real(0.0), Real(0.0)};
}

/// R(q) - 1.
/// @pre q has unit length
template <class Real>
STYLOBATE_INLINE Matrix<Real> minus_identity(const Quaternion<Real>& q)
{
    const Real zero(0.0);
    const Real x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
    const Real xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
    const Real xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
    const Real wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
    return {zero - (yy + zz), xy - wz, xz + wy, xy + wz, zero - (xx + zz), yz - wx, xz - wy, yz + wx, zero - (xx + yy)};
}

/// Rotation of the upper body as seen from the lower one: the product of the conjugate of `lower` and `upper`.
template <class Real>
STYLOBATE_INLINE Quaternion<Real> relative_rotation(const Quaternion<Real>& lower, const Quaternion<Real>& upper)
{
    const Vector<Real> l{lower.x, lower.y, lower.z}, u{upper.x, upper.y, upper.z};
    const Vector<Real> c = cross(l, u);
    return {fma(lower.w, upper.w, dot(l, u)), fms(lower.w, u.x, fma(upper.w, l.x, c.x)),
            fms(lower.w, u.y, fma(upper.w, l.y, c.y)), fms(lower.w, u.z, fma(upper.w, l.z, c.z))};
}

/// A principal axis of a body, or none.
enum class Axis { none = -1, x = 0, y = 1, z = 2 };

/// Reciprocal inertias of a body as the step uses them; c is `correction_axis`, r is the other one of x and z.
template <class Real>
struct Inertia {
    Real sphere;     ///< 1/I_r [1/(kg m2)]
    Real top;        ///< 1/I_y - 1/I_r
    Real correction; ///< 1/I_c - 1/I_r; not read where the correction axis is none
};

/// The axis c for which the step is most accurate, given 1/I_x, 1/I_y, 1/I_z; none for a symmetric top about y.
/// @pre the reciprocals of equal inertias are equal
constexpr Axis correction_axis(double per_x, double per_y, double per_z)
{
    if (per_x == per_z)
        return Axis::none;
    const double of_x = (per_y - per_z) * (per_x - per_z), of_z = (per_y - per_x) * (per_z - per_x);
    return of_x * of_x <= of_z * of_z ? Axis::x : Axis::z;
}

/// Inertias of a body in the form of the step.
/// @param axis as `correction_axis` returns it
template <class Real>
STYLOBATE_INLINE Inertia<Real> inertia_of(Real per_x, Real per_y, Real per_z, Axis axis)
{
    if (axis == Axis::z)
        return {per_x, per_y - per_x, per_z - per_x};
    return {per_z, per_y - per_z, per_x - per_z};
}

/// A principal axis of the body in the base frame: a column of R(q).
template <Axis axis, class Real>
STYLOBATE_INLINE Vector<Real> direction_of(const Quaternion<Real>& q)
{
    const Real one(1.0), two(2.0);
    if constexpr (axis == Axis::x)
        return {fnma(two, fma(q.y, q.y, q.z * q.z), one), two * fma(q.x, q.y, q.w * q.z),
                two * fms(q.x, q.z, q.w * q.y)};
    else if constexpr (axis == Axis::y)
        return {two * fms(q.x, q.y, q.w * q.z), fnma(two, fma(q.x, q.x, q.z * q.z), one),
                two * fma(q.y, q.z, q.w * q.x)};
    else
        return {two * fma(q.x, q.z, q.w * q.y), two * fms(q.y, q.z, q.w * q.x),
                fnma(two, fma(q.x, q.x, q.y * q.y), one)};
}

namespace detail {

/// sin(h) / h and 1 - cos(h) from h^2. Taylor's series: the error is below 2e-16 for h up to 0.05.
template <class Real>
struct HalfTurn {
    Real sine_per_h, versine;
};

template <class Real>
STYLOBATE_INLINE HalfTurn<Real> half_turn(Real h2)
{
    const Real s = fma(h2, fma(h2, fma(h2, Real(-1.0 / 5040), Real(1.0 / 120)), Real(-1.0 / 6)), Real(1.0));
    const Real v = fma(h2, fma(h2, fma(h2, Real(-1.0 / 40320), Real(1.0 / 720)), Real(-1.0 / 24)), Real(0.5));
    return {s, h2 * v};
}

/// q exp(h e) for a principal axis e: a turn by the angle 2 h about the body's own axis.
template <Axis axis, class Real>
STYLOBATE_INLINE Quaternion<Real> turned_about(const Quaternion<Real>& q, Real h)
{
    const HalfTurn<Real> t = half_turn(h * h);
    const Real s = h * t.sine_per_h, v = t.versine;
    // axis a, then b and c in cyclic order: w -= s a, a += s w, b += s c, c -= s b, and all lose the part v
    const auto up = [&](Real old, Real other) { return old + fms(s, other, v * old); };
    const auto down = [&](Real old, Real other) { return old - fma(s, other, v * old); };
    if constexpr (axis == Axis::x)
        return {down(q.w, q.x), up(q.x, q.w), up(q.y, q.z), down(q.z, q.y)};
    else if constexpr (axis == Axis::y)
        return {down(q.w, q.y), down(q.x, q.z), up(q.y, q.w), up(q.z, q.x)};
    else
        return {down(q.w, q.z), up(q.x, q.y), down(q.y, q.x), up(q.z, q.w)};
}

/// exp(p / 2) q: a turn by the vector p, of the base frame.
template <class Real>
STYLOBATE_INLINE Quaternion<Real> turned_by(const Quaternion<Real>& q, const Vector<Real>& p)
{
    const HalfTurn<Real> t = half_turn(Real(0.25) * dot(p, p));
    const Vector<Real> v = (Real(0.5) * t.sine_per_h) * p, e{q.x, q.y, q.z}, c = cross(v, e);
    return {q.w - fma(t.versine, q.w, dot(v, e)), q.x + fma(q.w, v.x, fnma(t.versine, q.x, c.x)),
            q.y + fma(q.w, v.y, fnma(t.versine, q.y, c.y)), q.z + fma(q.w, v.z, fnma(t.versine, q.z, c.z))};
}

/// The symmetric top: the turn about its own axis y and the one about the angular momentum commute.
template <class Real>
STYLOBATE_INLINE Quaternion<Real> turned_top(const Quaternion<Real>& q, const Vector<Real>& l,
                                             const Inertia<Real>& inertia)
{
    const Real own = Real(0.5) * inertia.top * dot(l, direction_of<Axis::y>(q));
    return turned_about<Axis::y>(turned_by(q, inertia.sphere * l), own);
}

/// Half of the correction, the top, the other half.
template <Axis axis, class Real>
STYLOBATE_INLINE Quaternion<Real> turned_corrected(Quaternion<Real> q, const Vector<Real>& l,
                                                   const Inertia<Real>& inertia)
{
    const Real quarter = Real(0.25) * inertia.correction;
    q = turned_about<axis>(q, quarter * dot(l, direction_of<axis>(q)));
    q = turned_top(q, l, inertia);
    return turned_about<axis>(q, quarter * dot(l, direction_of<axis>(q)));
}

} // namespace detail

/// The attitude after one free step.
/// @param l    dt L: angular momentum times the step, base frame [kg m2]
/// @param axis the correction axis, the same for all lanes
/// @pre the angle of the step is at most 0.1 rad
/// @return of unit length up to rounding: one step of Newton's method for 1 / |q| keeps it there
template <class Real>
STYLOBATE_INLINE Quaternion<Real> turned(const Quaternion<Real>& q, const Vector<Real>& l, const Inertia<Real>& inertia,
                                         Axis axis)
{
    Quaternion<Real> n;
    if (axis == Axis::none)
        n = detail::turned_top(q, l, inertia);
    else if (axis == Axis::x)
        n = detail::turned_corrected<Axis::x>(q, l, inertia);
    else
        n = detail::turned_corrected<Axis::z>(q, l, inertia);
    const Real square = fma(n.w, n.w, fma(n.x, n.x, fma(n.y, n.y, n.z * n.z)));
    const Real scale = fnma(Real(0.5), square, Real(1.5));
    return {scale * n.w, scale * n.x, scale * n.y, scale * n.z};
}

/// omega dt [rad] in the base frame, from l = dt L.
template <class Real>
STYLOBATE_INLINE Vector<Real> angular_increment(const Quaternion<Real>& q, const Vector<Real>& l,
                                                const Inertia<Real>& inertia, Axis axis)
{
    const auto add = [&](Real per, const Vector<Real>& e, const Vector<Real>& w) {
        return multiply_add(per * dot(l, e), e, w);
    };
    const Vector<Real> w = add(inertia.top, direction_of<Axis::y>(q), inertia.sphere * l);
    if (axis == Axis::x)
        return add(inertia.correction, direction_of<Axis::x>(q), w);
    if (axis == Axis::z)
        return add(inertia.correction, direction_of<Axis::z>(q), w);
    return w;
}

} // namespace stylobate::spatial

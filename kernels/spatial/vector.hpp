#pragma once
/// Vectors of space and matrices of a rotation. A rotation R is kept as R - 1, whose elements keep all their digits
/// where the rotation is small: a tilt of 1e-8 has a versine of 5e-17, which 1 + m33 would lose.

#include "kernels/real.hpp"

namespace stylobate::spatial {

template <class Real>
struct Vector {
    Real x, y, z;

    friend STYLOBATE_INLINE Vector operator+(const Vector& a, const Vector& b)
    {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend STYLOBATE_INLINE Vector operator-(const Vector& a, const Vector& b)
    {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend STYLOBATE_INLINE Vector operator*(Real s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class Real>
STYLOBATE_INLINE Vector<Real> zero_vector()
{
    return {Real(0.0), Real(0.0), Real(0.0)};
}

/// s a + b, each component with one rounding.
template <class Real>
STYLOBATE_INLINE Vector<Real> multiply_add(Real s, const Vector<Real>& a, const Vector<Real>& b)
{
    return {fma(s, a.x, b.x), fma(s, a.y, b.y), fma(s, a.z, b.z)};
}

template <class Real>
STYLOBATE_INLINE Real dot(const Vector<Real>& a, const Vector<Real>& b)
{
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

template <class Real>
STYLOBATE_INLINE Vector<Real> cross(const Vector<Real>& a, const Vector<Real>& b)
{
    return {fms(a.y, b.z, a.z * b.y), fms(a.z, b.x, a.x * b.z), fms(a.x, b.y, a.y * b.x)};
}

/// R - 1 of a rotation R, row by row.
template <class Real>
struct Matrix {
    Real m11, m12, m13;
    Real m21, m22, m23;
    Real m31, m32, m33;
};

/// (R - 1) v: the displacement of the point v.
template <class Real>
STYLOBATE_INLINE Vector<Real> displaced(const Matrix<Real>& m, const Vector<Real>& v)
{
    return {fma(m.m11, v.x, fma(m.m12, v.y, m.m13 * v.z)), fma(m.m21, v.x, fma(m.m22, v.y, m.m23 * v.z)),
            fma(m.m31, v.x, fma(m.m32, v.y, m.m33 * v.z))};
}

/// R v: components in the base frame from those in the body's frame.
template <class Real>
STYLOBATE_INLINE Vector<Real> rotated(const Matrix<Real>& m, const Vector<Real>& v)
{
    return v + displaced(m, v);
}

/// R^T v: components in the body's frame from those in the base frame.
template <class Real>
STYLOBATE_INLINE Vector<Real> rotated_back(const Matrix<Real>& m, const Vector<Real>& v)
{
    return {fma(m.m11, v.x, fma(m.m21, v.y, fma(m.m31, v.z, v.x))),
            fma(m.m12, v.x, fma(m.m22, v.y, fma(m.m32, v.z, v.y))),
            fma(m.m13, v.x, fma(m.m23, v.y, fma(m.m33, v.z, v.z)))};
}

} // namespace stylobate::spatial

#pragma once
/// 3 x 3 matrices of the rigid form: the blocks of its system of equations.

#include "kernels/real.hpp"

namespace stylobate {

template <class Real>
struct Vector3 {
    Real v[3];
    friend STYLOBATE_INLINE Vector3 operator+(const Vector3& a, const Vector3& b)
    {
        return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2]}};
    }
    friend STYLOBATE_INLINE Vector3 operator-(const Vector3& a, const Vector3& b)
    {
        return {{a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2]}};
    }
};

template <class Real>
struct Matrix3 {
    Real m[3][3];
    friend STYLOBATE_INLINE Matrix3 operator-(const Matrix3& a, const Matrix3& b)
    {
        Matrix3 out;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                out.m[i][k] = a.m[i][k] - b.m[i][k];
        return out;
    }
    friend STYLOBATE_INLINE Matrix3 operator*(const Matrix3& a, const Matrix3& b)
    {
        Matrix3 out;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                out.m[i][k] = fma(a.m[i][0], b.m[0][k], fma(a.m[i][1], b.m[1][k], a.m[i][2] * b.m[2][k]));
        return out;
    }
    friend STYLOBATE_INLINE Vector3<Real> operator*(const Matrix3& a, const Vector3<Real>& x)
    {
        Vector3<Real> out;
        for (int i = 0; i < 3; ++i)
            out.v[i] = fma(a.m[i][0], x.v[0], fma(a.m[i][1], x.v[1], a.m[i][2] * x.v[2]));
        return out;
    }
};

template <class Real>
STYLOBATE_INLINE Matrix3<Real> transposed(const Matrix3<Real>& a)
{
    Matrix3<Real> out;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            out.m[i][k] = a.m[k][i];
    return out;
}

/// By cofactors; 0 where the matrix is singular.
template <class Real>
STYLOBATE_INLINE Matrix3<Real> inverse_of(const Matrix3<Real>& a)
{
    const auto minor = [&](int i, int k, int p, int q) { return fms(a.m[i][p], a.m[k][q], a.m[i][q] * a.m[k][p]); };
    const Real c00 = minor(1, 2, 1, 2), c01 = minor(1, 2, 2, 0), c02 = minor(1, 2, 0, 1);
    const Real determinant = fma(a.m[0][0], c00, fma(a.m[0][1], c01, a.m[0][2] * c02));
    const Real zero(0.0), one(1.0);
    const auto regular = determinant != zero;
    const Real per = select(regular, one / select(regular, determinant, one), zero);
    return {{{per * c00, per * minor(0, 2, 2, 1), per * minor(0, 1, 1, 2)},
             {per * c01, per * minor(0, 2, 0, 2), per * minor(0, 1, 2, 0)},
             {per * c02, per * minor(0, 2, 1, 0), per * minor(0, 1, 0, 1)}}};
}

} // namespace stylobate

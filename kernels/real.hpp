#pragma once
/// The few operations that the kernels use, for plain `double` (host and device). `wide.hpp` has the same for
/// registers.
///
/// The kernels are written in these and in + - * / only. That is what makes them give the same bits at every width:
/// each maps to one correctly rounded instruction, or to a selection that is spelled out (`min_of` is `a < b ? a : b`,
/// which is also what the vector instructions do with signed zeros and NaN).

#include <cmath>

#if defined(__CUDACC__)
#define STYLOBATE_HD __host__ __device__ inline
#else
#define STYLOBATE_HD inline
#endif

#if defined(__GNUC__) && !defined(__CUDACC__)
#define STYLOBATE_INLINE __attribute__((always_inline)) inline
#else
#define STYLOBATE_INLINE STYLOBATE_HD
#endif

namespace stylobate
{

/// Number of realizations in a register, and how to move it from and to memory.
template <class Real>
struct Lanes;

template <>
struct Lanes<double> {
    static constexpr int count = 1;
    STYLOBATE_HD static double load(const double* from) { return *from; }
    STYLOBATE_HD static void store(double* to, double value) { *to = value; }
};

/// a * b + c with one rounding.
STYLOBATE_HD double fma(double a, double b, double c)
{
    return std::fma(a, b, c);
}
/// c - a * b with one rounding.
STYLOBATE_HD double fnma(double a, double b, double c)
{
    return std::fma(-a, b, c);
}
/// a * b - c with one rounding.
STYLOBATE_HD double fms(double a, double b, double c)
{
    return std::fma(a, b, -c);
}
STYLOBATE_HD double select(bool mask, double yes, double no)
{
    return mask ? yes : no;
}
STYLOBATE_HD double min_of(double a, double b)
{
    return a < b ? a : b;
}
STYLOBATE_HD double max_of(double a, double b)
{
    return a > b ? a : b;
}
STYLOBATE_HD double abs_of(double a)
{
    return std::fabs(a);
}
STYLOBATE_HD double sqrt_of(double a)
{
    return std::sqrt(a);
}
/// Nearest integer, halves to the even one.
STYLOBATE_HD double round_of(double a)
{
    return std::nearbyint(a);
}
/// `a` with its sign turned where `sign` is negative (or is -0).
STYLOBATE_HD double turn_sign(double a, double sign)
{
    return std::signbit(sign) ? -a : a;
}
STYLOBATE_HD bool any(bool mask)
{
    return mask;
}

template <class Real>
STYLOBATE_INLINE Real clamp(Real a, Real low, Real high)
{
    return min_of(max_of(a, low), high);
}

} // namespace stylobate

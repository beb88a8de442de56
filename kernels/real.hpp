#pragma once
/// The few operations that the kernels use, for plain `double` (host and device). `wide.hpp` has the same for
/// registers.
///
/// The kernels are written in these and in + - * / only. That is what makes them give the same bits at every width:
/// each maps to one correctly rounded instruction, or to a selection that is spelled out (`min_of` is `a < b ? a : b`,
/// which is also what the vector instructions do with signed zeros and NaN).

#include <cmath>

// Always inlined, in debug builds too: a function that is compiled for one instruction set must not be the copy that
// the linker keeps for all.
#if defined(__CUDACC__)
#define STYLOBATE_INLINE __host__ __device__ __forceinline__
#elif defined(__GNUC__)
#define STYLOBATE_INLINE __attribute__((always_inline)) inline
#else
#define STYLOBATE_INLINE inline
#endif

namespace stylobate {

/// Number of realizations in a register, and how to move it from and to memory.
template <class Real>
struct Lanes;

template <>
struct Lanes<double> {
    static constexpr int count = 1;
    STYLOBATE_INLINE static double load(const double* from) { return *from; }
    STYLOBATE_INLINE static void store(double* to, double value) { *to = value; }
};

/// a * b + c with one rounding.
STYLOBATE_INLINE double fma(double a, double b, double c)
{
    return std::fma(a, b, c);
}
/// c - a * b with one rounding.
STYLOBATE_INLINE double fnma(double a, double b, double c)
{
    return std::fma(-a, b, c);
}
/// a * b - c with one rounding.
STYLOBATE_INLINE double fms(double a, double b, double c)
{
    return std::fma(a, b, -c);
}
STYLOBATE_INLINE double select(bool mask, double yes, double no)
{
    return mask ? yes : no;
}
STYLOBATE_INLINE double min_of(double a, double b)
{
    return a < b ? a : b;
}
STYLOBATE_INLINE double max_of(double a, double b)
{
    return a > b ? a : b;
}
STYLOBATE_INLINE double abs_of(double a)
{
    return std::fabs(a);
}
STYLOBATE_INLINE double sqrt_of(double a)
{
    return std::sqrt(a);
}
/// Nearest integer, halves to the even one.
STYLOBATE_INLINE double round_of(double a)
{
    return std::nearbyint(a);
}
/// `a` with its sign turned where `sign` is negative (or is -0).
STYLOBATE_INLINE double turn_sign(double a, double sign)
{
    return std::signbit(sign) ? -a : a;
}
STYLOBATE_INLINE bool any(bool mask)
{
    return mask;
}

template <class Real>
STYLOBATE_INLINE Real clamp(Real a, Real low, Real high)
{
    return min_of(max_of(a, low), high);
}

} // namespace stylobate

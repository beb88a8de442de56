#pragma once
/// The few operations that the kernels use, for plain `double` (host and device) and `float`. `wide.hpp` has the same
/// for registers.
///
/// The kernels are written in these and in + - * / only. That is what makes them give the same bits at every width:
/// each maps to one correctly rounded instruction, or to a selection that is spelled out (`min_of` is `a < b ? a : b`,
/// which is also what the vector instructions do with signed zeros and NaN).

#include <bit>
#include <cmath>
#include <cstdint>

// Always inlined, in debug builds too: a function that is compiled for one instruction set must not be the copy that
// the linker keeps for all.
#if defined(__CUDACC__)
#define STYLOBATE_INLINE __host__ __device__ __forceinline__
#elif defined(__GNUC__)
#define STYLOBATE_INLINE __attribute__((always_inline)) inline
#else
#define STYLOBATE_INLINE inline
#endif

// For rare paths: not inlined into the rest. (Except on a device: a call needs the stepper in memory, and with it
// every pointer to its rows. docs/gpu.md has the registers.)
#if defined(__CUDACC__)
#define STYLOBATE_APART STYLOBATE_INLINE
#elif defined(__GNUC__)
#define STYLOBATE_APART __attribute__((noinline))
#else
#define STYLOBATE_APART
#endif

namespace stylobate {

/// Number of realizations in a register, and how to move it from and to memory.
template <class Real>
struct Lanes;

template <>
struct Lanes<double> {
    using Number = double; ///< what a lane holds
    static constexpr int count = 1;
    STYLOBATE_INLINE static double load(const double* from) { return *from; }
    STYLOBATE_INLINE static void store(double* to, double value) { *to = value; }
};

template <>
struct Lanes<float> {
    using Number = float;
    using Full = double; ///< the same in double precision: as many numbers, or half as many
    static constexpr int count = 1;
    STYLOBATE_INLINE static float load(const float* from) { return *from; }
    STYLOBATE_INLINE static void store(float* to, float value) { *to = value; }
};

template <class Real>
using NumberOf = typename Lanes<Real>::Number;

/// The smallest and the largest substitute: a quotient by the one and a product with the other stay finite.
template <class Number>
struct Extreme {
    static constexpr double tiny = 1e-300, huge = 1e300;
};
template <>
struct Extreme<float> {
    static constexpr double tiny = 1e-30, huge = 1e30;
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
// (Where b is a constant, nvcc makes PTX's min and max of the selections, which choose otherwise between 0 and -0.)
STYLOBATE_INLINE double min_of(double a, double b)
{
#if defined(__CUDA_ARCH__)
    double least;
    asm("{ .reg .pred p; setp.lt.f64 p, %1, %2; selp.f64 %0, %1, %2, p; }" : "=d"(least) : "d"(a), "d"(b));
    return least;
#else
    return a < b ? a : b;
#endif
}
STYLOBATE_INLINE double max_of(double a, double b)
{
#if defined(__CUDA_ARCH__)
    double most;
    asm("{ .reg .pred p; setp.gt.f64 p, %1, %2; selp.f64 %0, %1, %2, p; }" : "=d"(most) : "d"(a), "d"(b));
    return most;
#else
    return a > b ? a : b;
#endif
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
/// 2^k for an integer k from -1022 to 1023: the integer that a sum with 2^52 leaves in the mantissa, moved up.
STYLOBATE_INLINE double power_of_two(double k)
{
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(k + (0x1p52 + 1023)) << 52);
}
/// The largest integer e with 2^e <= a.
/// @pre a > 0, not subnormal
STYLOBATE_INLINE double exponent_of(double a)
{
    const std::uint64_t biased = std::bit_cast<std::uint64_t>(a) >> 52;
    return std::bit_cast<double>(biased | std::bit_cast<std::uint64_t>(0x1p52)) - (0x1p52 + 1023);
}
STYLOBATE_INLINE bool any(bool mask)
{
    return mask;
}

// The same in single precision. (Before all templates that use them: a float's functions are found by what stands
// above.)
STYLOBATE_INLINE float fma(float a, float b, float c)
{
    return std::fma(a, b, c);
}
STYLOBATE_INLINE float fnma(float a, float b, float c)
{
    return std::fma(-a, b, c);
}
STYLOBATE_INLINE float fms(float a, float b, float c)
{
    return std::fma(a, b, -c);
}
STYLOBATE_INLINE float select(bool mask, float yes, float no)
{
    return mask ? yes : no;
}
STYLOBATE_INLINE float min_of(float a, float b)
{
#if defined(__CUDA_ARCH__)
    float least;
    asm("{ .reg .pred p; setp.lt.f32 p, %1, %2; selp.f32 %0, %1, %2, p; }" : "=f"(least) : "f"(a), "f"(b));
    return least;
#else
    return a < b ? a : b;
#endif
}
STYLOBATE_INLINE float max_of(float a, float b)
{
#if defined(__CUDA_ARCH__)
    float most;
    asm("{ .reg .pred p; setp.gt.f32 p, %1, %2; selp.f32 %0, %1, %2, p; }" : "=f"(most) : "f"(a), "f"(b));
    return most;
#else
    return a > b ? a : b;
#endif
}
STYLOBATE_INLINE float abs_of(float a)
{
    return std::fabs(a);
}
STYLOBATE_INLINE float sqrt_of(float a)
{
    return std::sqrt(a);
}
STYLOBATE_INLINE float round_of(float a)
{
    return std::nearbyint(a);
}
STYLOBATE_INLINE float turn_sign(float a, float sign)
{
    return std::signbit(sign) ? -a : a;
}

template <class Real>
STYLOBATE_INLINE Real clamp(Real a, Real low, Real high)
{
    return min_of(max_of(a, low), high);
}

} // namespace stylobate

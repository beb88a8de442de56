#pragma once
/// `SoftWide`: two realizations in a register of 128 bits whose instruction set has no fused multiply-add, as
/// WebAssembly's. Same operations as `real.hpp`, same bits: the fused multiply-add is computed from sums and products.
///
/// The product is p - e without an error, the sum p + c is s - t (Dekker, Numerische Mathematik 18 (1971) 224; Knuth,
/// "The Art of Computer Programming", volume 2, 4.2.2), so that the exact result is s - (t + e). Of t + e only the
/// rounded value is known. The exact value is within 2^-52 of it, relatively; where both ends of that interval round to
/// the same number, this is the result (the rounding test of Ziv, ACM Transactions on Mathematical Software 17 (1991)
/// 410). All other cases, also those in which a part of the product may underflow or overflow, are rare and left to the
/// C library, whose `fma` must be exact (a test compares it). The combination is an own derivation.

#include "kernels/real.hpp"

#include <cmath>
#include <cstdint>

namespace stylobate {

struct SoftWide {
    using Register = double __attribute__((vector_size(16)));
    using Bits = std::int64_t __attribute__((vector_size(16)));

    /// Which realizations of a register are meant.
    struct Mask {
        Bits v;
        friend STYLOBATE_INLINE Mask operator&(Mask m, Mask n) { return {m.v & n.v}; }
        friend STYLOBATE_INLINE Mask operator|(Mask m, Mask n) { return {m.v | n.v}; }
        STYLOBATE_INLINE Mask operator!() const { return {~v}; }
    };

    Register v;

    SoftWide() = default;
    STYLOBATE_INLINE SoftWide(double all) : v{all, all} {}
    STYLOBATE_INLINE SoftWide(Register r) : v(r) {}

    friend STYLOBATE_INLINE SoftWide operator+(SoftWide a, SoftWide b) { return a.v + b.v; }
    friend STYLOBATE_INLINE SoftWide operator-(SoftWide a, SoftWide b) { return a.v - b.v; }
    friend STYLOBATE_INLINE SoftWide operator*(SoftWide a, SoftWide b) { return a.v * b.v; }
    friend STYLOBATE_INLINE SoftWide operator/(SoftWide a, SoftWide b) { return a.v / b.v; }
    friend STYLOBATE_INLINE Mask operator<(SoftWide a, SoftWide b) { return {a.v < b.v}; }
    friend STYLOBATE_INLINE Mask operator>(SoftWide a, SoftWide b) { return {a.v > b.v}; }
    friend STYLOBATE_INLINE Mask operator<=(SoftWide a, SoftWide b) { return {a.v <= b.v}; }
    friend STYLOBATE_INLINE Mask operator>=(SoftWide a, SoftWide b) { return {a.v >= b.v}; }
    friend STYLOBATE_INLINE Mask operator!=(SoftWide a, SoftWide b) { return {a.v != b.v}; }
};

template <>
struct Lanes<SoftWide> {
    using Number = double;
    static constexpr int count = 2;
    STYLOBATE_INLINE static SoftWide load(const double* from)
    {
        return *reinterpret_cast<const SoftWide::Register*>(from);
    }
    STYLOBATE_INLINE static void store(double* to, SoftWide value)
    {
        *reinterpret_cast<SoftWide::Register*>(to) = value.v;
    }
};

/// True if any realization of the register is meant.
STYLOBATE_INLINE bool any(SoftWide::Mask mask)
{
#if defined(__wasm_simd128__)
    return __builtin_wasm_any_true_v128(reinterpret_cast<signed char __attribute__((vector_size(16)))>(mask.v));
#else
    return (mask.v[0] | mask.v[1]) != 0;
#endif
}

STYLOBATE_INLINE SoftWide select(SoftWide::Mask mask, SoftWide yes, SoftWide no)
{
    using Bits = SoftWide::Bits;
    return reinterpret_cast<SoftWide::Register>((mask.v & reinterpret_cast<Bits>(yes.v)) |
                                                (~mask.v & reinterpret_cast<Bits>(no.v)));
}
STYLOBATE_INLINE SoftWide min_of(SoftWide a, SoftWide b)
{
    return select(a < b, a, b);
}
STYLOBATE_INLINE SoftWide max_of(SoftWide a, SoftWide b)
{
    return select(a > b, a, b);
}
STYLOBATE_INLINE SoftWide abs_of(SoftWide a)
{
    constexpr std::int64_t all_but_sign = ~(std::int64_t{1} << 63);
    return reinterpret_cast<SoftWide::Register>(reinterpret_cast<SoftWide::Bits>(a.v) & all_but_sign);
}
STYLOBATE_INLINE SoftWide sqrt_of(SoftWide a)
{
#if defined(__wasm_simd128__)
    return __builtin_wasm_sqrt_f64x2(a.v);
#else
    return SoftWide::Register{std::sqrt(a.v[0]), std::sqrt(a.v[1])};
#endif
}
STYLOBATE_INLINE SoftWide round_of(SoftWide a)
{
#if defined(__wasm_simd128__)
    return __builtin_wasm_nearest_f64x2(a.v);
#else
    return SoftWide::Register{std::nearbyint(a.v[0]), std::nearbyint(a.v[1])};
#endif
}
STYLOBATE_INLINE SoftWide turn_sign(SoftWide a, SoftWide sign)
{
    constexpr std::int64_t sign_bit = std::int64_t{1} << 63;
    return reinterpret_cast<SoftWide::Register>(reinterpret_cast<SoftWide::Bits>(a.v) ^
                                                (reinterpret_cast<SoftWide::Bits>(sign.v) & sign_bit));
}
STYLOBATE_INLINE SoftWide power_of_two(SoftWide k)
{
    const SoftWide moved = k + SoftWide(0x1p52 + 1023);
    return reinterpret_cast<SoftWide::Register>(reinterpret_cast<SoftWide::Bits>(moved.v) << 52);
}
STYLOBATE_INLINE SoftWide exponent_of(SoftWide a)
{
    const SoftWide::Bits biased = reinterpret_cast<SoftWide::Bits>(a.v) >> 52; // it is positive
    const SoftWide::Bits whole = reinterpret_cast<SoftWide::Bits>(SoftWide(0x1p52).v);
    return SoftWide(reinterpret_cast<SoftWide::Register>(biased | whole)) - SoftWide(0x1p52 + 1023);
}

namespace detail {

/// The C library's.
STYLOBATE_APART inline SoftWide::Register library_fma(SoftWide::Register a, SoftWide::Register b, SoftWide::Register c)
{
    return SoftWide::Register{std::fma(a[0], b[0], c[0]), std::fma(a[1], b[1], c[1])};
}

/// The 26 leading bits, rounded.
STYLOBATE_INLINE SoftWide::Register leading(SoftWide::Register a)
{
    constexpr std::int64_t half = std::int64_t{1} << 26, rest = 2 * half - 1;
    return reinterpret_cast<SoftWide::Register>((reinterpret_cast<SoftWide::Bits>(a) + half) & ~rest);
}

} // namespace detail

STYLOBATE_INLINE SoftWide fma(SoftWide of_a, SoftWide of_b, SoftWide of_c)
{
    using Register = SoftWide::Register;
    using Bits = SoftWide::Bits;
    const Register a = of_a.v, b = of_b.v, c = of_c.v;
    const Register a_high = detail::leading(a), a_low = a - a_high, b_high = detail::leading(b), b_low = b - b_high;
    const Register p = a * b;
    const Register e = (((p - a_high * b_high) - a_high * b_low) - a_low * b_high) - a_low * b_low;
    const Register s = p + c, of_s = s - p;
    const Register t = ((s - of_s) - p) + (of_s - c); // of two zeros +0, so that s - t keeps the sign of s
    const Register correction = t + e;
    // without an error of the product the correction is exact, and the nearer end gives the result
    constexpr double below = 1 - 0x1p-52, above = 1 + 0x1p-52;
    constexpr std::int64_t flip = std::bit_cast<std::int64_t>(below) ^ std::bit_cast<std::int64_t>(above);
    const Bits far = reinterpret_cast<Bits>(Register{below, below}) ^ ((e != 0.0) & flip);
    const Register near_end = s - correction * below;
    const Register far_end = s - correction * reinterpret_cast<Register>(far);
    constexpr double least = 0x1p-900;
    const Register size = abs_of(SoftWide(p)).v;
    const Bits unsure = (near_end != far_end) | ((size < least) & (a != 0.0) & (b != 0.0));
    if (any(SoftWide::Mask{unsure})) [[unlikely]]
        return detail::library_fma(a, b, c);
    return near_end;
}

STYLOBATE_INLINE SoftWide fnma(SoftWide a, SoftWide b, SoftWide c)
{
    return fma(SoftWide(-a.v), b, c);
}
STYLOBATE_INLINE SoftWide fms(SoftWide a, SoftWide b, SoftWide c)
{
    return fma(a, b, SoftWide(-c.v));
}

} // namespace stylobate

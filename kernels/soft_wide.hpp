#pragma once
/// `SoftWide`: two realizations in a register of 128 bits whose instruction set has no fused multiply-add, as
/// WebAssembly's. Same operations as `real.hpp`, same bits: the fused multiply-add is computed from sums and products.
///
/// The product is p - e without an error, the sum p + c is s - t (Dekker, Numerische Mathematik 18 (1971) 224; Knuth,
/// "The Art of Computer Programming", volume 2, 4.2.2), so that the exact result is s - (t + e). Of t + e only the
/// rounded value is known. The exact value is within 2^-52 of it, relatively; where both ends of that interval round to
/// the same number, this is the result (the rounding test of Ziv, ACM Transactions on Mathematical Software 17 (1991)
/// 410). All other cases, also those in which a part of the product may underflow or overflow, are rare; the C
/// library's `fma` has them, which must be exact. The combination is an own derivation.

#include "kernels/real.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace stylobate {

/// Which realizations of a register are meant.
struct SoftMask {
    using Bits = std::int64_t __attribute__((vector_size(16)));
    Bits v;
    friend STYLOBATE_INLINE SoftMask operator&(SoftMask m, SoftMask n) { return {m.v & n.v}; }
    friend STYLOBATE_INLINE SoftMask operator|(SoftMask m, SoftMask n) { return {m.v | n.v}; }
    STYLOBATE_INLINE SoftMask operator!() const { return {~v}; }
};

/// True if any realization of the register is meant.
STYLOBATE_INLINE bool any(SoftMask mask)
{
#if defined(__wasm_simd128__)
    return __builtin_wasm_any_true_v128(reinterpret_cast<signed char __attribute__((vector_size(16)))>(mask.v));
#else
    return (mask.v[0] | mask.v[1]) != 0;
#endif
}

namespace soft {

using Register = double __attribute__((vector_size(16)));
using Bits = SoftMask::Bits;

constexpr std::int64_t sign_bit = std::numeric_limits<std::int64_t>::min();

STYLOBATE_INLINE Bits to_bits(Register a)
{
    return reinterpret_cast<Bits>(a);
}
STYLOBATE_INLINE Register from_bits(Bits a)
{
    return reinterpret_cast<Register>(a);
}
STYLOBATE_INLINE Register all(double a)
{
    return Register{a, a};
}
STYLOBATE_INLINE Register absolute(Register a)
{
    return from_bits(to_bits(a) & ~sign_bit);
}
/// The 26 leading bits, rounded.
STYLOBATE_INLINE Register leading(Register a)
{
    constexpr std::int64_t half = std::int64_t{1} << 26, rest = 2 * half - 1;
    return from_bits((to_bits(a) + half) & ~rest);
}

/// A multiply-add, and where it is not known to be rounded correctly.
struct Tried {
    Register value;
    Bits unsure;
};
STYLOBATE_INLINE Tried try_multiply_add(Register a, Register b, Register c)
{
    const Register a_high = leading(a), a_low = a - a_high, b_high = leading(b), b_low = b - b_high;
    const Register p = a * b;
    const Register e = (((p - a_high * b_high) - a_high * b_low) - a_low * b_high) - a_low * b_low;
    const Register s = p + c, of_s = s - p;
    const Register t = ((s - of_s) - p) + (of_s - c); // of two zeros +0, so that s - t keeps the sign of s
    const Register correction = t + e;
    // it is exact where one of the two is zero
    const Bits inexact = (t != 0.0) & (e != 0.0);
    const Register margin = correction * from_bits(inexact & to_bits(all(0x1p-52)));
    const Register near_end = s - (correction - margin), far_end = s - (correction + margin);
    constexpr double least = 0x1p-900;
    const Register size = absolute(p);
    const Bits unsure = (near_end != far_end) | ((size < least) & (a != 0.0) & (b != 0.0));
    return {near_end, unsure};
}

/// Unsure ones are left to the C library. A function that is called: there would be too much code otherwise.
struct ByLibrary {
    STYLOBATE_APART static Register library(Register a, Register b, Register c)
    {
        return Register{std::fma(a[0], b[0], c[0]), std::fma(a[1], b[1], c[1])};
    }
    STYLOBATE_APART static Register multiply_add(Register a, Register b, Register c)
    {
        const Tried tried = try_multiply_add(a, b, c);
        if (any(SoftMask{tried.unsure})) [[unlikely]]
            return library(a, b, c);
        return tried.value;
    }
};

/// Unsure ones are noted, and have any bits: all that was computed since the note was cleared is then to be done again
/// by the library. Nothing branches, and nothing has to be kept beside calls.
struct Noted {
    inline static Bits unsure{}; ///< of one thread
    static bool any_unsure() { return any(SoftMask{unsure}); }
    STYLOBATE_INLINE static Register multiply_add(Register a, Register b, Register c)
    {
        const Tried tried = try_multiply_add(a, b, c);
        unsure |= tried.unsure;
        return tried.value;
    }
};

} // namespace soft

/// @tparam Method of multiply-adds
template <class Method>
struct SoftWideBy {
    using Register = soft::Register;
    using Mask = SoftMask;
    Register v;

    SoftWideBy() = default;
    STYLOBATE_INLINE SoftWideBy(double all) : v(soft::all(all)) {}
    STYLOBATE_INLINE SoftWideBy(Register r) : v(r) {}

    friend STYLOBATE_INLINE SoftWideBy operator+(SoftWideBy a, SoftWideBy b) { return a.v + b.v; }
    friend STYLOBATE_INLINE SoftWideBy operator-(SoftWideBy a, SoftWideBy b) { return a.v - b.v; }
    friend STYLOBATE_INLINE SoftWideBy operator*(SoftWideBy a, SoftWideBy b) { return a.v * b.v; }
    friend STYLOBATE_INLINE SoftWideBy operator/(SoftWideBy a, SoftWideBy b) { return a.v / b.v; }
    friend STYLOBATE_INLINE Mask operator<(SoftWideBy a, SoftWideBy b) { return {a.v < b.v}; }
    friend STYLOBATE_INLINE Mask operator>(SoftWideBy a, SoftWideBy b) { return {a.v > b.v}; }
    friend STYLOBATE_INLINE Mask operator<=(SoftWideBy a, SoftWideBy b) { return {a.v <= b.v}; }
    friend STYLOBATE_INLINE Mask operator>=(SoftWideBy a, SoftWideBy b) { return {a.v >= b.v}; }
    friend STYLOBATE_INLINE Mask operator!=(SoftWideBy a, SoftWideBy b) { return {a.v != b.v}; }
};
using SoftWide = SoftWideBy<soft::ByLibrary>;

template <class Method>
struct Lanes<SoftWideBy<Method>> {
    using Number = double;
    static constexpr int count = 2;
    STYLOBATE_INLINE static SoftWideBy<Method> load(const double* from)
    {
        return *reinterpret_cast<const soft::Register*>(from);
    }
    STYLOBATE_INLINE static void store(double* to, SoftWideBy<Method> value)
    {
        *reinterpret_cast<soft::Register*>(to) = value.v;
    }
};

template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> fma(SoftWideBy<Method> a, SoftWideBy<Method> b, SoftWideBy<Method> c)
{
    return Method::multiply_add(a.v, b.v, c.v);
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> fnma(SoftWideBy<Method> a, SoftWideBy<Method> b, SoftWideBy<Method> c)
{
    return fma(SoftWideBy<Method>(-a.v), b, c);
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> fms(SoftWideBy<Method> a, SoftWideBy<Method> b, SoftWideBy<Method> c)
{
    return fma(a, b, SoftWideBy<Method>(-c.v));
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> select(SoftMask mask, SoftWideBy<Method> yes, SoftWideBy<Method> no)
{
    return soft::from_bits((mask.v & soft::to_bits(yes.v)) | (~mask.v & soft::to_bits(no.v)));
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> min_of(SoftWideBy<Method> a, SoftWideBy<Method> b)
{
    return select(a < b, a, b);
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> max_of(SoftWideBy<Method> a, SoftWideBy<Method> b)
{
    return select(a > b, a, b);
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> abs_of(SoftWideBy<Method> a)
{
    return soft::absolute(a.v);
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> sqrt_of(SoftWideBy<Method> a)
{
#if defined(__wasm_simd128__)
    return __builtin_wasm_sqrt_f64x2(a.v);
#else
    return soft::Register{std::sqrt(a.v[0]), std::sqrt(a.v[1])};
#endif
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> round_of(SoftWideBy<Method> a)
{
#if defined(__wasm_simd128__)
    return __builtin_wasm_nearest_f64x2(a.v);
#else
    return soft::Register{std::nearbyint(a.v[0]), std::nearbyint(a.v[1])};
#endif
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> turn_sign(SoftWideBy<Method> a, SoftWideBy<Method> sign)
{
    return soft::from_bits(soft::to_bits(a.v) ^ (soft::to_bits(sign.v) & soft::sign_bit));
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> power_of_two(SoftWideBy<Method> k)
{
    return soft::from_bits(soft::to_bits(k.v + (0x1p52 + 1023)) << 52);
}
template <class Method>
STYLOBATE_INLINE SoftWideBy<Method> exponent_of(SoftWideBy<Method> a)
{
    const soft::Bits biased = soft::to_bits(a.v) >> 52; // it is positive
    return soft::from_bits(biased | soft::to_bits(soft::all(0x1p52))) - (0x1p52 + 1023);
}

} // namespace stylobate

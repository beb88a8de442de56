#pragma once
/// `Wide<Arch>`: one register of realizations, around xsimd::batch. Same operations as `real.hpp`, same bits.
/// `Wide<Arch, float>` is the same register in single precision, with twice as many.
///
/// Another instruction set is another `Arch` of xsimd and one more file like `step_avx2.cpp`.

#include "kernels/real.hpp"

#include <xsimd/xsimd.hpp>

namespace stylobate {

template <class Arch, class Number = double>
struct Wide {
    using Register = xsimd::batch<Number, Arch>;
    using Mask = xsimd::batch_bool<Number, Arch>;
    Register v;

    Wide() = default;
    STYLOBATE_INLINE Wide(double all) : v(static_cast<Number>(all)) {}
    STYLOBATE_INLINE Wide(Register r) : v(r) {}

    friend STYLOBATE_INLINE Wide operator+(Wide a, Wide b) { return a.v + b.v; }
    friend STYLOBATE_INLINE Wide operator-(Wide a, Wide b) { return a.v - b.v; }
    friend STYLOBATE_INLINE Wide operator*(Wide a, Wide b) { return a.v * b.v; }
    friend STYLOBATE_INLINE Wide operator/(Wide a, Wide b) { return a.v / b.v; }
    friend STYLOBATE_INLINE Mask operator<(Wide a, Wide b) { return a.v < b.v; }
    friend STYLOBATE_INLINE Mask operator>(Wide a, Wide b) { return a.v > b.v; }
    friend STYLOBATE_INLINE Mask operator<=(Wide a, Wide b) { return a.v <= b.v; }
    friend STYLOBATE_INLINE Mask operator>=(Wide a, Wide b) { return a.v >= b.v; }
    friend STYLOBATE_INLINE Mask operator!=(Wide a, Wide b) { return a.v != b.v; }
};

template <class Arch, class Number_>
struct Lanes<Wide<Arch, Number_>> {
    using Number = Number_;
    using Full = Wide<Arch>;
    using Real = Wide<Arch, Number>;
    static constexpr int count = static_cast<int>(Real::Register::size);
    STYLOBATE_INLINE static Real load(const Number* from) { return Real::Register::load_aligned(from); }
    STYLOBATE_INLINE static void store(Number* to, Real value) { value.v.store_aligned(to); }
};

// xsimd 8 has no fused forms for AVX-512: they compile to a product and a sum, which have other bits.
#if defined(__AVX512F__)
#define STYLOBATE_FUSED(name, intrinsic)                                                                               \
    template <class Arch, class Number>                                                                                \
    STYLOBATE_INLINE Wide<Arch, Number> name(Wide<Arch, Number> a, Wide<Arch, Number> b, Wide<Arch, Number> c)         \
    {                                                                                                                  \
        using Register = typename Wide<Arch, Number>::Register;                                                        \
        if constexpr (sizeof(Register) != 64)                                                                          \
            return xsimd::name(a.v, b.v, c.v);                                                                         \
        else if constexpr (sizeof(Number) == sizeof(float))                                                            \
            return Register(intrinsic##_ps(a.v, b.v, c.v));                                                            \
        else                                                                                                           \
            return Register(intrinsic##_pd(a.v, b.v, c.v));                                                            \
    }
#else
#define STYLOBATE_FUSED(name, intrinsic)                                                                               \
    template <class Arch, class Number>                                                                                \
    STYLOBATE_INLINE Wide<Arch, Number> name(Wide<Arch, Number> a, Wide<Arch, Number> b, Wide<Arch, Number> c)         \
    {                                                                                                                  \
        return xsimd::name(a.v, b.v, c.v);                                                                             \
    }
#endif
STYLOBATE_FUSED(fma, _mm512_fmadd)
STYLOBATE_FUSED(fnma, _mm512_fnmadd)
STYLOBATE_FUSED(fms, _mm512_fmsub)
#undef STYLOBATE_FUSED

template <class Arch, class Number>
STYLOBATE_INLINE Wide<Arch, Number> select(typename Wide<Arch, Number>::Mask mask, Wide<Arch, Number> yes,
                                           Wide<Arch, Number> no)
{
    return xsimd::select(mask, yes.v, no.v);
}
template <class Arch, class Number>
STYLOBATE_INLINE Wide<Arch, Number> min_of(Wide<Arch, Number> a, Wide<Arch, Number> b)
{
    return xsimd::min(a.v, b.v);
}
template <class Arch, class Number>
STYLOBATE_INLINE Wide<Arch, Number> max_of(Wide<Arch, Number> a, Wide<Arch, Number> b)
{
    return xsimd::max(a.v, b.v);
}
template <class Arch, class Number>
STYLOBATE_INLINE Wide<Arch, Number> abs_of(Wide<Arch, Number> a)
{
    return xsimd::abs(a.v);
}
template <class Arch, class Number>
STYLOBATE_INLINE Wide<Arch, Number> sqrt_of(Wide<Arch, Number> a)
{
    return xsimd::sqrt(a.v);
}
template <class Arch, class Number>
STYLOBATE_INLINE Wide<Arch, Number> round_of(Wide<Arch, Number> a)
{
    return xsimd::nearbyint(a.v);
}
template <class Arch, class Number>
STYLOBATE_INLINE Wide<Arch, Number> turn_sign(Wide<Arch, Number> a, Wide<Arch, Number> sign)
{
    return a.v ^ (sign.v & typename Wide<Arch, Number>::Register(static_cast<Number>(-0.0)));
}
template <class Arch>
STYLOBATE_INLINE Wide<Arch> power_of_two(Wide<Arch> k)
{
    using Bits = xsimd::batch<std::uint64_t, Arch>;
    const Wide<Arch> moved = k + Wide<Arch>(0x1p52 + 1023);
    return xsimd::bitwise_cast<typename Wide<Arch>::Register>(xsimd::bitwise_cast<Bits>(moved.v) << 52);
}
template <class Arch>
STYLOBATE_INLINE Wide<Arch> exponent_of(Wide<Arch> a)
{
    using Bits = xsimd::batch<std::uint64_t, Arch>;
    const Bits biased = xsimd::bitwise_cast<Bits>(a.v) >> 52;
    const Bits whole = xsimd::bitwise_cast<Bits>(typename Wide<Arch>::Register(0x1p52));
    return Wide<Arch>(xsimd::bitwise_cast<typename Wide<Arch>::Register>(biased | whole)) - Wide<Arch>(0x1p52 + 1023);
}
/// True if any realization of the register is meant.
template <class T, class Arch>
STYLOBATE_INLINE bool any(xsimd::batch_bool<T, Arch> mask)
{
    return xsimd::any(mask);
}

} // namespace stylobate

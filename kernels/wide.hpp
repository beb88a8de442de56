#pragma once
/// `Wide<Arch>`: one register of realizations, around xsimd::batch. Same operations as `real.hpp`, same bits.
///
/// Another instruction set is another `Arch` of xsimd and one more file like `step_avx2.cpp`.

#include "kernels/real.hpp"

#include <xsimd/xsimd.hpp>

namespace stylobate {

template <class Arch>
struct Wide {
    using Register = xsimd::batch<double, Arch>;
    using Mask = xsimd::batch_bool<double, Arch>;
    Register v;

    Wide() = default;
    STYLOBATE_INLINE Wide(double all) : v(all) {}
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

template <class Arch>
struct Lanes<Wide<Arch>> {
    static constexpr int count = static_cast<int>(Wide<Arch>::Register::size);
    STYLOBATE_INLINE static Wide<Arch> load(const double* from) { return Wide<Arch>::Register::load_aligned(from); }
    STYLOBATE_INLINE static void store(double* to, Wide<Arch> value) { value.v.store_aligned(to); }
};

// xsimd 8 has no fused forms for AVX-512: they compile to a product and a sum, which have other bits.
#if defined(__AVX512F__)
#define STYLOBATE_FUSED(name, intrinsic)                                                                               \
    template <class Arch>                                                                                              \
    STYLOBATE_INLINE Wide<Arch> name(Wide<Arch> a, Wide<Arch> b, Wide<Arch> c)                                         \
    {                                                                                                                  \
        if constexpr (sizeof(typename Wide<Arch>::Register) == 64)                                                     \
            return typename Wide<Arch>::Register(intrinsic(a.v, b.v, c.v));                                            \
        else                                                                                                           \
            return xsimd::name(a.v, b.v, c.v);                                                                         \
    }
#else
#define STYLOBATE_FUSED(name, intrinsic)                                                                               \
    template <class Arch>                                                                                              \
    STYLOBATE_INLINE Wide<Arch> name(Wide<Arch> a, Wide<Arch> b, Wide<Arch> c)                                         \
    {                                                                                                                  \
        return xsimd::name(a.v, b.v, c.v);                                                                             \
    }
#endif
STYLOBATE_FUSED(fma, _mm512_fmadd_pd)
STYLOBATE_FUSED(fnma, _mm512_fnmadd_pd)
STYLOBATE_FUSED(fms, _mm512_fmsub_pd)
#undef STYLOBATE_FUSED

template <class Arch>
STYLOBATE_INLINE Wide<Arch> select(typename Wide<Arch>::Mask mask, Wide<Arch> yes, Wide<Arch> no)
{
    return xsimd::select(mask, yes.v, no.v);
}
template <class Arch>
STYLOBATE_INLINE Wide<Arch> min_of(Wide<Arch> a, Wide<Arch> b)
{
    return xsimd::min(a.v, b.v);
}
template <class Arch>
STYLOBATE_INLINE Wide<Arch> max_of(Wide<Arch> a, Wide<Arch> b)
{
    return xsimd::max(a.v, b.v);
}
template <class Arch>
STYLOBATE_INLINE Wide<Arch> abs_of(Wide<Arch> a)
{
    return xsimd::abs(a.v);
}
template <class Arch>
STYLOBATE_INLINE Wide<Arch> sqrt_of(Wide<Arch> a)
{
    return xsimd::sqrt(a.v);
}
template <class Arch>
STYLOBATE_INLINE Wide<Arch> round_of(Wide<Arch> a)
{
    return xsimd::nearbyint(a.v);
}
template <class Arch>
STYLOBATE_INLINE Wide<Arch> turn_sign(Wide<Arch> a, Wide<Arch> sign)
{
    return a.v ^ (sign.v & typename Wide<Arch>::Register(-0.0));
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

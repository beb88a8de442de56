#pragma once
/// `Twice<Real>`: two registers of realizations at a time. One or two blocks are one chain of operations after the
/// other, which leaves most of the processor idle; a second register is independent work for it
/// (`docs/performance.md`). Same operations as `real.hpp`, each on both registers: same bits.

#include "kernels/wide.hpp"

namespace stylobate {

/// Which realizations of two registers are meant.
template <class Mask>
struct TwiceMask {
    Mask a, b;
    friend STYLOBATE_INLINE TwiceMask operator&(TwiceMask m, TwiceMask n) { return {m.a & n.a, m.b & n.b}; }
    friend STYLOBATE_INLINE TwiceMask operator|(TwiceMask m, TwiceMask n) { return {m.a | n.a, m.b | n.b}; }
    STYLOBATE_INLINE TwiceMask operator!() const { return {!a, !b}; }
};

template <class Mask>
STYLOBATE_INLINE bool any(TwiceMask<Mask> mask)
{
    return stylobate::any(mask.a | mask.b);
}

template <class Real>
struct Twice {
    using Mask = TwiceMask<decltype(Real() < Real())>;
    Real a, b;

    Twice() = default;
    STYLOBATE_INLINE Twice(double all) : a(all), b(all) {}
    STYLOBATE_INLINE Twice(Real first, Real second) : a(first), b(second) {}

    friend STYLOBATE_INLINE Twice operator+(Twice p, Twice q) { return {p.a + q.a, p.b + q.b}; }
    friend STYLOBATE_INLINE Twice operator-(Twice p, Twice q) { return {p.a - q.a, p.b - q.b}; }
    friend STYLOBATE_INLINE Twice operator*(Twice p, Twice q) { return {p.a * q.a, p.b * q.b}; }
    friend STYLOBATE_INLINE Twice operator/(Twice p, Twice q) { return {p.a / q.a, p.b / q.b}; }
    friend STYLOBATE_INLINE Mask operator<(Twice p, Twice q) { return {p.a < q.a, p.b < q.b}; }
    friend STYLOBATE_INLINE Mask operator>(Twice p, Twice q) { return {p.a > q.a, p.b > q.b}; }
    friend STYLOBATE_INLINE Mask operator<=(Twice p, Twice q) { return {p.a <= q.a, p.b <= q.b}; }
    friend STYLOBATE_INLINE Mask operator>=(Twice p, Twice q) { return {p.a >= q.a, p.b >= q.b}; }
    friend STYLOBATE_INLINE Mask operator!=(Twice p, Twice q) { return {p.a != q.a, p.b != q.b}; }
};

template <class Real>
struct Lanes<Twice<Real>> {
    using Half = Lanes<Real>;
    using Number = typename Half::Number;
    static constexpr int count = 2 * Half::count;
    STYLOBATE_INLINE static Twice<Real> load(const Number* from)
    {
        return {Half::load(from), Half::load(from + Half::count)};
    }
    STYLOBATE_INLINE static void store(Number* to, Twice<Real> value)
    {
        Half::store(to, value.a);
        Half::store(to + Half::count, value.b);
    }
};

template <class Real>
STYLOBATE_INLINE Twice<Real> fma(Twice<Real> p, Twice<Real> q, Twice<Real> r)
{
    return {fma(p.a, q.a, r.a), fma(p.b, q.b, r.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> fnma(Twice<Real> p, Twice<Real> q, Twice<Real> r)
{
    return {fnma(p.a, q.a, r.a), fnma(p.b, q.b, r.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> fms(Twice<Real> p, Twice<Real> q, Twice<Real> r)
{
    return {fms(p.a, q.a, r.a), fms(p.b, q.b, r.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> select(typename Twice<Real>::Mask mask, Twice<Real> yes, Twice<Real> no)
{
    return {select(mask.a, yes.a, no.a), select(mask.b, yes.b, no.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> min_of(Twice<Real> p, Twice<Real> q)
{
    return {min_of(p.a, q.a), min_of(p.b, q.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> max_of(Twice<Real> p, Twice<Real> q)
{
    return {max_of(p.a, q.a), max_of(p.b, q.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> abs_of(Twice<Real> p)
{
    return {abs_of(p.a), abs_of(p.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> sqrt_of(Twice<Real> p)
{
    return {sqrt_of(p.a), sqrt_of(p.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> round_of(Twice<Real> p)
{
    return {round_of(p.a), round_of(p.b)};
}
template <class Real>
STYLOBATE_INLINE Twice<Real> turn_sign(Twice<Real> p, Twice<Real> sign)
{
    return {turn_sign(p.a, sign.a), turn_sign(p.b, sign.b)};
}

} // namespace stylobate

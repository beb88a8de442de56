#pragma once
/// A number that counts what is done with it: the kernel is run on it, so that the floating-point operations of a step
/// are counted from the code itself.

#include "kernels/real.hpp"
#include "kernels/spatial/topology.hpp"

#include <cmath>

namespace stylobate {

struct OperationCounts {
    long add = 0, mul = 0, fma = 0, div = 0, sqrt = 0;
    long load = 0, store = 0;
    long meant = 0;     ///< how often `any` asked whether a realization is meant, and it was
    long subnormal = 0; ///< numbers so small that some processors are slow with them
    /// As is customary: a fused multiply-add is two, selections and minima are none.
    long flops() const { return add + mul + 2 * fma + div + sqrt; }
};
inline OperationCounts counted;

struct Counted {
    struct Mask {
        bool v;
        friend Mask operator&(Mask a, Mask b) { return {a.v && b.v}; }
        friend Mask operator|(Mask a, Mask b) { return {a.v || b.v}; }
        Mask operator!() const { return {!v}; }
    };
    double v = 0;
    Counted() = default;
    Counted(double value) : v(value) { counted.subnormal += std::fpclassify(v) == FP_SUBNORMAL; }
    friend Counted operator+(Counted a, Counted b) { return ++counted.add, Counted(a.v + b.v); }
    friend Counted operator-(Counted a, Counted b) { return ++counted.add, Counted(a.v - b.v); }
    friend Counted operator*(Counted a, Counted b) { return ++counted.mul, Counted(a.v * b.v); }
    friend Counted operator/(Counted a, Counted b) { return ++counted.div, Counted(a.v / b.v); }
    friend Mask operator<(Counted a, Counted b) { return {a.v < b.v}; }
    friend Mask operator>(Counted a, Counted b) { return {a.v > b.v}; }
    friend Mask operator<=(Counted a, Counted b) { return {a.v <= b.v}; }
    friend Mask operator>=(Counted a, Counted b) { return {a.v >= b.v}; }
    friend Mask operator!=(Counted a, Counted b) { return {a.v != b.v}; }
};

template <>
struct Lanes<Counted> {
    using Number = double;
    static constexpr int count = 1;
    static Counted load(const double* from) { return ++counted.load, Counted(*from); }
    static void store(double* to, Counted value) { ++counted.store, *to = value.v; }
};

inline bool any(Counted::Mask mask)
{
    counted.meant += mask.v;
    return mask.v;
}
inline Counted fma(Counted a, Counted b, Counted c)
{
    return ++counted.fma, Counted(fma(a.v, b.v, c.v));
}
inline Counted fnma(Counted a, Counted b, Counted c)
{
    return ++counted.fma, Counted(fnma(a.v, b.v, c.v));
}
inline Counted fms(Counted a, Counted b, Counted c)
{
    return ++counted.fma, Counted(fms(a.v, b.v, c.v));
}
inline Counted select(Counted::Mask mask, Counted yes, Counted no)
{
    return mask.v ? yes : no;
}
inline Counted min_of(Counted a, Counted b)
{
    return min_of(a.v, b.v);
}
inline Counted max_of(Counted a, Counted b)
{
    return max_of(a.v, b.v);
}
inline Counted abs_of(Counted a)
{
    return abs_of(a.v);
}
inline Counted sqrt_of(Counted a)
{
    return ++counted.sqrt, Counted(sqrt_of(a.v));
}
inline Counted round_of(Counted a)
{
    return round_of(a.v);
}
inline Counted turn_sign(Counted a, Counted sign)
{
    return turn_sign(a.v, sign.v);
}
inline Counted power_of_two(Counted k)
{
    return power_of_two(k.v);
}
inline Counted exponent_of(Counted a)
{
    return exponent_of(a.v);
}

/// What a block costs in one step: the step counted on a bundle of one realization that rocks (`counted_step.cpp`).
OperationCounts operations_per_block_step(int blocks);
/// What a drum costs in one step in space, with its bed.
OperationCounts operations_per_spatial_step(spatial::BedKind kind);

} // namespace stylobate

#pragma once
/// `LongReal`: the kernels in long double, for derivatives by differences. Eleven more bits than double leave the
/// difference of two energies with digits enough to compare it with a force. A class, so that the templates find its
/// operations whatever is included first.

#include "kernels/real.hpp"

#include <cmath>

namespace stylobate {

struct LongReal {
    long double v;

    LongReal() = default;
    LongReal(long double value) : v(value) {}
    explicit operator long double() const { return v; }
    explicit operator double() const { return static_cast<double>(v); }

    friend LongReal operator+(LongReal a, LongReal b) { return a.v + b.v; }
    friend LongReal operator-(LongReal a, LongReal b) { return a.v - b.v; }
    friend LongReal operator*(LongReal a, LongReal b) { return a.v * b.v; }
    friend LongReal operator/(LongReal a, LongReal b) { return a.v / b.v; }
    friend bool operator<(LongReal a, LongReal b) { return a.v < b.v; }
    friend bool operator>(LongReal a, LongReal b) { return a.v > b.v; }
    friend bool operator<=(LongReal a, LongReal b) { return a.v <= b.v; }
    friend bool operator>=(LongReal a, LongReal b) { return a.v >= b.v; }
    friend bool operator!=(LongReal a, LongReal b) { return a.v != b.v; }
    friend LongReal fma(LongReal a, LongReal b, LongReal c) { return a.v * b.v + c.v; }
    friend LongReal fnma(LongReal a, LongReal b, LongReal c) { return c.v - a.v * b.v; }
    friend LongReal fms(LongReal a, LongReal b, LongReal c) { return a.v * b.v - c.v; }
    friend LongReal select(bool mask, LongReal yes, LongReal no) { return mask ? yes : no; }
    friend LongReal min_of(LongReal a, LongReal b) { return a.v < b.v ? a : b; }
    friend LongReal max_of(LongReal a, LongReal b) { return a.v > b.v ? a : b; }
    friend LongReal abs_of(LongReal a) { return std::fabs(a.v); }
    friend LongReal turn_sign(LongReal a, LongReal sign) { return std::signbit(sign.v) ? -a.v : a.v; }
    friend LongReal sqrt_of(LongReal a) { return std::sqrt(a.v); }
};

template <>
struct Lanes<LongReal> {
    using Number = long double;
    static constexpr int count = 1;
};

} // namespace stylobate

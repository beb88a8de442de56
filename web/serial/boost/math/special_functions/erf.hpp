#pragma once
// Boost's, and for arguments of type double the results that it has on x86-64, where it computes in the 64 bits of the
// x87 registers: draws are part of a realization's identity. Emscripten's long double has 113 bits.

#include_next <boost/math/special_functions/erf.hpp>

#include "ensemble/numerics/elementary.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace stylobate {

/// A number with 64 bits, rounded to the nearest after each operation.
class Extended {
public:
    Extended(long double value = 0) : value_(rounded(value)) {}
    explicit operator double() const { return static_cast<double>(value_); }
    long double value() const { return value_; }

    friend Extended operator+(Extended a, Extended b) { return a.value_ + b.value_; }
    friend Extended operator-(Extended a, Extended b) { return a.value_ - b.value_; }
    friend Extended operator*(Extended a, Extended b) { return a.value_ * b.value_; }
    friend Extended operator/(Extended a, Extended b) { return a.value_ / b.value_; }
    friend Extended operator-(Extended a) { return -a.value_; }
    Extended& operator+=(Extended b) { return *this = *this + b; }
    Extended& operator*=(Extended b) { return *this = *this * b; }
    Extended& operator/=(Extended b) { return *this = *this / b; }
    friend bool operator<(Extended a, Extended b) { return a.value_ < b.value_; }
    friend bool operator>(Extended a, Extended b) { return a.value_ > b.value_; }
    friend bool operator<=(Extended a, Extended b) { return a.value_ <= b.value_; }
    friend bool operator>=(Extended a, Extended b) { return a.value_ >= b.value_; }
    friend bool operator==(Extended a, Extended b) { return a.value_ == b.value_; }
    friend bool operator!=(Extended a, Extended b) { return a.value_ != b.value_; }

    friend Extended sqrt(Extended a)
    {
        const double near = std::sqrt(static_cast<double>(a));
        return near == 0 ? Extended(0) : Extended(near + (a.value_ - near * (long double)near) / (2.0L * near));
    }
    friend Extended log(Extended a) { return sum(log_pair(static_cast<double>(a))); } // of a double
    friend Extended exp(Extended a)
    {
        const double high = static_cast<double>(a);
        if (std::fabs(high) > 700)
            return std::exp(high);
        return sum(exp_of(DoublePair(high, static_cast<double>(a.value_ - high))));
    }
    friend Extended floor(Extended a) { return floorl(a.value_); }
    friend Extended ldexp(Extended a, int exponent) { return scalbnl(a.value_, exponent); }
    friend Extended frexp(Extended a, int* exponent) { return frexpl(a.value_, exponent); }

private:
    static Extended sum(DoublePair p) { return static_cast<long double>(p.hi) + p.lo; }
    static long double rounded(long double value)
    {
        static_assert(sizeof value == 16);
        unsigned __int128 bits;
        std::memcpy(&bits, &value, sizeof bits);
        constexpr int dropped = 49;
        if (const auto exponent = static_cast<int>(bits >> 112) & 0x7fff; exponent == 0 || exponent == 0x7fff)
            return value;
        const unsigned __int128 odd = bits >> dropped & 1, half = (unsigned __int128){1} << (dropped - 1);
        bits = (bits + half - 1 + odd) >> dropped << dropped;
        std::memcpy(&value, &bits, sizeof bits);
        return value;
    }
    long double value_;
};

} // namespace stylobate

namespace boost::math {

template <class Policy>
double erfc_inv(double z, const Policy& policy)
{
    using stylobate::Extended;
    if (!(z > 0 && z < 2))
        return erfc_inv<double, Policy>(z, policy); // refused
    const double q = z > 1 ? 2 - z : z, p = 1 - q;
    const auto result = static_cast<double>(
        detail::erf_inv_imp(Extended(p), Extended(q), policy, static_cast<integral_constant<int, 64>*>(nullptr)));
    return z > 1 ? -result : result;
}

template <class Policy>
double erfc(double z, const Policy& policy)
{
    return static_cast<double>(detail::erf_imp(stylobate::Extended(z), true, policy, integral_constant<int, 64>()));
}

} // namespace boost::math

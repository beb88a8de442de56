#pragma once

#include <cmath>

namespace stylobate {

/// Logarithm of |Gamma(x)|. Unlike `std::lgamma` it may be called by several threads at once: that one also writes the
/// sign of Gamma into a global variable of the C library.
inline double log_gamma(double x)
{
    int sign = 0;
    return ::lgamma_r(x, &sign);
}

} // namespace stylobate

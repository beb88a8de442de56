#pragma once
/// The distributions that intervals use.

#include <cmath>

namespace stylobate {

/// The quantile of Student's t with these degrees of freedom.
double student_quantile(double probability, double degrees);
/// The quantile of the standard normal distribution.
double normal_quantile(double probability);
/// The probability of the standard normal distribution below a value.
double normal_below(double z);
double normal_density(double z);

/// Logarithm of |Gamma(x)|. Unlike `std::lgamma` it may be called by several threads at once: that one also writes the
/// sign of Gamma into a global variable of the C library.
inline double log_gamma(double x)
{
    int sign = 0;
    return ::lgamma_r(x, &sign);
}

} // namespace stylobate

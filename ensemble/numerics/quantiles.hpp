#pragma once
/// The distributions that intervals use.

namespace stylobate {

/// The quantile of Student's t with these degrees of freedom.
double student_quantile(double probability, double degrees);
/// The quantile of the standard normal distribution.
double normal_quantile(double probability);
/// The probability of the standard normal distribution below a value.
double normal_below(double z);
double normal_density(double z);

} // namespace stylobate

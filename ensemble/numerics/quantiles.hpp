#pragma once
/// Quantiles of the distributions that intervals use (Boost.Math).

namespace stylobate {

/// The quantile of Student's t with these degrees of freedom.
double student_quantile(double probability, double degrees);
/// The same of the standard normal distribution.
double normal_quantile(double probability);

} // namespace stylobate

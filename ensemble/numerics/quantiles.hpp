#pragma once
/// Quantiles of the distributions that intervals are made of.

namespace stylobate {

/// The t below which Student's t with these degrees of freedom stays with this probability.
double student_quantile(double probability, double degrees);
/// The same of the standard normal distribution.
double normal_quantile(double probability);

} // namespace stylobate

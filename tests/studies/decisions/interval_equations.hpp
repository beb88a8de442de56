#pragma once
/// The equations that published intervals satisfy, for tests of limits.

#include <boost/math/distributions/beta.hpp>

#include <cmath>
#include <utility>

namespace stylobate {

/// Jeffreys' limits of k in n trials: quantiles of Beta(k + 1/2, n - k + 1/2).
inline std::pair<double, double> jeffreys_limits(double k, double n, double level)
{
    const boost::math::beta_distribution<double> posterior(k + 0.5, n - k + 0.5);
    return {quantile(posterior, (1 - level) / 2), quantile(posterior, (1 + level) / 2)};
}

/// How many standard errors the difference (more - less) / pairs is from d: z at the lower limit of Tango's interval
/// (1998), -z at the upper one.
/// @param more, less pairs that reached the state in the variant alone and in the base alone
inline double tango_score(double more, double less, double pairs, double d)
{
    const double a = 2 * pairs, b = (2 * pairs - more + less) * d - more - less, c = -less * d * (1 - d);
    const double q = (std::sqrt(b * b - 4 * a * c) - b) / (2 * a);
    return (more - less - pairs * d) / std::sqrt(pairs * (2 * q + d * (1 - d)));
}

} // namespace stylobate

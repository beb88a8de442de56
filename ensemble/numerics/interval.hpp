#pragma once
/// Intervals for a probability that is estimated from trials.
///
/// Surfaces use Jeffreys' interval. Exact coverage at level 0.95, by summing the binomial probabilities (J Jeffreys, W
/// Wilson):
///
///                        n = 16              n = 64              n = 256
///   average over p       J 0.9516 W 0.9533  J 0.9500 W 0.9515  J 0.9499 W 0.9506
///   worst p              J 0.8962 W 0.8362  J 0.8822 W 0.8377  J 0.8777 W 0.8381
///   average width        J 0.3556 W 0.3587  J 0.1882 W 0.1892  J 0.0957 W 0.0958
///
/// Both are right on average. Wilson's coverage is lowest at p = 0.18 / n, and most cells of a collapse surface have a
/// probability near 0 or 1; Jeffreys' is better there, and is not wider. Both intervals are reviewed in Brown, Cai &
/// DasGupta, "Interval estimation for a binomial proportion", Statistical Science 16 (2001) 101.

#include <cmath>
#include <cstdint>

namespace stylobate {

// The distributions that intervals use.

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

/// The source of the interval of a cell of an adaptive surface.
enum class IntervalMethod : std::uint8_t {
    own,    ///< its own trials
    surface ///< pooled with its neighbours (adaptive.hpp)
};
const char* to_string(IntervalMethod method);

struct BinomialInterval {
    double lower = 0;
    double upper = 1;
};

/// Jeffreys' interval: equal tails of the posterior Beta(successes + 1/2, failures + 1/2) (Brown, Cai & DasGupta 2001,
/// section 3.1.3).
///
/// @param level confidence, in (0, 1)
/// @pre successes <= trials
/// @return [0, 1] without trials; the lower limit is exactly 0 at no success, the upper one exactly 1 at no failure
BinomialInterval jeffreys(std::uint64_t trials, std::uint64_t successes, double level);

} // namespace stylobate

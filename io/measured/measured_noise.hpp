#pragma once
/// How noisy samples are, from the samples alone.

#include <span>

namespace stylobate {

/// Standard deviation of white noise upon a signal that is smooth from sample to sample: the p-th difference of noise
/// has the deviation sqrt((2p)! / (p!)2) sd, while that of the signal goes down with p. The smallest of p = 1 ... 8, by
/// the median of absolute values, so that knocks and gaps (NaN) do not count. 0 where there are fewer than 32
/// neighbouring samples.
/// @param stride  from one sample to the next, for a column of a table
double noise_of(std::span<const double> values, std::size_t stride = 1);

} // namespace stylobate

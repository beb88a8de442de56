#pragma once
/// Percentile intervals for functions of means over independent rows.
///
/// As many rows as there are are resampled with replacement; the scatter of the estimates of such samples is that of
/// the estimate (Efron & Tibshirani, "An Introduction to the Bootstrap" (1993), chapter 13). An estimator consists of
/// the list of numbers that it needs of a row, and a function of their means: a resample then costs one pass.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace stylobate {

/// A value with its interval. NaN, all three, where the data do not determine it.
struct Estimate {
    double value = 0;
    double lower = 0;
    double upper = 0;

    bool contains(double x) const { return lower <= x && x <= upper; }
    static Estimate undetermined();
};

struct BootstrapOptions {
    double level = 0.95;
    std::size_t resamples = 1000;
    std::uint64_t seed = 1;
};

/// From means of the rows' numbers to estimates.
using FromMeans = std::function<void(std::span<const double> means, std::span<double> estimates)>;

/// @param rows      (n x width), row by row, of independent rows
/// @param estimates number of estimates that `from_means` computes
/// @return each with its interval; undetermined where the estimate, or so many of the resamples' estimates that they
///         reach into the interval, are not finite
std::vector<Estimate> bootstrap_rows(std::span<const double> rows, std::size_t width, std::size_t estimates,
                                     const FromMeans& from_means, const BootstrapOptions& options);

/// Estimates as of `bootstrap_rows`, with limits of the bootstrap or of the jackknife, whichever are wider. Those of
/// the jackknife are value -+ Student's quantile x the standard error from the values without each row (Efron &
/// Tibshirani 1993, chapter 11). For ratios of few rows either interval alone holds in 84 to 95 % of the designs and is
/// too narrow on one side (docs/sensitivity.md has the coverage of both together); the combination is an own choice.
std::vector<Estimate> resampled_rows(std::span<const double> rows, std::size_t width, std::size_t estimates,
                                     const FromMeans& from_means, const BootstrapOptions& options);

/// Means over the rows, one for each of their numbers.
std::vector<double> row_means(std::span<const double> rows, std::size_t width);

} // namespace stylobate

#pragma once
/// Percentile intervals for whatever is a function of means over independent rows.
///
/// The rows are drawn again, as many as there are, with replacement; the estimates of each such sample spread as the
/// estimate does (Efron & Tibshirani, "An Introduction to the Bootstrap" (1993), chapter 13). An estimator says what it
/// needs of a row as a list of numbers, and what it makes of their means: a resample then costs one pass.

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
/// @param estimates how many `from_means` fills in
/// @return each with its interval; undetermined where the estimate, or so many of the resamples' estimates that they
///         reach into the interval, are not finite
std::vector<Estimate> bootstrap_rows(std::span<const double> rows, std::size_t width, std::size_t estimates,
                                     const FromMeans& from_means, const BootstrapOptions& options);

/// The same with limits of the bootstrap or of the jackknife, whichever lie further out: value -+ Student's quantile x
/// the standard error from the values without each row. Of ratios of few rows either interval alone holds in 84 to 95 %
/// of the designs, where it is too narrow on the one side or on the other (docs/sensitivity.md has the coverage of both
/// together).
std::vector<Estimate> resampled_rows(std::span<const double> rows, std::size_t width, std::size_t estimates,
                                     const FromMeans& from_means, const BootstrapOptions& options);

/// Means over the rows, one for each of their numbers.
std::vector<double> row_means(std::span<const double> rows, std::size_t width);

} // namespace stylobate

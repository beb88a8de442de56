#pragma once
/// Two shares of the same trials: their difference and their ratio.

#include "ensemble/estimators/fragility/limits.hpp"

#include <cstdint>

namespace stylobate {

/// Trials by two outcomes.
struct PairedCounts {
    std::uint64_t both = 0, first = 0, second = 0, neither = 0; ///< `first`, `second`: that one alone
    std::uint64_t trials() const { return both + first + second + neither; }
};

struct PairedEstimate {
    double value = 0;
    Limits limits;
};

/// First share minus the second: Wald's interval after one trial is added to either of the two kinds that differ
/// (Bonett & Price, "Adjusted Wald confidence interval for a difference of binomial proportions based on paired data",
/// Journal of Educational and Behavioral Statistics 37 (2012) 479).
PairedEstimate paired_difference(const PairedCounts& counts, double level);

/// First share over the second: the normal interval of the logarithm, with its variance
/// (first + second) / ((both + first) (both + second)) (delta method), in which one trial is added to those that differ
/// (own choice: without any that differ the width would be 0). From 0 to infinity where either share is 0.
PairedEstimate paired_ratio(const PairedCounts& counts, double level);

} // namespace stylobate

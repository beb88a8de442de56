#pragma once
/// Curves fitted again to records drawn with replacement.

#include "ensemble/estimators/fragility/curve_target.hpp"

#include <span>

namespace stylobate {

struct BootstrapLimits {
    Limits percentile;
    Limits accelerated;              ///< bias-corrected and accelerated (BCa, Efron 1987)
    Limits studentized;              ///< from the quantiles of (value - estimate) / standard error (bootstrap-t)
    std::size_t without_maximum = 0; ///< resamples whose likelihood has none; they count as infinitely far out
};

/// @param resamples number of them; resample i draws with stream `bootstrap`, index i, elements 0 to records - 1
/// @return one for each target; unbounded where the fit itself has no maximum
std::vector<BootstrapLimits> bootstrap_limits(const FittedCurve& curve, std::span<const CurveTarget> targets,
                                              double level, std::size_t resamples, std::uint64_t seed);

} // namespace stylobate

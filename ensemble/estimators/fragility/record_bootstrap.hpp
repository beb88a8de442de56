#pragma once
/// Curves fitted to records resampled with replacement (Efron & Tibshirani, "An Introduction to the Bootstrap" (1993),
/// chapters 12 to 14).

#include "ensemble/estimators/fragility/curve_target.hpp"

#include <span>

namespace stylobate {

struct BootstrapLimits {
    Limits percentile;
    Limits accelerated;              ///< bias-corrected and accelerated (BCa; Efron, JASA 82 (1987) 171)
    Limits studentized;              ///< from the quantiles of (value - estimate) / standard error (bootstrap-t)
    std::size_t without_maximum = 0; ///< resamples without a maximum; they count as infinite
};

/// @param resamples number of them; resample i draws with stream `bootstrap`, index i, elements 0 to records - 1
/// @return one for each target; unbounded where the fit itself has no maximum
std::vector<BootstrapLimits> bootstrap_limits(const FittedCurve& curve, std::span<const CurveTarget> targets,
                                              double level, std::size_t resamples, std::uint64_t seed);

} // namespace stylobate

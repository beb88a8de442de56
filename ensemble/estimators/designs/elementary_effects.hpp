#pragma once
/// Morris' screening: the mean and the largest effect of moving one factor, for a few runs each.
///
/// A row of the design has a point A, and for each factor k a point A_k that differs from A in this factor alone, by a
/// step of D = 1/2 in the probability of its value (of each of its values, where a factor has several). This is a
/// radial design (Campolongo, Saltelli & Cariboni, "From screening to quantitative sensitivity analysis. A unified
/// approach", Computer Physics Communications 182 (2011) 978) with the step p / (2 (p - 1)) for many levels p of
/// Morris, "Factorial sampling plans for preliminary computational experiments", Technometrics 33 (1991) 161. The
/// elementary effect is
///
///   e_k = (p(A_k) - p(A)) / D,   signed so that the factor moves up
///
/// with p the mean over the rest (sobol_indices.hpp). The reported numbers are
///
///   mu       the mean, with its direction; only of factors with a single value (Morris 1991)
///   mu_star  the mean of |e|. With M draws of the rest the noise of e adds to it, so that no factor has 0
///   rms      the root of the mean of e^2, without the noise: 0 where there is no effect (own derivation, see below)
///   sigma    the standard deviation of e, without the noise, due to interactions and curvature; only of factors with
///            a single value (Morris 1991)
///
/// mu_star: Campolongo, Cariboni & Saltelli, "An effective screening design for sensitivity analysis of large models",
/// Environmental Modelling & Software 22 (2007) 1509. The noise is removed as in sobol_indices.hpp: squares are
/// estimated by products of different draws of the rest. Intervals: `bootstrap_rows`.

#include "ensemble/estimators/designs/sobol_indices.hpp"

namespace stylobate {

struct ElementaryEffects {
    Estimate mu;
    Estimate mu_star;
    Estimate rms;
    Estimate sigma;
    bool acts = false; ///< whether A_k ever differed from A in any outcome
};

/// @param values    points A, A_1 ... in each row
/// @param direction (rows x factors) 1 where the factor moves up from A to A_k, -1 where down; NaN: undefined
/// @throws std::invalid_argument if their numbers do not fit
std::vector<ElementaryEffects> elementary_effects(const DesignValues& values, const std::vector<double>& direction,
                                                  const BootstrapOptions& options);

/// D.
inline constexpr double elementary_step = 0.5;

} // namespace stylobate

#pragma once
/// Morris' screening: what moving one factor does, on the average and at its strongest, for a handful of runs each.
///
/// A row of the design has a point A, and for each factor k a point A_k that differs from A in this factor alone, by a
/// step of D = 1/2 in the probability of its value (of each of its values, where a factor has several); a radial design
/// (Campolongo, Saltelli & Cariboni, Computer Physics Communications 182 (2011) 978) with Morris' own step p / (2 (p -
/// 1)) for many levels p (Technometrics 33 (1991) 161). The elementary effect is
///
///   e_k = (p(A_k) - p(A)) / D,   signed so that the factor moves up
///
/// with p the mean over the rest (sobol_indices.hpp). Told are
///
///   mu       the mean: which way; only of factors with a single value
///   mu_star  the mean of |e|: how much (Campolongo, Cariboni & Saltelli 2007). With M draws of the rest the noise of
///            e adds to it, so that no factor has 0
///   rms      the root of the mean of e^2, its noise taken off: 0 where there is no effect
///   sigma    the spread of e, its noise taken off: by interactions and curvature; only of factors with a single value
///
/// Intervals: `bootstrap_rows`.

#include "ensemble/estimators/sensitivity/sobol_indices.hpp"

namespace stylobate {

struct ElementaryEffects {
    Estimate mu;
    Estimate mu_star;
    Estimate rms;
    Estimate sigma;
    bool acts = false; ///< whether A_k ever differed from A in any outcome
};

/// @param values    points A, A_1 ... in each row
/// @param direction (rows x factors) 1 where the factor moves up from A to A_k, -1 where down; NaN: no such thing
/// @throws std::invalid_argument if their numbers do not fit
std::vector<ElementaryEffects> elementary_effects(const DesignValues& values, const std::vector<double>& direction,
                                                  const BootstrapOptions& options);

/// D.
inline constexpr double elementary_step = 0.5;

} // namespace stylobate

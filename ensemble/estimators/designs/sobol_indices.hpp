#pragma once
/// Sobol's indices: the share of each factor in the variance of an outcome, alone and with all its interactions (Sobol,
/// "Global sensitivity indices for nonlinear mathematical models and their Monte Carlo estimates", Mathematics and
/// Computers in Simulation 55 (2001) 271).
///
/// A row of the design has two independent draws A and B of all factors x, and for each factor k a third point A_k: A
/// with its k-th factor from B (Saltelli et al., "Variance based sensitivity analysis of model output. Design and
/// estimator for the total sensitivity index", Computer Physics Communications 181 (2010) 259). An outcome y depends on
/// the factors and on a rest w, of which each row has M draws, the same ones at all points of the row. p(x) = E[y|x] is
/// the mean over the rest: for outcomes 0 and 1 the probability. Two kinds of indices are reported:
///
///   of the mean    S_k  = Var E[p|x_k] / Var p                 ST_k = E Var[p|x_~k] / Var p
///   of the value   S_k  = Var E[y|x_k] / Var y                 ST_k = E Var[y|x_~k, w] / Var y,   w one factor more
///
/// In a chaotic system a factor that hardly moves the probability may still decide single outcomes: its total index of
/// the value is then near that of the rest, its index of the mean near 0.
///
/// Squares and products of p are estimated by products of outcomes with different draws of the rest (own derivation; a
/// U-statistic),
///
///   <y z> = sum_{i != j} y_i z_j / (M (M - 1)),   E <y_A y_Ak> = E p(A) p(A_k),
///
/// so that the noise of the rest, p (1 - p) / M in the square of a mean of M, does not enter and no bias is left to
/// subtract. From row means of these
///
///   ST_k = (<y_A y_A> + <y_Ak y_Ak> - 2 <y_A y_Ak>) / 2 / V                       (Jansen 1999)
///   S_k  = (<y_B y_Ak> - m_k^2 - beta c) / V_k,   c = <y_A y_B> - m_A m_B         (Janon et al. 2014, for beta = 0)
///
/// with V from A and B, and m_k, V_k from B and A_k. E c = 0 since A and B are independent, so c is a control variate:
/// beta minimizes the variance of S_k, from its regression on c over the jackknife (own choice). For beta = 1 this is
/// Saltelli's estimator, which is exact for a factor without effect but poor for a strong one, where Janon's is good;
/// the regression is as good as the better of the two everywhere (tests/ensemble/estimators/test_sobol_indices.cpp).
/// The bias Var(m) of m^2 is removed; what remains is the bias of a ratio, of order 1 / rows.
///
/// - Jansen, "Analysis of variance designs for model output", Computer Physics Communications 117 (1999) 35.
/// - Janon, Klein, Lagnoux, Nodet & Prieur, "Asymptotic normality and efficiency of two Sobol index estimators", ESAIM:
///   Probability and Statistics 18 (2014) 342.
///
/// Intervals: `resampled_rows`. Their measured coverage is in docs/sensitivity.md.

#include "ensemble/numerics/row_bootstrap.hpp"

#include <cstddef>
#include <vector>

namespace stylobate {

/// Outcomes over a design.
struct DesignValues {
    std::size_t rows = 0;
    std::size_t factors = 0;
    std::size_t inner = 1;     ///< M; 1: there is no rest
    std::vector<double> value; ///< (rows x points x inner); the points of a row: A, B, A_1 ... of Sobol's indices, A,
                               ///< A_1 ... of elementary effects

    double at(std::size_t row, std::size_t point, std::size_t draw, std::size_t points) const
    {
        return value[(row * points + point) * inner + draw];
    }
};

struct FactorIndices {
    Estimate first;
    Estimate total;
};

struct SobolIndices {
    Estimate mean;      ///< of y
    Estimate explained; ///< Var p / Var y: the share of all factors together; 1 - this is that of the rest
    std::vector<FactorIndices> of_mean;  ///< (factors)
    std::vector<FactorIndices> of_value; ///< (factors), and the rest where there is one
    /// Whether the point A_k ever differed from A in any outcome: a factor that never did has no effect at all.
    std::vector<bool> acts;
};

/// Without bias: an estimate may lie below 0 or above 1.
/// @throws std::invalid_argument if the number of values does not fit
SobolIndices sobol_indices(const DesignValues& values, const BootstrapOptions& options);

/// Indices as shares that are possible: estimates and intervals cut to [0, 1]. An interval keeps its coverage when
/// what cannot be true is cut from it. Where nothing of it is left, the index is not determined.
SobolIndices possible_shares(SobolIndices indices);

// Morris' screening: the mean and the largest effect of moving one factor, for a few runs each.
//
// A row of the design has a point A, and for each factor k a point A_k that differs from A in this factor alone, by a
// step of D = 1/2 in the probability of its value (of each of its values, where a factor has several). This is a
// radial design (Campolongo, Saltelli & Cariboni, "From screening to quantitative sensitivity analysis. A unified
// approach", Computer Physics Communications 182 (2011) 978) with the step p / (2 (p - 1)) for many levels p of
// Morris, "Factorial sampling plans for preliminary computational experiments", Technometrics 33 (1991) 161. The
// elementary effect is
//
//   e_k = (p(A_k) - p(A)) / D,   signed so that the factor moves up
//
// with p the mean over the rest (`sobol_indices`). The reported numbers are
//
//   mu       the mean, with its direction; only of factors with a single value (Morris 1991)
//   mu_star  the mean of |e|. With M draws of the rest the noise of e adds to it, so that no factor has 0
//   rms      the root of the mean of e^2, without the noise: 0 where there is no effect (own derivation, see below)
//   sigma    the standard deviation of e, without the noise, due to interactions and curvature; only of factors with
//            a single value (Morris 1991)
//
// mu_star: Campolongo, Cariboni & Saltelli, "An effective screening design for sensitivity analysis of large models",
// Environmental Modelling & Software 22 (2007) 1509. The noise is removed as in the indices of Sobol: squares are
// estimated by products of different draws of the rest. Intervals: `bootstrap_rows`.

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

#pragma once
/// Sobol's indices: which factors the variance of an outcome comes from, alone and with all that they interact with.
///
/// A row of the design has two independent draws A and B of all factors x, and for each factor k a third point A_k: A
/// with its k-th factor from B (Saltelli et al., Computer Physics Communications 181 (2010) 259). An outcome y depends
/// on the factors and on a rest w, of which each row has M draws, the same ones at all points of the row. p(x) = E[y|x]
/// is the mean over the rest: of 0 and 1 the probability. Two kinds of indices are told:
///
///   of the mean    S_k  = Var E[p|x_k] / Var p                 ST_k = E Var[p|x_~k] / Var p
///   of the value   S_k  = Var E[y|x_k] / Var y                 ST_k = E Var[y|x_~k, w] / Var y,   w one factor more
///
/// In a chaotic system a factor that hardly moves the probability may still decide single outcomes: its total index of
/// the value is then near that of the rest, its index of the mean near 0.
///
/// Squares and products of p are estimated by products of outcomes with different draws of the rest,
///
///   <y z> = sum_{i != j} y_i z_j / (M (M - 1)),   E <y_A y_Ak> = E p(A) p(A_k),
///
/// so that the noise of the rest, p (1 - p) / M in the square of a mean of M, never gets in: no bias is left to
/// subtract. From row means of these
///
///   ST_k = (<y_A y_A> + <y_Ak y_Ak> - 2 <y_A y_Ak>) / 2 / V                       (Jansen 1999)
///   S_k  = (<y_B y_Ak> - m_k^2 - beta c) / V_k,   c = <y_A y_B> - m_A m_B         (Janon et al. 2014, for beta = 0)
///
/// with V from A and B, and m_k, V_k from B and A_k. E c = 0 since A and B are independent, so it may be taken out in
/// any amount: beta is where the variance of S_k is least, from its regression on c over the jackknife. For beta = 1
/// this is Saltelli's estimator, which is exact for a factor without effect but poor for a strong one, where Janon's is
/// good; the regression is as good as the better of the two everywhere
/// (tests/ensemble/estimators/test_sobol_indices.cpp). m^2 is freed of its bias Var(m); what remains is the bias of a
/// ratio, of order 1 / rows.
///
/// Intervals: `resampled_rows`. Their measured coverage is in docs/sensitivity.md.

#include "ensemble/estimators/resampling/row_bootstrap.hpp"

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
    Estimate mean;                       ///< of y
    Estimate explained;                  ///< Var p / Var y: what all factors together leave to the rest is 1 - this
    std::vector<FactorIndices> of_mean;  ///< (factors)
    std::vector<FactorIndices> of_value; ///< (factors), and the rest where there is one
    /// Whether the point A_k ever differed from A in any outcome: a factor that never did has no effect at all.
    std::vector<bool> acts;
};

/// @throws std::invalid_argument if the number of values does not fit
SobolIndices sobol_indices(const DesignValues& values, const BootstrapOptions& options);

} // namespace stylobate

#pragma once
/// What neighbouring cells say about a cell: a smooth surface of the collapse probability, for intervals that borrow.
///
/// Of a cell's own trials, s collapses in n, the likelihood is binomial. What its neighbours say comes first, as a
/// distribution of u = logit p there:
///
///   p(u) = (1 - e) sum over t of w_t N(u; m_t, v_t) + e B(u)
///
/// and the cell's interval is that of  p(u) x binomial(s | n, p(u)), by quadrature: equal tails, with the lower limit 0
/// where nothing collapsed and the upper one 1 where all did, as elsewhere.
///
/// - m_t, v_t: a latent Gaussian process (Matern 5/2, lengths l_f and l_a in steps of the grid, standard deviation sd,
///   about a level of its own, with an independent departure `misfit` of each cell from it) given the trials of the
///   other cells of the window, two cells to either side, by Laplace's approximation. The cell itself is left out, so
///   that each prediction is one of data that it has not seen; its own departure is in v_t.
/// - w_t: how well the setting t = (l_f, l_a, sd, misfit) has predicted what was held out in the windows of the
///   cells around, the cell itself left out again: exp of the sum of log scores. So it is measured, place by place, how
///   far one may borrow and in which direction: along a cliff, far; across it, not.
/// - e: how often what neighbours say is just wrong. B is Jeffreys' prior of a probability: where a cell contradicts
/// its
///   neighbours, what is left is the interval of its own trials. (The robust mixture of Schmidli et al., Biometrics 70
///   (2014) 1023.) e is one of two values, weighed as the settings are.
///
/// Where B has more than half of the weight, the neighbours are not believed at all (`believed` is false), and the
/// interval of the cell's own trials is to be taken.
///
/// An interval that borrows is as good as the surface is smooth: its coverage is right on average over cells of
/// surfaces like those that it was measured on (tests/ensemble/estimators/test_surface_model.cpp, docs/adaptive.md),
/// not for every cell. A single cell that differs from all its neighbours is found by its own trials only: at the
/// fewest of them, 8, a probability of 0.8 amid ones is missed once in six times.
///
/// Rasmussen & Williams, "Gaussian Processes for Machine Learning" (2006), algorithms 3.1 and 3.2; predictive scores:
/// Vehtari et al., JMLR 17 (2016) 103.

#include "ensemble/numerics/interval.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stylobate {

/// Trials and collapses of the cells, (rows x columns), row by row.
struct SurfaceTrials {
    std::size_t rows = 0;    ///< frequencies
    std::size_t columns = 0; ///< PGAs
    std::vector<std::uint64_t> trials;
    std::vector<std::uint64_t> collapses;
    std::size_t cells() const { return rows * columns; }
};

/// What the model says of a cell.
struct SurfaceEstimate {
    double probability = 0.5; ///< mean
    BinomialInterval interval;
    bool believed = false; ///< the cell's own trials agree with what its neighbours say
};

class SurfaceModel {
public:
    /// @param level confidence, in (0, 1)
    explicit SurfaceModel(double level) : level_(level) {}

    /// Of every cell. The same data give the same bits, whatever the number of threads and whatever was asked before;
    /// what has not changed since the last time is not computed again.
    std::vector<SurfaceEstimate> estimate(const SurfaceTrials& data);

private:
    /// What the neighbours of one cell say: for every setting, and how well it predicted the cell's own trials.
    struct Neighbours {
        std::vector<double> mean;     ///< m_t (settings)
        std::vector<double> variance; ///< v_t (settings)
        std::vector<double> evidence; ///< of the cell's trials under N(m_t, v_t) (settings)
        double evidence_alone = 0;    ///< and under B
    };
    double level_;
    SurfaceTrials last_;
    std::vector<Neighbours> neighbours_; ///< by cell, of `last_`
};

} // namespace stylobate

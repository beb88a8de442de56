#pragma once
/// Which realizations of a surface are run: more where the interval is wide, until every cell's is narrow enough.
///
/// The allocation proceeds round by round (own derivation). In the first round every cell gets the realizations of its
/// first interim analysis; after each round the cells whose interval is still too wide proceed to their next one
/// (`InterimAnalyses`). A cell takes its realizations in their order, k = 0, 1, 2, ..., so that those that are run are
/// a subset of the whole study, with the same bits. A round depends on the outcomes of those before it alone, not on
/// threads or interruptions, and is large enough to keep the lanes full.
///
/// The interval of a cell is that of its own trials, valid under this stopping rule (`interim_analyses.hpp`). With
/// `borrow`, where a cell agrees with its neighbours, it is the pooled interval of the surface model
/// (`SurfaceModel`), unless only its own is narrow enough. The intervals of all cells are computed from all trials
/// after every round; a cell that was narrow enough continues if new trials of its neighbours have made its interval
/// too wide. A posterior interval does not depend on the stopping rule; its coverage depends on the smoothness of the
/// surface, and is measured.
///
/// Where the budget is not sufficient, the widest cells come first; their intervals stay valid, and wider than
/// requested.

#include "ensemble/estimators/surface/interim_analyses.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/numerics/interval.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stylobate {

// Information of neighbouring cells on a cell: a smooth surface of the collapse probability, for pooled intervals.
//
// The likelihood of a cell's own trials, s collapses in n, is binomial. The prior is the information of its
// neighbours, a distribution of u = logit p at the cell:
//
//   p(u) = (1 - e) sum over t of w_t N(u; m_t, v_t) + e B(u)
//
// and the cell's interval is that of  p(u) x binomial(s | n, p(u)), by quadrature: equal tails, with the lower limit 0
// where nothing collapsed and the upper one 1 where all did, as elsewhere.
//
// - m_t, v_t: a latent Gaussian process (Matern 5/2, lengths l_f and l_a in steps of the grid, standard deviation sd,
//   about a level of its own, with an independent departure `misfit` of each cell from it) given the trials of the
//   other cells of the window, two cells to either side, by Laplace's approximation (Rasmussen & Williams, "Gaussian
//   Processes for Machine Learning" (2006), algorithms 3.1 and 3.2). The cell itself is left out, so that each
//   prediction is independent of its data; its own departure is in v_t.
// - w_t: how well the setting t = (l_f, l_a, sd, misfit) predicts the held-out trials in the windows of the
//   surrounding cells, the cell itself left out again: exp of the sum of log scores (predictive scores: Vehtari et
//   al., "Bayesian leave-one-out cross-validation approximations for Gaussian latent variable models", Journal of
//   Machine Learning Research 17 (2016) 103; their use as local weights is an own choice). The range of pooling in
//   each direction is thus estimated locally: large along a cliff, small across it.
// - e: the probability that the neighbours carry no information. B is Jeffreys' prior of a probability: a cell that
//   contradicts its neighbours has the interval of its own trials (the robust mixture of Schmidli et al., "Robust
//   meta-analytic-predictive priors in clinical trials with historical control information", Biometrics 70 (2014)
//   1023). e is one of two values, weighted as the settings are.
//
// Where B has more than half of the weight, the neighbours are disregarded (`agrees_with_neighbours` is false), and
// the interval of the cell's own trials is to be used.
//
// The coverage of a pooled interval depends on the smoothness of the surface: it is right on average over cells of
// surfaces like those on which it was measured (tests/ensemble/estimators/test_surface_model.cpp, docs/adaptive.md),
// not for every cell. A single cell that differs from all its neighbours is detected by its own trials only: with the
// fewest of them, 8, a probability of 0.8 whose neighbours all have 1 is missed once in six times.

/// Trials and collapses of the cells, (rows x columns), row by row.
struct SurfaceTrials {
    std::size_t rows = 0;    ///< frequencies
    std::size_t columns = 0; ///< PGAs
    std::vector<std::uint64_t> trials;
    std::vector<std::uint64_t> collapses;
    std::size_t cells() const { return rows * columns; }
};

/// The estimate of the model for a cell.
struct SurfaceEstimate {
    double probability = 0.5; ///< mean
    BinomialInterval interval;
    bool agrees_with_neighbours = false; ///< the cell's own trials agree with its neighbours
};

class SurfaceModel {
public:
    /// @param level confidence, in (0, 1)
    explicit SurfaceModel(double level) : level_(level) {}

    /// The estimates of every cell. The same data give the same bits, whatever the number of threads and the earlier
    /// calls; unchanged parts are not computed again.
    std::vector<SurfaceEstimate> estimate(const SurfaceTrials& data);

private:
    /// The predictions of one cell's neighbours, for every setting, and how well each predicted the cell's own trials.
    struct Neighbours {
        std::vector<double> mean;     ///< m_t (settings)
        std::vector<double> variance; ///< v_t (settings)
        std::vector<double> evidence; ///< of the cell's trials under N(m_t, v_t) (settings)
        double evidence_alone = 0;    ///< and under B
    };
    /// Computes again what the trials of a cell and of its window have changed.
    void update(std::size_t cell, const SurfaceTrials& data, bool same_grid);
    /// The interval of a cell: its own trials under the prior of its neighbours.
    SurfaceEstimate combined(std::size_t cell, const SurfaceTrials& data) const;

    double level_;
    SurfaceTrials last_;
    std::vector<Neighbours> neighbours_; ///< by cell, of `last_`
};

/// The estimate of a cell.
struct CellEstimate {
    double probability = 0; ///< own: the share of its trials, NaN without any; surface: the posterior mean
    BinomialInterval interval;
    IntervalMethod method = IntervalMethod::own;
};

class AdaptiveAllocation {
public:
    /// @param most realizations of one cell (the study's)
    /// @pre spec.minimum <= most, spec.minimum * rows * columns <= spec.budget
    AdaptiveAllocation(const AdaptiveSpec& spec, std::size_t rows, std::size_t columns, std::uint64_t most);

    /// Realizations of each cell (cells) after the next round, given the trials among those requested so far; the first
    /// time of none. If they are the same as before, the allocation is finished.
    const std::vector<std::uint64_t>& next(const SurfaceTrials& data);
    /// So far.
    const std::vector<std::uint64_t>& asked() const { return rounds_.asked(); }
    std::uint64_t rounds() const { return rounds_.rounds(); }

    /// Of every cell.
    std::vector<CellEstimate> estimate(const SurfaceTrials& data);
    const InterimAnalyses& analyses() const { return analyses_; }

private:
    AdaptiveSpec spec_;
    InterimAnalyses analyses_;
    SurfaceModel model_;
    SurfaceTrials known_; ///< what was estimated last, and from what
    std::vector<CellEstimate> estimates_;
    WidestFirst rounds_;
};

} // namespace stylobate

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
/// (`surface_model.hpp`), unless only its own is narrow enough. The intervals of all cells are computed from all trials
/// after every round; a cell that was narrow enough continues if new trials of its neighbours have made its interval
/// too wide. A posterior interval does not depend on the stopping rule; its coverage depends on the smoothness of the
/// surface, and is measured.
///
/// Where the budget is not sufficient, the widest cells come first; their intervals stay valid, and wider than
/// requested.

#include "ensemble/estimators/surface/interim_analyses.hpp"
#include "ensemble/estimators/surface/surface_model.hpp"
#include "ensemble/model/study.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

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

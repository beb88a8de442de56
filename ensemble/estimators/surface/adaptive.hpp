#pragma once
/// Which realizations of a surface are run: more where the interval is wide, until every cell's is narrow enough.
///
/// It goes round by round. In the first one every cell gets its first look's realizations; after each round the cells
/// whose interval is still too wide go on to their next look (`AdaptiveLooks`). A cell takes its realizations in their
/// order, k = 0, 1, 2, ..., so that what is run is a part of what the whole study would run, with the same bits. A
/// round depends on the outcomes of those before it alone, not on threads or interruptions, and is large enough to keep
/// the lanes full.
///
/// A cell's interval is that of its own trials, valid under this rule (`adaptive_looks.hpp`); or, with `borrow`, where
/// a cell agrees with its neighbours, that of the surface model (`surface_model.hpp`) unless only its own is narrow
/// enough. The intervals of all cells are computed from all trials after every round, so a cell that was narrow enough
/// goes on if what its neighbours have shown since has made it too wide. An interval that begins with what is known
/// beforehand (a posterior) is not bent by the rule of stopping; that it is right is a matter of the surface's
/// smoothness, and measured.
///
/// Where the budget does not reach, the widest cells come first; their intervals stay right, and wider than asked for.

#include "ensemble/estimators/surface/adaptive_looks.hpp"
#include "ensemble/estimators/surface/surface_model.hpp"
#include "ensemble/model/study.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// What is known of a cell.
struct CellEstimate {
    double probability = 0; ///< of its own trials their share, NaN without any; of the surface the posterior mean
    BinomialInterval interval;
    IntervalMethod method = IntervalMethod::own;
};

class AdaptiveAllocation {
public:
    /// @param most realizations of one cell (the study's)
    /// @pre spec.minimum <= most, spec.minimum * rows * columns <= spec.budget
    AdaptiveAllocation(const AdaptiveSpec& spec, std::size_t rows, std::size_t columns, std::uint64_t most);

    /// Realizations of each cell (cells) after the next round, given the trials among those asked for so far; the first
    /// time of none. The same as before: it is finished.
    const std::vector<std::uint64_t>& next(const SurfaceTrials& data);
    /// So far.
    const std::vector<std::uint64_t>& asked() const { return asked_; }
    std::uint64_t rounds() const { return rounds_; }

    /// Of every cell.
    std::vector<CellEstimate> estimate(const SurfaceTrials& data);
    const AdaptiveLooks& looks() const { return looks_; }

private:
    AdaptiveSpec spec_;
    AdaptiveLooks looks_;
    SurfaceModel model_;
    SurfaceTrials known_; ///< what was estimated last, and from what
    std::vector<CellEstimate> estimates_;
    std::vector<std::uint64_t> asked_;
    std::uint64_t rounds_ = 0;
};

} // namespace stylobate

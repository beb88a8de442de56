#pragma once
/// Which pairs of a surface are run: more where the difference is undecided.
///
/// Round by round, as on an adaptive surface (estimators/surface/adaptive.hpp): every cell begins with the pairs of its
/// first look; after each round the cells that are undecided proceed to their next one, the widest intervals first,
/// until the budget is spent. A cell is decided where its repeated interval excludes 0, or lies within the difference
/// that matters on both sides. A cell takes its pairs in the order of their indices. A round depends on the outcomes of
/// those before it alone.

#include "ensemble/estimators/paired/paired_counts.hpp"
#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/estimators/paired/repeated_looks.hpp"
#include "ensemble/estimators/surface/widest_first.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace stylobate {

struct PairedBudget {
    std::uint64_t pairs = 0;   ///< of all cells together, at most
    std::uint64_t minimum = 8; ///< of each cell
    double margin = 0.05;      ///< a difference that is smaller does not matter
};

class PairedAllocation {
public:
    /// @param most pairs of one cell   @pre minimum <= most, minimum * cells <= pairs
    PairedAllocation(const PairedBudget& budget, std::size_t cells, std::uint64_t most, double level);

    /// Pairs of each cell after the next round, from the counts among those requested so far; the first time of none.
    /// If they are the same as before, the allocation is finished.
    const std::vector<std::uint64_t>& next(std::span<const PairedCounts> counts);
    const std::vector<std::uint64_t>& asked() const { return rounds_.asked(); }
    std::uint64_t rounds() const { return rounds_.rounds(); }
    const RepeatedLooks& looks() const { return looks_; }
    /// Whether a cell needs no more pairs.
    bool decided(const PairedCounts& counts) const;

private:
    PairedDifference interval(const PairedCounts& counts) const;

    PairedBudget budget_;
    RepeatedLooks looks_;
    WidestFirst rounds_;
};

} // namespace stylobate

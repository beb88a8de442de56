#pragma once
/// Which pairs of a surface are run: more where the difference is undecided.
///
/// Round by round, as on an adaptive surface (estimators/surface/adaptive.hpp): every cell begins with the pairs of its
/// first look; after each round the cells that are undecided proceed to their next one, the widest intervals first,
/// until the budget is spent. A cell is decided where its repeated interval excludes 0, or lies within the difference
/// that matters on both sides. A cell takes its pairs in the order of their indices. A round depends on the outcomes of
/// those before it alone.

#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/estimators/surface/interim_analyses.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace stylobate {

// Intervals that stay valid where pairs are added until the difference is decided.
//
// A cell is looked at after n_1 < n_2 < ... < n_K pairs. An interval of a fixed number of pairs is too narrow then: to
// stop where it excludes 0 is to choose the moment. A repeated confidence interval (Jennison & Turnbull, "Interim
// analyses: the repeated confidence interval approach", Journal of the Royal Statistical Society B 51 (1989) 305)
// takes the same quantile c at every look, so large that all K intervals together hold with the level:
//
//   P(|W(n_k)| < c sqrt(n_k) for all k) = level,   W Brownian motion
//
// (Pocock, "Group sequential methods in the design and analysis of clinical trials", Biometrika 64 (1977) 191; the
// integral over the increments after Armitage, McPherson & Rowe, "Repeated significance tests on accumulating data",
// Journal of the Royal Statistical Society A 132 (1969) 235). Whatever decides when to stop, also the outcomes of
// other cells or the end of a budget, the interval at that look is one of the K. Here it is Tango's score interval at
// c (paired_difference.hpp); docs/compare.md has the measured coverage.

class RepeatedLooks {
public:
    /// @param first pairs at the first look   @param most at the last one   @pre 1 <= first <= most
    RepeatedLooks(std::uint64_t first, std::uint64_t most, double level);
    /// At looks that are given, ascending.
    RepeatedLooks(std::vector<std::uint64_t> pairs, double level);

    /// n_1 ... n_K: each about half more than the one before.
    const std::vector<std::uint64_t>& pairs() const { return pairs_; }
    /// The first look with more pairs than these; the last one if there is none.
    std::uint64_t after(std::uint64_t pairs) const { return next_look(pairs_, pairs); }
    /// c.
    double quantile() const { return quantile_; }
    /// Two-sided p-value, valid at any look: the probability that at some look |W| / sqrt(n) is as large as this.
    double p_value(double z) const;

private:
    /// P(|W(n_k)| < c sqrt(n_k) for all k)
    double inside(double c) const;

    std::vector<std::uint64_t> pairs_;
    double quantile_ = 0;
};

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

#pragma once
/// From the realizations of two studies to what the intervention changes.

#include "ensemble/estimators/paired/repeated_looks.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/study_side.hpp"

namespace stylobate {

/// How the pairs of a study are divided.
struct PairLayout {
    std::size_t cells = 1;      ///< of a surface, or stripes
    std::size_t groups = 0;     ///< different motions; 0: pairs are independent of each other
    std::uint64_t per_cell = 1; ///< realizations in a cell of a surface, or under a motion in a stripe
    MotionGroups motions = {};
    double level = interval_level;
    // of an adaptive comparison
    std::vector<std::uint64_t> asked = {}; ///< (cells) of each cell's realizations the first so many; empty: all
    const RepeatedLooks* looks = nullptr;  ///< whose quantile makes intervals valid; null: numbers are fixed

    std::size_t cell(std::uint64_t index) const { return groups > 0 ? index / per_cell % cells : index / per_cell; }
    /// Whether a realization takes part.
    bool has(std::uint64_t index) const { return asked.empty() || index % per_cell < asked[index / per_cell]; }
    std::size_t group(std::uint64_t index) const { return groups > 0 ? motions.of_cell(index / per_cell) : 0; }
};
/// @param motions of the header of its results
PairLayout pair_layout(const Study& study, const MotionTable& motions, double level);

/// Pairs of one limit state: counts[cell * groups + group].
std::vector<PairedCounts> count_pairs(const StudySide& base, const StudySide& variant, std::size_t base_limit,
                                      std::size_t variant_limit, const PairLayout& layout);

/// One place from the counts of its groups, or of its single group.
PlaceComparison compare_place(std::span<const PairedCounts> groups, const PairLayout& layout);
/// All cells together: over motions in a fragility study, else each cell with the same weight.
PlaceComparison compare_overall(std::span<const PairedCounts> counts, const PairLayout& layout);

/// All that is known of the pairs: counts, limit states that both studies have, common draws. The name, the study and
/// the notes are left to the caller.
VariantComparison compare_sides(const StudySide& base, const std::vector<std::string>& base_inputs,
                                const StudySide& variant, const std::vector<std::string>& variant_inputs,
                                const PairLayout& layout);

} // namespace stylobate

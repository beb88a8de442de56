#pragma once
/// Studies paired realization by realization: which limit states each reached, and what the intervention changes.

#include "ensemble/estimators/paired/paired_allocation.hpp"
#include "io/store/result_store.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/experiment/limit_state.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct LimitDefinition {
    std::string name, describe;
    bool damage = true;                                           ///< whether more of it is worse
    std::function<std::optional<bool>(const ResultRow&)> reached; ///< of a valid realization; nothing: not known
};

/// What became of the realizations of a study, by index.
class StudySide {
public:
    /// Without rows as yet. @param study, header must outlive it
    StudySide(const Study& study, const ResultHeader& header);

    void add(const ResultRow& row);

    bool has(std::uint64_t index) const { return (state_[index] & present) != 0; }
    bool valid(std::uint64_t index) const { return (state_[index] & invalid) == 0; }
    /// Whether it is a valid realization of which is known whether it reached the limit state. @pre has(index)
    bool known(std::uint64_t index, std::size_t limit) const
    {
        return valid(index) && (state_[index] >> (most_limits + limit) & 1) == 0;
    }
    /// @pre has(index) && known(index, limit)
    bool reached(std::uint64_t index, std::size_t limit) const { return (state_[index] >> limit & 1) != 0; }
    std::uint64_t size() const { return state_.size(); }
    const std::vector<LimitDefinition>& limits() const { return limits_; }

    /// Draws of the first realizations of each cell, for the question which numbers two studies have in common: an
    /// adaptive comparison has the first ones, too.
    struct Draws {
        std::uint64_t index;
        std::vector<double> inputs;
    };
    /// In the order of their indices.
    std::vector<Draws> draws() const;

private:
    // a bit for each limit state that was reached, one for each of which it is not known, and these
    static constexpr std::size_t most_limits = 30;
    static constexpr std::uint64_t present = 1ull << 63, invalid = 1ull << 62;
    static constexpr std::uint64_t most_draws = 512; ///< or one of each cell

    std::vector<LimitDefinition> limits_;
    std::vector<std::uint64_t> state_;
    std::vector<Draws> draws_;
    std::uint64_t per_cell_, drawn_per_cell_; ///< realizations of a cell, and those of them that keep their draws
};

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

/// What two studies have in common, by quantity, and of a quantity by relation. A number is the same if all pairs have
/// the same bits; it is the same quantile if the order of the realizations is the same.
/// @param names of the inputs: "friction[3]"
std::vector<CommonInput> common_inputs(const std::vector<StudySide::Draws>& base,
                                       const std::vector<std::string>& base_names,
                                       const std::vector<StudySide::Draws>& variant,
                                       const std::vector<std::string>& variant_names);

/// Pairs that are looked at, at most: the first ones of each cell.
inline constexpr std::uint64_t most_dependence_pairs = 4'000'000;

/// The quantities of the base that vary, the one with the smallest p-value first. None where pairs share motions (a
/// fragility study): the test wants independent pairs.
/// @param rows of the base   @param base_limit, variant_limit the limit state among those of each side
std::vector<InputDependence> input_dependences(const ResultReader& rows, const StudySide& base,
                                               const StudySide& variant, std::size_t base_limit,
                                               std::size_t variant_limit, const PairLayout& layout);

} // namespace stylobate

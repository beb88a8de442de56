#pragma once
/// What is counted of the realizations of a surface that keeps no row of them: a few kilobytes, however many they are.

#include "ensemble/model/outcome.hpp"
#include "ensemble/model/time_counts.hpp"

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace stylobate {

/// What is counted of one realization.
struct TallyEntry {
    std::uint64_t index = 0;
    std::uint64_t cell = 0;
    InvalidReason invalid = InvalidReason::none; ///< else it is no trial, and nothing below counts
    std::uint32_t reached = 0;                   ///< bit k: limit state k of `ResultHeader::limit_states`
    std::int32_t first_block = -1;               ///< as `Outcome::first_collapse_block`
    double collapse_time_s = -1;                 ///< -1: none
    double total_collapse_time_s = -1;           ///< -1: none
    double energy_residual = 0;
};

/// The counts. They depend on which realizations were added, not on their order.
struct Tally {
    /// Invalid realizations of which the index is kept: those of the lowest indices.
    static constexpr std::size_t most_invalid = 100;
    static constexpr std::uint64_t no_realization = ~std::uint64_t{0};

    Tally() = default;
    Tally(std::size_t cells, std::size_t limit_states, std::size_t blocks);

    std::size_t limit_states = 0, blocks = 0;
    std::vector<std::uint64_t> trials;                    ///< (cells) valid realizations
    std::vector<std::uint64_t> invalid;                   ///< (cells)
    std::vector<std::uint64_t> reached;                   ///< (cells x limit states) of the valid ones
    std::vector<std::uint64_t> first;                     ///< (cells x blocks) how often each fell before all others
    std::vector<std::uint64_t> first_together;            ///< (cells) how often several fell first, at the same step
    TimeCounts collapse_time_s, total_collapse_time_s;    ///< over all cells
    std::map<std::uint64_t, InvalidReason> first_invalid; ///< by index
    double energy_residual = 0;                           ///< of the valid ones that of the greatest magnitude,
    std::uint64_t energy_realization = no_realization;    ///< and whose it is, of several the lowest index

    std::size_t cells() const { return trials.size(); }
    /// Counts of each cell that are by "limit_state", "block" or nothing else.
    std::size_t width(std::string_view by) const
    {
        return by == "limit_state" ? limit_states : by == "block" ? blocks : 1;
    }
    std::uint64_t all_trials() const;
    std::uint64_t all_invalid() const;
    /// Realizations that were added.
    std::uint64_t added() const { return all_trials() + all_invalid(); }
    /// Over all cells. @param limit number of the limit state
    std::uint64_t all_reached(std::size_t limit) const;

    /// @throws std::invalid_argument if there is no such cell or block
    void add(const TallyEntry& entry);
    /// The counts of other realizations of the same study. @throws std::invalid_argument if its shape is another one
    void add(const Tally& other);

private:
    void keep_worst(double residual, std::uint64_t realization);
};

/// The counts of each cell: f(name in files, field, what else they are counted by: "limit_state", "block" or nothing,
/// facts).
template <class F>
void visit_fields(std::type_identity<Tally>, F&& f)
{
    f("trials", &Tally::trials, "", FieldFacts{.says = "valid realizations"});
    f("invalid", &Tally::invalid, "", FieldFacts{.says = "invalid realizations"});
    f("reached", &Tally::reached, "limit_state", FieldFacts{.says = "realizations that reached the limit state"});
    f("first_fallen", &Tally::first, "block", FieldFacts{.says = "realizations in which the block fell first"});
    f("first_together", &Tally::first_together, "",
      FieldFacts{.says = "realizations in which several blocks fell first, together"});
}

} // namespace stylobate

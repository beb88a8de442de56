#pragma once
/// What is counted of the realizations of a surface that keeps no row of them: a few kilobytes, however many they are.

#include "ensemble/model/outcome.hpp"
#include "ensemble/model/time_counts.hpp"

#include <cstdint>
#include <map>
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

} // namespace stylobate

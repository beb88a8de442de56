#pragma once
/// Counts of a results file without rows, against the study, each other, and realizations run again.

#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"
#include "studies/verify/verification.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// Whether the counts agree: those of a cell with the number of its realizations, limit states with trials, first falls
/// and times with collapses, and all of them with the list of what is done.
/// @pre the file has counts
FileCheck check_counts(const Study& study, const ResultReader& reader);

/// Counts of whole cells and single realizations, as they come out when they are run again.
class CountReplay {
public:
    /// Chooses cells of which all realizations are counted, as many as `most` realizations allow, and beside them the
    /// realization with the largest residual of energy and some of the invalid ones.
    /// @param seed of the choice of the cells   @pre the file has counts
    CountReplay(const Study& study, const ResultReader& reader, std::uint64_t most, std::uint64_t seed);

    /// Ascending, each once.
    const std::vector<std::uint64_t>& indices() const { return indices_; }
    /// Takes a realization that was run again. Called from one thread at a time.
    void take(const ResultRow& row);
    /// Compares what was taken.
    void conclude(FileCheck& check) const;

private:
    const Study& study_;
    const ResultHeader& header_;
    const Tally& tally_;
    std::vector<std::uint64_t> cells_;   ///< ascending
    std::vector<std::uint64_t> singles_; ///< ascending
    std::vector<std::uint64_t> indices_;
    Tally again_;                   ///< of `cells_`
    std::vector<TallyEntry> taken_; ///< of `singles_`
};

} // namespace stylobate

#pragma once
/// Values of a results file: rows against the study, each other, and the same realization run again; tables against
/// those that the rows or counts make again; counts against the study, each other, and realizations run again.

#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/table.hpp"
#include "studies/verify/verification.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// Every row: its cell, its state and the reason of an invalid one, and of a valid one that its numbers are finite,
/// that lengths, times and counts are not negative, and that the fall times agree with the values derived from them.
/// @returns the check "rows"; a row with another cell than its index's is `wrong_cell`
struct RowChecks {
    FileCheck check;
    bool wrong_cell = false;
};
RowChecks check_rows(const Study& study, const ResultReader& reader);

/// Adds each value of which the bits differ, by its name in the file.
/// @pre both are of one study
void compare_rows(const ResultHeader& header, const ResultRow& stored, const ResultRow& again, FileCheck& check);

/// Adds the first difference of each list of two trajectories.
void compare_trajectories(const Trajectory& stored, const Trajectory& again, FileCheck& check);

/// Adds each value of a table of which the bits differ.
void compare_surfaces(const SurfaceTable& stored, const SurfaceTable& again, FileCheck& check);
void compare_tables(const Table& stored, const Table& again, FileCheck& check);

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

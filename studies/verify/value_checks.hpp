#pragma once
/// Values of a results file: rows against the study, each other, and the same realization run again; tables against
/// those that the rows or counts make again.

#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/table.hpp"
#include "studies/verify/verification.hpp"

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

} // namespace stylobate

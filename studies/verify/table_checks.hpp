#pragma once
/// Tables of a results file, against those that its rows or counts make again.

#include "io/store/result_store.hpp"
#include "io/tables/table.hpp"
#include "studies/verify/verification.hpp"

namespace stylobate {

/// Adds each value of which the bits differ.
void compare_surfaces(const SurfaceTable& stored, const SurfaceTable& again, FileCheck& check);
void compare_tables(const Table& stored, const Table& again, FileCheck& check);

} // namespace stylobate

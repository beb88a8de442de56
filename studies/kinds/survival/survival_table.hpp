#pragma once
/// The table /survival of a results file, and the likelihoods of several files together.

#include "io/tables/table.hpp"
#include "studies/kinds/survival/survival.hpp"

#include <string>

namespace stylobate {

Table survival_table(const Survival& survival);
/// The counts of the cells, of a table that was read. @throws InputError if it is not as it was written
std::vector<CellCount> agreeing_counts(const Table& table, const PastAxes& axes);
/// Cell by cell.
std::string survival_csv(const Survival& survival);

} // namespace stylobate

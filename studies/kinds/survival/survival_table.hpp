#pragma once
/// The table /survival of a results file.

#include "io/tables/table.hpp"
#include "studies/kinds/survival/survival.hpp"

#include <string>

namespace stylobate {

Table survival_table(const Survival& survival);
/// Cell by cell.
std::string survival_csv(const Survival& survival);

} // namespace stylobate

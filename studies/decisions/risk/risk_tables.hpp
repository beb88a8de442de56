#pragma once
/// Tables that the files of risk estimates have in common.

#include "ensemble/estimators/risk/hazard.hpp"
#include "ensemble/estimators/risk/risk_number.hpp"
#include "io/tables/table.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// The columns of a number with all its limits [1/year].
void add_numbers(Table& table, const std::string& name, const std::vector<RiskNumber>& numbers);
/// @throws InputError if the table was not written so
std::vector<RiskNumber> numbers_of(const Table& table, const std::string& name, const Table::Shape& shape);

/// /hazard.
Table hazard_table(const HazardModel& hazard);
/// @throws InputError if it is none
HazardModel hazard_of(const Table& table);

} // namespace stylobate

#pragma once
/// Tables that the files of risk estimates have in common.

#include "ensemble/estimators/risk/frequency_change.hpp"
#include "ensemble/estimators/risk/hazard.hpp"
#include "ensemble/estimators/risk/risk_number.hpp"
#include "io/tables/table.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// The columns of a RiskNumber or a ChangeNumber with all its limits.
template <class Number>
void add_numbers(Table& table, const std::string& name, const std::vector<Number>& numbers,
                 const std::string& unit = "1/year");
/// @throws InputError if the table was not written so
template <class Number>
std::vector<Number> numbers_of(const Table& table, const std::string& name, const Table::Shape& shape);

/// A level of intervals. @throws InputError if it is none
double level_of(const Table& table, const char* name);
/// @throws InputError if there are none, or if one is not above 0 and finite
std::vector<double> years_of(const Table& table);

/// /hazard.
Table hazard_table(const HazardModel& hazard);
/// @throws InputError if it is none
HazardModel hazard_of(const Table& table);

} // namespace stylobate

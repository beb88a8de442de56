#pragma once
/// From the engine's tables to those of the public headers.

#include "io/tables/table.hpp"
#include "stylobate/answer.hpp"

#include <vector>

namespace stylobate::api {

inline Table table_of(const stylobate::Table& table)
{
    Table made{table.name(), {}, {}};
    made.attributes = table.attributes();
    for (const stylobate::Table::Column& column : table.columns())
        made.columns.push_back({column.name, column.unit, column.values, column.shape});
    return made;
}

inline std::vector<Table> tables_of(const std::vector<stylobate::Table>& tables)
{
    std::vector<Table> made;
    for (const stylobate::Table& table : tables)
        made.push_back(table_of(table));
    return made;
}

} // namespace stylobate::api

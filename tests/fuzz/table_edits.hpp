#pragma once
/// Changes of tables as they lie in sealed files, in memory: a thousand times as many in a second as of the file.

#include "io/tables/table.hpp"
#include "tests/fuzz/byte_source.hpp"

#include <vector>

namespace stylobate::fuzz {

/// Changes while the recipe lasts: of a value, a type, a shape or a name; of a column, an attribute or a table taken
/// away, or there twice.
/// @returns what a file can hold: texts end before a NUL
std::vector<Table> edited_tables(const std::vector<Table>& tables, ByteSource& recipe);

/// Of the same names, shapes and bits.
bool same_tables(const std::vector<Table>& a, const std::vector<Table>& b);

} // namespace stylobate::fuzz

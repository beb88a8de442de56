#pragma once
/// Tables as groups of HDF5; for the writer and the reader of a results file alone, as `io/files/hdf5.hpp` is.

#include "io/files/hdf5.hpp"
#include "io/tables/table.hpp"

namespace stylobate {

/// A group of the table's name: an attribute for each of its attributes, a data set for each of its columns, a group
/// for each of the tables below it.
void write_table(hid_t parent, const Table& table);
/// Adds what the table holds to a group that is there.
void write_content(hid_t group, const Table& table);

/// Whatever the group holds that `write_table` can have written; an empty table if there is no such group.
/// @param file for messages
/// @throws hdf5::Error if it holds anything else
Table read_table(hid_t parent, const std::string& name, const std::string& file);
/// What an open group holds.
Table read_content(hid_t group, const std::string& name, const std::string& file);

} // namespace stylobate

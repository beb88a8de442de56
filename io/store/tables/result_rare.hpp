#pragma once
/// /rare of a results file; for the writer and the reader alone, as `io/files/hdf5.hpp` is.

#include "io/files/hdf5.hpp"
#include "io/tables/rare_table.hpp"

namespace stylobate {

void write_rare(hid_t file, const RareTable& table);

/// Empty if there is none. @throws hdf5::Error if it is not as it was written
RareTable read_rare_table(hid_t file);

} // namespace stylobate

#pragma once
/// /fragility of a results file; for the writer and the reader alone, as `io/files/hdf5.hpp` is.

#include "io/files/hdf5.hpp"
#include "io/tables/fragility_table.hpp"

namespace stylobate {

void write_fragility(hid_t file, const FragilityTable& table);

/// Empty if there is none. @throws hdf5::Error if it is not as it was written
FragilityTable read_fragility_table(hid_t file);

} // namespace stylobate

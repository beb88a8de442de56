#pragma once
/// /sensitivity of a results file; for the writer and the reader alone, as `io/files/hdf5.hpp` is.

#include "io/files/hdf5.hpp"
#include "io/tables/sensitivity_table.hpp"

namespace stylobate {

/// @throws std::invalid_argument if its arrays do not fit its names
void write_sensitivity(hid_t file, const SensitivityTable& table);

/// Empty if there is none. @throws hdf5::Error if it is not as it was written
SensitivityTable read_sensitivity_table(hid_t file);

} // namespace stylobate

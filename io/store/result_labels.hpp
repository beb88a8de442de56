#pragma once
/// What makes a results file explain itself to programs that do not know it (xarray, netCDF tools, MATLAB).

#include "io/files/hdf5.hpp"

namespace stylobate {

/// Gives every data set of a results file its `long_name`, every numerical one its `units` ("1": dimensionless), and
/// every dimension its scale: a data set of the same group or of one above it. Scales that the file lacks, such as
/// `block` with the names of the blocks, are added as lists of text. A data set that FORMAT.md does not list is left
/// as it is. Called once, when everything else has been written.
void write_labels(hid_t file);

} // namespace stylobate

#pragma once
/// The part of a results file that holds counts instead of rows.

#include "ensemble/numerics/run_order.hpp"
#include "io/files/hdf5.hpp"
#include "io/store/result_store.hpp"
#include "io/store/tally.hpp"

namespace stylobate {

struct TallyFile {
    Tally tally;
    DoneSet done; ///< what is counted, by its place in the order of the run
};

void write_tally(hid_t file, const ResultHeader& header, const TallyFile& counted);
/// @throws hdf5::Error if something is missing, has another shape, or does not fit the rest
TallyFile read_tally(hid_t file, const ResultHeader& header);

} // namespace stylobate

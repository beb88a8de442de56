#pragma once
/// The group /twins of a results file: pairs that were followed.

#include "ensemble/model/followed_twin.hpp"
#include "io/files/hdf5.hpp"

#include <vector>

namespace stylobate {

void write_twins(hid_t file, const std::vector<FollowedTwin>& twins);

/// Empty if there is none. @throws hdf5::Error if it is not as it was written
std::vector<FollowedTwin> read_twins_group(hid_t file);

} // namespace stylobate

#pragma once
/// The trajectory of a realization, as a part of a results file and as bytes.

#include "io/files/hdf5.hpp"
#include "io/store/result_store.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace stylobate {

/// @throws std::invalid_argument if its arrays do not fit together
void check_trajectory(const Trajectory& trajectory);
/// Below /trajectories, which is there.
void write_trajectory(hid_t file, const Trajectory& trajectory);

/// The index first, then every list with its length in front.
std::vector<std::byte> bytes_of(const Trajectory& trajectory);
/// @throws std::invalid_argument if the bytes are not those of a trajectory
Trajectory trajectory_of(std::span<const std::byte> bytes);

} // namespace stylobate

#pragma once
/// Which trajectories a single study keeps, and how large they will be, before anything runs.

#include "ensemble/experiment.hpp"

#include <cstdint>
#include <string>

namespace stylobate {

struct KeptTrajectories {
    std::uint64_t count = 0; ///< number of realizations, the first ones
    double each_mb = 0; ///< at most, of one [1e6 bytes]: until the end of the shaking and of what is watched after it
    double mb = 0;      ///< of all that are kept
    std::string words;  ///< what was chosen and how to choose otherwise; empty where all are kept and small
};

/// Bytes of a trajectory in a results file: in a sample the time, the base and the pose of each block.
std::uint64_t trajectory_bytes(std::uint64_t samples, std::uint64_t blocks);

/// By `output.trajectories` and `output.most_mb`. Realizations differ in length; the longest of the first 32 stands for
/// all, and those that fall earlier take less.
/// @param file of the study, for the message
/// @throws InputError if the requested trajectories are larger than `output.most_mb`, with the estimate and what to set
KeptTrajectories plan_trajectories(const Experiment& experiment, const std::string& file);

} // namespace stylobate

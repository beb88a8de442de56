#pragma once
/// What strengthens a structure (`kernels/mechanisms/reinforced.hpp`), at rest and in a bundle.

#include "ensemble/statics/settle.hpp"
#include "ensemble/statics/static_state.hpp"
#include "kernels/bundle.hpp"

#include <vector>

namespace stylobate {

/// Whether anything strengthens the realization, or it is marked as strengthened.
bool is_reinforced(const Realization& realization);

/// Force of a block's tendon at rest and its moment about the block's geometric centre, in the frame of the base.
struct TendonPull {
    double x_n, y_n, moment_n_m;
};
/// @param pose of the block; all 0 where it has no prestress
TendonPull tendon_pull(const Realization& realization, int block, const Pose& pose);

/// `bed_load_n` and what the tendons press on the bed beside [N].
double bed_force_n(const Realization& realization, int bed);

/// Writes what strengthens a realization into its lane. What was put in at rest counts from the state of rest without
/// the initial tilt.
/// @param start state in which the realization starts
/// @param order kernel's block -> realization's block
/// @pre the lane's rows of reinforcements are 0, the others are written
void store_reinforcement(const Realization& realization, const StaticState& start, const std::vector<int>& order,
                         const Bundle& bundle, int lane);

} // namespace stylobate

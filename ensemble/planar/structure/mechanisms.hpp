#pragma once
/// The mechanisms of a realization: which model they need, and their rows in a bundle.

#include "ensemble/planar/structure/static_state.hpp"
#include "kernels/planar/bundle.hpp"

#include <vector>

namespace stylobate {

/// Which step runs a realization: with mechanisms where any is not neutral, or the realization is marked so.
StepModel model_of(const Realization& realization);

/// Writes the mechanisms of a realization into its lane, but those that strengthen it.
/// @param order kernel's block -> realization's block
/// @pre the lane's rows of mechanisms are 0, those of the paper's model are written
void store_mechanisms(const Statics& statics, const std::vector<int>& order, const Bundle& bundle, int lane);

/// Writes what strengthens a realization into its lane. What was put in at rest counts from the state of rest without
/// the initial tilt.
/// @pre as of `store_mechanisms`; the lane's rows of strengthening are 0
void store_strengthening(const Statics& statics, const std::vector<int>& order, const Bundle& bundle, int lane);

} // namespace stylobate

#pragma once
/// Rest of a structure in space.

#include "ensemble/realization/realization.hpp"
#include "ensemble/spatial/structure/solid_bundle.hpp"
#include "kernels/spatial/bundle.hpp"

namespace stylobate {

/// Lets a realization come to rest under gravity: displacements, attitudes and springs of friction into its lane.
/// @param lane as `store_solids` has left it
/// @throws InputError if it does not come to rest: the structure cannot stand
void settle(const Realization& realization, const SolidTopology& topology, const spatial::Bundle& bundle, int lane);

} // namespace stylobate

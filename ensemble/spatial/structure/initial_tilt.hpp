#pragma once
/// Columns in space that lean at the start.

#include "ensemble/spatial/structure/bed_forces.hpp"

#include <vector>

namespace stylobate {

/// Leans the columns of a realization from `initial_tilt_block` up, each as one rigid body about the rim of that
/// block's bottom face, and sinks them in until the bed of that block carries what it carries at rest. Epistyles follow
/// level: with the point of each seat that rises highest, on the mean, and until their seats together carry what they
/// carry at rest.
///
/// @param forces of the realization
/// @param poses  (bodies of the topology) in: at rest
void lean(const SpatialStructure& structure, const SolidTopology& topology, ForcesAtRest& forces,
          std::vector<SolidPose>& poses);

} // namespace stylobate

#pragma once
/// The mechanisms of a structure in space: which step they need, and their rows in a bundle.

#include "ensemble/realization/realization.hpp"
#include "ensemble/spatial/structure/solid_bundle.hpp"
#include "kernels/spatial/mechanisms/wedge.hpp"

namespace stylobate {

/// Which step runs a structure: with mechanisms where one that has rows is not neutral, or the structure is marked so.
/// (Friction of a joint, and centres of mass beside the axis, are part of the plain step.)
spatial::StepModel model_in_space(const SpatialStructure& structure);

/// The wedge of a joint in the axes that the kernel gives it. Where a beam lies on a round drum, the kernel's lower
/// face is the beam's: that is turned instead, the other way, so that the beam rests at the same tilt.
/// @param at of the middle of the face that the study turns, from the anchor along those axes [m]
/// @param reversed `TopologyJoint::reversed`
spatial::Wedge<double> wedge_of(const SolidJoint& joint, const std::array<double, 2>& at, bool reversed);

/// Writes the mechanisms of a realization into its lane.
/// @pre the bundle has their rows, the lane's are 0, and those of its joints are written
void store_solid_mechanisms(const Realization& realization, const SolidTopology& topology,
                            const spatial::Bundle& bundle, int lane);

} // namespace stylobate

#pragma once
/// Rest of a structure in space.

#include "ensemble/realization/realization.hpp"
#include "ensemble/spatial/structure/solid_bundle.hpp"
#include "kernels/spatial/bundle.hpp"

namespace stylobate {

/// Lets a realization come to rest under gravity: displacements, attitudes and springs of friction into its lane. The
/// increments stay 0.
///
/// Each bed first sinks under the weight above it, which two seats of one body share. That is the rest of columns whose
/// centres of mass lie above each other, exact to rounding. Otherwise Newton's method follows, on the forces of the
/// kernel itself (`ForcesAtRest`), with their derivatives by differences; the friction that the state of rest needs is
/// counted from the reference state on, as in the plane.
///
/// The largest force (or moment over the radius of gyration) that is not balanced is below 1e-12 of the body's weight,
/// except where edges of two faces lie exactly over each other: there the lateral force of a bed jumps by the depth
/// over the width, and up to 1e-3 may remain (measured: 5e-5 in a column of squares on a tilted base, 3e-4 in a
/// colonnade). The kinetic energy without shaking is measured against the least energy that overturns a part of the
/// structure
/// (`Scales::barrier_j`): below 1e-26 of it in columns of six drums with and without offsets, 1e-13 in colonnades.
///
/// With `initial_tilt_rad` each column, from `initial_tilt_block` up, then leans as one rigid body about the rim of
/// that block's bottom face, and sinks until the bed carries what it carried before; the beds below and the springs of
/// friction stay as they were. Epistyles are carried along, level, by what rose highest of their seats.
///
/// @param lane as `store_solids` has left it
/// @throws InputError if it does not come to rest, or only in an unstable equilibrium: the structure cannot stand
void settle(const Realization& realization, const SolidTopology& topology, const spatial::Bundle& bundle, int lane);

} // namespace stylobate

#pragma once
/// Static equilibrium of bodies in space under the forces of their beds.

#include "ensemble/spatial/structure/bed_forces.hpp"

#include <vector>

namespace stylobate {

/// Where a search for the equilibrium ended.
struct Rest {
    std::vector<SolidPose> poses; ///< (bodies of the topology)
    double unbalanced = 0;        ///< largest force, or moment over the radius of gyration, over the body's weight
    double allowed = 0;           ///< what can remain of it
    int worst = 0;                ///< the body of the topology that has it
    bool stable = true;           ///< the energy has a minimum; not decided where friction is at its limit
    bool balanced() const { return unbalanced <= allowed; }
};

/// The weight that each joint carries if the seats of a body share its load evenly; butt joints carry none [N]
/// (joints).
std::vector<double> bed_loads_n(const SpatialStructure& structure, double gravity_m_s2);

/// Searches the equilibrium of a realization from its reference state. Each bed first sinks under its load
/// (`bed_loads_n`). Then Newton's method: derivatives by differences of the forces, kept as long as a step reduces the
/// residual to a tenth; a step is halved while it goes too far. First without the friction cone, so that a bed that
/// opens on the way does not slip, and then, if the result lies outside of the cone, with it.
///
/// @param forces of the realization; they are left in the poses of the result
Rest rest_of(const SpatialStructure& structure, const SolidTopology& topology, ForcesAtRest& forces);

} // namespace stylobate

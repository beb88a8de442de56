#pragma once
/// What an impact makes of the velocities of a column: laws that agree for one point, and differ for several.

#include "bench/rigid_reference/contact_problem.hpp"

#include <string>

namespace stylobate::reference {

enum class ImpactLaw {
    together,   ///< all points at once, plastic (Moreau)
    sequential, ///< the fastest closing point alone, plastic; then the next one, until none closes
    viscous,    ///< dashpots of one coefficient at all points, without springs, until none closes
    compliant   ///< springs and dashpots at all points, stepped through until none carries: stiff contacts of a given
                ///< damping ratio in the limit of any stiffness, where an impact takes no time and weight is nothing
};

struct Impacts {
    ImpactLaw law = ImpactLaw::together;
    double along_ratio = 0.57735; ///< viscous: coefficient along the face over that across it (two corners: sqrt(1/3))
    double damping_ratio = 1;     ///< compliant: of one block on two points; along the face a third of the springs
    double fineness = 0.1; ///< viscous: part of a point's closing speed that its own dashpot takes in an increment
};

/// Slowest closing that is an impact [m/s].
inline constexpr double still_m_s = 1e-8;

/// @param contacts all points that touch, the closing ones and the others   @return whether all conditions are verified
/// (of `together`), nothing closes any more (`sequential`, `viscous`), or nothing carries any more (`compliant`)
bool strike(const Bodies& bodies, const Impacts& impacts, Contacts& contacts, Twists& velocity);

double kinetic_energy(const Bodies& bodies, const Twists& velocity);

} // namespace stylobate::reference

#pragma once
/// What an impact makes of the velocities of a column: laws that agree for one point, and differ for several.

#include "bench/rigid_reference/contact_problem.hpp"

#include <string>

namespace stylobate::reference {

enum class ImpactLaw {
    together,   ///< all points at once, plastic (Moreau)
    sequential, ///< the fastest closing point alone, plastic; then the next one, until none closes
    viscous     ///< dashpots of one coefficient at all points, without springs, until none closes
};

struct Impacts {
    ImpactLaw law = ImpactLaw::together;
    double along_ratio = 0.57735; ///< viscous: coefficient along the face over that across it (two corners: sqrt(1/3))
    double fineness = 0.1; ///< viscous: part of a point's closing speed that its own dashpot takes in an increment
};

/// Slowest closing that is an impact [m/s].
inline constexpr double still_m_s = 1e-8;

/// @param contacts all points that touch, the closing ones and the others   @return whether all conditions are verified
/// (of `together`), or nothing closes any more (else)
bool strike(const Bodies& bodies, const Impacts& impacts, Contacts& contacts, Twists& velocity);

double kinetic_energy(const Bodies& bodies, const Twists& velocity);

} // namespace stylobate::reference

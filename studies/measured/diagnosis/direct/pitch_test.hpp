#pragma once
/// Rotation of the table in proportion to its acceleration, from blocks that ride on it.
///
/// Soft beds lean as well: under an acceleration a of the base the inertia of the blocks above tilts every bed against
/// it, by its moment over the bed's stiffness. What rides on the table turns with it as a whole; the lean adds up from
/// bed to bed:
///
///   rotation of block b = (pitch + softness L_b) a,   L_b = sum over the beds below b of  (mass above) x (height of
///                                                     its centre above the bed),  L of the lowest block 1
///
/// for beds of one stiffness (statics of a stack: Newton's law for all blocks above a bed). The slopes of all blocks of
/// a column tell the two apart; soft beds lean one way alone, and not
/// much.

#include "studies/measured/diagnosis/evidence/ride.hpp"

namespace stylobate {

struct PitchFit {
    bool seen = false;  ///< rotations were measured
    bool apart = false; ///< the lean of beds is not in it: of a column, or of the table itself
    double slope = 0;   ///< [rad s2/m]
    double sd = 0, gain = 0;
};

/// @param prepared rides of the campaign
PitchFit fit_pitch(const Campaign& campaign, const CampaignScales& scales, const Prepared& prepared);

/// (n_block) L_b of a column, from bottom to top; empty if the blocks are no single column.
std::vector<double> lean_of_beds(const Specimen& specimen);

} // namespace stylobate

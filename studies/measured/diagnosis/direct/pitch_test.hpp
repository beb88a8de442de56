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
///
/// Whether the table moves up and down, from how high what stands on it is.
///
/// A block that rocks stands on one corner, and that corner is as high as the table: the height of its lowest corner,
/// from its centre and its rotation, gives the table's height throughout a run, not only while it rides. It is held
/// against the base motion, and searched for a line: a frequency of the table's own that stands out in motion after
/// motion, as no harmonic of the shaking or of the rocking does.

#include "ensemble/model/campaign.hpp"
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

struct VerticalMotion {
    std::size_t samples = 0;
    /// Common motion while all rides, beyond what noise makes, over the noise (rms).
    double rms_over_noise = 0;
    double ratio = 0, ratio_sd = 0; ///< of the horizontal motion, over whole runs
    /// Power of the line over that of its neighbours, in the lower quartile of the motions; 0: too few motions.
    double line = 0;
    double line_hz = 0;
    double line_m_s2 = 0, line_sd_m_s2 = 0; ///< its amplitude, mean over the runs
    double peak_m_s2 = 0;                   ///< of the common motion while all rides
};

/// @param pitch_rad_s2_m what the table turns by for each m/s2 of the base
VerticalMotion vertical_motion(const Campaign& campaign, const Prepared& prepared, const CampaignScales& scales,
                               double pitch_rad_s2_m);

} // namespace stylobate

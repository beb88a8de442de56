#pragma once
/// Whether the table moves up and down, from how high what stands on it is.
///
/// A block that rocks stands on one corner, and that corner is as high as the table: the height of its lowest corner,
/// from its centre and its rotation, gives the table's height throughout a run, not only while it rides. It is held
/// against the base motion, and searched for a line: a frequency of the table's own that stands out in motion after
/// motion, as no harmonic of the shaking or of the rocking does.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/ride.hpp"

namespace stylobate {

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

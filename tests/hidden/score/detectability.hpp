#pragma once
/// How well an effect could be seen at best: what it does to the blocks, against the cameras' noise and against what
/// the scatter of making does. Defined here once, before any diagnosis is scored.

#include "tests/hidden/virtual_campaign.hpp"

namespace stylobate::hidden {

/// Both must be reached: README.md gives the reasons.
inline constexpr double least_snr_noise = 15;
inline constexpr double least_snr_scatter = 1;

struct Detectability {
    double snr_noise = 0;   ///< against the cameras' noise, summed over windows, blocks, coordinates and runs
    double snr_scatter = 0; ///< the same over what the scatter of friction, widths and masses makes
    bool detectable() const { return snr_noise >= least_snr_noise && snr_scatter >= least_snr_scatter; }
};

/// Noise of a change of velocity over a window: slopes of straight lines through the frames of the window before and
/// of the one after, whose middles lie one window apart. The slope of a line through n points of noise s, equally
/// spaced over T, has the variance 12 s2 / (n T2), about, for n >> 1.
double velocity_change_noise(double noise_sd);

/// For each effect of a campaign, in their order.
std::vector<Detectability> detectability_of(const VirtualCampaign& made);

} // namespace stylobate::hidden

#pragma once
/// How well an effect could be seen at best: what it does to the blocks, against the cameras' noise and against what
/// the scatter of making does. Defined here once, before any diagnosis is scored.

#include "tests/hidden/virtual_campaign.hpp"

#include <vector>

namespace stylobate::hidden {

/// Both must be reached: README.md gives the reasons.
inline constexpr double least_snr_noise = 15;
inline constexpr double least_snr_scatter = 1;

struct Detectability {
    double snr_noise = 0;   ///< against the cameras' noise, summed over windows, blocks, coordinates and runs
    double snr_scatter = 0; ///< the same over what the scatter of friction, widths and masses makes
    /// Part of the squared sum that another healthy law, without the effect, makes as well; 0 of what is seen at rest.
    double law_share = 0;
    /// Both thresholds, of what no healthy law makes.
    bool detectable() const;
};

/// The part of `effect`, in squares, that the best combination of changes of the law makes, each taken at the most
/// `most` times, to either side.
/// @param laws each as long as the effect
double share_of_laws(const std::vector<double>& effect, const std::vector<std::vector<double>>& laws, double most);

/// Noise of a change of velocity over a window: slopes of straight lines through the frames of the window before and
/// of the one after, whose middles lie one window apart. The slope of a line through n points of noise s, equally
/// spaced over T, has the variance 12 s2 / (n T2), about, for n >> 1.
double velocity_change_noise(double noise_sd);

/// For each effect of a campaign, in their order.
std::vector<Detectability> detectability_of(const VirtualCampaign& made);

} // namespace stylobate::hidden

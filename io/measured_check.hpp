#pragma once
/// Whether measured data can be what they say: units, clocks, sensors, geometry.

#include "ensemble/campaign.hpp"

namespace stylobate {

/// Adds to the findings of a campaign. @pre its shapes are right
/// @throws InputError for what cannot be used
void check_campaign(Campaign& campaign);

} // namespace stylobate

#pragma once
/// Consistency checks of measured data: units, clocks, sensors, geometry.

#include "ensemble/model/campaign.hpp"

namespace stylobate {

/// Refuses a specimen that cannot be: sizes in another unit, densities that no stone has, blocks that overlap, joints
/// between what does not touch, a block without a joint. @throws InputError
void check_specimen(const Campaign& campaign);

/// All checks: the specimen, then run by run clocks, units, missing values, noise, saturation, offsets, rest places and
/// collapses, then repeats against each other. Adds to the findings of a campaign. @pre its shapes are right
/// @throws InputError for what cannot be used
void check_campaign(Campaign& campaign);

} // namespace stylobate

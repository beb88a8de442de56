#pragma once
/// Tests on single joints in the virtual laboratory: the same specimen, contact law and hidden effects as in its
/// shakes.

#include "tests/hidden/virtual_campaign.hpp"

namespace stylobate::hidden {

/// A test as the laboratory does it: the specimen is set up by hand as planned, and moved, pulled, pushed or dropped.
///
/// Rods touch the middle line of their block at `height_m`; from 0.2 s on their end moves with `speed_m_s`, over a
/// fifth of the block's width (10 mm of small blocks) at the most. Gauge and rod have 5 % of critical damping. Hands
/// hold a body at the planned place, shifted as it was laid and level to what the cameras see. A body that turned by
/// 0.7 rad against the table or has lost nine tenths of its bed is caught: the run has collapsed. A vertical motion of
/// the table with its own frequency does not act here; its other effects do.
///
/// @param planned setup, and series without noise: `base_displacement_m`, `base_tilt_rad`; of blocks, the places where
///                hands hold them until `released_s`
/// @param number  any, a test each: what scatters by hand and in the sensors belongs to it
/// @param worn    the specimen after its last run, if its memory persists (`Effects::persists`); may be null
/// @param end     the specimen after this one; may be null
/// @return the plan with what was measured; of a test at rest, which has no series, the plan itself
/// @throws InputError where the plan contradicts itself or the specimen
MeasuredRun performed(const VirtualCampaign& made, const MeasuredRun& planned, int number, const State* worn,
                      State* end);

/// The specimen with what callipers, level and scales give: centres of mass, and where the joints begin to carry. Their
/// noise is twice that of the cameras: 0.1 mm for small blocks.
Specimen measured_at_rest(const VirtualCampaign& made, int number, const State* worn = nullptr);

/// All planned tests of a campaign, one after the other, after the shakes of the virtual one; the number of each is its
/// place among them. Memory goes on from test to test where it persists. A test at rest fills the lists of the
/// specimen.
/// @throws InputError where a plan contradicts itself or the specimen, or is measured already
Campaign tested(const VirtualCampaign& made, const Campaign& planned);

} // namespace stylobate::hidden

#pragma once
/// The test that would distinguish the remaining causes.

#include "studies/diagnosis/decision/prediction.hpp"

namespace stylobate {

/// Of a few motions that a table can make, the one whose outcome separates these causes best.
std::optional<NextTest> next_test(const Campaign& campaign, const TrackScales& scales, const Study& baseline,
                                  const std::vector<JudgedCause>& causes, std::uint64_t seed, const RunOptions& options,
                                  SimulationCount& count, Observer& observer);

} // namespace stylobate

#pragma once
/// What lies askew before the shaking: wedges and offsets of drums.

#include "studies/diagnosis/tests/direct_tests.hpp"

namespace stylobate {

/// Adds the tests of every joint, from the means over the first samples of each run, and what they found.
void test_rest(const Campaign& campaign, const TrackScales& scales, const DirectThresholds& limits, DirectResult& out);

} // namespace stylobate

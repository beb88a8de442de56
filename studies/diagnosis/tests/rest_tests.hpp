#pragma once
/// What lies askew before the shaking: wedges and offsets of drums.

#include "studies/diagnosis/tests/direct_tests.hpp"

namespace stylobate {

/// Whether the cameras saw the table in every run: then places on it are known, not only beside other blocks.
bool sees_table(const Campaign& campaign);

/// Adds the tests of every joint, from the means of each run over the time before its base moves (at least 20 samples),
/// and what they found.
void test_rest(const Campaign& campaign, const CampaignScales& scales, const DirectThresholds& limits,
               DirectResult& out);

} // namespace stylobate

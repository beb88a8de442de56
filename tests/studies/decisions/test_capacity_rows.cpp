/// Ratios of capacities in a comparison: which counts make them, and what is said of them.

#include "studies/decisions/compare/comparison_text.hpp"
#include "tests/studies/decisions/decision_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace stylobate {
namespace {

/// Two frequencies of three PGA. At 1 Hz the variant falls at 4 m/s2 instead of 2; at 2 Hz it never falls.
Comparison two_frequencies()
{
    Comparison c = sample_comparison(false);
    c.adaptive_budget = 0;
    c.frequency_hz = {1, 2};
    c.pga_m_s2 = {1, 2, 4};
    c.variants.resize(1);
    VariantComparison& v = c.variants.front();
    v.limits.resize(1);
    v.limits.front().cells.assign(6, PlaceComparison{});
    const PairedCounts stands{0, 0, 0, 20}, saved{0, 20, 0, 0}, falls{20, 0, 0, 0};
    const PairedCounts counts[] = {stands, saved, falls, stands, stands, saved};
    for (std::size_t i = 0; i < 6; ++i)
        v.limits.front().cells[i].counts = counts[i];
    return c;
}

TEST(CapacityRows, AreOfEachFrequencyOverItsIntensities)
{
    const Comparison c = two_frequencies();
    const auto rows = capacity_rows(c, c.variants.front().limits.front());
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].place, "1 Hz");
    EXPECT_NEAR(rows[0].ratio.value, 2, 1e-12); // half of ln(2 / 1) and half of ln(4 / 2)
    EXPECT_FALSE(rows[0].ratio.at_least);
    EXPECT_EQ(rows[1].place, "2 Hz");
    EXPECT_NEAR(rows[1].ratio.value, std::sqrt(2), 1e-12);
    EXPECT_TRUE(rows[1].ratio.at_least);
    const std::string text = comparison_text(c);
    EXPECT_NE(text.find("  Capacity (PGA at collapse) over that of the base\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\n  1 Hz              2.00 ("), std::string::npos) << text;
    EXPECT_NE(text.find("\n  2 Hz     at least 1.41 ("), std::string::npos) << text;
    EXPECT_NE(comparison_json(c).text().find("\"at_least\": true"), std::string::npos);
}

TEST(CapacityRows, OfAFragilityStudyAreOverItsStripesByTheMotions)
{
    const Comparison c = sample_comparison(true);
    const LimitComparison& limit = c.variants.front().limits.front();
    const auto rows = capacity_rows(c, limit);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].place, "all stripes");
    const CapacityRatio direct = capacity_ratio(c.intensity, limit.by_motion, 20, c.level);
    EXPECT_EQ(rows[0].ratio.value, direct.value);
    EXPECT_EQ(rows[0].ratio.upper, direct.upper);
    EXPECT_EQ(capacity_measure(c), "PGV");
}

TEST(CapacityRows, NoneWithoutARangeAndNoneOfWhatStopsByItsOutcomes)
{
    Comparison c = two_frequencies();
    LimitComparison& limit = c.variants.front().limits.front();
    limit.damage = false;
    EXPECT_TRUE(capacity_rows(c, limit).empty()) << "rocking without collapse has no capacity";
    limit.damage = true;
    c.adaptive_budget = 100;
    EXPECT_TRUE(capacity_rows(c, limit).empty());
    c.adaptive_budget = 0;
    c.pga_m_s2 = {1};
    EXPECT_TRUE(capacity_rows(c, limit).empty());
}

TEST(CapacityRows, TextSaysWhatIsABound)
{
    EXPECT_EQ(capacity_text({1.2, 1.1, 1.3, 1.2, false, false}), "1.20 (1.10 to 1.30; steps x 1.20)");
    EXPECT_EQ(capacity_text({1.2, 1.1, 1.3, 1, true, false}), "at least 1.20 (1.10 to 1.30; steps x 1.00)");
    EXPECT_EQ(capacity_text({0.8, 0.7, 0.9, 1, false, true}), "at most 0.80 (0.70 to 0.90; steps x 1.00)");
    EXPECT_EQ(capacity_text({1, 0.7, 1.4, 1, true, true}),
              "not bounded by this range, in it 1.00 (0.70 to 1.40; steps x 1.00)");
    EXPECT_EQ(capacity_text({std::nan(""), 0, 0, 1, false, false}), "not in this range");
}

} // namespace
} // namespace stylobate

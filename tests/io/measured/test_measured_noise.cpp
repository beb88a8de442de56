/// How long nothing moves, and means of what was seen: against samples made by hand.

#include "io/measured/measured_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace stylobate {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

TEST(MeanSeen, IsOfAColumnsFirstSamplesWithoutMissingOnes)
{
    const std::vector<double> table = {1, 10, missing, 20, 3, 60, 100, 1000};
    EXPECT_DOUBLE_EQ(mean_seen(table, 3, 0, 2), 2);
    EXPECT_DOUBLE_EQ(mean_seen(table, 3, 1, 2), 30);
    EXPECT_TRUE(std::isnan(mean_seen(std::vector<double>{missing, missing}, 2, 0, 1)));
}

/// A base at rest for 150 of 500 samples, with an offset of its sensor; then 1 m/s2 more.
MeasuredRun resting(double noise)
{
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal(0.2, noise);
    MeasuredRun run;
    for (int i = 0; i < 500; ++i)
        run.base_acceleration_m_s2.values.push_back(normal(random) + (i < 150 ? 0 : 1));
    return run;
}

TEST(SamplesAtRest, AreHalfOfThoseBeforeTheBaseMoves)
{
    EXPECT_EQ(samples_at_rest(resting(0.05)), 75U);
    EXPECT_EQ(samples_at_rest(resting(1e-6)), 75U);
}

TEST(SamplesAtRest, AreNoneWhereThatIsNotKnownOrTooShort)
{
    EXPECT_EQ(samples_at_rest({}), 0U);
    MeasuredRun run = resting(0.05);
    run.base_acceleration_m_s2.values.erase(run.base_acceleration_m_s2.values.begin(),
                                            run.base_acceleration_m_s2.values.begin() + 115);
    EXPECT_EQ(samples_at_rest(run), 0U) << "35 samples, of which 15 would count";
}

TEST(PlacesAtRest, AreBesideTheNominalOnesAndFromTheTableWhereItIsSeen)
{
    Specimen specimen;
    specimen.rest_x_m = {0, 0.5};
    MeasuredRun run;
    run.blocks.x_m.values = {0.01, 0.52, 0.03, 0.54, 9, 9}; // of the third sample nothing counts
    EXPECT_EQ(places_at_rest(specimen, run, 2).size(), 2U);
    EXPECT_NEAR(places_at_rest(specimen, run, 2)[0], 0.02, 1e-12);
    EXPECT_NEAR(places_at_rest(specimen, run, 2)[1], 0.03, 1e-12);
    run.table.x_m.values = {0.001, 0.003, 9};
    EXPECT_NEAR(places_at_rest(specimen, run, 2)[1], 0.028, 1e-12);
}

} // namespace
} // namespace stylobate

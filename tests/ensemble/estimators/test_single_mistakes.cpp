/// Rules of estimators at the values where a mistake in one expression shows, by hand (tests/mutants).

#include "ensemble/estimators/fragility/measure_ranking.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/estimators/paired/paired_allocation.hpp"
#include "ensemble/estimators/paired/paired_tests.hpp"
#include "ensemble/estimators/past/exclusion.hpp"
#include "ensemble/estimators/past/past_posterior.hpp"
#include "ensemble/estimators/search/response_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace stylobate {
namespace {

/// Limits of the score interval (Tango 1998) of 200 pairs, by bisection elsewhere. With 1.96, the quantile of one look,
/// 4 and 8 that differ have -0.0161 and 0.0599: one of them is beyond the margin of 0.05, whichever way the 8 differ.
/// With 2.73, which is enough for eight looks (Bonferroni), 3 and 3 have -0.0483 and 0.0483.
TEST(PairedAllocation, IsDecidedWhereBothLimitsAreWithinTheMargin)
{
    const PairedAllocation allocation({400, 16, 0.05}, 4, 200, 0.95);
    EXPECT_FALSE(allocation.decided({0, 4, 8, 188}));
    EXPECT_FALSE(allocation.decided({0, 8, 4, 188}));
    EXPECT_TRUE(allocation.decided({0, 3, 3, 194}));
}

/// The thirds of 1, ..., 7 are divided by 3 and 5, which belong to what lies below: {1, 2, 3}, {4, 5}, {6, 7}.
TEST(Dependence, AValueOnTheDivisionBelongsToTheThirdBelow)
{
    std::vector<PairedTrial> trials;
    for (int value = 1; value <= 7; ++value)
        trials.push_back({0, false, value == 3 || value == 5});
    const Dependence found = dependence_on(trials, std::vector<double>{1, 2, 3, 4, 5, 6, 7}, 0.95);
    EXPECT_EQ(found.between[0], 3);
    EXPECT_EQ(found.between[1], 5);
    EXPECT_NEAR(found.thirds[0].value, 1.0 / 3, 1e-12);
    EXPECT_NEAR(found.thirds[1].value, 0.5, 1e-12);
    EXPECT_NEAR(found.thirds[2].value, 0, 1e-12);
}

/// Twenty records at three intensities, which reach more of five the larger their number modulo 5 is.
RankedMeasure ranked_with(double level, double scale, double shift)
{
    std::vector<FragilityRun> runs;
    std::vector<double> first, second;
    for (std::uint32_t g = 0; g < 20; ++g) {
        const int more = static_cast<int>(g % 5), other = static_cast<int>(g * 7 % 11);
        first.push_back(shift + scale * more);
        second.push_back(other);
        for (int j = 0; j < 3; ++j)
            runs.push_back({g, {0.5 * (1 << j)}, static_cast<double>((2 + 4 * j + more + other % 3) / 3), 5});
    }
    return ranked_measures(grouped(runs), {"im"}, {"first", "second"}, {first, second}, level).front();
}

/// With two features the smaller p-value is compared with half of what the level leaves.
TEST(MeasureRanking, OfTwoFeaturesEachHasHalfOfTheRemainder)
{
    const RankedMeasure measure = ranked_with(0.95, 1, 0);
    const double p = std::min(measure.sufficiency[0].p_value, measure.sufficiency[1].p_value);
    ASSERT_GT(p, 1e-9);
    ASSERT_LT(p, 0.3);
    EXPECT_TRUE(ranked_with(1 - 1.5 * p, 1, 0).sufficient);
    EXPECT_FALSE(ranked_with(1 - 2.5 * p, 1, 0).sufficient);
}

/// A coefficient is for a standard deviation of the feature, whatever its unit and origin are.
TEST(MeasureRanking, ACoefficientHasNoUnit)
{
    const Sufficiency one = ranked_with(0.95, 1, 0).sufficiency[0], other = ranked_with(0.95, 10, 3).sufficiency[0];
    EXPECT_GT(one.coefficient, 0.1);
    EXPECT_NEAR(other.coefficient, one.coefficient, 1e-9);
    EXPECT_NEAR(other.limits.upper, one.limits.upper, 1e-9);
}

/// Every record falls by 0.6 or 0.8: 44 standard errors, where random signs of 40 records reach sqrt(40) at most. Of
/// 1999 random ones and the seen one none but this is as large.
TEST(StripeShares, TheSmallestPValueIsThatOfTheSeenDecrease)
{
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < 40; ++g) {
        runs.push_back({g, {1}, g % 2 == 0 ? 9.0 : 8.0, 10});
        runs.push_back({g, {2}, g % 2 == 0 ? 1.0 : 2.0, 10});
    }
    EXPECT_DOUBLE_EQ(stripe_shares(grouped(runs)).p_monotone, 1.0 / 2000);
}

/// Groups of one and of three count as (1 + 3)^2 / (1 + 9) equal ones.
TEST(PairedNoise, GroupsOfUnequalSizeCountAsFewer)
{
    const PairedNoise noise = paired_noise({1, 2}, {1, 3}, {0, 0}, 1);
    EXPECT_DOUBLE_EQ(noise.groups, 1.6);
    EXPECT_DOUBLE_EQ(noise.share[0], 0.75);
}

/// Two intensities whose states all agree with each other.
struct AllAlike {
    PastAxes axes{{1.0}, {1, 2}, 1};
    std::vector<double> trials;
    StandingStates standing;
    MeasuredState measured{{0}, {1}, false};

    AllAlike(std::size_t weak, double of_weak, std::size_t strong, double of_strong) : trials{of_weak, of_strong}
    {
        standing.cell.assign(weak, 0);
        standing.cell.resize(weak + strong, 1);
        standing.value.assign(weak + strong, 0);
    }
};

/// 40 of 40 stand under the weaker shaking, 30 of 300 under the stronger one. A monument of the stronger one is judged
/// by the 29 others of 299, with half a count of either kind: (29.5 / 300) / (40.5 / 41) of the largest likelihood,
/// below Wilks' part. One of the weaker one has the largest likelihood itself.
TEST(Past, AMonumentIsJudgedByTheOthers)
{
    const AllAlike all(40, 40, 30, 300);
    const RatioThresholds found = ratio_thresholds(
        all.axes, all.trials, all.standing, AgreeingStates(all.standing, all.measured), all.measured, 1, 40, 0.95, 3);
    ASSERT_TRUE(found.mean.calibrated);
    EXPECT_NEAR(found.mean.part[1], 29.5 / 300 / (40.5 / 41), 1e-12);
    EXPECT_NEAR(found.profile.part[1], 29.5 / 300 / (40.5 / 41), 1e-12);
    EXPECT_NEAR(found.mean.part[0], 0.1465, 5e-5);
}

/// Half of the structures stand under either shaking, of which there are 1000 trials and 100: monuments come from both
/// alike, and not ten times as often from the cell of more trials. The place of the true intensity is below 1/2 for the
/// weaker one. 400 monuments: four standard deviations are 0.1.
TEST(Past, MonumentsOfACellAreDrawnByItsPriorNotByItsTrials)
{
    const AllAlike all(500, 1000, 50, 100);
    const MonumentTest test =
        test_monuments(all.axes, all.trials, all.standing, AgreeingStates(all.standing, all.measured), all.measured,
                       std::vector<double>{0.5, 0.5}, 400, 5);
    ASSERT_EQ(test.intensity.size(), 400U);
    const auto weaker = std::count_if(test.intensity.begin(), test.intensity.end(), [](double u) { return u < 0.5; });
    EXPECT_NEAR(static_cast<double>(weaker) / 400, 0.5, 0.1);
}

/// Each state within the tolerance of 0 agrees, as it is and mirrored, and counts once.
TEST(Past, AStateThatAgreesInBothSensesIsSeenOnce)
{
    StandingStates standing{{0, 0, 0}, {0, 0.5, -2}};
    const MeasuredState measured{{0}, {1}, true};
    std::vector<int> seen(3);
    AgreeingStates(standing, measured).each({0}, [&](std::size_t r) { ++seen[r]; });
    EXPECT_EQ(seen, (std::vector<int>{1, 1, 0}));
    seen.assign(3, 0);
    AgreeingStates(standing, measured).each({2}, [&](std::size_t r) { ++seen[r]; });
    EXPECT_EQ(seen, (std::vector<int>{0, 0, 1})) << "mirrored alone";
}

} // namespace
} // namespace stylobate

/// Ratios of capacities: by hand, against capacities that are known, and the coverage of the intervals.

#include "ensemble/estimators/paired/paired_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace stylobate {
namespace {

/// In the base all fall from 2 on, in the variant from 4 on: twice the intensity.
TEST(CapacityRatio, OfStepsIsTheRatioOfTheirPlaces)
{
    const std::vector<double> at{1, 2, 4, 8};
    const CapacityRatio r =
        capacity_ratio(at, std::vector<PairedCounts>{{0, 0, 0, 9}, {0, 9, 0, 0}, {9, 0, 0, 0}, {9, 0, 0, 0}}, 0, 0.95);
    EXPECT_NEAR(r.value, 2, 1e-12);
    EXPECT_NEAR(r.grid, 2, 1e-12); // the base falls from 1 to 2 on, the variant from 2 to 4 on: 1 to 4 times
    EXPECT_LT(r.lower, 2);
    EXPECT_GT(r.lower, 1);
    EXPECT_FALSE(r.at_least);
    EXPECT_FALSE(r.at_most);
}

/// d = 0, -2/4, -1/4 at 1, 2, 8: -(ln 8 / 2 (-1/2) + ln 4 / 2 (-1/4)).
TEST(CapacityRatio, ByHand)
{
    const std::vector<double> at{1, 2, 8};
    const CapacityRatio r =
        capacity_ratio(at, std::vector<PairedCounts>{{0, 0, 0, 4}, {0, 2, 0, 2}, {2, 1, 0, 1}}, 0, 0.95);
    EXPECT_NEAR(std::log(r.value), std::log(8) / 4 + std::log(4) / 8, 1e-12);
    // the base's shares rise by 1/2 and 1/4, the variant's by 0 and 1/2
    EXPECT_NEAR(std::log(r.grid), std::log(2) / 2 * 0.5 + std::log(4) / 2 * (0.25 + 0.5), 1e-12);
}

/// Two intensities of equal weight ln 2 / 2: the cells of `PairedDifference.StrataByHand`, d from -0.3297 to 0.6801.
TEST(CapacityRatio, TheIntervalIsThatOfTheWeightedDifference)
{
    const std::vector<double> at{3, 6};
    const CapacityRatio r = capacity_ratio(at, std::vector<PairedCounts>{{0, 1, 2, 1}, {1, 0, 1, 2}}, 0, 0.95);
    EXPECT_NEAR(std::log(r.value), -std::log(2) / 4, 1e-12);
    EXPECT_NEAR(std::log(r.lower), -std::log(2) * 0.68012578, 1e-7);
    EXPECT_NEAR(std::log(r.upper), std::log(2) * 0.32964999, 1e-7);
}

/// Three motions with sums of w d of -ln 2 / 2 (2, 1, 0) / 2: their mean is -ln 2 / 4, their standard error ln 2 / 4
/// sqrt(1 / 3), and Student's quantile of two degrees of freedom is 4.302653.
TEST(CapacityRatio, OfMotionsByHand)
{
    const std::vector<double> at{1, 2};
    const CapacityRatio r = capacity_ratio(
        at,
        std::vector<PairedCounts>{{0, 2, 0, 0}, {0, 1, 0, 1}, {0, 0, 0, 2}, {0, 0, 0, 2}, {1, 0, 0, 1}, {0, 0, 0, 2}},
        3, 0.95);
    EXPECT_NEAR(std::log(r.value), std::log(2) / 4, 1e-12);
    EXPECT_NEAR(std::log(r.upper) - std::log(r.value), 4.302653 * std::log(2) / 4 / std::sqrt(3), 1e-6);
    EXPECT_NEAR(std::log(r.upper * r.lower), std::log(2) / 2, 1e-12);
    // one motion alone says nothing of the others
    const CapacityRatio one = capacity_ratio(at, std::vector<PairedCounts>{{0, 2, 0, 0}, {2, 0, 0, 0}}, 1, 0.95);
    EXPECT_NEAR(one.value, std::sqrt(2), 1e-12);
    EXPECT_EQ(one.lower, 0);
    EXPECT_TRUE(std::isinf(one.upper));
}

TEST(CapacityRatio, IsABoundWhereTheRangeCutsTheDifferenceOff)
{
    const std::vector<double> at{1, 2};
    const PairedCounts same{0, 0, 0, 40}, fewer{0, 40, 0, 0}, more{0, 0, 40, 0};
    const CapacityRatio above = capacity_ratio(at, std::vector<PairedCounts>{same, fewer}, 0, 0.95);
    EXPECT_TRUE(above.at_least);
    EXPECT_FALSE(above.at_most);
    const CapacityRatio below = capacity_ratio(at, std::vector<PairedCounts>{more, same}, 0, 0.95);
    EXPECT_TRUE(below.at_most);
    EXPECT_FALSE(below.at_least);
    const CapacityRatio both = capacity_ratio(at, std::vector<PairedCounts>{more, fewer}, 0, 0.95);
    EXPECT_TRUE(both.at_least && both.at_most);
}

TEST(CapacityRatio, IsNotKnownWhereNothingSeparates)
{
    const std::vector<double> at{1, 2};
    for (const PairedCounts& all : {PairedCounts{0, 0, 0, 9}, PairedCounts{9, 0, 0, 0}}) {
        const CapacityRatio r = capacity_ratio(at, std::vector<PairedCounts>{all, all}, 0, 0.95);
        EXPECT_TRUE(std::isnan(r.value));
        EXPECT_EQ(r.lower, 0);
    }
    EXPECT_TRUE(std::isnan(capacity_ratio(at, std::vector<PairedCounts>(2), 0, 0.95).value));
}

/// Capacities that are lognormal with a median of 2 and of 2.6, and correlated: 2000 comparisons of 32 pairs at 10
/// intensities. One standard error of a coverage of 0.95 is 0.005; ln ratios are biased by the trapezoids by less than
/// 0.001.
TEST(CapacityRatioStatistics, IntervalsHoldTheRatioOfCapacitiesThatAreKnown)
{
    std::mt19937_64 engine(11);
    std::normal_distribution<double> normal;
    std::vector<double> at;
    for (int i = 0; i < 10; ++i)
        at.push_back(0.5 * std::pow(1.4, i));
    for (const double correlation : {0.0, 0.8, 0.99}) {
        int held = 0;
        constexpr int repeats = 2000;
        double mean = 0;
        for (int r = 0; r < repeats; ++r) {
            std::vector<PairedCounts> counts(at.size());
            for (std::size_t i = 0; i < at.size(); ++i)
                for (int k = 0; k < 32; ++k) {
                    const double u = normal(engine);
                    const double v = correlation * u + std::sqrt(1 - correlation * correlation) * normal(engine);
                    counts[i].add(2 * std::exp(0.35 * u) < at[i], 2.6 * std::exp(0.35 * v) < at[i]);
                }
            const CapacityRatio ratio = capacity_ratio(at, counts, 0, 0.95);
            held += ratio.lower <= 1.3 && 1.3 <= ratio.upper;
            mean += std::log(ratio.value) / repeats;
        }
        std::printf("correlation %g: %d of %d intervals hold\n", correlation, held, repeats);
        EXPECT_NEAR(held / static_cast<double>(repeats), 0.955, 0.02) << correlation;
        EXPECT_NEAR(mean, std::log(1.3), 0.006) << correlation;
    }
}

} // namespace
} // namespace stylobate

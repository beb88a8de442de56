/// Repeated looks at pairs, and the allocation that uses them.

#include "ensemble/estimators/paired/paired_allocation.hpp"

#include "tests/ensemble/estimators/paired_truth.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace stylobate {
namespace {

std::vector<std::uint64_t> equal_steps(std::uint64_t looks)
{
    std::vector<std::uint64_t> pairs;
    for (std::uint64_t k = 1; k <= looks; ++k)
        pairs.push_back(100 * k);
    return pairs;
}

/// Pocock (1977), table 1: two-sided 5 % with equal groups.
TEST(RepeatedLooks, HaveTheConstantsOfPocock)
{
    const double published[] = {1.960, 2.178, 2.289, 2.361, 2.413};
    for (std::uint64_t looks = 1; looks <= 5; ++looks)
        EXPECT_NEAR(RepeatedLooks(equal_steps(looks), 0.95).quantile(), published[looks - 1], 2e-3) << looks;
    EXPECT_NEAR(RepeatedLooks(equal_steps(10), 0.95).quantile(), 2.555, 2e-3);
}

TEST(RepeatedLooks, GrowByHalf)
{
    const RepeatedLooks looks(8, 100, 0.95);
    EXPECT_EQ(looks.pairs(), (std::vector<std::uint64_t>{8, 12, 20, 32, 48, 72, 100}));
    EXPECT_EQ(looks.after(0), 8U);
    EXPECT_EQ(looks.after(12), 20U);
    EXPECT_EQ(looks.after(100), 100U);
    EXPECT_NEAR(looks.p_value(looks.quantile()), 0.05, 1e-6);
    EXPECT_EQ(looks.p_value(0), 1);
    EXPECT_EQ(RepeatedLooks(16, 16, 0.95).pairs().size(), 1U);
    EXPECT_NEAR(RepeatedLooks(16, 16, 0.95).quantile(), 1.95996, 1e-3);
}

TEST(PairedAllocation, GoesWhereTheDifferenceIsUndecided)
{
    PairedAllocation allocation({400, 16, 0.05}, 4, 200, 0.95);
    EXPECT_EQ(allocation.next({}), std::vector<std::uint64_t>(4, 16));
    // all changed for the worse: decided; one alone: not; none: its interval is wider than the margin
    const std::vector<PairedCounts> counts = {{0, 0, 14, 2}, {5, 1, 0, 10}, {0, 0, 0, 16}, {0, 16, 0, 0}};
    const std::vector<std::uint64_t> asked = allocation.next(counts);
    EXPECT_EQ(asked, (std::vector<std::uint64_t>{16, 24, 24, 16}));
    EXPECT_EQ(allocation.rounds(), 2U);
    EXPECT_TRUE(allocation.decided({0, 0, 0, 200}));
}

TEST(PairedAllocation, StaysWithinItsBudget)
{
    PairedAllocation allocation({70, 16, 0.01}, 4, 1000, 0.95);
    allocation.next({});
    const std::vector<PairedCounts> open(4, PairedCounts{4, 4, 4, 4});
    const std::vector<std::uint64_t> asked = allocation.next(open);
    EXPECT_LE(std::accumulate(asked.begin(), asked.end(), std::uint64_t{0}), 70U);
    EXPECT_EQ(allocation.next(open), asked);
}

/// Surfaces of 12 cells run to their end: the intervals of the cells and of the mean hold, the intervals of a fixed
/// number of pairs do not.
TEST(PairedAllocationStatistics, IntervalsHoldWhereverItStops)
{
    std::mt19937_64 random(4);
    std::vector<PairedTruth> truths;
    double mean = 0;
    for (int i = 0; i < 12; ++i) {
        truths.push_back({0.5, 0.5 + (i < 4 ? 0.0 : i < 8 ? 0.08 : -0.2), i % 2 == 0 ? 0.3 : 0.6});
        mean += truths.back().difference() / 12;
    }
    constexpr int repeats = 2000;
    double held = 0, fixed = 0, held_mean = 0, false_zero = 0, zeros = 0;
    const PairedAllocation begun({3000, 16, 0.03}, truths.size(), 400, 0.95);
    for (int repeat = 0; repeat < repeats; ++repeat) {
        PairedAllocation allocation = begun;
        std::vector<PairedCounts> counts(truths.size());
        std::vector<std::uint64_t> before(truths.size());
        while (true) {
            const std::vector<std::uint64_t> asked = allocation.next(counts);
            if (asked == before)
                break;
            for (std::size_t cell = 0; cell < truths.size(); ++cell)
                counts[cell] += truths[cell].draw(asked[cell] - before[cell], random);
            before = asked;
        }
        for (std::size_t cell = 0; cell < truths.size(); ++cell) {
            const double d = truths[cell].difference();
            const auto n = static_cast<double>(counts[cell].pairs()), b = static_cast<double>(counts[cell].base_only),
                       v = static_cast<double>(counts[cell].variant_only);
            const PairedDifference at = score_interval(n, b, v, allocation.looks().quantile()),
                                   plain = score_interval(n, b, v, 1.96);
            held += at.lower <= d && d <= at.upper;
            fixed += plain.lower <= d && d <= plain.upper;
            if (d == 0) {
                zeros += 1;
                false_zero += at.lower > 0 || at.upper < 0;
            }
        }
        const PairedDifference all = weighted_difference(counts, {}, allocation.looks().quantile());
        held_mean += all.lower <= mean && mean <= all.upper;
    }
    const double cells = repeats * static_cast<double>(truths.size());
    EXPECT_GE(held / cells, 0.95) << "of fixed numbers: " << fixed / cells;
    EXPECT_LE(held / cells, 0.99);
    EXPECT_LT(fixed / cells, 0.94);
    EXPECT_GE(held_mean / repeats, 0.95);
    EXPECT_LE(false_zero / zeros, 0.05);
}

} // namespace
} // namespace stylobate

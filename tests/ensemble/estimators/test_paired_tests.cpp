/// Exact tests of paired outcomes, and adjusted p-values.

#include "ensemble/estimators/paired/paired_tests.hpp"

#include "tests/ensemble/estimators/paired_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stylobate {
namespace {

TEST(PairedTests, McNemarIsTheSignTestOfDiscordantPairs)
{
    EXPECT_EQ(mcnemar_p({100, 0, 0, 100}), 1);
    EXPECT_NEAR(mcnemar_p({0, 0, 6, 10}), 2.0 / 64, 1e-14);
    EXPECT_NEAR(mcnemar_p({7, 1, 7, 10}), 2 * (1 + 8) / 256.0, 1e-14);
    EXPECT_NEAR(mcnemar_p({7, 7, 1, 10}), 2 * (1 + 8) / 256.0, 1e-14);
    EXPECT_EQ(mcnemar_p({7, 4, 4, 10}), 1);
}

TEST(PairedTests, SignFlipOfSinglePairsIsMcNemars)
{
    std::vector<PairedCounts> groups;
    PairedCounts all;
    for (int i = 0; i < 30; ++i) {
        PairedCounts one;
        one.add(i % 5 == 0, i % 2 == 0);
        groups.push_back(one);
        all += one;
    }
    EXPECT_NEAR(sign_flip_p(groups), mcnemar_p(all), 1e-14);
}

/// All patterns of signs, one by one.
TEST(PairedTests, SignFlipCountsThePatterns)
{
    std::mt19937_64 random(1);
    for (int repeat = 0; repeat < 50; ++repeat) {
        std::vector<PairedCounts> groups;
        std::vector<int> x;
        int sum = 0;
        for (int g = 0; g < 10; ++g) {
            groups.push_back({1, random() % 4, random() % 5, 2});
            x.push_back(static_cast<int>(groups.back().variant_only) - static_cast<int>(groups.back().base_only));
            sum += x.back();
        }
        int as_large = 0;
        for (int pattern = 0; pattern < 1024; ++pattern) {
            int flipped = 0;
            for (int g = 0; g < 10; ++g)
                flipped += (pattern >> g & 1) != 0 ? x[static_cast<std::size_t>(g)] : -x[static_cast<std::size_t>(g)];
            as_large += flipped >= std::abs(sum);
        }
        EXPECT_NEAR(sign_flip_p(groups), std::min(1.0, 2 * as_large / 1024.0), 1e-12);
    }
}

/// 10001 groups with a difference of one pair each: too many for the distribution, and its tail is McNemar's, that of
/// Binomial(10001, 1/2).
TEST(PairedTests, ManyGroupsHaveTheExactTail)
{
    for (const std::size_t more : {5001U, 5050U, 5101U, 5151U}) {
        std::vector<PairedCounts> groups(10001, PairedCounts{0, 1, 0, 1});
        for (std::size_t g = 0; g < more; ++g)
            groups[g] = {0, 0, 1, 1};
        const double exact = mcnemar_p({0, 10001 - more, more, 0});
        EXPECT_NEAR(sign_flip_p(groups) / exact, 1, 2e-3) << more << ", exact " << exact;
    }
    // 5000 groups of three and 5001 of one: a variance of 5000 x 9 + 5001, a sum of 1 + 448; z = 448 / sqrt(50001)
    std::vector<PairedCounts> uneven(10001, PairedCounts{0, 1, 0, 1});
    for (std::size_t g = 0; g < 5000; ++g)
        uneven[g] = g % 2 == 0 ? PairedCounts{0, 3, 0, 1} : PairedCounts{0, 0, 3, 1};
    for (std::size_t g = 5000; g < 5000 + 2725; ++g)
        uneven[g] = {0, 0, 1, 1}; // 2725 up, 2276 down
    EXPECT_NEAR(sign_flip_p(uneven), std::erfc(448 / std::sqrt(2 * 50001.0)), 1e-12);
}

/// The example of Benjamini and Hochberg (1995), section 3.2: fifteen values, of which Bonferroni's procedure rejects
/// three at 0.05 and theirs the first four.
TEST(PairedTests, BenjaminiHochbergRejectsAsInItsPaper)
{
    const std::vector<double> p = {0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                                   0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.000};
    const std::vector<double> fdr = benjamini_hochberg(p), fwer = holm(p);
    EXPECT_EQ(std::count_if(fdr.begin(), fdr.end(), [](double x) { return x <= 0.05; }), 4);
    EXPECT_EQ(std::count_if(fwer.begin(), fwer.end(), [](double x) { return x <= 0.05; }), 3);
    EXPECT_NEAR(fdr[3], 0.0095 * 15 / 4, 1e-12);
    EXPECT_NEAR(fwer[1], 0.0004 * 14, 1e-12);
    EXPECT_EQ(fdr[14], 1);
}

TEST(PairedTests, AdjustedValuesBelongToTheirCells)
{
    EXPECT_EQ(holm({0.04, 0.01, 0.03}), (std::vector<double>{0.06, 0.03, 0.06}));
    EXPECT_EQ(benjamini_hochberg({}), std::vector<double>{});
    EXPECT_EQ(holm({0.2}), std::vector<double>{0.2});
}

/// 64 cells, of which `harmed` are harmed: the mean share of false names, and how often there is any.
struct Names {
    double false_share = 0, any_false = 0, found = 0;
};
template <class Adjust>
Names names_of(int harmed, const Adjust& adjust)
{
    std::mt19937_64 random(5);
    constexpr int repeats = 1000, cells = 64;
    Names names;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        std::vector<double> p;
        for (int i = 0; i < cells; ++i)
            p.push_back(mcnemar_p(PairedTruth{0.4, i < harmed ? 0.6 : 0.4, 0.6}.draw(64, random)));
        const std::vector<double> adjusted = adjust(p);
        int wrong = 0, right = 0;
        for (int i = 0; i < cells; ++i)
            (i < harmed ? right : wrong) += adjusted[static_cast<std::size_t>(i)] <= 0.05;
        names.false_share += wrong / std::max(1.0, static_cast<double>(wrong + right)) / repeats;
        names.any_false += (wrong > 0) / static_cast<double>(repeats);
        names.found += right / static_cast<double>(repeats);
    }
    return names;
}

TEST(PairedTestsStatistics, FalseNamesAreAsRareAsStated)
{
    const Names none = names_of(0, benjamini_hochberg), some = names_of(8, benjamini_hochberg);
    const Names some_holm = names_of(8, holm);
    EXPECT_LE(none.any_false, 0.06);
    EXPECT_LE(some.false_share, 0.06);
    EXPECT_LE(some_holm.any_false, 0.06);
    EXPECT_GT(some.found, some_holm.found);
    EXPECT_GT(some.found, 2);
}

/// Groups whose pairs fall together: McNemar's test of the pairs would be wrong, that of the groups is not.
TEST(PairedTestsStatistics, GroupsKeepTheLevel)
{
    std::mt19937_64 random(6);
    const GroupedTruth none{0, 1, 0, 0.6, 0.9}; // the variant harms under some motions and helps under others
    int by_groups = 0, by_pairs = 0;
    constexpr int repeats = 2000;
    for (int i = 0; i < repeats; ++i) {
        const std::vector<PairedCounts> groups = none.draw(20, 10, random);
        PairedCounts all;
        for (const PairedCounts& group : groups)
            all += group;
        by_groups += sign_flip_p(groups) <= 0.05;
        by_pairs += mcnemar_p(all) <= 0.05;
    }
    EXPECT_LE(by_groups, 0.065 * repeats);
    EXPECT_GT(by_pairs, 0.1 * repeats);
}

} // namespace
} // namespace stylobate

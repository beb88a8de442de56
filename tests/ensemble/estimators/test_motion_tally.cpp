/// Structures under one motion: shares by hand, their means over all outcomes, and counts of equal uncertainty.

#include "ensemble/estimators/past/past_likelihood.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace stylobate {
namespace {

TEST(MotionTally, SharesByHand)
{
    const MotionTally t{.valid = 4, .stand = 3, .as_is = 2, .mirrored = 0, .agree = 2};
    EXPECT_EQ(agreeing_share(t), 0.5);
    // one of the other three is drawn: that has fallen with 1/3, stands with 2/3
    EXPECT_NEAR(built_share(t, 2, 1), 0.5 / 3, 1e-15);
    EXPECT_NEAR(built_share(t, 2, 2), 0.5 * 2 / 3, 1e-15);
    EXPECT_NEAR(built_share(t, 1, 1), 0.5, 1e-15);
    // two of the other three, of which two stand: both with 1/3, one with 2/3
    EXPECT_NEAR(built_share(t, 3, 3), 0.5 / 3, 1e-15);
    EXPECT_NEAR(built_share(t, 3, 2), 0.5 * 2 / 3, 1e-15);
    EXPECT_EQ(built_share(t, 3, 1), 0);
    // pairs of four: six, of three that stand: three
    EXPECT_NEAR(all_stand_share(t, 2), 0.5, 1e-15);
    EXPECT_NEAR(all_stand_share(t, 3), 0.25, 1e-15);
    EXPECT_EQ(all_stand_share(t, 4), 0);
}

/// Over all outcomes of five structures, each of which agrees with q, stands otherwise with p - q, or falls.
TEST(MotionTally, SharesAreUnbiased)
{
    constexpr double p = 0.7, q = 0.25;
    constexpr std::uint32_t k = 5;
    double built = 0, all = 0, probability = 0;
    for (std::uint32_t g = 0; g <= k; ++g)
        for (std::uint32_t other = 0; g + other <= k; ++other) {
            const std::uint32_t fallen = k - g - other;
            const double chance = std::tgamma(k + 1) / std::tgamma(g + 1) / std::tgamma(other + 1) /
                                  std::tgamma(fallen + 1) * std::pow(q, g) * std::pow(p - q, other) *
                                  std::pow(1 - p, fallen);
            const MotionTally t{k, g + other, g, 0, g};
            built += chance * built_share(t, 4, 2);
            all += chance * all_stand_share(t, 3);
            probability += chance;
        }
    EXPECT_NEAR(probability, 1, 1e-14);
    // one of the three others stands as well
    EXPECT_NEAR(built, q * 3 * p * (1 - p) * (1 - p), 1e-14);
    EXPECT_NEAR(all, p * p * p, 1e-14);
}

TEST(MotionTally, ASiteHasOneSenseOfTheShaking)
{
    const MotionTally right{4, 4, 2, 0, 2}, left{4, 4, 0, 3, 3}, both{4, 4, 1, 1, 2}, symmetric{4, 2, 2, 2, 2};
    EXPECT_EQ(site_share(std::array{right, right}), 0.25);
    EXPECT_EQ(site_share(std::array{right, left}), 0) << "one as it is, the other mirrored";
    EXPECT_EQ(site_share(std::array{left, left}), 0.5625);
    EXPECT_EQ(site_share(std::array{both, right}), 0.125);
    // one that agrees both ways agrees once: 2/4 for a state that is its own mirror image
    EXPECT_EQ(site_share(std::array{symmetric, symmetric}), 0.25);
    EXPECT_EQ(site_share(std::array{symmetric, right}), 0.25);
}

/// What the motion decides two structures tell no better than one; what it leaves open they do.
TEST(MotionTally, TwoIdenticalStructuresDoNotSharpenWhatTheMotionDecides)
{
    std::vector<double> decided, open;
    for (int m = 0; m < 100; ++m) {
        const std::uint32_t agree = m < 30 ? 1 : 0, second = m % 10 < 3 ? 1 : 0;
        const MotionTally first{1, 1, agree, 0, agree}, independent{1, 1, second, 0, second};
        decided.push_back(site_share(std::array{first, first}));
        open.push_back(site_share(std::array{first, independent}));
    }
    EXPECT_EQ(effective_count(decided, 100).successes, 30);
    EXPECT_EQ(effective_count(decided, 100).trials, 100);
    EXPECT_EQ(effective_count(open, 100).successes, 9);
}

TEST(MotionTally, AnEffectiveCountHasTheStandardErrorOfTheMean)
{
    const CellCount whole = effective_count(std::array{0.0, 1.0, 1.0, 0.0, 1.0}, 5);
    EXPECT_EQ(whole.trials, 5);
    EXPECT_EQ(whole.successes, 3);
    // mean 1/2, variance 1/16 of two: 0.25 / 8 = (1/16) / 2
    const CellCount two = effective_count(std::array{0.25, 0.75}, 100);
    EXPECT_NEAR(two.trials, 8, 1e-12);
    EXPECT_NEAR(two.successes, 4, 1e-12);
    EXPECT_EQ(effective_count(std::array{0.25, 0.75}, 6).trials, 6) << "not more than there are realizations";
    EXPECT_EQ(effective_count(std::array{0.5, 0.5, 0.5}, 12).trials, 12);
    EXPECT_EQ(effective_count(std::array{0.0, 0.0, 0.0}, 12).trials, 3);
    EXPECT_EQ(effective_count(std::array{0.0, 0.0, 0.0}, 12).successes, 0);
}

} // namespace
} // namespace stylobate

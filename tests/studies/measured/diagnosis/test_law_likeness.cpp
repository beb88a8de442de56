/// How unlike laws are: by hand, and in a world of laws whose truth is known.

#include "studies/measured/diagnosis/campaigns/campaign_ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace stylobate {
namespace {

using Numbers = std::vector<double>;
const double none = std::numeric_limits<double>::quiet_NaN();

/// Pairs that differ by these much in every number.
std::vector<std::pair<Numbers, Numbers>> pairs_apart(const Numbers& apart)
{
    std::vector<std::pair<Numbers, Numbers>> pairs;
    for (int i = 0; i < 8; ++i) {
        Numbers one(apart.size(), i), other = one;
        for (std::size_t k = 0; k < apart.size(); ++k)
            other[k] += apart[k];
        pairs.emplace_back(one, other);
    }
    return pairs;
}

TEST(LawLikeness, ByHand)
{
    // scatter of each number within a law: 1.4826 |difference| / sqrt 2
    const double unit = 1.4826 / std::sqrt(2.0);
    const LawLikeness likeness(pairs_apart({1, 2, 0.5, 1}), 0.75);
    // 3, 1, 2 and 4 units away; the farthest of the four is left out
    const Numbers of{0, 0, 0, 0}, other{3 * unit, 2 * unit, unit, 4 * unit};
    EXPECT_NEAR(likeness.distance(of, other), std::sqrt((9 + 1 + 4) / 3.0), 1e-12);
    EXPECT_DOUBLE_EQ(likeness.distance(of, of), 0);
    EXPECT_NEAR(LawLikeness(pairs_apart({1, 2, 0.5, 1}), 1).distance(of, other), std::sqrt((9 + 1 + 4 + 16) / 4.0),
                1e-12);
}

TEST(LawLikeness, WhatIsMissing)
{
    const double unit = 1.4826 / std::sqrt(2.0);
    const LawLikeness likeness(pairs_apart({1, 1, 1, 1}), 0.75);
    // what the measured campaign lacks does not count
    EXPECT_NEAR(likeness.distance({0, none, none, none}, {unit, 5, 5, 5}), 1, 1e-12);
    // what the other one lacks is far, as far as anything
    EXPECT_NEAR(likeness.distance({0, 0, none, none}, {0, none, 0, 0}), std::sqrt(100.0 / 2), 1e-12);
    // a number that does not scatter within a law has no unit
    EXPECT_DOUBLE_EQ(LawLikeness(pairs_apart({0, 0}), 0.75).distance({0, 0}, {7, 7}), 0);
}

/// Distances in units of a law's scatter; of the nearest so many others the mean.
TEST(IsolationPValue, IsTheRankOfTheMeanDistanceToTheNearest)
{
    const double unit = 1.4826 / std::sqrt(2.0);
    const LawLikeness likeness(pairs_apart({1}), 1);
    const std::vector<Numbers> nulls = {{0}, {unit}, {3 * unit}, {7 * unit}};
    const std::vector<double> apart = isolations(likeness, nulls, 2);
    ASSERT_EQ(apart.size(), 4U);
    EXPECT_NEAR(apart[0], (1 + 3) / 2.0, 1e-12);
    EXPECT_NEAR(apart[1], (1 + 2) / 2.0, 1e-12);
    EXPECT_NEAR(apart[2], (2 + 3) / 2.0, 1e-12);
    EXPECT_NEAR(apart[3], (4 + 6) / 2.0, 1e-12);
    EXPECT_NEAR(isolation(likeness, {5 * unit}, nulls, 2), 2, 1e-12);
    // of the nearest twelve here all: 5 + 4 + 2 + 2 over 4 beside (1 + 3 + 7) / 3, (1 + 2 + 6) / 3, (3 + 2 + 4) / 3 and
    // (7 + 6 + 4) / 3, of which two are as large
    EXPECT_NEAR(isolation_p_value(likeness, nulls, {5 * unit}), 3.0 / 5, 1e-12);
}

TEST(IsolationPValue, IsUniformForLawsOfTheFamilyAndSmallOutside)
{
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto law = [&](double centre) {
        Numbers out;
        for (int k = 0; k < 6; ++k)
            out.push_back(centre + normal(random));
        return out;
    };
    const LawLikeness likeness(pairs_apart({0.5, 0.5, 0.5, 0.5, 0.5, 0.5}), 0.75);
    std::vector<Numbers> nulls;
    for (int i = 0; i < 150; ++i)
        nulls.push_back(law(0));
    int small = 0, tiny = 0;
    for (int i = 0; i < 200; ++i) {
        const double p = isolation_p_value(likeness, nulls, law(0));
        small += p <= 0.1 ? 1 : 0;
        tiny += p <= 0.01 ? 1 : 0;
    }
    EXPECT_NEAR(small, 20, 14) << "3 standard deviations, with that of the nulls";
    EXPECT_LE(tiny, 8);
    EXPECT_LT(isolation_p_value(likeness, nulls, law(5)), 0.01);
}

} // namespace
} // namespace stylobate

/// How unlike laws are, by hand.

#include "studies/measured/diagnosis/campaigns/campaign_ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

} // namespace
} // namespace stylobate

/// The nearest cause: by hand, and how many numbers are independent, from draws.

#include "studies/measured/diagnosis/campaigns/nearest_cause.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace stylobate {
namespace {

/// 199 nulls at distances from 0.5 to 1.5.
NearnessEvidence evidence(double healthy, const std::vector<double>& distance, const std::vector<int>& mechanism)
{
    NearnessEvidence e;
    e.healthy = healthy;
    e.distance = distance;
    e.mechanism = mechanism;
    e.numbers = 10;
    e.gain_p_value = 0.05;
    for (int i = 0; i < 199; ++i)
        e.nulls.push_back(0.5 + i / 198.0);
    return e;
}

TEST(NearestCause, IsNamedWhereNoHealthyLawIsLikeTheMeasuredOne)
{
    const NearestCause found = nearest_cause(evidence(3, {2, 1.2, 1.3, 2.5}, {0, 1, 1, 2}), 2);
    EXPECT_EQ(found.best, 1);
    EXPECT_TRUE(found.named);
    EXPECT_DOUBLE_EQ(found.healthy_p, 1 / 200.0);
    EXPECT_NEAR(found.gain, 10 * std::log(3 / 1.2), 1e-12);
    EXPECT_TRUE(found.set.empty()) << "another candidate of its mechanism is no rival";
    // of healthy campaigns and of the two other mechanisms
    EXPECT_NEAR(found.probability, 1 / (1 + std::pow(1.2 / 3, 10) + std::pow(1.2 / 2, 10) + std::pow(1.2 / 2.5, 10)),
                1e-12);
}

TEST(NearestCause, IsNotNamedWhereAHealthyLawIs)
{
    EXPECT_FALSE(nearest_cause(evidence(1.4, {0.5}, {0}), 2).named)
        << "as far as healthy campaigns are from each other";
    EXPECT_FALSE(nearest_cause(evidence(3, {2.9, 2.5}, {0, 1}), 2).named) << "hardly nearer than healthy ones";
    EXPECT_TRUE(nearest_cause(evidence(3, {2.9, 2.3}, {0, 1}), 2).named);
}

TEST(NearestCause, RivalsAreInTheSet)
{
    const NearestCause found = nearest_cause(evidence(3, {1.1, 1.0, 1.14, 1.2}, {7, 8, 5, 6}), 2);
    EXPECT_EQ(found.best, 1);
    EXPECT_EQ(found.set, (std::vector<int>{7, 5}));
    const double a = std::pow(1.1, -10), b = std::pow(1.14, -10), others = std::pow(1.2, -10) + std::pow(3.0, -10);
    EXPECT_NEAR(found.probability, 1 / (1 + a + b + others), 1e-12);
    EXPECT_NEAR(found.set_probability, (1 + a + b) / (1 + a + b + others), 1e-12);
}

TEST(NearestCause, TakesThePlaceOfTheLikelihoodsWithTheSurerProbabilityWhereBothAgree)
{
    const std::vector<int> mechanism = {0, 1, 1, 2};
    NearestCause nearest; // of mechanism 1, and hardly nearer than that of mechanism 2
    nearest.best = 2;
    nearest.healthy_p = 0.005;
    nearest.probability = 0.4;
    nearest.set = {2};
    nearest.set_probability = 0.45;
    const auto joined = [&](int best, bool named, double probability) {
        EnsembleVerdict verdict;
        verdict.best = best;
        verdict.named = named;
        verdict.probability = verdict.set_probability = probability;
        verdict.unexplained = true;
        name_nearest(nearest, mechanism, verdict);
        EXPECT_EQ(verdict.best, 2);
        EXPECT_TRUE(verdict.named);
        EXPECT_FALSE(verdict.unexplained);
        EXPECT_EQ(verdict.p_value, 0.005);
        return std::pair(verdict.probability, verdict.set);
    };
    const std::pair by_nearness(0.4, std::vector<int>{2});
    EXPECT_EQ(joined(1, true, 0.9), std::pair(0.9, std::vector<int>{})) << "the same mechanism at another place";
    EXPECT_EQ(joined(1, false, 0.9), std::pair(0.9, std::vector<int>{})) << "which the likelihood alone does not name";
    EXPECT_EQ(joined(1, true, 0.3), by_nearness) << "less sure";
    EXPECT_EQ(joined(3, true, 0.9), by_nearness) << "another mechanism";
}

TEST(NearestCause, IsNotNamedWhereTheLikelihoodShowsNothing)
{
    NearnessEvidence e = evidence(3, {2.9, 1}, {0, 1});
    EXPECT_TRUE(nearest_cause(e, 2).named);
    e.gain_p_value = 0.11;
    EXPECT_FALSE(nearest_cause(e, 2).named);
    EXPECT_EQ(nearest_cause(e, 2).best, 1);
}

TEST(NearestCause, WithoutCampaignsThereIsNone)
{
    const double none = std::numeric_limits<double>::infinity();
    const NearestCause found = nearest_cause(evidence(3, {none, none}, {0, 1}), 2);
    EXPECT_EQ(found.best, -1);
    EXPECT_FALSE(found.named);
    EXPECT_EQ(nearest_cause(evidence(3, {none, 1}, {0, 1}), 2).best, 1);
}

TEST(NearestCause, IsNearerThanHealthyCampaignsByOneOfItsCandidates)
{
    const NearnessEvidence e = evidence(2, {2.5, 1.8, 1.95, 3}, {0, 0, 1, 2});
    EXPECT_TRUE(nearer_than_healthy(e, 0));
    EXPECT_FALSE(nearer_than_healthy(e, 1)) << "hardly nearer";
    EXPECT_FALSE(nearer_than_healthy(e, 2));
}

/// Squares of 12 normal numbers each, by a generator of the standard library.
TEST(IndependentNumbers, AreThoseOfWhichTheSquaresAreMade)
{
    std::mt19937_64 generator(5);
    std::normal_distribution<double> normal(0, 1.7);
    std::vector<double> squares;
    for (int i = 0; i < 4000; ++i) {
        double mean = 0;
        for (int k = 0; k < 12; ++k)
            mean += std::pow(normal(generator), 2) / 12;
        squares.push_back(mean);
    }
    // 2 / trigamma(6) = 11.03; the median deviation scatters by 1.9 % here, and the logarithm is not quite normal
    EXPECT_NEAR(independent_numbers(squares), 11, 1);
    EXPECT_EQ(independent_numbers({2, 2, 2}), 40) << "no scatter says nothing";
    EXPECT_EQ(independent_numbers({1, 1000, 1e-3}), 4);
}

} // namespace
} // namespace stylobate

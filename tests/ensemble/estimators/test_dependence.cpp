/// Whether a gain depends on a drawn quantity: the variance of the rank sum by all permutations, the share of false
/// alarms, and dependences that were planted.

#include "ensemble/estimators/paired/paired_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace stylobate {
namespace {

TEST(Dependence, RankSumHasTheVarianceOfAllPermutations)
{
    // two strata, ties among the values; y of the second one is permuted against its values too
    const std::vector<double> values = {0.3, 0.1, 0.1, 0.7, 0.5, 2, 1, 3, 3};
    const std::vector<int> y = {1, 0, -1, 0, 1, -1, 0, 0, 1};
    const std::size_t first = 5;
    std::vector<PairedTrial> trials;
    for (std::size_t i = 0; i < y.size(); ++i)
        trials.push_back({i < first ? std::size_t{0} : std::size_t{1}, y[i]<0, y[i]> 0});
    const Dependence found = dependence_on(trials, values, 0.95);
    const double z = found.z;

    const std::vector<double> ranks = {3, 1.5, 1.5, 5, 4, 2, 1, 3.5, 3.5}; // by hand
    const auto sum_of = [&](const std::vector<std::size_t>& order) {
        double sum = 0;
        for (std::size_t i = 0; i < y.size(); ++i)
            sum += ranks[i] * y[order[i]];
        return sum;
    };
    std::vector<std::size_t> order(y.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const double observed = sum_of(order);
    double mean = 0, square = 0, count = 0;
    do {
        std::sort(order.begin() + first, order.end());
        do {
            const double sum = sum_of(order);
            mean += sum;
            square += sum * sum;
            count += 1;
        } while (std::next_permutation(order.begin() + first, order.end()));
    } while (std::next_permutation(order.begin(), order.begin() + first));
    mean /= count;
    EXPECT_EQ(count, 120 * 24);
    EXPECT_NEAR(z, (observed - mean) / std::sqrt(square / count - mean * mean), 1e-12);
    EXPECT_NEAR(found.p, std::erfc(std::abs(z) / std::sqrt(2.0)), 1e-12); // both tails of the normal distribution

    // sorted 0.1 0.1 0.3 0.5 0.7 1 2 3 3: a third of the way of eight is 2 2/3, two thirds are 5 1/3
    EXPECT_NEAR(found.between[0], 0.3 + 0.2 * 2 / 3, 1e-12);
    EXPECT_NEAR(found.between[1], 1 + 1.0 / 3, 1e-12);
    // the middle third has y = 0, 1 of the first stratum and 0 of the second one
    EXPECT_NEAR(found.thirds[0].value, 0, 1e-12);
    EXPECT_NEAR(found.thirds[1].value, 0.25, 1e-12);
    EXPECT_NEAR(found.thirds[2].value, 0, 1e-12);
}

struct Drawn {
    std::vector<PairedTrial> trials;
    std::vector<double> values;
};

/// 12 cells of 60 pairs; the variant prevents a collapse with probability `slope` times the quantity, in [0, 1].
Drawn draw(double slope, double without, std::mt19937_64& random)
{
    std::uniform_real_distribution<double> uniform;
    Drawn out;
    for (std::size_t cell = 0; cell < 12; ++cell)
        for (int i = 0; i < 60; ++i) {
            const double value = uniform(random);
            const bool base = uniform(random) < 0.3 + 0.04 * static_cast<double>(cell);
            const bool saved = uniform(random) < without + slope * value;
            out.trials.push_back({cell, base, base && !saved});
            out.values.push_back(value);
        }
    return out;
}

TEST(DependenceStatistics, IsSeldomFoundWhereThereIsNone)
{
    std::mt19937_64 random(7);
    constexpr int repeats = 2000;
    int alarms = 0;
    for (int i = 0; i < repeats; ++i) {
        const Drawn drawn = draw(0, 0.3, random);
        alarms += dependence_on(drawn.trials, drawn.values, 0.95).p < 0.05;
    }
    // 5 % of 2,000: outside 100 +- 39 in one of 15,000 seeds
    EXPECT_NEAR(alarms, 100, 39);
}

TEST(Dependence, IsFoundWithItsSignAndSize)
{
    std::mt19937_64 random(8);
    const Drawn drawn = draw(0.8, 0, random);
    const Dependence found = dependence_on(drawn.trials, drawn.values, 0.95);
    EXPECT_LT(found.z, -5) << "the more of it, the lower the difference";
    EXPECT_LT(found.p, 1e-6);
    EXPECT_NEAR(found.between[0], 1.0 / 3, 0.05);
    EXPECT_NEAR(found.between[1], 2.0 / 3, 0.05);
    // the mean share of collapses is 0.52, of which 0.8 times the mean of each third is prevented
    for (std::size_t third = 0; third < 3; ++third) {
        const double truth = -0.52 * 0.8 * (static_cast<double>(third) + 0.5) / 3;
        EXPECT_LT(found.thirds[third].lower, truth);
        EXPECT_GT(found.thirds[third].upper, truth);
    }
}

TEST(Dependence, NothingThatVariesIsNoDependence)
{
    const std::vector<PairedTrial> same(30, PairedTrial{0, true, true});
    std::vector<double> values(30);
    std::iota(values.begin(), values.end(), 0.0);
    EXPECT_EQ(dependence_on(same, values, 0.95).p, 1);
    const std::vector<double> constant(30, 4.0);
    const Dependence found =
        dependence_on(std::vector<PairedTrial>{{0, true, false}, {0, false, false}, {0, true, true}},
                      std::span(constant).first(3), 0.95);
    EXPECT_EQ(found.z, 0);
    EXPECT_EQ(found.p, 1);
}

} // namespace
} // namespace stylobate

/// How many of alike structures stand after common earthquakes: closed forms, and a process that is simulated.

#include "ensemble/estimators/past/hazard_update.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

using namespace stylobate;

/// Independent structures: L_m = m L, and the sum is the binomial probability without its coefficient.
TEST(Past, HowManyAlikeStructuresStandIsBinomialWhereTheyFallIndependently)
{
    const double x = 0.3, c = 1.7, stands = std::exp(-c * x);
    EXPECT_NEAR(alike_likelihood(std::vector{x}, 1, c), stands, 1e-15);
    EXPECT_NEAR(alike_likelihood(std::vector{x, 2 * x, 3 * x, 4 * x}, 3, c), std::pow(stands, 3) * (1 - stands), 1e-15);
    EXPECT_NEAR(alike_likelihood(std::vector{x, 2 * x, 3 * x, 4 * x, 5 * x}, 2, c),
                std::pow(stands, 2) * std::pow(1 - stands, 3), 1e-15);
    // earthquakes that fell all or none: three stand or none does
    EXPECT_NEAR(alike_likelihood(std::vector{x, x, x}, 3, c), stands, 1e-15);
    EXPECT_NEAR(alike_likelihood(std::vector{x, x, x}, 2, c), 0, 1e-15);
}

/// Earthquakes as a Poisson process, each with the probability to stand 0.9 or 0.4, which three structures share.
TEST(PastStatistics, AlikeStructuresUnderCommonEarthquakesStandAsOftenAsTheSumSays)
{
    constexpr double events = 1.5;
    std::vector<double> exposure;
    for (int m = 1; m <= 3; ++m)
        exposure.push_back(events * (1 - 0.5 * (std::pow(0.9, m) + std::pow(0.4, m))));
    std::mt19937_64 random(31);
    std::poisson_distribution<int> number(events);
    std::uniform_real_distribution<double> uniform;
    constexpr int histories = 20000;
    std::array<int, 4> stand{};
    for (int h = 0; h < histories; ++h) {
        std::array<bool, 3> stands{true, true, true};
        for (int e = number(random); e > 0; --e) {
            const double p = uniform(random) < 0.5 ? 0.9 : 0.4;
            for (bool& one : stands)
                one = uniform(random) < p && one;
        }
        ++stand[static_cast<std::size_t>(std::count(stands.begin(), stands.end(), true))];
    }
    for (const auto& [n, choices] : {std::pair{1U, 3.0}, {2U, 3.0}, {3U, 1.0}}) {
        const double p = choices * alike_likelihood(exposure, n, 1);
        EXPECT_NEAR(stand[n], histories * p, 4 * std::sqrt(histories * p * (1 - p))) << n;
    }
}

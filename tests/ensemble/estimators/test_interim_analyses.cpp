/// The analyses at a cell of an adaptive surface: their exact coverage against simulation, and what it must be.

#include "ensemble/estimators/surface/interim_analyses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

using namespace stylobate;

namespace {

struct Replicated {
    double coverage;
    double trials;
};

/// Trial by trial, as a run does it: the oracle of the exact sums.
Replicated simulate(const InterimAnalyses& analyses, double p, int repeats, std::uint64_t seed)
{
    std::mt19937_64 engine(seed);
    std::bernoulli_distribution collapses(p);
    double covered = 0;
    double trials = 0;
    std::map<std::pair<std::uint64_t, std::uint64_t>, BinomialInterval> known; // they take longer than the trials
    for (int i = 0; i < repeats; ++i) {
        std::uint64_t n = 0;
        std::uint64_t s = 0;
        BinomialInterval interval;
        do {
            for (const std::uint64_t next = analyses.after(n); n < next; ++n)
                s += collapses(engine);
            const auto [at, is_new] = known.try_emplace({n, s});
            if (is_new)
                at->second = analyses.interval(n, s);
            interval = at->second;
        } while (!analyses.narrow(interval) && n < analyses.trials().back());
        covered += interval.lower <= p && p <= interval.upper;
        trials += static_cast<double>(n);
    }
    return {covered / repeats, trials / repeats};
}

} // namespace

TEST(InterimAnalyses, GoUpToWhereEveryCountIsEnough)
{
    const InterimAnalyses analyses(8, 100000, 0.05, 0.95);
    EXPECT_EQ(analyses.trials().front(), 8U);
    for (std::size_t k = 1; k < analyses.trials().size(); ++k) {
        const std::uint64_t before = analyses.trials()[k - 1];
        EXPECT_GT(analyses.trials()[k], before);
        EXPECT_LE(analyses.trials()[k], before + std::max<std::uint64_t>(8, before / 4 + 4));
        EXPECT_EQ(analyses.after(before), analyses.trials()[k]);
        EXPECT_EQ(analyses.after(analyses.trials()[k] - 1), analyses.trials()[k]);
    }
    const std::uint64_t last = analyses.trials().back();
    EXPECT_TRUE(analyses.narrow(analyses.interval(last, last / 2)));
    const std::uint64_t before = analyses.trials()[analyses.trials().size() - 2];
    EXPECT_FALSE(analyses.narrow(analyses.interval(before, before / 2)));

    const InterimAnalyses few(8, 100, 0.05, 0.95);
    EXPECT_EQ(few.trials().back(), 100U);
    const InterimAnalyses one(20, 20, 0.05, 0.95);
    EXPECT_EQ(one.trials(), std::vector<std::uint64_t>{20});
}

// 10,000 repeats: a coverage of 0.95 has a standard deviation of 0.0022, so that 4.5 of them is 0.01. Of 14 comparisons
// at 4.5 deviations one fails by chance once in 10,000 seeds; the seed is fixed.
TEST(InterimAnalyses, ExactCoverageIsThatOfSimulatedRuns)
{
    for (const double half_width : {0.05, 0.1}) {
        const InterimAnalyses analyses(8, 512, half_width, 0.95);
        for (const double p : {0.002, 0.02, 0.07, 0.105, 0.3, 0.5, 0.88}) {
            constexpr int repeats = 10000;
            const Replicated seen = simulate(analyses, p, repeats, 7);
            const InterimAnalyses::Expected exact = analyses.expected(p, analyses.trials().size());
            const double sd = std::sqrt(exact.coverage * (1 - exact.coverage) / repeats);
            EXPECT_NEAR(seen.coverage, exact.coverage, 4.5 * sd + 1e-6) << p << ' ' << half_width;
            EXPECT_NEAR(seen.trials, exact.trials, 0.02 * exact.trials) << p << ' ' << half_width;
        }
    }
}

// With the budget at an end after any analysis the average over p is right too; and the worst p has what Jeffreys'
// interval of a fixed number of trials has (0.8777 for 256), or more.
TEST(InterimAnalyses, CoverageIsRightWhereverTheAnalysesEnd)
{
    for (const double half_width : {0.03, 0.05, 0.1}) {
        const InterimAnalyses analyses(8, 512, half_width, 0.95);
        for (std::size_t k = 1; k <= analyses.trials().size(); ++k) {
            double sum = 0;
            double worst = 1;
            constexpr int parts = 389; // none of the points where it was made right
            for (int i = 0; i < parts; ++i) {
                const double coverage = analyses.expected((i + 0.5) / parts, k).coverage;
                sum += coverage;
                worst = std::min(worst, coverage);
            }
            EXPECT_GE(sum / parts, 0.949) << half_width << ", analysis " << k;
            EXPECT_LE(sum / parts, 0.98) << half_width << ", analysis " << k;
            EXPECT_GE(worst, 0.84) << half_width << ", analysis " << k;
        }
    }
}

TEST(InterimAnalyses, AUniformGridNeedsWhatTheNormalDistributionSays)
{
    // the posterior Beta(n/2 + 1/2, n/2 + 1/2) has the variance 1 / (4 (n + 2)): n = (1.96 / 2 h)^2 - 2
    for (const double h : {0.02, 0.05, 0.1})
        EXPECT_NEAR(static_cast<double>(uniform_trials(h, 0.95)), std::pow(1.96 / (2 * h), 2) - 2, 2) << h;
}

/// A single analysis of twenty trials: the binomial probabilities of the counts whose interval holds p.
TEST(InterimAnalyses, CoverageOfOneAnalysisByHand)
{
    const InterimAnalyses one(20, 20, 0.05, 0.95);
    for (const double p : {0.03, 0.3, 0.62}) {
        double coverage = 0, probability = std::pow(1 - p, 20);
        for (std::uint64_t s = 0; s <= 20; ++s) {
            const BinomialInterval interval = one.interval(20, s);
            coverage += interval.lower <= p && p <= interval.upper ? probability : 0;
            probability *= static_cast<double>(20 - s) / static_cast<double>(s + 1) * p / (1 - p);
        }
        EXPECT_NEAR(one.expected(p, 1).coverage, coverage, 1e-12) << p;
        EXPECT_NEAR(one.expected(p, 1).trials, 20, 1e-12);
    }
}

TEST(InterimAnalyses, ThePlainIntervalIsNotRightUnderTheRule)
{
    const InterimAnalyses analyses(8, 512, 0.05, 0.95);
    EXPECT_GT(analyses.interval_level(), 0.95);
    EXPECT_LT(analyses.interval_level(), 0.97);
    // an independent cell needs most at 1/2, least at 0 and 1
    const std::size_t all = analyses.trials().size();
    EXPECT_GT(analyses.expected(0.5, all).trials, 10 * analyses.expected(0.0001, all).trials);
    EXPECT_NEAR(analyses.expected(0.2, all).coverage, analyses.expected(0.8, all).coverage, 1e-9);
}

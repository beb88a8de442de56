/// Subset simulation of limit states whose probability is known in closed form.

#include "ensemble/estimators/subset_simulation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace stylobate;

namespace {

/// P(N > b).
double beyond(double b)
{
    return std::erfc(b / std::sqrt(2)) / 2;
}
double quantile_of(double p)
{
    double low = 0, high = 10;
    for (int i = 0; i < 100; ++i)
        (beyond((low + high) / 2) > p ? low : high) = (low + high) / 2;
    return low;
}

constexpr std::size_t dimension = 40;

/// Along the diagonal: standard normal.
double diagonal(const double* u)
{
    double sum = 0;
    for (std::size_t i = 0; i < dimension; ++i)
        sum += u[i];
    return sum / std::sqrt(static_cast<double>(dimension));
}

/// As a collapse is seen: a response that can be measured up to the fall, and is beyond all then.
Response falling(double limit)
{
    return [limit](const std::vector<double>& points, std::uint64_t) {
        std::vector<double> response;
        for (std::size_t i = 0; i < points.size(); i += dimension) {
            const double x = diagonal(&points[i]);
            response.push_back(x >= limit ? std::numeric_limits<double>::infinity() : x);
        }
        return response;
    };
}

struct Score {
    int held = 0, designs = 0;
    double sum = 0, evaluations = 0, plain = 0;
};

Score score(double p, const Response& response, double limit, int designs, std::size_t repeats, std::size_t samples)
{
    Score score;
    for (int design = 0; design < designs; ++design) {
        std::vector<double> found;
        double evaluations = 0;
        for (std::size_t r = 0; r < repeats; ++r) {
            const SubsetRun run = subset_simulation(
                dimension, response, {.samples = samples, .limit = limit, .seed = 100U + unsigned(design)}, r);
            found.push_back(run.probability);
            evaluations += static_cast<double>(run.evaluations);
        }
        const Estimate estimate = mean_of_repeats(found, 0.95);
        score.held += estimate.contains(p);
        score.sum += estimate.value;
        score.evaluations += evaluations;
        score.plain += 1 / plain_sampling_cost(found);
        ++score.designs;
    }
    return score;
}

/// 100 whole estimates, each of 10 repeats: 0.95 of them has a deviation of 0.022.
TEST(SubsetSimulation, IntervalsHoldWhatIsKnown)
{
    for (const double p : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const double limit = quantile_of(p);
        const Score s = score(p, falling(limit), limit, 100, 10, 500);
        const double gain = s.designs / s.plain / (s.evaluations / s.designs);
        const std::string text = fmt::format("p {:g}: held by {} of {}, mean {:.3g}, {:.0f} evaluations each, plain "
                                             "sampling takes {:.1f} times as many for the same error",
                                             p, s.held, s.designs, s.sum / s.designs, s.evaluations / s.designs, gain);
        std::printf("%s\n", text.c_str());
        EXPECT_GE(s.held, 88) << text;
        EXPECT_NEAR(s.sum / s.designs / p, 1, 0.1) << text;
        EXPECT_GT(gain, p > 5e-4 ? 1 : p > 5e-5 ? 5 : 40) << text;
    }
}

/// Two ways to fail, far apart in a space where most numbers do not matter: 2 P(N > b).
TEST(SubsetSimulation, TwoWaysToFail)
{
    const double p = 1e-4, limit = quantile_of(p / 2);
    const Response response = [](const std::vector<double>& points, std::uint64_t) {
        std::vector<double> g;
        for (std::size_t i = 0; i < points.size(); i += dimension)
            g.push_back(std::abs(points[i]));
        return g;
    };
    const Score s = score(p, response, limit, 60, 10, 500);
    EXPECT_GE(s.held, 51) << s.held;
    EXPECT_NEAR(s.sum / s.designs / p, 1, 0.1);
}

TEST(SubsetSimulation, IsTheSameHoweverABatchIsDone)
{
    const double limit = quantile_of(1e-4);
    const Response at_once = falling(limit);
    const Response backwards = [&](const std::vector<double>& points, std::uint64_t first) {
        std::vector<double> response(points.size() / dimension);
        for (std::size_t i = response.size(); i-- > 0;) {
            const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i * dimension);
            response[i] = at_once(std::vector<double>(begin, begin + dimension), first + i)[0];
        }
        return response;
    };
    const SubsetOptions options{.samples = 300, .limit = limit, .seed = 5};
    const SubsetRun a = subset_simulation(dimension, at_once, options, 3);
    const SubsetRun b = subset_simulation(dimension, backwards, options, 3);
    EXPECT_EQ(a.probability, b.probability);
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_NE(a.probability, subset_simulation(dimension, at_once, options, 4).probability);
    for (std::size_t i = 1; i < a.levels.size(); ++i) {
        EXPECT_GT(a.levels[i].threshold, a.levels[i - 1].threshold);
        EXPECT_NEAR(a.levels[i].acceptance, 0.44, 0.15);
        EXPECT_LT(a.levels[i].stuck, 0.2);
    }
}

TEST(SubsetSimulation, SaysWhatItCouldNotReach)
{
    // a response without a slope: the second level is no higher than the first
    const Response flat = [](const std::vector<double>& points, std::uint64_t) {
        return std::vector<double>(points.size() / dimension, 1.0);
    };
    const SubsetRun run = subset_simulation(dimension, flat, {.limit = 2}, 0);
    EXPECT_EQ(run.probability, 0);
    EXPECT_LE(run.levels.size(), 2U);
    EXPECT_TRUE(std::isnan(mean_of_repeats({0, 0, 0}, 0.95).value));
    EXPECT_TRUE(std::isnan(mean_of_repeats({1e-3}, 0.95).upper));
    // invalid realizations: no chain goes there, and they are counted
    const Response holes = [](const std::vector<double>& points, std::uint64_t) {
        std::vector<double> g;
        for (std::size_t i = 0; i < points.size(); i += dimension)
            g.push_back(points[i + 1] > 2 ? std::nan("") : points[i]);
        return g;
    };
    const SubsetRun with_holes = subset_simulation(dimension, holes, {.samples = 2000, .limit = 3}, 0);
    EXPECT_GT(with_holes.invalid, 20U);
    EXPECT_NEAR(with_holes.probability / (beyond(3) * (1 - beyond(2))), 1, 0.5);
    EXPECT_THROW(subset_simulation(dimension, flat, {.samples = 10}, 0), std::invalid_argument);
}

} // namespace

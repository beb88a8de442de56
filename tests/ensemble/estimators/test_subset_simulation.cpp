/// Subset simulation of limit states whose probability is known in closed form.

#include "tests/ensemble/estimators/rare_truth.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace stylobate;

namespace {

/// P(N > b).
double beyond(double b)
{
    return std::erfc(b / std::sqrt(2)) / 2;
}

struct Score {
    int held = 0, designs = 0;
    double sum = 0, squares = 0, evaluations = 0, plain = 0;
    double share() const { return static_cast<double>(held) / designs; }
    double mean() const { return sum / designs; }
    double error_of_mean() const { return std::sqrt((squares / designs - mean() * mean()) / designs); }
};

Score score(const RareTruth& truth, int designs, std::size_t repeats, std::size_t samples = 500)
{
    Score score;
    const Response response = truth.response();
    for (int design = 0; design < designs; ++design) {
        const SubsetOptions options{.samples = samples, .limit = truth.limit, .seed = 100U + unsigned(design)};
        const SubsetRun pilot = subset_pilot(truth.dimension, response, options);
        score.evaluations += static_cast<double>(pilot.evaluations);
        std::vector<double> found;
        double mean = 0;
        for (std::size_t r = 0; r < repeats; ++r) {
            const SubsetRun run = subset_simulation(truth.dimension, response, options, pilot.levels, r + 1);
            found.push_back(run.probability);
            mean += run.probability / truth.probability / static_cast<double>(repeats);
            score.evaluations += static_cast<double>(run.evaluations);
        }
        score.held += mean_of_repeats(found, 0.95).contains(truth.probability);
        score.sum += mean;
        score.squares += mean * mean;
        score.plain += 1 / plain_sampling_cost(found);
        ++score.designs;
    }
    return score;
}

/// Runs of two limit states, which are taken as the repeats of estimates of 5, of 10 and of 20: 140 intervals of
/// either.
TEST(SubsetSimulationStatistics, IntervalsOfAnyNumberOfRepeatsHoldWhatIsKnown)
{
    int held = 0, intervals = 0;
    for (const RareTruth& truth : {rare_plane(1e-4), rare_corner(1e-4)}) {
        std::vector<double> found;
        double sum = 0;
        const SubsetOptions options{.limit = truth.limit, .seed = 7};
        const SubsetRun pilot = subset_pilot(truth.dimension, truth.response(), options);
        for (std::size_t r = 1; r <= 400; ++r) {
            found.push_back(subset_simulation(truth.dimension, truth.response(), options, pilot.levels, r).probability);
            sum += found.back() / truth.probability;
        }
        EXPECT_NEAR(sum / 400, 1, 0.09) << truth.name << ": each is 0.5 off, so that four deviations are 0.1";
        for (const std::size_t repeats : {5, 10, 20})
            for (std::size_t first = 0; first < found.size(); first += repeats, ++intervals)
                held += mean_of_repeats({found.begin() + static_cast<std::ptrdiff_t>(first),
                                         found.begin() + static_cast<std::ptrdiff_t>(first + repeats)},
                                        0.95)
                            .contains(truth.probability);
    }
    // 266 are expected; if all were independent 250 or fewer would hold in 1 of 10,000 tests, and all in 1 of 10^6
    EXPECT_EQ(intervals, 280);
    EXPECT_GT(held, 250);
    EXPECT_LT(held, 280);
    EXPECT_TRUE(std::isnan(mean_of_repeats({1e-4, 2e-4, 1e-4, 1e-4}, 0.95).value)) << "too few";
}

/// 2000 whole estimates, each of 10 repeats of 500 samples: 0.95 of them has a deviation of 0.005.
TEST(SubsetSimulationStatisticsLong, IntervalsHoldWhatIsKnown)
{
    int held = 0, designs = 0;
    for (const RareTruth& truth :
         {rare_plane(1e-3), rare_plane(1e-5), rare_plane(1e-6), rare_pair(1e-4), rare_corner(1e-4)}) {
        const Score s = score(truth, 400, 10);
        const double gain = s.designs / s.plain / (s.evaluations / s.designs);
        const std::string text =
            fmt::format("{} of {:g}: held by {} of {}, mean {:.4f} of it, plain sampling takes {:.1f} "
                        "times as many for the same error",
                        truth.name, truth.probability, s.held, s.designs, s.mean(), gain);
        std::printf("%s\n", text.c_str());
        held += s.held;
        designs += s.designs;
        EXPECT_GE(s.share(), 0.92) << text;                      // three deviations
        EXPECT_NEAR(s.mean(), 1, 4 * s.error_of_mean()) << text; // 1 in 16,000 by chance
        EXPECT_GT(gain, truth.probability > 5e-4 ? 1 : truth.probability > 5e-5 ? 5 : 40) << text;
    }
    EXPECT_NEAR(static_cast<double>(held) / designs, 0.95, 0.015) << held << " of " << designs; // three deviations
}

/// With few repeats and with many.
TEST(SubsetSimulationStatisticsLong, IntervalsHoldWithAnyNumberOfRepeats)
{
    for (const std::size_t repeats : {5, 20, 40}) {
        const Score s = score(rare_plane(1e-4), 400, repeats);
        EXPECT_NEAR(s.share(), 0.95, 0.033) << repeats << " repeats: three deviations";
    }
}

/// The mean of many estimates, which the choice of levels and of steps must not pull to one side. With five chains of
/// ten samples the pilots themselves are 4 % too large (200,000 of them: 1.042 +- 0.003), the standard error of the
/// mean of 60,000 repeats is 0.6 %, and four of them are allowed: 1 in 16,000 by chance.
TEST(SubsetSimulationStatisticsLong, IsUnbiased)
{
    const Score few = score(rare_plane(1e-3, 2), 6000, 10, 50);
    EXPECT_LT(few.error_of_mean(), 0.0075);
    EXPECT_NEAR(few.mean(), 1, 4 * few.error_of_mean());
    for (const RareTruth& truth : {rare_shell(1e-4), rare_corner(1e-4)}) {
        const Score s = score(truth, 200, 10);
        EXPECT_LT(s.error_of_mean(), 0.015) << truth.name;
        EXPECT_NEAR(s.mean(), 1, 4 * s.error_of_mean()) << truth.name;
    }
}

/// Repeats keep what the pilot has chosen, whatever their own responses are.
TEST(SubsetSimulationStatistics, RepeatsKeepTheLevelsAndStepsOfThePilot)
{
    const RareTruth truth = rare_plane(1e-4);
    const SubsetOptions options{.samples = 200, .limit = truth.limit, .seed = 3};
    const SubsetRun pilot = subset_pilot(truth.dimension, truth.response(), options);
    ASSERT_GE(pilot.levels.size(), 4U);
    const SubsetRun run = subset_simulation(truth.dimension, truth.response(), options, pilot.levels, 1);
    ASSERT_EQ(run.levels.size(), pilot.levels.size());
    double product = 1;
    for (std::size_t l = 0; l < run.levels.size(); ++l) {
        EXPECT_EQ(run.levels[l].threshold, pilot.levels[l].threshold);
        EXPECT_EQ(run.levels[l].steps, pilot.levels[l].steps);
        EXPECT_EQ(run.levels[l].steps.size(), l == 0 ? 0U : 9U); // chains of ten samples
        product *= run.levels[l].probability;
    }
    EXPECT_EQ(run.probability, product);
    // a repeat with nothing above a threshold ends there, as 0
    std::vector<SubsetLevel> far = pilot.levels;
    far[1].threshold = 100;
    const SubsetRun none = subset_simulation(truth.dimension, truth.response(), options, far, 1);
    EXPECT_EQ(none.probability, 0);
    EXPECT_EQ(none.evaluations, 200U);
}

/// Cox's interval of a lognormal mean: with logarithms of mean m and variance v, by hand.
TEST(SubsetSimulationStatistics, IntervalOfRepeatsByHand)
{
    const double e = std::exp(1.0);
    const Estimate found =
        mean_of_repeats({1e-4, 1e-4 * e, 1e-4 * e * e, 1e-4 * e * e * e, 1e-4 * e * e * e * e}, 0.95);
    EXPECT_NEAR(found.value, 1e-4 * (1 + e + e * e + e * e * e + e * e * e * e) / 5, 1e-12);
    // m = 2, v = 2.5, t of four degrees 2.776445: 2 + 1.25 -+ 2.776445 sqrt(0.5 + 0.78125)
    EXPECT_NEAR(std::log(found.lower * 1e4), 3.25 - 2.776445 * std::sqrt(1.28125), 1e-5);
    EXPECT_NEAR(std::log(found.upper * 1e4), 3.25 + 2.776445 * std::sqrt(1.28125), 1e-5);
    const Estimate zero = mean_of_repeats({0, 1e-4, 1e-4, 1e-4, 1e-4}, 0.95);
    EXPECT_NEAR(zero.value, 0.8e-4, 1e-12);
    EXPECT_TRUE(std::isnan(zero.lower) && std::isnan(zero.upper));
}

/// Repeats of mean 2e-4 and variance 0.5e-8 (1 - p are 0.9998): n p (1 - p) / s^2 = 5 x 2e-4 x 0.9998 / 0.5e-8.
TEST(SubsetSimulation, PlainCostByHand)
{
    EXPECT_NEAR(plain_sampling_cost({1e-4, 2e-4, 3e-4, 2e-4, 2e-4}), 199960, 1e-6);
}

/// The shares of the levels are counted anew from the responses alone, in the order in which they were asked for.
TEST(SubsetSimulation, ProbabilityIsTheProductOfTheCountedShares)
{
    const RareTruth truth = rare_plane(1e-3, 3);
    const Response response = truth.response();
    std::vector<std::vector<double>> batches;
    const Response recorded = [&](const std::vector<double>& points, std::uint64_t first) {
        batches.push_back(response(points, first));
        return batches.back();
    };
    constexpr std::size_t samples = 60, chains = 12, steps = 5;
    const SubsetRun run =
        subset_pilot(3, recorded, {.samples = samples, .level_probability = 0.2, .limit = truth.limit, .seed = 2});
    std::vector<double> level = batches.front();
    double product = 1;
    std::size_t batch = 1;
    for (std::size_t l = 0;; ++l) {
        std::vector<double> sorted = level;
        std::sort(sorted.rbegin(), sorted.rend());
        const double next = sorted[chains]; // the greatest of those that do not go on
        const bool last = next >= truth.limit;
        std::vector<double> above;
        double reached = 0;
        for (const double g : level) {
            reached += g >= truth.limit;
            if (g > next)
                above.push_back(g);
        }
        const double share = (last ? reached : static_cast<double>(above.size())) / samples;
        ASSERT_LT(l, run.levels.size());
        EXPECT_EQ(run.levels[l].probability, share) << l;
        product *= share;
        if (last) {
            EXPECT_EQ(run.levels.size(), l + 1);
            break;
        }
        std::vector<double> at;
        for (std::size_t c = 0; c < chains; ++c)
            at.push_back(above[c * above.size() / chains]);
        level = at;
        for (std::size_t step = 1; step < steps; ++step, ++batch) {
            for (std::size_t c = 0; c < chains; ++c)
                at[c] = batches[batch][c] > next ? batches[batch][c] : at[c];
            level.insert(level.end(), at.begin(), at.end());
        }
    }
    EXPECT_NEAR(run.probability / product, 1, 1e-12);
    EXPECT_GE(run.levels.size(), 3U);
}

TEST(SubsetSimulationStatistics, IsTheSameHoweverABatchIsDone)
{
    constexpr std::size_t dimension = 40;
    const RareTruth truth = rare_plane(1e-4, dimension);
    const double limit = truth.limit;
    const Response at_once = truth.response();
    const Response backwards = [&](const std::vector<double>& points, std::uint64_t first) {
        std::vector<double> response(points.size() / dimension);
        for (std::size_t i = response.size(); i-- > 0;) {
            const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i * dimension);
            response[i] = at_once(std::vector<double>(begin, begin + dimension), first + i)[0];
        }
        return response;
    };
    const SubsetOptions options{.samples = 300, .limit = limit, .seed = 5};
    const std::vector<SubsetLevel> plan = subset_pilot(dimension, at_once, options).levels;
    const SubsetRun a = subset_simulation(dimension, at_once, options, plan, 3);
    const SubsetRun b =
        subset_simulation(dimension, backwards, options, subset_pilot(dimension, backwards, options).levels, 3);
    EXPECT_EQ(a.probability, b.probability);
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_NE(a.probability, subset_simulation(dimension, at_once, options, plan, 4).probability);
    for (std::size_t i = 1; i < a.levels.size(); ++i) {
        EXPECT_GT(a.levels[i].threshold, a.levels[i - 1].threshold);
        EXPECT_NEAR(a.levels[i].acceptance, 0.44, 0.15);
        EXPECT_LT(a.levels[i].stuck, 0.2);
    }
}

TEST(SubsetSimulationStatistics, SaysWhatItCouldNotReach)
{
    constexpr std::size_t dimension = 10;
    // a response without a slope: the second level is no higher than the first
    const Response flat = [](const std::vector<double>& points, std::uint64_t) {
        return std::vector<double>(points.size() / dimension, 1.0);
    };
    const SubsetRun run = subset_pilot(dimension, flat, {.limit = 2});
    EXPECT_EQ(run.probability, 0);
    EXPECT_LE(run.levels.size(), 2U);
    EXPECT_EQ(subset_simulation(dimension, flat, {.limit = 2}, run.levels, 1).probability, 0);
    EXPECT_TRUE(std::isnan(mean_of_repeats({0, 0, 0, 0, 0}, 0.95).value));
    EXPECT_TRUE(std::isnan(mean_of_repeats({1e-3}, 0.95).upper));
    // invalid realizations: no chain goes there, and they are counted
    const Response holes = [](const std::vector<double>& points, std::uint64_t) {
        std::vector<double> g;
        for (std::size_t i = 0; i < points.size(); i += dimension)
            g.push_back(points[i + 1] > 2 ? std::nan("") : points[i]);
        return g;
    };
    const SubsetRun with_holes = subset_pilot(dimension, holes, {.samples = 2000, .limit = 3});
    EXPECT_GT(with_holes.invalid, 20U);
    EXPECT_NEAR(with_holes.probability / (beyond(3) * (1 - beyond(2))), 1, 0.5);
    EXPECT_THROW(subset_pilot(dimension, flat, {.samples = 10}), std::invalid_argument);
}

} // namespace

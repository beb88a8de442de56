/// What neighbouring cells say about a cell: closed forms where a neighbour is known exactly, symmetries,
/// contradiction.

#include "ensemble/estimators/surface/adaptive.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

using namespace stylobate;

namespace {

SurfaceTrials surface(std::size_t rows, std::size_t columns, std::uint64_t trials)
{
    return {rows, columns, std::vector<std::uint64_t>(rows * columns, trials),
            std::vector<std::uint64_t>(rows * columns, 0)};
}

/// Trials drawn of a surface that rises with the column and falls with the row.
SurfaceTrials drawn(std::size_t rows, std::size_t columns, std::uint64_t seed)
{
    std::mt19937_64 engine(seed);
    SurfaceTrials data = surface(rows, columns, 0);
    for (std::size_t cell = 0; cell < data.cells(); ++cell) {
        const double u = 1.5 * (static_cast<double>(cell % columns) - 3) - static_cast<double>(cell / columns) + 2;
        data.trials[cell] = 8 + engine() % 60;
        for (std::uint64_t i = 0; i < data.trials[cell]; ++i)
            data.collapses[cell] += std::bernoulli_distribution(1 / (1 + std::exp(-u)))(engine);
    }
    return data;
}

double width(const SurfaceEstimate& estimate)
{
    return estimate.interval.upper - estimate.interval.lower;
}

void expect_same(const SurfaceEstimate& a, const SurfaceEstimate& b)
{
    EXPECT_EQ(a.probability, b.probability);
    EXPECT_EQ(a.interval.lower, b.interval.lower);
    EXPECT_EQ(a.interval.upper, b.interval.upper);
    EXPECT_EQ(a.agrees_with_neighbours, b.agrees_with_neighbours);
}

double normal(double u, double mean, double variance)
{
    return std::exp(-(u - mean) * (u - mean) / (2 * variance)) / std::sqrt(2 * M_PI * variance);
}

/// The posterior of one cell in p by the trapezoidal rule in u = logit p, from a density of u.
template <class Prior>
SurfaceEstimate integrate(Prior prior, double trials, double collapses)
{
    std::vector<double> density;
    std::vector<double> p;
    double sum = 0;
    double mean = 0;
    for (double u = -30; u <= 30; u += 0.002) {
        p.push_back(1 / (1 + std::exp(-u)));
        density.push_back(prior(u) * std::exp(collapses * u - trials * std::log1p(std::exp(u))));
        sum += density.back();
        mean += density.back() * p.back();
    }
    const auto quantile = [&](double part) {
        double below = 0;
        std::size_t i = 0;
        while (below < part * sum)
            below += density[i++];
        return p[i - 1];
    };
    SurfaceEstimate estimate;
    estimate.probability = mean / sum;
    estimate.interval = {quantile(0.025), quantile(0.975)};
    return estimate;
}

double jeffreys_prior(double u)
{
    const double p = 1 / (1 + std::exp(-u));
    return std::sqrt(p * (1 - p)) / M_PI;
}

double matern_at_lag(double lag, double length)
{
    const double d = std::sqrt(5.0) * lag / length;
    return (1 + d + d * d / 3) * std::exp(-d);
}

struct Process {
    double length, sd, misfit;
};
/// The settings of a row of cells (all three row lengths are the same there).
std::vector<Process> processes()
{
    std::vector<Process> all;
    for (const double length : {1.2, 3.0, 8.0})
        for (const auto& [sd, misfit] : {std::pair(2.0, 0.1), {2.0, 0.4}, {6.0, 0.3}, {6.0, 1.0}})
            all.push_back({length, sd, misfit});
    return all;
}

} // namespace

TEST(SurfaceModel, ACellAloneHasTheMixtureOfThePriors)
{
    SurfaceTrials data = surface(1, 1, 30);
    data.collapses[0] = 11;
    SurfaceModel model(0.95);
    const SurfaceEstimate got = model.estimate(data)[0];
    const auto prior = [](double u) {
        double sum = 0;
        for (const Process& process : processes())
            sum += normal(u, 0, 16 + process.sd * process.sd + process.misfit * process.misfit) / 12;
        return 0.89 * sum + 0.11 * jeffreys_prior(u);
    };
    const SurfaceEstimate want = integrate(prior, 30, 11);
    EXPECT_NEAR(got.probability, want.probability, 1e-3);
    EXPECT_NEAR(got.interval.lower, want.interval.lower, 2e-3);
    EXPECT_NEAR(got.interval.upper, want.interval.upper, 2e-3);
}

// With a million trials the neighbour's logit is known (to 0.002), and what it says is the conditional normal
// distribution. Each of the two cells judges the settings of the other: how well the first one predicts the million.
TEST(SurfaceModel, ANeighbourKnownExactlySaysTheConditionalNormal)
{
    SurfaceTrials data = surface(1, 2, 0);
    data.trials = {12, 1000000};
    data.collapses = {3, 200000};
    SurfaceModel model(0.95);
    const SurfaceEstimate got = model.estimate(data)[0];

    const double known = std::log(0.2 / 0.8);
    std::vector<Process> all = processes();
    std::vector<double> mean, variance, weight, weight_alone;
    for (const Process& process : all) {
        const double own = 16 + process.sd * process.sd + process.misfit * process.misfit;
        const double both = 16 + process.sd * process.sd * matern_at_lag(1, process.length);
        mean.push_back(both / own * known);
        variance.push_back(own - both * both / own);
        // the evidence of the million under what the first cell's twelve trials say of it, against B's: both are the
        // densities at the known logit
        const auto density = [&](double u) { return normal(u, 0, own); };
        double said = 0;
        double norm = 0;
        for (double u = -30; u <= 30; u += 0.01) {
            const double d = density(u) * std::exp(3 * u - 12 * std::log1p(std::exp(u)));
            norm += d;
            said += d * normal(known, both / own * u, own - both * both / own);
        }
        weight.push_back(said / norm);
    }
    double alone = 0;
    for (std::size_t t = 0; t < all.size(); ++t) {
        double with = 0;
        for (const double e : {0.02, 0.2}) {
            const double score = (1 - e) * weight[t] + e * jeffreys_prior(known);
            with += score * (1 - e);
            alone += score * e;
        }
        weight[t] = with;
    }
    const auto prior = [&](double u) {
        double sum = alone * jeffreys_prior(u);
        for (std::size_t t = 0; t < all.size(); ++t)
            sum += weight[t] * normal(u, mean[t], variance[t]);
        return sum;
    };
    const SurfaceEstimate want = integrate(prior, 12, 3);
    // Laplace's approximation of twelve trials is in the weights only
    EXPECT_NEAR(got.probability, want.probability, 4e-3);
    EXPECT_NEAR(got.interval.lower, want.interval.lower, 6e-3);
    EXPECT_NEAR(got.interval.upper, want.interval.upper, 6e-3);
    EXPECT_TRUE(got.agrees_with_neighbours);
}

TEST(SurfaceModel, TransposedAndTurnedOverItIsTheSame)
{
    const SurfaceTrials data = drawn(6, 8, 3);
    SurfaceTrials transposed = surface(8, 6, 0);
    SurfaceTrials turned = data;
    for (std::size_t cell = 0; cell < data.cells(); ++cell) {
        const std::size_t to = cell % 8 * 6 + cell / 8;
        transposed.trials[to] = data.trials[cell];
        transposed.collapses[to] = data.collapses[cell];
        turned.collapses[cell] = data.trials[cell] - data.collapses[cell];
    }
    SurfaceModel a(0.95), b(0.95), c(0.95);
    const auto straight = a.estimate(data);
    const auto across = b.estimate(transposed);
    const auto over = c.estimate(turned);
    for (std::size_t cell = 0; cell < data.cells(); ++cell) {
        const SurfaceEstimate& same = across[cell % 8 * 6 + cell / 8];
        EXPECT_NEAR(straight[cell].probability, same.probability, 1e-4) << cell;
        EXPECT_NEAR(straight[cell].interval.upper, same.interval.upper, 1e-3) << cell;
        EXPECT_NEAR(straight[cell].probability, 1 - over[cell].probability, 1e-4) << cell;
        EXPECT_NEAR(straight[cell].interval.lower, 1 - over[cell].interval.upper, 1e-3) << cell;
    }
}

TEST(SurfaceModel, SameBitsWhateverWasAskedBeforeAndWithAnyThreads)
{
    SurfaceTrials data = drawn(7, 7, 5);
    SurfaceModel fresh(0.95), used(0.95), alone(0.95);
    SurfaceTrials before = data;
    for (const std::size_t cell : {3, 24, 25, 48}) {
        before.trials[cell] += 9;
        before.collapses[cell] += 4;
    }
    used.estimate(drawn(3, 3, 1));
    used.estimate(before);
    const auto a = fresh.estimate(data);
    const auto b = used.estimate(data);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto c = alone.estimate(data);
    for (std::size_t cell = 0; cell < data.cells(); ++cell) {
        expect_same(a[cell], b[cell]);
        expect_same(a[cell], c[cell]);
    }
}

TEST(SurfaceModel, BorrowsOnAPlateauAndAlongACliffNotAcrossIt)
{
    SurfaceTrials data = surface(9, 9, 8);
    for (std::size_t cell = 0; cell < data.cells(); ++cell)
        if (cell % 9 >= 5)
            data.collapses[cell] = 8;
    SurfaceModel model(0.95);
    const auto estimates = model.estimate(data);
    // eight trials without a fall say no more than p < 0.26 by themselves
    for (std::size_t row = 0; row < 9; ++row) {
        EXPECT_LT(estimates[row * 9 + 1].interval.upper, 0.1) << row;
        EXPECT_GT(estimates[row * 9 + 7].interval.lower, 0.9) << row;
        // at the edge of the cliff it knows less
        EXPECT_GT(width(estimates[row * 9 + 4]), width(estimates[row * 9 + 1])) << row;
        EXPECT_LT(estimates[row * 9 + 4].probability, 0.1) << row;
        EXPECT_GT(estimates[row * 9 + 5].probability, 0.9) << row;
    }
}

TEST(SurfaceModel, ACellThatContradictsItsNeighboursIsLeftToItsOwnTrials)
{
    SurfaceTrials data = surface(9, 9, 60);
    data.collapses[4 * 9 + 4] = 30;
    SurfaceModel model(0.95);
    const auto estimates = model.estimate(data);
    EXPECT_FALSE(estimates[4 * 9 + 4].agrees_with_neighbours);
    const BinomialInterval own = jeffreys(60, 30, 0.95);
    EXPECT_NEAR(estimates[4 * 9 + 4].interval.lower, own.lower, 0.03);
    EXPECT_NEAR(estimates[4 * 9 + 4].interval.upper, own.upper, 0.03);
    // and its neighbours, which have trials enough, are not bent by it
    EXPECT_TRUE(estimates[4 * 9 + 3].agrees_with_neighbours);
    EXPECT_LT(estimates[4 * 9 + 3].interval.upper, jeffreys(60, 0, 0.95).upper * 1.2);
}

TEST(SurfaceModel, MoreTrialsMakeItNarrower)
{
    SurfaceTrials data = drawn(6, 6, 9);
    SurfaceModel model(0.95);
    const auto before = model.estimate(data);
    for (std::size_t cell = 0; cell < data.cells(); ++cell) {
        data.trials[cell] *= 10;
        data.collapses[cell] *= 10;
    }
    const auto after = model.estimate(data);
    double sum = 0;
    for (std::size_t cell = 0; cell < data.cells(); ++cell)
        sum += width(after[cell]) / width(before[cell]);
    EXPECT_LT(sum / static_cast<double>(data.cells()), 0.55);
}

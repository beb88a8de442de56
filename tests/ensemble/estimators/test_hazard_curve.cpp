/// Integrals over a hazard curve against closed forms and against sums over fine steps.

#include "ensemble/estimators/risk/frequency_estimate.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/numerics/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace stylobate {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double phi_below(double z)
{
    return std::erfc(-z / std::sqrt(2.0)) / 2;
}

HazardCurve power_law(double k0, double k)
{
    return {std::vector<double>{1, 10}, std::vector<double>{k0, k0 * std::pow(10, -k)}};
}

/// A curve as sites have it: steeper and steeper, its points of any spacing, two of them equal.
struct Table {
    std::vector<double> intensity{0.1, 0.15, 0.4, 1, 1.3, 2.5, 6}, frequency{0.3, 0.3, 0.05, 6e-3, 3e-3, 2e-4, 1e-7};
    HazardCurve curve{intensity, frequency};
};

/// The integral of P -d lambda by the mean value of P in steps of `step` in ln im.
template <class P>
double summed(const HazardCurve& hazard, P&& probability, double from, double to, double step)
{
    double sum = 0;
    const auto steps = static_cast<int>(std::ceil((to - from) / step));
    for (int i = 0; i < steps; ++i) {
        const double a = from + (to - from) * i / steps, b = from + (to - from) * (i + 1) / steps;
        // Simpson's mean of P over the frequency of the step
        sum += (probability(a) + 4 * probability((a + b) / 2) + probability(b)) / 6 *
               (hazard.frequency(a) - hazard.frequency(b));
    }
    return sum;
}

TEST(HazardCurve, FrequencyPassesThroughItsPointsAndIsALineBetweenThem)
{
    const Table table;
    for (std::size_t i = 0; i < table.intensity.size(); ++i)
        EXPECT_NEAR(table.curve.frequency(std::log(table.intensity[i])), table.frequency[i],
                    1e-13 * table.frequency[i]);
    EXPECT_NEAR(table.curve.frequency(std::log(std::sqrt(0.4 * 1))), std::sqrt(0.05 * 6e-3), 1e-12);
    EXPECT_DOUBLE_EQ(table.curve.frequency(-infinity), 0.3);
    EXPECT_NEAR(power_law(2e-4, 3).frequency(std::log(0.01)), 2e2, 1e-10);
    for (const double x : {-3.0, 0.1, 0.9, 3.0}) { // the density is minus the slope, on pieces and beyond the ends
        const double h = 1e-6;
        EXPECT_NEAR(table.curve.density(x), (table.curve.frequency(x - h) - table.curve.frequency(x + h)) / (2 * h),
                    1e-8 * (1 + table.curve.density(x)));
    }
}

TEST(HazardCurve, IntensityIsTheInverseOfFrequency)
{
    const Table table;
    for (const double x : {-1.85, -0.4, 0.0, 0.5, 1.2, 2.5})
        EXPECT_NEAR(table.curve.log_intensity(table.curve.frequency(x)), x, 1e-12);
}

TEST(HazardCurve, CornellsClosedForm)
{
    for (const double k : {0.8, 2.5, 4.0, 9.0})
        for (const double median : {0.05, 0.7, 12.0})
            for (const double beta : {0.05, 0.4, 1.1, 3.0}) {
                const double k0 = 3e-4, want = k0 * std::pow(median, -k) * std::exp(k * k * beta * beta / 2);
                const double found =
                    power_law(k0, k).lognormal_integral(-std::log(median) / beta, 1 / beta, -infinity, infinity);
                EXPECT_NEAR(found / want, 1, 1e-12) << k << ' ' << median << ' ' << beta;
            }
}

TEST(HazardCurve, LognormalIntegralOfATableIsThatOfSmallSteps)
{
    const Table table;
    for (const double beta : {0.02, 0.3, 0.9})
        for (const double median : {0.12, 0.8, 3.0}) {
            const double b0 = -std::log(median) / beta, b1 = 1 / beta;
            for (const auto& [from, to] : {std::pair(-2.2, 1.7), std::pair(-0.3, 0.1), std::pair(1.5, 5.0)}) {
                const double want = summed(
                    table.curve, [&](double x) { return phi_below(b0 + b1 * x); }, from, to, 1e-4);
                EXPECT_NEAR(table.curve.lognormal_integral(b0, b1, from, to), want, 1e-7 * want + 1e-18)
                    << beta << ' ' << median << ' ' << from;
            }
            const double whole = table.curve.lognormal_integral(b0, b1, -infinity, infinity);
            const double parts = table.curve.lognormal_integral(b0, b1, -infinity, -0.1) +
                                 table.curve.lognormal_integral(b0, b1, -0.1, infinity);
            EXPECT_NEAR(parts / whole, 1, 1e-12);
        }
}

TEST(HazardCurve, SteepHazardNeitherOverflowsNorCancels)
{
    // k beta = 60: exp(k^2 beta^2 / 2) alone is beyond a double
    const std::vector<double> intensity{1, 1.2, 1.4}, frequency{1e-3, 1e-3 * std::pow(1.2, -60), 1e-30};
    const HazardCurve hazard(intensity, frequency);
    const double want = summed(
        hazard, [](double x) { return phi_below(x - 0.5); }, 0, std::log(1.4), 1e-5);
    EXPECT_NEAR(hazard.lognormal_integral(-0.5, 1, 0, std::log(1.4)) / want, 1, 1e-6);
}

TEST(HazardCurve, NodeWeightsAreThoseOfSmallSteps)
{
    const Table table;
    const std::vector<double> nodes{std::log(0.3), std::log(0.7), std::log(1.1), std::log(3.0)};
    const std::vector<double> p{0.02, 0.3, 0.25, 0.9};
    const auto probability = [&](double x) {
        const double first = nodes[1] - nodes[0];
        if (x <= nodes[0])
            return std::max(0.0, p[0] * (1 - (nodes[0] - x) / first));
        for (std::size_t j = 0; j + 1 < nodes.size(); ++j)
            if (x <= nodes[j + 1])
                return std::lerp(p[j], p[j + 1], (x - nodes[j]) / (nodes[j + 1] - nodes[j]));
        return p.back();
    };
    for (const auto& [from, to] : {std::pair(-4.0, 6.0), std::pair(-1.0, 0.2), std::pair(1.0, 2.0)}) {
        const std::vector<double> weights = table.curve.node_weights(nodes, from, to);
        double found = 0;
        for (std::size_t j = 0; j < p.size(); ++j)
            found += weights[j] * p[j];
        const double want = summed(table.curve, probability, from, to, 1e-4);
        EXPECT_NEAR(found, want, 2e-6 * want) << from; // the steps straddle the kinks
    }
    // every event above the first node once, and of those below it what the ramp counts
    double all = 0;
    for (const double w : table.curve.node_weights(nodes, nodes[0], infinity))
        all += w;
    EXPECT_NEAR(all, table.curve.frequency(nodes[0]), 1e-12 * all);
}

TEST(HazardQuantile, FractilesOfALognormalHazardGiveItsOtherQuantiles)
{
    HazardModel hazard;
    hazard.intensity = {1, 2, 4};
    hazard.frequency = {1e-2, 1e-3, 5e-5};
    const double sigma = 0.6;
    for (const double z : {-1.0, 0.0, 1.5}) {
        HazardFractile fractile{phi_below(z), {}};
        for (const double f : hazard.frequency)
            fractile.frequency.push_back(f * std::exp(sigma * z));
        hazard.fractiles.push_back(fractile);
    }
    for (const double z : {-2.3, -1.0, -0.4, 0.7, 1.5, 2.6})
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(quantile_curve(hazard, phi_below(z)).frequency(std::log(hazard.intensity[i])) /
                            (hazard.frequency[i] * std::exp(sigma * z)),
                        1, 1e-9)
                << z;
}

/// Fractiles that part towards strong shaking: continued far enough, the upper one would rise.
TEST(HazardQuantile, WhatWouldRiseStaysLevel)
{
    HazardModel hazard;
    hazard.intensity = {1, 2, 4};
    hazard.frequency = {1e-2, 5e-3, 2e-3};
    hazard.fractiles = {{0.16, {9e-3, 1e-3, 1e-4}}, {0.84, {1.1e-2, 9e-3, 8e-3}}};
    const HazardCurve high = quantile_curve(hazard, 0.999);
    const double first = high.frequency(0);
    EXPECT_GT(first, 1.1e-2);
    for (const double im : {1.5, 2.0, 3.0, 4.0})
        EXPECT_NEAR(high.frequency(std::log(im)), first, 1e-9 * first);
    EXPECT_LT(high.frequency(std::log(8.0)), high.frequency(std::log(4.0)));
}

TEST(RiskNumber, CombinedIsTheRootOfTheSumOfSquares)
{
    const RiskNumber both =
        combined(1e-3, {1e-3 / std::exp(0.3), 1e-3 * std::exp(0.4)}, HazardSpread{std::exp(-0.4), 1, std::exp(0.3)});
    EXPECT_NEAR(both.total.lower, 1e-3 * std::exp(-0.5), 1e-12);
    EXPECT_NEAR(both.total.upper, 1e-3 * std::exp(0.5), 1e-12);
    EXPECT_NEAR(both.fragility_part, 0.5, 1e-12);
    EXPECT_NEAR(both.hazard.lower, 1e-3 * std::exp(-0.4), 1e-15);

    // nothing seen: the lower limit stays 0, and both upper ones count
    const RiskNumber none = combined(0, {0, 2e-5}, HazardSpread{0.5, 1, 3});
    EXPECT_EQ(none.total.lower, 0);
    EXPECT_NEAR(none.total.upper, 6e-5, 1e-18);

    // a mean hazard, above the median of its fractiles: the interval is around the median
    const HazardSpread mean{0.3, 0.8, 1.6};
    const double middle = 0.8e-3;
    const RiskNumber above = combined(1e-3, {1e-3 / std::exp(0.3), 1e-3 * std::exp(0.4)}, mean);
    EXPECT_NEAR(above.total.lower, middle * std::exp(-std::hypot(0.3, std::log(0.8 / 0.3))), 1e-15);
    EXPECT_NEAR(above.total.upper, middle * std::exp(std::hypot(0.4, std::log(2.0))), 1e-15);
    // without a lower limit of the fragility the part is that of the upper half
    const RiskNumber open = combined(1e-3, {0, 1e-3 * std::exp(0.4)}, mean);
    EXPECT_EQ(open.total.lower, 0);
    EXPECT_NEAR(open.fragility_part, 0.16 / (0.16 + std::log(2.0) * std::log(2.0)), 1e-12);
    EXPECT_TRUE(std::isnan(combined(1e-3, {0, infinity}, mean).fragility_part));

    const RiskNumber certain = combined(1e-3, {5e-4, 2e-3}, std::nullopt);
    EXPECT_EQ(certain.total.upper, 2e-3);
    EXPECT_EQ(certain.fragility_part, 1);
    EXPECT_NEAR(probability_over(certain, 100).total.upper, 1 - std::exp(-0.2), 1e-15);
}

} // namespace
} // namespace stylobate

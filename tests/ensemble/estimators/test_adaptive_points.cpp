/// Scrambled Sobol points: exactly uniform, stratified, independent from cell to cell, and without bias for a known
/// surface; and that independent numbers are what they were.

#include "ensemble/sampling/point_set.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace stylobate;

namespace {

Study study_of(std::uint64_t realizations, std::uint64_t seed, Sampling sampling = Sampling::sobol)
{
    Study study;
    study.kind = StudyKind::surface;
    study.surface = SurfaceSpec{{1, 2, 4, Spacing::linear}, {1, 2, 4, Spacing::linear}, {}};
    study.seed = seed;
    study.realizations = realizations;
    study.sampling = sampling;
    return study;
}

std::vector<PointSet::Place> places(std::uint64_t count)
{
    std::vector<PointSet::Place> all;
    for (std::uint64_t element = 0; element < count; ++element)
        all.push_back({Stream::friction, element});
    return all;
}

double variance(const std::vector<double>& values)
{
    double mean = 0;
    for (const double v : values)
        mean += v / static_cast<double>(values.size());
    double sum = 0;
    for (const double v : values)
        sum += (v - mean) * (v - mean);
    return sum / static_cast<double>(values.size() - 1);
}

} // namespace

TEST(AdaptivePoints, EveryPartOfEveryRangeIsTakenOnce)
{
    const PointSet points(study_of(512, 3), places(50));
    for (const std::uint64_t cell : {0, 7})
        for (const std::uint64_t count : {8, 64, 512})
            for (std::uint64_t element = 0; element < 50; ++element) {
                std::set<int> parts;
                for (std::uint64_t k = 0; k < count; ++k)
                    parts.insert(static_cast<int>(points.uniform(cell * 512 + k, Stream::friction, element) *
                                                  static_cast<double>(count)));
                EXPECT_EQ(parts.size(), count) << cell << ' ' << element;
            }
}

// In two dimensions 2^m points of Sobol's first ones are a (0, m, 2)-net: one point in every box of 2^-a by 2^(a-m).
TEST(AdaptivePoints, TheFirstTwoDimensionsAreANet)
{
    const PointSet points(study_of(256, 5), places(2));
    for (int a = 0; a <= 8; ++a) {
        std::set<std::pair<int, int>> boxes;
        for (std::uint64_t k = 0; k < 256; ++k)
            boxes.emplace(static_cast<int>(points.uniform(k, Stream::friction, 0) * (1 << a)),
                          static_cast<int>(points.uniform(k, Stream::friction, 1) * (1 << (8 - a))));
        EXPECT_EQ(boxes.size(), 256U) << a;
    }
}

// Each number alone is uniform over the scrambles: 4000 seeds, a chi-square of 16 parts (15 degrees of freedom, beyond
// 40 once in 2000); 6 numbers, the seed fixed.
TEST(AdaptivePoints, EachNumberIsUniformOverTheScrambles)
{
    for (const std::uint64_t k : {0, 1, 200})
        for (const std::uint64_t element : {0, 11}) {
            std::vector<int> parts(16, 0);
            for (std::uint64_t seed = 0; seed < 4000; ++seed) {
                const PointSet points(study_of(256, seed), places(12));
                ++parts[static_cast<std::size_t>(points.uniform(k, Stream::friction, element) * 16)];
            }
            double chi2 = 0;
            for (const int n : parts)
                chi2 += (n - 250.0) * (n - 250.0) / 250;
            EXPECT_LT(chi2, 40) << k << ' ' << element;
        }
}

// A known surface: collapse where a sum of six numbers, one of which counts most, passes a threshold. The share over
// cells (scrambles) has the exact mean (no bias) and less variance than the binomial; and between two cells there is no
// correlation. 2000 scrambles of 64: the mean has a deviation below 0.0014, the variances' ratio 0.03, the correlation
// 0.022.
TEST(AdaptivePoints, AKnownProbabilityHasNoBiasAndLessVariance)
{
    // P(2 u_0 + (u_1 + ... + u_5) > 3.5) = 1/2 by symmetry
    constexpr std::uint64_t per_cell = 64;
    std::vector<double> first, second, both;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const PointSet points(study_of(per_cell, seed), places(6));
        double share[2] = {0, 0};
        for (std::uint64_t cell = 0; cell < 2; ++cell)
            for (std::uint64_t k = 0; k < per_cell; ++k) {
                double sum = points.uniform(cell * per_cell + k, Stream::friction, 0);
                for (std::uint64_t element = 0; element < 6; ++element)
                    sum += points.uniform(cell * per_cell + k, Stream::friction, element);
                share[cell] += (sum > 3.5) / static_cast<double>(per_cell);
            }
        first.push_back(share[0]);
        second.push_back(share[1]);
        both.push_back(share[0] + share[1]);
    }
    double mean = 0;
    for (const double share : first)
        mean += share / 2000;
    const double binomial = 0.25 / per_cell;
    EXPECT_NEAR(mean, 0.5, 4 * std::sqrt(binomial / 2000));
    EXPECT_LT(variance(first), 0.5 * binomial);
    EXPECT_NEAR(variance(both) / (variance(first) + variance(second)), 1, 0.1);
}

TEST(AdaptivePoints, IndependentNumbersAreWhatTheyWere)
{
    const PointSet points(study_of(100, 3, Sampling::independent), places(5));
    EXPECT_EQ(points.uniform(123, Stream::friction, 4), uniform01(3, 123, Stream::friction, 4));
    const PointSet sobol(study_of(100, 3), places(5));
    EXPECT_NE(sobol.uniform(123, Stream::friction, 4), uniform01(3, 123, Stream::friction, 4));
    EXPECT_EQ(sobol.uniform(123, Stream::friction, 5), uniform01(3, 123, Stream::friction, 5)); // not named
    EXPECT_EQ(sobol.uniform(123, Stream::base_noise, 0), uniform01(3, 123, Stream::base_noise, 0));
}

// Through the sampler: what is drawn once, and for each bed, mechanisms too.
TEST(AdaptivePoints, TheSamplerDrawsThem)
{
    Study study = study_of(64, 9);
    study.structure = equal_column(4, 1, 0.05, 0.03, 0.05, 0.2, 9.81);
    study.contact.normal_stiffness_n_m2 = 1e8;
    study.contact.tangential_stiffness_n_m = 5e6;
    study.contact.friction = 0.6;
    study.excitation.kind = ExcitationKind::harmonic;
    Perturbation phase;
    phase.quantity = Quantity::phase;
    phase.distribution = DistributionKind::uniform;
    phase.from = 0;
    phase.to = 2 * std::numbers::pi;
    Perturbation friction;
    friction.quantity = Quantity::friction;
    friction.distribution = DistributionKind::uniform;
    friction.per = Per::joint;
    friction.from = 0.4;
    friction.to = 0.8;
    study.perturbations = {friction, phase};
    const Sampler sampler(study, nullptr);
    ASSERT_EQ(sampler.input_names().size(), 4U);
    for (std::size_t input = 0; input < 4; ++input) {
        std::set<int> parts;
        for (std::uint64_t k = 0; k < 64; ++k) {
            const double value = sampler.realization(3 * 64 + k).inputs[input];
            const double u = input < 3 ? (value - 0.4) / 0.4 : value / (2 * std::numbers::pi);
            parts.insert(static_cast<int>(u * 64));
        }
        EXPECT_EQ(parts.size(), 64U) << sampler.input_names()[input];
    }
}

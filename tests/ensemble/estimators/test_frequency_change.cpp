/// The change of a frequency by pairs: by hand, against Student's interval, without any change, and its coverage.

#include "ensemble/estimators/risk/frequency_change.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stylobate {
namespace {

double part(std::size_t g, std::size_t of)
{
    return static_cast<double>(g % of);
}

/// At 1 and 2, `n` motions of ten pairs. @param base, variant of a motion and stripe, how many of ten
template <class Base, class Variant>
PairedStripes pairs_of(std::size_t n, Base&& base, Variant&& variant)
{
    PairedStripes pairs;
    pairs.intensity = {1, 2};
    for (std::size_t g = 0; g < n; ++g)
        for (std::size_t j = 0; j < 2; ++j) {
            pairs.trials.push_back(10);
            pairs.base.push_back(base(g, j));
            pairs.variant.push_back(variant(g, j));
        }
    return pairs;
}

/// Weights of the stripes 1 and 2 under 0.01 / im, by hand (`test_frequency_estimate.cpp` has the integrals).
struct Weights {
    double first, second;
};
Weights weights()
{
    const double s = std::log(2.0), place = (1 - (1 + s) / 2) / s;
    return {place * 0.02 + (0.5 - place) * 0.01, place * 0.01 + 0.005};
}

TEST(FrequencyChange, IsTheMeanOfTheMotionsOwnChanges)
{
    // motion g reaches it in 2 + g % 3 of ten at 1 and in 6 + g % 4 at 2; the variant in one less, and in two less
    const auto base = [](std::size_t g, std::size_t j) { return j == 0 ? 2 + part(g, 3) : 6 + part(g, 4); };
    const auto variant = [&](std::size_t g, std::size_t j) { return base(g, j) - (j == 0 ? 1 : 1 + part(g, 2)); };
    const FrequencyChange found = frequency_change(pairs_of(24, base, variant), power_law(0.01, 1), {.years = {100}});
    const Weights w = weights();
    const double b = w.first * 0.3 + w.second * 0.75, v = w.first * 0.2 + w.second * 0.6;
    EXPECT_NEAR(found.base.frequency.value, b, 1e-12);
    EXPECT_NEAR(found.variant.frequency.value, v, 1e-12);
    EXPECT_NEAR(found.frequency.value, v - b, 1e-12);
    EXPECT_NEAR(found.ratio.value, v / b, 1e-12);
    EXPECT_NEAR(found.probability[0].value, std::exp(-100 * b) - std::exp(-100 * v), 1e-12);
    // half of the motions have d = -(w1 + w2) / 10, half -(w1 + 2 w2) / 10: Student's interval with the effective
    // number of motions
    double sum = 0, square = 0;
    for (const double d : {w.first + w.second, w.first + 2 * w.second}) {
        sum += 12 * d / 10;
        square += 12 * d * d / 100;
    }
    const double error = w.second / 20 / std::sqrt(23.0);
    const double reach = student_quantile(0.95, sum * sum / square - 1) * error;
    EXPECT_FALSE(found.few);
    EXPECT_NEAR((found.frequency.fragility.upper - found.frequency.value) / reach, 1, 0.12);
    EXPECT_NEAR((found.frequency.value - found.frequency.fragility.lower) / reach, 1, 0.12);
    EXPECT_LT(found.frequency.fragility.upper, 0) << "pairs show it";
    const auto width = [](const Limits& l) { return l.upper - l.lower; };
    EXPECT_LT(width(found.frequency.fragility), 0.5 * width(found.base.frequency.fragility));
    EXPECT_EQ(found.frequency.fragility.lower, found.frequency.total.lower) << "a hazard without fractiles";
}

/// 101 draws at level 0.9: the limits are the sixth smallest and the sixth largest one, of the very weights, each drawn
/// change set apart from the estimate by t / z sqrt((m + 1) / (m - 1)).
TEST(FrequencyChange, LimitsAreThoseOfTheDraws)
{
    constexpr std::size_t m = 12;
    const auto base = [](std::size_t g, std::size_t j) { return j == 0 ? 2 + part(g, 3) : 6 + part(g, 4); };
    const auto variant = [&](std::size_t g, std::size_t j) { return base(g, j) - (j == 0 ? 1 : 1 + part(g, 2)); };
    const FrequencyChange found =
        frequency_change(pairs_of(m, base, variant), power_law(0.01, 1), {.years = {100}, .draws = 101, .seed = 4});
    const Weights w = weights();
    std::vector<double> b, v;
    double sum = 0, square = 0, mean_b = 0, mean_v = 0;
    for (std::size_t g = 0; g < m; ++g) {
        b.push_back((w.first * base(g, 0) + w.second * base(g, 1)) / 10);
        v.push_back((w.first * variant(g, 0) + w.second * variant(g, 1)) / 10);
        mean_b += b.back() / m;
        mean_v += v.back() / m;
        sum += b.back() - v.back();
        square += (b.back() - v.back()) * (b.back() - v.back());
    }
    const double spread =
        student_quantile(0.95, sum * sum / square - 1) / 1.6448536269514722 * std::sqrt((m + 1.0) / (m - 1.0));
    ASSERT_FALSE(found.few);
    std::vector<double> change, ratio, probability;
    for (std::uint64_t draw = 0; draw < 101; ++draw) {
        double all = 0, drawn_b = 0, drawn_v = 0;
        for (std::uint64_t g = 0; g < m; ++g) {
            const double weight = -std::log(1 - uniform01(4, draw, Stream::bootstrap, g));
            all += weight;
            drawn_b += weight * b[g];
            drawn_v += weight * v[g];
        }
        drawn_b /= all;
        drawn_v /= all;
        change.push_back(drawn_v - drawn_b);
        ratio.push_back(std::log(drawn_v / drawn_b));
        probability.push_back(std::exp(-100 * drawn_b) - std::exp(-100 * drawn_v));
    }
    const auto expect = [&](const Limits& limits, std::vector<double>& drawn, double value, auto&& scale) {
        std::sort(drawn.begin(), drawn.end());
        EXPECT_NEAR(limits.lower, scale(value + spread * (drawn[5] - value)), 1e-9 * std::abs(limits.lower));
        EXPECT_NEAR(limits.upper, scale(value + spread * (drawn[95] - value)), 1e-9 * std::abs(limits.upper));
    };
    const auto same = [](double x) { return x; };
    expect(found.frequency.fragility, change, mean_v - mean_b, same);
    expect(found.ratio.fragility, ratio, std::log(mean_v / mean_b), [](double x) { return std::exp(x); });
    expect(found.probability[0].fragility, probability, std::exp(-100 * mean_b) - std::exp(-100 * mean_v), same);
}

/// What is not known of the hazard makes both frequencies larger or smaller, and hardly changes their ratio.
TEST(FrequencyChange, TheHazardIsCommonToBoth)
{
    const auto base = [](std::size_t g, std::size_t j) { return j == 0 ? 2 + part(g, 3) : 6 + part(g, 4); };
    const auto variant = [&](std::size_t g, std::size_t j) { return base(g, j) - (j == 0 ? 1 : 1 + part(g, 2)); };
    const FrequencyChange found = frequency_change(pairs_of(24, base, variant), power_law(0.01, 1, 0.5), {});
    const double value = found.frequency.value;
    EXPECT_NEAR(found.frequency.total.lower / value, std::exp(0.5 * 1.6449), 0.15);
    EXPECT_NEAR(found.frequency.total.upper / value, std::exp(-0.5 * 1.6449), 0.05);
    EXPECT_NEAR(found.ratio.total.lower, found.ratio.fragility.lower, 1e-9);
    EXPECT_NEAR(found.ratio.total.upper, found.ratio.fragility.upper, 1e-9);
}

TEST(FrequencyChange, WithoutAChangeTheLimitsAreThoseOfAFurtherMotion)
{
    const auto same = [](std::size_t g, std::size_t j) { return j == 0 ? part(g, 2) : 3 + part(g, 4); };
    const FrequencyChange found =
        frequency_change(pairs_of(20, same, same), power_law(0.01, 1), {.years = {100}, .draws = 20000});
    EXPECT_TRUE(found.few);
    EXPECT_EQ(found.frequency.value, 0);
    // the upper quantile of W0 / (W0 + ... + W20) is 1 - 0.05^(1/20); it counts from the first stripe with damage on
    const double most = (1 - std::pow(0.05, 1.0 / 20)) * (weights().first + weights().second);
    EXPECT_NEAR(found.frequency.fragility.upper / most, 1, 0.05);
    EXPECT_NEAR(found.frequency.fragility.lower / most, -1, 0.05);
    EXPECT_LT(found.probability[0].total.lower, 0);
    EXPECT_GT(found.probability[0].total.upper, 0);
}

TEST(FrequencyChange, SeparatedStripesLeaveTheChangeOpen)
{
    const auto base = [](std::size_t, std::size_t j) { return j == 0 ? 0.0 : 10.0; };
    const FrequencyChange found = frequency_change(pairs_of(20, base, base), power_law(0.01, 1), {.years = {100}});
    // 0.005 events a year lie between the stripes: the distances of both structures' limits from their values
    const RiskNumber& f = found.base.frequency;
    const double up = f.fragility.upper - f.value, down = f.value - f.fragility.lower;
    EXPECT_GT(up, 0.002);
    EXPECT_GE(found.frequency.fragility.upper, std::hypot(up, down));
    EXPECT_LE(found.frequency.fragility.lower, -std::hypot(up, down));
    EXPECT_LE(found.frequency.fragility.upper, 1.2 * std::hypot(up, down));
    // the hazard is in the draws, and not a second time in the distances
    const FrequencyChange uncertain =
        frequency_change(pairs_of(20, base, base), power_law(0.01, 1, 0.5), {.years = {100}});
    EXPECT_LE(uncertain.frequency.total.upper, 1.2 * std::hypot(up, down));
    EXPECT_GE(uncertain.base.frequency.total.upper - f.value, 1.5 * up);
}

/// A stripe that no pair has, and a motion that has none, are as if they had not been run.
TEST(FrequencyChange, WithoutPairsNothingIsAdded)
{
    const auto base = [](std::size_t g, std::size_t j) { return j == 0 ? 2 + part(g, 3) : 6 + part(g, 4); };
    const auto variant = [&](std::size_t g, std::size_t j) { return base(g, j) - 1; };
    const FrequencyChange want = frequency_change(pairs_of(12, base, variant), power_law(0.01, 1), {});
    PairedStripes pairs = pairs_of(13, base, variant);
    pairs.intensity = {1, 1.5, 2};
    for (std::vector<double>* of : {&pairs.trials, &pairs.base, &pairs.variant}) {
        of->back() = (*of)[of->size() - 2] = 0;
        for (std::ptrdiff_t g = 12; g >= 0; --g)
            of->insert(of->begin() + 2 * g + 1, 0.0);
    }
    const FrequencyChange found = frequency_change(pairs, power_law(0.01, 1), {});
    EXPECT_EQ(found.frequency.value, want.frequency.value);
    EXPECT_EQ(found.frequency.fragility.upper, want.frequency.fragility.upper);
}

TEST(FrequencyChange, FewMotionsGiveNoInterval)
{
    const auto base = [](std::size_t g, std::size_t j) { return j == 0 ? 2 + part(g, 3) : 8; };
    const auto variant = [](std::size_t, std::size_t j) { return j == 0 ? 1.0 : 7.0; };
    const FrequencyChange found = frequency_change(pairs_of(5, base, variant), power_law(0.01, 1), {});
    EXPECT_TRUE(std::isinf(found.frequency.total.upper) && std::isinf(found.frequency.total.lower));
    EXPECT_EQ(found.probability[0].total.upper, 1);
}

/// 20 motions whose own shares vary; the variant has a lower one under each. 300 repeats: the standard error of a
/// coverage of 0.9 is 0.017, and four of them are allowed below it.
TEST(FrequencyChangeStatistics, IntervalsContainTheTruth)
{
    const Weights w = weights();
    int covered = 0, better = 0;
    const int repeats = 300;
    for (std::uint64_t r = 0; r < repeats; ++r) {
        PairedStripes pairs;
        pairs.intensity = {1, 2};
        for (std::uint64_t g = 0; g < 20; ++g) {
            const double p = 0.6 * uniform01(5, 100 * r + g, Stream::virtual_specimen, 0); // its mean is 0.3
            for (const std::uint64_t j : {0, 1}) {
                double b = 0, v = 0;
                for (std::uint64_t i = 0; i < 10; ++i) {
                    const double u = uniform01(5, 100 * r + g, Stream::virtual_specimen, 1 + 10 * j + i);
                    b += u < p + 0.3 * static_cast<double>(j);
                    v += u < 0.8 * (p + 0.3 * static_cast<double>(j));
                }
                pairs.trials.push_back(10);
                pairs.base.push_back(b);
                pairs.variant.push_back(v);
            }
        }
        const FrequencyChange found = frequency_change(pairs, power_law(0.01, 1), {.years = {100}, .draws = 500});
        const double truth = -0.2 * (w.first * 0.3 + w.second * 0.6);
        covered += found.frequency.fragility.lower <= truth && truth <= found.frequency.fragility.upper;
        better += found.frequency.fragility.upper < 0;
    }
    EXPECT_GT(covered / double(repeats), 0.9 - 4 * 0.017);
    EXPECT_GT(better / double(repeats), 0.9);
}

} // namespace
} // namespace stylobate

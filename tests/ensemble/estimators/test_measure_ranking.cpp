/// Intensity measures ranked: the one that drives the outcome comes first and is sufficient, the others are not.

#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/estimators/fragility/measure_ranking.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace stylobate;

namespace {

/// Records scaled to several intensities. What decides is v; a = v times a factor that falls with the magnitude, and
/// some scatter; magnitude says nothing beside v.
struct RankedTruth {
    FragilityData data;
    std::vector<double> magnitude, number;
};

RankedTruth draw(std::uint64_t seed, std::uint32_t records)
{
    RankedTruth truth;
    std::vector<FragilityRun> runs;
    for (std::uint32_t g = 0; g < records; ++g) {
        std::uint64_t element = 0;
        const auto uniform = [&] { return uniform01(seed, g, Stream::virtual_specimen, element++); };
        const auto normal = [&] { return link_quantile(Link::probit, uniform()); };
        const double magnitude = 5.5 + 2 * uniform(), own = 0.2 * normal(), scatter = 0.2 * normal();
        truth.magnitude.push_back(magnitude);
        truth.number.push_back(normal()); // says nothing beside any measure
        for (int j = 0; j < 6; ++j) {
            const double v = std::exp(-0.8 + 0.32 * j), a = v * std::exp(-0.5 * (magnitude - 6.5) + scatter);
            double reached = 0;
            for (int i = 0; i < 5; ++i)
                reached += std::log(v) + own + 0.25 * normal() > 0 ? 1 : 0;
            runs.push_back({g, {a, v}, reached, 5});
        }
    }
    truth.data = grouped(runs);
    return truth;
}

} // namespace

TEST(MeasureRanking, WhatDrivesTheOutcomeIsFirstAndSufficient)
{
    int first = 0, sufficient = 0, found = 0, chance = 0;
    const int repeats = 200;
    for (std::uint64_t r = 0; r < repeats; ++r) {
        const RankedTruth truth = draw(r, 40);
        const auto ranked =
            ranked_measures(truth.data, {"PGA", "PGV"}, {"magnitude", "number"}, {truth.magnitude, truth.number});
        first += ranked[0].name == "PGV" && ranked[1].behind.lower > 0 ? 1 : 0;
        for (const RankedMeasure& measure : ranked) {
            if (measure.name == "PGV")
                sufficient += measure.sufficient ? 1 : 0;
            else {
                found += measure.sufficiency[0].p_value < 0.05 ? 1 : 0;
                chance += measure.sufficiency[1].p_value < 0.05 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(first, 0.9 * repeats);
    EXPECT_GT(found, 0.9 * repeats) << "magnitude adds to PGA";
    // four standard errors of .05 are .062
    EXPECT_GT(sufficient, (0.95 - 0.062) * repeats);
    EXPECT_LT(chance, (0.05 + 0.062) * repeats);
}

/// Two measures with two values each, under nine records: each curve passes through both of its shares, and a record
/// has k ln p + (n - k) ln(1 - p) of its likelihood at either value.
TEST(MeasureRanking, GainAndDifferenceByHand)
{
    // records x (a low, v low), (a low, v high), (a high, v low), (a high, v high): reached of four
    const double reached[9][4] = {{0, 2, 0, 4}, {1, 3, 2, 3}, {0, 3, 1, 4}, {1, 2, 1, 3}, {0, 4, 2, 4},
                                  {0, 1, 0, 3}, {2, 3, 1, 4}, {0, 2, 2, 4}, {1, 3, 0, 3}};
    std::vector<FragilityRun> runs;
    std::array<double, 2> by_a{}, by_v{};
    for (std::uint32_t g = 0; g < 9; ++g)
        for (std::size_t i = 0; i < 4; ++i) {
            runs.push_back({g, {i < 2 ? 1.0 : 2.0, i % 2 == 0 ? 1.0 : 3.0}, reached[g][i], 4});
            by_a[i / 2] += reached[g][i] / 72;
            by_v[i % 2] += reached[g][i] / 72;
        }
    const auto term = [](double k, double n, double p) { return k * std::log(p) + (n - k) * std::log(1 - p); };
    double gain_a = 0, gain_v = 0, sum = 0, square = 0;
    for (const auto& r : reached) {
        const double a = term(r[0] + r[1], 8, by_a[0]) + term(r[2] + r[3], 8, by_a[1]),
                     v = term(r[0] + r[2], 8, by_v[0]) + term(r[1] + r[3], 8, by_v[1]);
        const double none = term(r[0] + r[1] + r[2] + r[3], 16, (by_a[0] + by_a[1]) / 2);
        gain_a += (a - none) / 144;
        gain_v += (v - none) / 144;
        sum += v - a;
        square += (v - a) * (v - a);
    }
    const auto ranked = ranked_measures(grouped(runs), {"a", "v"}, {}, {}, 0.9);
    EXPECT_EQ(ranked[0].name, "v");
    EXPECT_NEAR(ranked[0].gain, gain_v, 1e-9);
    EXPECT_NEAR(ranked[1].gain, gain_a, 1e-9);
    // Student's interval of a sum over nine records, 1.859548 of eight degrees of freedom
    const double reach = 1.859548 * std::sqrt(9 * (square - sum * sum / 9) / 8);
    EXPECT_NEAR(ranked[1].behind.lower, (sum - reach) / 144, 1e-7);
    EXPECT_NEAR(ranked[1].behind.upper, (sum + reach) / 144, 1e-7);
    const double slope = (link_quantile(Link::probit, by_v[1]) - link_quantile(Link::probit, by_v[0])) / std::log(3.0);
    EXPECT_NEAR(ranked[0].dispersion, 1 / slope, 1e-9);
}

/// A two-sided p-value is the level at which the interval begins to hold 0.
TEST(MeasureRanking, PValueOfAFeatureIsThatOfItsInterval)
{
    const RankedTruth truth = draw(4, 20);
    const auto of = [&](double level) {
        return ranked_measures(with_measure(truth.data, 0), {"PGA"}, {"magnitude"}, {truth.magnitude}, level)[0]
            .sufficiency[0];
    };
    const Sufficiency found = of(0.95);
    ASSERT_GT(found.p_value, 1e-6);
    ASSERT_LT(found.p_value, 0.5);
    const Limits limits = of(1 - found.p_value).limits;
    EXPECT_NEAR(std::min(std::abs(limits.lower), std::abs(limits.upper)), 0, 1e-6 * std::abs(found.coefficient));
}

TEST(MeasureRanking, SaysItInWords)
{
    const RankedTruth truth = draw(1000, 60);
    const auto ranked = ranked_measures(truth.data, {"PGA", "PGV"}, {"magnitude"}, {truth.magnitude});
    EXPECT_NEAR(ranked[0].dispersion, std::hypot(0.2, 0.25), 0.1);
    EXPECT_EQ(ranked[0].behind.lower, 0);
    EXPECT_NE(ranked[0].says.find("no insufficiency found"), std::string::npos) << ranked[0].says;
    EXPECT_NE(ranked[1].says.find("not sufficient: magnitude"), std::string::npos) << ranked[1].says;
    EXPECT_NE(ranked[1].says.find("less than PGV"), std::string::npos) << ranked[1].says;
}

TEST(MeasureRanking, RefusesWhatItCannotRank)
{
    const RankedTruth truth = draw(1, 10);
    EXPECT_THROW(ranked_measures(truth.data, {"PGA"}, {}, {}), InputError);
    EXPECT_THROW(ranked_measures(truth.data, {"PGA", "PGV"}, {"magnitude"}, {}), InputError);
    EXPECT_THROW(ranked_measures(truth.data, {"PGA", "PGV"}, {"same"}, {std::vector<double>(10, 1.0)}), InputError);
    EXPECT_THROW(ranked_measures(draw(1, 4).data, {"PGA", "PGV"}, {}, {}), InputError);
    // nothing reached: no curve in any measure, and it is said
    std::vector<FragilityRun> none;
    for (std::uint32_t g = 0; g < 10; ++g)
        none.push_back({g, {1.0 + g, 2.0 + g}, 0, 1});
    const auto ranked = ranked_measures(grouped(none), {"PGA", "PGV"}, {}, {});
    EXPECT_NE(ranked[0].says.find("not ranked"), std::string::npos);
    EXPECT_FALSE(ranked[0].sufficient);
}

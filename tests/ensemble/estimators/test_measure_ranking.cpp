/// Intensity measures ranked: the one that drives the outcome comes first and is sufficient, the others are not.

#include "ensemble/estimators/fragility/link.hpp"
#include "ensemble/estimators/fragility/measure_ranking.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace stylobate;

namespace {

/// Records scaled to several intensities. What decides is v; a = v times a factor that falls with the magnitude, and
/// some scatter; magnitude says nothing beside v.
struct Truth {
    FragilityData data;
    std::vector<double> magnitude, number;
};

Truth draw(std::uint64_t seed, std::uint32_t records)
{
    Truth truth;
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
        const Truth truth = draw(r, 40);
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

TEST(MeasureRanking, SaysItInWords)
{
    const Truth truth = draw(1000, 60);
    const auto ranked = ranked_measures(truth.data, {"PGA", "PGV"}, {"magnitude"}, {truth.magnitude});
    EXPECT_NEAR(ranked[0].dispersion, std::hypot(0.2, 0.25), 0.1);
    EXPECT_EQ(ranked[0].behind.lower, 0);
    EXPECT_NE(ranked[0].says.find("no insufficiency found"), std::string::npos) << ranked[0].says;
    EXPECT_NE(ranked[1].says.find("not sufficient: magnitude"), std::string::npos) << ranked[1].says;
    EXPECT_NE(ranked[1].says.find("less than PGV"), std::string::npos) << ranked[1].says;
}

TEST(MeasureRanking, RefusesWhatItCannotRank)
{
    const Truth truth = draw(1, 10);
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

/// Curves from capacities: known truths, records that never reach, coverage, resurrection.

#include "ensemble/estimators/fragility/capacity_curve.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace stylobate;

namespace {

/// One run of each record at each intensity; capacities are lognormal about 1.
std::vector<FragilityRun> runs(std::uint64_t repeat, std::uint32_t records, double dispersion, double step, double most)
{
    std::vector<FragilityRun> drawn;
    for (std::uint32_t g = 0; g < records; ++g) {
        const double z = link_quantile(Link::probit, uniform01(41, repeat, Stream::virtual_specimen, g));
        for (double im = step; im <= most; im += step)
            drawn.push_back({g, {im}, im >= std::exp(dispersion * z) ? 1.0 : 0.0, 1});
    }
    return drawn;
}

} // namespace

TEST(CapacityCurve, FineStepsGiveMeanAndDeviationOfTheLogarithms)
{
    const auto capacities = record_capacities(runs(0, 200, 0.4, 0.001, 6));
    double mean = 0, square = 0;
    for (const RecordCapacity& capacity : capacities)
        mean += std::log(capacity.at - 0.0005) / 200;
    for (const RecordCapacity& capacity : capacities)
        square += std::pow(std::log(capacity.at - 0.0005) - mean, 2) / 200;
    const CapacityCurve curve = capacity_curve(capacities);
    ASSERT_TRUE(curve.found);
    EXPECT_NEAR(std::log(curve.median), mean, 1e-5);
    EXPECT_NEAR(curve.dispersion, std::sqrt(square), 1e-5);
}

TEST(CapacityCurve, IsTheMaximumOfTheLikelihood)
{
    const auto capacities = record_capacities(runs(3, 40, 0.4, 0.25, 1.25));
    const CapacityCurve curve = capacity_curve(capacities);
    ASSERT_TRUE(curve.found);
    EXPECT_GT(curve.unreached, 0U);
    const auto log_likelihood = [&](double mean, double deviation) {
        double sum = 0;
        for (const RecordCapacity& capacity : capacities)
            sum += std::log((std::erf((std::log(capacity.at) - mean) / deviation / std::sqrt(2.0)) -
                             std::erf((std::log(capacity.below) - mean) / deviation / std::sqrt(2.0))) /
                            2);
        return sum;
    };
    const double best = log_likelihood(std::log(curve.median), curve.dispersion);
    for (const double by : {-1e-3, 1e-3}) {
        EXPECT_LT(log_likelihood(std::log(curve.median) + by, curve.dispersion), best);
        EXPECT_LT(log_likelihood(std::log(curve.median), curve.dispersion + by), best);
    }
}

TEST(CapacityCurve, IntervalsCoverAlsoWhereSomeNeverReach)
{
    // 500 repeats: four standard errors of .95 are .039
    int median = 0, dispersion = 0;
    for (std::uint64_t r = 0; r < 500; ++r) {
        const CapacityCurve curve = capacity_curve(record_capacities(runs(100 + r, 30, 0.4, 0.2, 1.4)));
        ASSERT_TRUE(curve.found);
        median += curve.median_limits.lower <= 1 && 1 <= curve.median_limits.upper ? 1 : 0;
        dispersion += curve.dispersion_limits.lower <= 0.4 && 0.4 <= curve.dispersion_limits.upper ? 1 : 0;
    }
    EXPECT_NEAR(median / 500.0, 0.95, 0.039);
    EXPECT_NEAR(dispersion / 500.0, 0.95, 0.039);
}

TEST(CapacityCurve, ResurrectionAndWhatBoundsNothingAreSaid)
{
    const std::vector<FragilityRun> again = {
        {7, {1}, 0, 1}, {7, {2}, 1, 1}, {7, {3}, 0, 1}, {9, {1}, 0, 1}, {9, {2}, 0, 1}};
    const auto capacities = record_capacities(again);
    ASSERT_EQ(capacities.size(), 2U);
    EXPECT_EQ(capacities[0].record, 7U);
    EXPECT_EQ(capacities[0].below, 1);
    EXPECT_EQ(capacities[0].at, 2);
    EXPECT_TRUE(capacities[0].resurrected);
    EXPECT_EQ(capacities[1].below, 2);
    EXPECT_TRUE(std::isinf(capacities[1].at));
    const CapacityCurve curve = capacity_curve(capacities);
    ASSERT_FALSE(curve.says.empty());
    EXPECT_NE(curve.says[0].find("1 of 2 records"), std::string::npos);

    std::vector<RecordCapacity> same(20, RecordCapacity{0, 1, 2, false});
    EXPECT_FALSE(capacity_curve(same).found);
    for (RecordCapacity& capacity : same)
        capacity.at = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(capacity_curve(same).found) << "nothing reached";
    EXPECT_THROW(capacity_curve(std::span(same).first(1)), InputError);
}

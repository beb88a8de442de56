/// Searches of known functions: how often the range that is not shown to be worse holds the optimum, and the interval
/// the probability at the answer. 0.95 is stated; the standard error of 200 searches is 0.015 there. Figures are in
/// docs/compare.md.

#include "tests/ensemble/estimators/search_truth.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <string>

namespace stylobate {
namespace {

void expect_coverage(std::size_t dimensions, const SearchSetup& setup)
{
    std::vector<KnownFunction> functions = known_functions(dimensions);
    functions.push_back(random_function(dimensions, 1));
    for (const KnownFunction& function : functions) {
        const SearchRepeats found = searches_of(function, setup);
        std::string range;
        for (const double width : found.range)
            range += " " + std::to_string(width).substr(0, 4);
        const std::string text = function.name + ": place " + std::to_string(found.place) + ", value " +
                                 std::to_string(found.value) + ", interval " + std::to_string(found.interval) +
                                 ", excess " + std::to_string(found.excess) + ", range" + range;
        std::cout << text << "\n";
        const double error = std::sqrt(0.95 * 0.05 / setup.repeats);
        EXPECT_GE(found.place, 0.95 - 2 * error) << text;
        EXPECT_GE(found.value, 0.93 - 2 * error) << text;
    }
}

TEST(ResponseSurfaceStatistics, OneNumber)
{
    expect_coverage(1, {.points = 12, .spacings = 100});
}

TEST(ResponseSurfaceStatistics, OneNumberUnderTwentyMotions)
{
    expect_coverage(1, {.points = 12, .realizations = 600, .motions = 20, .smooth = true, .spacings = 100});
}

TEST(ResponseSurfaceStatistics, TwoNumbers)
{
    expect_coverage(2, {.points = 16, .repeats = 30, .spacings = 20});
}

TEST(ResponseSurfaceStatistics, ThreeNumbers)
{
    expect_coverage(3, {.points = 24, .repeats = 20, .spacings = 8});
}

TEST(ResponseSurfaceStatisticsLong, OneNumberOfManyRealizations)
{
    expect_coverage(1, {.points = 12, .realizations = 3000, .spacings = 100});
}

TEST(ResponseSurfaceStatisticsLong, OneNumberOfManyPointsUnderTwentyMotions)
{
    expect_coverage(1, {.points = 25, .realizations = 600, .motions = 20, .spacings = 100});
}

TEST(ResponseSurfaceStatisticsLong, TwoNumbers)
{
    expect_coverage(2, {.points = 16, .spacings = 20});
}

TEST(ResponseSurfaceStatisticsLong, TwoNumbersUnderTwentyMotions)
{
    expect_coverage(2, {.points = 20, .realizations = 600, .motions = 20, .smooth = true, .spacings = 20});
}

TEST(ResponseSurfaceStatisticsLong, ThreeNumbers)
{
    expect_coverage(3, {.points = 24, .spacings = 8});
}

} // namespace
} // namespace stylobate

/// Searches of known functions: how often the range that is not shown to be worse holds the optimum, and the interval
/// the probability at the answer. 0.95 is stated; the standard error of the 200 searches of a long test is 0.015 there.
/// The others are the first few of these, of all functions together. Figures are in docs/compare.md.

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
    double place = 0, value = 0;
    const auto all = static_cast<double>(functions.size());
    const bool each_by_itself = setup.repeats >= 100;
    for (const KnownFunction& function : functions) {
        const SearchRepeats found = searches_of(function, setup);
        std::string range;
        for (const double width : found.range)
            range += " " + std::to_string(width).substr(0, 4);
        const std::string text = function.name + ": place " + std::to_string(found.place) + ", value " +
                                 std::to_string(found.value) + ", interval " + std::to_string(found.interval) +
                                 ", excess " + std::to_string(found.excess) + ", range" + range;
        std::cout << text << "\n";
        place += found.place / all;
        value += found.value / all;
        const double error = std::sqrt(0.95 * 0.05 / setup.repeats);
        if (each_by_itself) {
            EXPECT_GE(found.place, 0.95 - 2 * error) << text;
            EXPECT_GE(found.value, 0.93 - 2 * error) << text;
        }
    }
    // three standard errors: a false alarm in 740 for other seeds
    const double error = std::sqrt(0.95 * 0.05 / (setup.repeats * all));
    EXPECT_GE(place, 0.95 - 3 * error);
    EXPECT_GE(value, 0.93 - 3 * error);
}

TEST(ResponseSurfaceStatistics, OneNumber)
{
    expect_coverage(1, {.points = 12, .repeats = 25, .spacings = 100});
}

TEST(ResponseSurfaceStatistics, OneNumberUnderTwentyMotions)
{
    expect_coverage(1,
                    {.points = 12, .realizations = 600, .motions = 20, .smooth = true, .repeats = 25, .spacings = 100});
}

TEST(ResponseSurfaceStatistics, TwoNumbers)
{
    expect_coverage(2, {.points = 16, .repeats = 6, .spacings = 20});
}

TEST(ResponseSurfaceStatistics, ThreeNumbers)
{
    expect_coverage(3, {.points = 24, .repeats = 3, .spacings = 8});
}

TEST(ResponseSurfaceStatisticsLong, OneNumber)
{
    expect_coverage(1, {.points = 12, .spacings = 100});
}

TEST(ResponseSurfaceStatisticsLong, OneNumberUnderTwentyMotions)
{
    expect_coverage(1, {.points = 12, .realizations = 600, .motions = 20, .smooth = true, .spacings = 100});
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

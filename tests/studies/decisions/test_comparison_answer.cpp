/// What a comparison comes to in sentences, and that its file keeps what they are made of.

#include "studies/decisions/compare/comparison_answer.hpp"
#include "studies/decisions/compare/comparison_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace stylobate {
namespace {

PlaceComparison place(double base, double variant, double lower, double upper, double p)
{
    PlaceComparison all;
    all.counts = {10, 30, 10, 50};
    all.base.probability = base;
    all.variant.probability = variant;
    all.difference = variant - base;
    all.lower = lower;
    all.upper = upper;
    all.p = all.p_adjusted = p;
    return all;
}

/// Two cells, in the second of which the variant harms; its gain hangs on the friction.
Comparison comparison(double lower, double upper)
{
    Comparison c;
    c.kind = "surface";
    c.base_name = "column";
    c.adjustment = "benjamini-hochberg";
    c.frequency_hz = {2};
    c.pga_m_s2 = {3, 6};
    VariantComparison dowels;
    dowels.name = "dowels";
    LimitComparison collapse{"collapse", "collapse", true, {}, place(0.5, 0.4, lower, upper, 1e-3)};
    collapse.cells = {place(0.8, 0.4, -0.5, -0.3, 1e-6), place(0.2, 0.4, 0.1, 0.3, 1e-4)};
    dowels.limits.push_back(collapse);
    dowels.depends.push_back(
        {"friction", {4.5, 1e-5, {0.65, 0.71}, {{{-0.2, -0.3, -0.1}, {-0.1, -0.2, -0.01}, {0.02, -0.1, 0.1}}}}, 2e-5});
    dowels.depends.push_back(
        {"tilt", {0.3, 0.7, {0.1, 0.2}, {{{-0.1, -0.2, 0.1}, {-0.1, -0.2, 0.1}, {-0.1, -0.2, 0.1}}}}, 0.7});
    c.variants.push_back(dowels);
    return c;
}

TEST(ComparisonAnswer, IsOneSentenceWithItsIntervalAndItsVerdict)
{
    const Comparison better = comparison(-0.2, -0.05), open = comparison(-0.2, 0.05), worse = comparison(0.01, 0.3);
    EXPECT_EQ(answer_text(better, better.variants.front()),
              "With dowels the probability of collapse is 0.400 instead of 0.500 over the 2 cells of the study, each "
              "with the same weight: a difference of -0.1000 [-0.2000, -0.0500] at 95 %. It helps.");
    EXPECT_TRUE(answer_text(open, open.variants.front())
                    .ends_with("No difference is shown; one larger than 0.200 is "
                               "excluded."));
    EXPECT_TRUE(answer_text(worse, worse.variants.front()).ends_with("It harms."));
    Comparison empty = better;
    empty.variants.front().limits.front().overall.counts = {};
    EXPECT_NE(answer_text(empty, empty.variants.front()).find("nothing can be said"), std::string::npos);
}

TEST(ComparisonAnswer, NamesWhereItHarmsAndWhatWouldChangeIt)
{
    const Comparison c = comparison(-0.2, -0.05);
    const VariantComparison& dowels = c.variants.front();
    EXPECT_NE(harm_text(c, dowels).find("It harms in 1 of 2 cells"), std::string::npos);
    EXPECT_NE(harm_text(c, dowels).find("6 m/s2"), std::string::npos) << harm_text(c, dowels);

    const std::vector<std::string> hangs = dependence_texts(c, dowels);
    ASSERT_EQ(hangs.size(), 1U) << "the tilt does not count";
    EXPECT_EQ(hangs.front(), "friction: the difference is -0.200 [-0.300, -0.100] at friction below 0.65, and 0.020 "
                             "[-0.100, 0.100] at friction above 0.71 (adjusted p = 2e-05).");

    const std::vector<std::string> changes = what_would_change_it(c, dowels);
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes.front(), "friction above 0.71: no difference is shown, 0.020 [-0.100, 0.100].");
    EXPECT_EQ(changes.back(), harm_text(c, dowels));
}

TEST(ComparisonAnswer, SaysHowManyMorePairsWouldShowADifference)
{
    Comparison c = comparison(-0.4, 0.2); // half width 0.3, difference -0.1
    c.variants.front().depends.clear();
    c.variants.front().limits.front().cells.pop_back();
    c.pga_m_s2.pop_back();
    const std::vector<std::string> changes = what_would_change_it(c, c.variants.front());
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_NE(changes.front().find("about 9 times as many"), std::string::npos) << changes.front();
}

TEST(ComparisonAnswer, ItsGroundsAreInTheFile)
{
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "comparison_answer.h5";
    Comparison c = comparison(-0.2, -0.05);
    write_comparison(c, file);
    const Comparison read = read_comparison(file);
    EXPECT_EQ(dependence_texts(read, read.variants.front()), dependence_texts(c, c.variants.front()));
    EXPECT_EQ(what_would_change_it(read, read.variants.front()), what_would_change_it(c, c.variants.front()));
    EXPECT_EQ(read.variants.front().depends.size(), 2U);
    c.variants.front().depends.clear();
    write_comparison(c, file);
    EXPECT_TRUE(read_comparison(file).variants.front().depends.empty());
    std::filesystem::remove(file);
}

} // namespace
} // namespace stylobate

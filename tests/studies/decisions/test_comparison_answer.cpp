/// What a comparison comes to in sentences, and that its file keeps what they are made of.

#include "ensemble/model/input_error.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/comparison_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

/// Two cells, in the second of which the variant harms; its gain depends on the friction.
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
              "with the same weight: a difference of -0.1000 (-0.2000 to -0.0500) at 95 %. It helps.");
    EXPECT_TRUE(
        answer_text(open, open.variants.front()).ends_with("at 95 %. Undecided: -20.0 to +5.0 percentage points."));
    EXPECT_TRUE(answer_text(worse, worse.variants.front()).ends_with("It harms."));
    Comparison empty = better;
    empty.variants.front().limits.front().overall.counts = {};
    EXPECT_NE(answer_text(empty, empty.variants.front()).find("nothing can be said"), std::string::npos);
}

TEST(ComparisonAnswer, NamesWhereItHarmsAndWhatWouldChangeIt)
{
    const Comparison c = comparison(-0.2, -0.05);
    const VariantComparison& dowels = c.variants.front();
    const std::string harm = harm_text(c, dowels).value();
    EXPECT_NE(harm.find("It harms in 1 of 2 cells"), std::string::npos);
    EXPECT_NE(harm.find("6 m/s2"), std::string::npos) << harm;

    const std::vector<std::string> changes = what_would_change_it(c, dowels);
    ASSERT_EQ(changes.size(), 2U) << "the tilt does not count";
    EXPECT_EQ(changes.front(), "friction above 0.71: no difference is shown, 0.020 (-0.100 to 0.100).");
    EXPECT_EQ(changes.back(), harm);
}

/// What the sections are, in the order in which they stand in a page and on a console.
TEST(ComparisonAnswer, IsOneDocumentForConsoleAndPage)
{
    Comparison c = comparison(-0.2, -0.05);
    c.variants.front().inputs = {{"friction", CommonDraws::same, 3}, {"tilt", CommonDraws::quantiles, 1}};
    c.variants.front().notes = {"The numerics differ."};
    c.adaptive_budget = 100;
    const std::string text = comparison_text(c);
    const std::vector<std::string> parts = {
        "Comparison with column\nThe answer\n",
        "  " + answer_text(c, c.variants.front()) + "\n",
        "  dowels: " + harm_text(c, c.variants.front()).value() + "\n",
        "  Adaptive: at most 100 pairs",
        "What the answer depends on\n",
        "  friction from 0.65 to 0.71  -0.200 (-0.300 to -0.100)  -0.100 (-0.200 to -0.010)   0.020 (-0.100 to 0.100)",
        "What would change it: dowels\n  - friction above 0.71: no difference is shown",
        "What changes\n",
        "  -0.1000 (-0.2000 to -0.0500)  better           30             10 ",
        "Where it changes\n",
        "  dowels: collapse worse in 1 and better in 1 of 2 cells\n",
        "  2 Hz, 6 m/s2  0.200   0.400  +0.2000 (+0.1000 to +0.3000)      0.0001\n",
        "What is common\n  Draws of dowels: friction (3): same numbers; tilt: same quantiles\n",
        "  dowels: The numerics differ.\n"};
    std::size_t at = 0;
    for (const std::string& part : parts) {
        const std::size_t found = text.find(part, at);
        ASSERT_NE(found, std::string::npos) << part << "is not in\n" << text;
        at = found;
    }
}

TEST(ComparisonAnswer, SaysHowManyMorePairsWouldShowADifference)
{
    Comparison c = comparison(-0.4, 0.2); // half width 0.3, difference -0.1
    c.variants.front().depends.clear();
    c.variants.front().limits.front().cells.pop_back();
    c.pga_m_s2.pop_back();
    const std::vector<std::string> changes = what_would_change_it(c, c.variants.front());
    ASSERT_EQ(changes.size(), 1U);
    // 100 pairs, whose upper limit is 0.3 from the difference: three times too far, so 9 times as many
    EXPECT_NE(changes.front().find("about 900 instead of 100 would show it"), std::string::npos) << changes.front();

    // the limit on the other side of 0 counts, however near the one beyond the difference is: (0.11 / 0.1)^2
    PlaceComparison& all = c.variants.front().limits.front().overall;
    all.lower = -0.12;
    all.upper = 0.01;
    EXPECT_NE(what_would_change_it(c, c.variants.front()).front().find("about 130 instead of 100"), std::string::npos)
        << what_would_change_it(c, c.variants.front()).front();
    // the same of a variant that seems to harm
    all.difference = 0.1;
    all.lower = -0.01;
    all.upper = 0.12;
    EXPECT_NE(what_would_change_it(c, c.variants.front()).front().find("about 130 instead of 100"), std::string::npos);
    all.difference = 0;
    EXPECT_EQ(what_would_change_it(c, c.variants.front()).front(),
              "More pairs would exclude smaller differences; the one that was found is 0.");
}

TEST(ComparisonAnswer, CellsThatAreAsTheAnswerIsDoNotChangeIt)
{
    Comparison c = comparison(0.01, 0.3); // it harms
    c.variants.front().depends.clear();
    const std::vector<std::string> changes = what_would_change_it(c, c.variants.front());
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_TRUE(changes.front().starts_with("It helps in 1 of 2 cells")) << changes.front();
    EXPECT_NE(changes.front().find("3 m/s2: 0.400 instead of 0.800, difference -0.4000"), std::string::npos)
        << changes.front();
    const Comparison open = comparison(-0.2, 0.05);
    const std::vector<std::string> both = what_would_change_it(open, open.variants.front());
    ASSERT_EQ(both.size(), 5U) << "two thirds with a difference, both kinds of cells, more pairs";
    EXPECT_TRUE(both[0].starts_with("friction below 0.65: a difference is shown,")) << both[0];
    EXPECT_TRUE(both[2].starts_with("It harms")) << both[2];
    EXPECT_TRUE(both[3].starts_with("It helps")) << both[3];
    EXPECT_TRUE(both[4].starts_with("More pairs")) << both[4];
}

TEST(ComparisonAnswer, AThirdWithTheOtherSignIsNamed)
{
    Comparison c = comparison(-0.2, -0.05);
    c.variants.front().depends.front().found.thirds[1] = {0.1, 0.01, 0.2};
    EXPECT_EQ(what_would_change_it(c, c.variants.front()).front(),
              "friction from 0.65 to 0.71: the difference has the other sign, 0.100 (0.010 to 0.200).");
}

TEST(ComparisonAnswer, OfMotionsSpeaksOfMotions)
{
    Comparison c = comparison(-0.4, 0.2);
    c.kind = "fragility";
    c.adjustment = "holm";
    c.frequency_hz = c.pga_m_s2 = {};
    c.intensity = {1, 2};
    c.measure = "sa_0.5s_m_s2";
    c.motions = 20;
    VariantComparison& dowels = c.variants.front();
    dowels.limits.front().describe = "a block falls"; // of a damage state: a clause, no noun
    dowels.depends.clear();
    EXPECT_TRUE(answer_text(c, dowels).starts_with("With dowels the probability of collapse is"));
    EXPECT_EQ(c.place(0), "Sa(0.5 s) 1 m/s2");
    EXPECT_NE(answer_text(c, dowels).find("over 20 motions at 2 intensities: a difference"), std::string::npos);
    const std::string harm = harm_text(c, dowels).value();
    EXPECT_TRUE(harm.starts_with("It harms in 1 of 2 intensities (Holm")) << harm;
    EXPECT_EQ(what_would_change_it(c, dowels).back(),
              "More motions: were the difference the one that was found, about 180 instead of 20 would show it.");
    c.intensity = {}; // a cloud
    dowels.limits.front().cells.pop_back();
    EXPECT_NE(answer_text(c, dowels).find("over 20 motions: a difference"), std::string::npos);
    dowels.limits.front().overall.upper = 1; // one motion alone shows nothing
    EXPECT_TRUE(answer_text(c, dowels).ends_with("Undecided: no difference is excluded."));
}

TEST(ComparisonAnswer, NamesWhatPairingSavedAndTheRangeOfAnOpenVerdict)
{
    Comparison c = comparison(-0.2, 0.05);
    PlaceComparison& all = c.variants.front().limits.front().overall;
    all.unpaired = 20.2 * static_cast<double>(all.counts.pairs());
    EXPECT_NE(comparison_text(c).find("a factor of 20  collapse\n"), std::string::npos) << comparison_text(c);
    all.unpaired = std::nan("");
    EXPECT_NE(comparison_text(c).find(" unknown  collapse\n"), std::string::npos) << comparison_text(c);
    EXPECT_EQ(verdict_text(c.variants.front().limits.front(), all), "undecided: -20.0 to +5.0 percentage points");
    all.lower = -0.0005;
    EXPECT_EQ(points_text(all), "-0.05 to +5.0 percentage points");
}

TEST(ComparisonAnswer, WithoutPairsNothingIsSaid)
{
    Comparison c = comparison(-1, 1);
    VariantComparison& dowels = c.variants.front();
    dowels.limits.front().overall = {};
    dowels.limits.front().overall.difference = std::nan("");
    dowels.pairs = 0;
    dowels.depends.clear();
    EXPECT_EQ(what_would_change_it(c, dowels),
              std::vector<std::string>{"Pairs that are valid in both studies; there is none."});
    const std::string text = comparison_text(c);
    EXPECT_NE(text.find("no pair of realizations is valid in both studies"), std::string::npos) << text;
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(ComparisonAnswer, WhatNothingChangesIsSaid)
{
    Comparison c = comparison(-0.2, -0.05);
    VariantComparison& dowels = c.variants.front();
    dowels.limits.front().cells[1].p_adjusted = 1;
    dowels.depends.front().p_adjusted = 0.06;
    EXPECT_EQ(what_would_change_it(c, dowels),
              std::vector<std::string>{"None of the drawn quantities is shown to change it."});
    dowels.depends.clear();
    EXPECT_EQ(what_would_change_it(c, dowels),
              std::vector<std::string>{"Nothing that was examined: no test by drawn quantity was made."});
}

TEST(ComparisonAnswer, ItsGroundsAreInTheFile)
{
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "comparison_answer.h5";
    Comparison c = comparison(-0.2, -0.05);
    write_comparison(c, file);
    const Comparison read = read_comparison(file);
    EXPECT_EQ(comparison_text(read), comparison_text(c));
    EXPECT_EQ(what_would_change_it(read, read.variants.front()), what_would_change_it(c, c.variants.front()));
    EXPECT_EQ(read.variants.front().depends.size(), 2U);
    c.variants.front().depends.clear();
    write_comparison(c, file);
    EXPECT_TRUE(read_comparison(file).variants.front().depends.empty());
    Comparison none = c; // what is no comparison is refused before it is used
    none.variants.clear();
    write_comparison(none, file);
    EXPECT_THROW(read_comparison(file), InputError);
    c.variants.front().limits.clear();
    write_comparison(c, file);
    EXPECT_THROW(read_comparison(file), InputError);
    std::filesystem::remove(file);
}

} // namespace
} // namespace stylobate

/// Claims judged on realizations that were made up, so that every number and every verdict is known beforehand.

#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/interval.hpp"
#include "studies/evidence/claims/claim.hpp"
#include "studies/evidence/claims/claim_page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stylobate::claims {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// `count` realizations of which the first `rocked` rock; amounts are 1, 2, 3, ... in every place.
std::vector<Observation> cell(std::size_t count, std::size_t rocked)
{
    std::vector<Observation> all(count);
    for (std::size_t i = 0; i < count; ++i) {
        all[i].index = i;
        all[i].rocked = i < rocked;
        all[i].cycles_to_collapse = std::numeric_limits<double>::quiet_NaN();
        all[i].amount.fill(static_cast<double>(i + 1));
    }
    return all;
}

Measure onset_of(Event event)
{
    Measure m;
    m.kind = Measure::Kind::onset;
    m.event = event;
    return m;
}

/// 200 realizations in each cell; share[f][p] of them rock.
Sample sample(const std::vector<double>& frequency_hz, const std::vector<double>& pga_m_s2,
              const std::vector<std::vector<double>>& share, Levels levels = {})
{
    Sample s;
    s.levels = std::move(levels);
    s.f1_hz = 10;
    s.frequency_hz = frequency_hz;
    s.pga_m_s2 = pga_m_s2;
    for (const auto& row : share)
        for (const double p : row)
            s.cells.push_back(cell(200, static_cast<std::size_t>(std::lround(200 * p))));
    return s;
}

/// A file with one test and the axes "K" (soft, stiff) and "start" (smooth, abrupt).
ClaimFile two_axes(const Criterion& criterion)
{
    ClaimFile file;
    file.file = file.name = "made_up";
    file.axes = {{"K", "stiffness", {{"soft", {}, {}, {}}, {"stiff", {}, {}, {}}}},
                 {"start", "start", {{"smooth", {}, {}, {}}, {"abrupt", {}, {}, {}}}}};
    Test test;
    test.id = "P1";
    test.says = "Something.";
    test.criterion = criterion;
    test.ranges = {{}};
    file.tests = {test};
    return file;
}

Criterion at_least(double limit)
{
    Criterion c;
    c.measure.event = Event::rocked;
    c.at_least = limit;
    return c;
}

/// One cell in each of the four variants.
std::vector<Sample> four(double soft_smooth, double soft_abrupt, double stiff_smooth, double stiff_abrupt)
{
    return {sample({1}, {2}, {{soft_smooth}}, {0, 0}), sample({1}, {2}, {{soft_abrupt}}, {0, 1}),
            sample({1}, {2}, {{stiff_smooth}}, {1, 0}), sample({1}, {2}, {{stiff_abrupt}}, {1, 1})};
}

Verdict verdict(const ClaimFile& file, const std::vector<Sample>& samples)
{
    return judged(file, file.tests[0], samples).verdict;
}

std::vector<Case> cases_of(const ClaimFile& file, const std::vector<Sample>& samples, double margin = 0)
{
    return judge(file, file.tests[0], samples, margin);
}

// ---- numbers with intervals -----------------------------------------------------------------------------------------

TEST(ClaimEstimate, ProbabilityCountsOnlyWhatIsGiven)
{
    auto observations = cell(100, 30);
    for (std::size_t i = 0; i < 40; ++i)
        observations[i].slid = true; // 30 rocked and slid, 10 only slid
    Measure m;
    m.event = Event::rocked;
    EXPECT_DOUBLE_EQ(probability(observations, m, 0.95).value, 0.3);
    m.given = Event::slid;
    const Estimate given = probability(observations, m, 0.95);
    EXPECT_DOUBLE_EQ(given.value, 0.75);
    EXPECT_EQ(given.realizations, 40u);
    EXPECT_DOUBLE_EQ(given.lower, jeffreys(40, 30, 0.95).lower);
    m.given = Event::collapsed;
    EXPECT_FALSE(probability(observations, m, 0.95).known());
}

TEST(ClaimEstimate, EventsArePartsOfEachOther)
{
    Observation o;
    EXPECT_TRUE(o.has(Event::stood));
    o.rocked = true;
    EXPECT_TRUE(o.has(Event::rocked_only) && o.has(Event::rocked_or_slid) && !o.has(Event::rocked_and_slid));
    o.slid = true;
    EXPECT_TRUE(o.has(Event::rocked_and_slid) && !o.has(Event::rocked_only) && !o.has(Event::slid_only));
    o.collapsed = true;
    o.cycles_to_collapse = 2.5;
    EXPECT_TRUE(o.has(Event::collapsed_early, 3) && !o.has(Event::collapsed_early, 2) && !o.has(Event::upright));
}

TEST(ClaimEstimate, MedianHasTheTextbookRanks)
{
    // Order statistics for the median at 95 %, as in tables of the sign test: n = 10: 2nd and 9th; n = 100: 40th, 61st
    const Measure m;
    const Estimate ten = median(cell(10, 0), m, 0.95);
    EXPECT_DOUBLE_EQ(ten.value, 5.5);
    EXPECT_DOUBLE_EQ(ten.lower, 2);
    EXPECT_DOUBLE_EQ(ten.upper, 9);
    const Estimate hundred = median(cell(100, 0), m, 0.95);
    EXPECT_DOUBLE_EQ(hundred.lower, 40);
    EXPECT_DOUBLE_EQ(hundred.upper, 61);
    EXPECT_FALSE(median(cell(5, 0), m, 0.95).known()); // 2^-5 on either side is more than 5 %
    const Estimate many = median(cell(4000, 0), m, 0.95);
    EXPECT_NEAR(many.lower, 2000 - 1.96 * std::sqrt(1000), 2); // normal approximation; 0.5^4000 is 0 in double
}

TEST(ClaimEstimate, MinorityIsHighestAtOneHalf)
{
    Measure m;
    m.event = Event::rocked;
    EXPECT_DOUBLE_EQ(minority(cell(200, 180), m, 0.95).value, 0.1);
    EXPECT_DOUBLE_EQ(minority(cell(200, 20), m, 0.95).upper, probability(cell(200, 20), m, 0.95).upper);
    EXPECT_DOUBLE_EQ(minority(cell(200, 100), m, 0.95).upper, 0.5);
    EXPECT_EQ(minority(cell(200, 0), m, 0.95).lower, 0);
}

TEST(ClaimEstimate, OnsetIsInterpolatedAndBracketedByTheAxis)
{
    const Sample s = sample({1}, {1, 2, 4, 8}, {{0, 0.25, 0.75, 1}});
    const Estimate e = onset(s, 0, onset_of(Event::rocked), 0.95);
    EXPECT_NEAR(e.value, std::sqrt(8.0), 1e-12); // half way between 2 and 4 on the logarithmic axis
    EXPECT_EQ(e.lower, 2);
    EXPECT_EQ(e.upper, 4);
}

TEST(ClaimEstimate, OnsetOfASharpStepIsKnownToOneCellOnly)
{
    const Estimate e = onset(sample({1}, {1, 2, 4}, {{0, 0, 1}}), 0, onset_of(Event::rocked), 0.95);
    EXPECT_EQ(e.lower, 2);
    EXPECT_EQ(e.upper, 4);
    const Estimate blurred = onset(sample({1}, {1, 2, 4}, {{0, 0.48, 1}}), 0, onset_of(Event::rocked), 0.95);
    EXPECT_EQ(blurred.lower, 1); // 0.48 of 200 may be 1/2
    EXPECT_EQ(blurred.upper, 4);
}

TEST(ClaimEstimate, OnsetBeyondTheAxis)
{
    const Estimate above = onset(sample({1}, {1, 2}, {{0, 0.1}}), 0, onset_of(Event::rocked), 0.95);
    EXPECT_EQ(above.value, infinity);
    EXPECT_EQ(above.lower, 2);
    EXPECT_EQ(number_text(onset_of(Event::rocked), above), "above 2 m/s²");
    const Estimate below = onset(sample({1}, {1, 2}, {{1, 1}}), 0, onset_of(Event::rocked), 0.95);
    EXPECT_EQ(below.lower, 0);
    EXPECT_EQ(below.upper, 1);
    EXPECT_TRUE(below.below(above));
    EXPECT_FALSE(above.below(above));
}

TEST(ClaimEstimate, OnsetBetweenStepsFollowsTheLimitsOfTheCurve)
{
    Measure m = onset_of(Event::rocked);
    m.between_steps = true;
    const Estimate e = onset(sample({1}, {1, 2, 4}, {{0, 0.4, 1}}), 0, m, 0.95);
    // by hand: the limits at 80 of 200 and at 200 of 200, straight lines in ln PGA
    const BinomialInterval middle = jeffreys(200, 80, 0.95), last = jeffreys(200, 200, 0.95);
    EXPECT_NEAR(e.value, 2 * std::pow(2, 0.1 / 0.6), 1e-12);
    EXPECT_NEAR(e.lower, 2 * std::pow(2, (0.5 - middle.upper) / (last.upper - middle.upper)), 1e-12);
    EXPECT_NEAR(e.upper, 2 * std::pow(2, (0.5 - middle.lower) / (last.lower - middle.lower)), 1e-12);
    // a step from 0 to 1 is not resolved: it may lie anywhere between
    const Estimate step = onset(sample({1}, {1, 2, 4}, {{0, 0, 1}}), 0, m, 0.95);
    EXPECT_EQ(step.lower, 2);
    EXPECT_EQ(step.upper, 4);
}

TEST(ClaimEstimate, OnsetTakesTheLowestOfSeveralCrossings)
{
    const Estimate e = onset(sample({1}, {1, 2, 4, 8}, {{0, 1, 0, 1}}), 0, onset_of(Event::rocked), 0.95);
    EXPECT_LT(e.value, 2);
    EXPECT_EQ(e.upper, 2);
}

// ---- criteria -------------------------------------------------------------------------------------------------------

TEST(ClaimCriterion, BoundIsDecidedByTheInterval)
{
    const ClaimFile file = two_axes(at_least(0.5));
    const auto cases = cases_of(file, four(0.9, 0.1, 0.52, 0.48));
    ASSERT_EQ(cases.size(), 4u);
    EXPECT_EQ(cases[0].finding, Finding::holds);
    EXPECT_EQ(cases[1].finding, Finding::fails);
    EXPECT_EQ(cases[2].finding, Finding::undecided);
    EXPECT_EQ(cases[3].finding, Finding::undecided);
}

TEST(ClaimCriterion, AllCellsAndAnyCell)
{
    ClaimFile file = two_axes(at_least(0.5));
    const std::vector<Sample> mixed{sample({1, 2}, {1, 2}, {{0.1, 0.2}, {0.9, 0.1}}, {0, 0})};
    auto one = cases_of(file, mixed);
    EXPECT_EQ(one[0].finding, Finding::fails);
    EXPECT_DOUBLE_EQ(one[0].number.value, 0.1); // the worst
    file.tests[0].criterion.any = true;
    one = cases_of(file, mixed);
    EXPECT_EQ(one[0].finding, Finding::holds);
    EXPECT_DOUBLE_EQ(one[0].number.value, 0.9); // the best
    file.tests[0].ranges[0].frequency.to = 1;
    EXPECT_EQ(cases_of(file, mixed)[0].finding, Finding::fails);
}

TEST(ClaimCriterion, AtMostLooksFromTheOtherSide)
{
    Criterion c;
    c.measure.event = Event::rocked;
    c.at_most = 0.5;
    const ClaimFile file = two_axes(c);
    const auto cases = cases_of(file, four(0.9, 0.1, 0.5, 0));
    EXPECT_EQ(cases[0].finding, Finding::fails);
    EXPECT_EQ(cases[1].finding, Finding::holds);
    EXPECT_EQ(cases[2].finding, Finding::undecided);
    EXPECT_EQ(cases[3].finding, Finding::holds);
}

TEST(ClaimCriterion, BetweenTwoNumbers)
{
    Criterion c = at_least(0.4);
    c.at_most = 0.6;
    const ClaimFile file = two_axes(c);
    const auto cases = cases_of(file, four(0.9, 0.1, 0.5, 0.4));
    EXPECT_EQ(cases[0].finding, Finding::fails);
    EXPECT_EQ(cases[1].finding, Finding::fails);
    EXPECT_EQ(cases[2].finding, Finding::holds);
    EXPECT_EQ(cases[3].finding, Finding::undecided);
}

TEST(ClaimCriterion, CellsWithNothingGivenArePassedOver)
{
    Criterion c = at_least(0.5);
    c.measure.given = Event::rocked;
    const ClaimFile file = two_axes(c);
    // in the first cell nothing rocked; in the second all that did
    EXPECT_EQ(cases_of(file, {sample({1}, {1, 2}, {{0, 0.9}}, {0, 0})})[0].finding, Finding::holds);
    EXPECT_EQ(cases_of(file, {sample({1}, {1}, {{0}}, {0, 0})})[0].finding, Finding::undecided);
}

TEST(ClaimCriterion, ManyCellsWidenTheIntervals)
{
    // 0.59 of 200 differs from 1/2 at 95 % (Jeffreys from 0.521), but not at the 99.75 % that each of 20 cells has to
    // be judged at (from 0.484)
    const ClaimFile file = two_axes(at_least(0.5));
    EXPECT_EQ(cases_of(file, {sample({1}, {1}, {{0.59}}, {0, 0})})[0].finding, Finding::holds);
    std::vector<double> pga;
    for (int i = 1; i <= 20; ++i)
        pga.push_back(i);
    const auto many = cases_of(file, {sample({1}, pga, {std::vector<double>(20, 0.59)}, {0, 0})});
    EXPECT_EQ(many[0].finding, Finding::undecided);
}

Criterion falling_onset()
{
    Criterion c;
    c.kind = Criterion::Kind::trend;
    c.measure = onset_of(Event::rocked);
    return c;
}

const std::vector<double> octaves{1, 2, 4, 8};

TEST(ClaimCriterion, TrendFallsRisesOrTurns)
{
    ClaimFile file = two_axes(falling_onset());
    const std::vector<double> early{0, 1, 1, 1}, middle{0, 0, 1, 1}, late{0, 0, 0, 1};
    const auto finding = [&](const std::vector<std::vector<double>>& share) {
        return cases_of(file, {sample({1, 2, 3}, octaves, share, {0, 0})})[0].finding;
    };
    EXPECT_EQ(finding({late, middle, early}), Finding::holds);
    EXPECT_EQ(finding({late, late, early}), Finding::holds);
    EXPECT_EQ(finding({early, middle, late}), Finding::fails);
    EXPECT_EQ(finding({late, early, middle}), Finding::fails); // it turns
    EXPECT_EQ(finding({middle, middle, middle}), Finding::undecided);
    // one frequency alone, or nothing within the axis: no case
    EXPECT_TRUE(cases_of(file, {sample({1}, octaves, {middle}, {0, 0})}).empty());
    const std::vector<double> never{0, 0, 0, 0};
    EXPECT_TRUE(cases_of(file, {sample({1, 2}, octaves, {never, never}, {0, 0})}).empty());
    file.tests[0].criterion.way = Criterion::Way::rises;
    EXPECT_EQ(finding({early, middle, late}), Finding::holds);
}

TEST(ClaimCriterion, TrendWithAMargin)
{
    const ClaimFile file = two_axes(falling_onset());
    const std::vector<double> early{0, 1, 1, 1}, middle{0, 0, 1, 1}, late{0, 0, 0, 1};
    // from [2, 4] it turns to [4, 8], which may be nothing, then falls to [1, 2], which may be nothing from the first
    const std::vector<Sample> turning{sample({1, 2, 3}, octaves, {middle, late, early}, {0, 0})};
    EXPECT_EQ(cases_of(file, turning, 0)[0].finding, Finding::fails);
    EXPECT_EQ(cases_of(file, turning, 0.2)[0].finding, Finding::undecided);
    // from [1, 2] to [4, 8] is a factor of two at the least
    const std::vector<Sample> wide{sample({1, 2, 3}, octaves, {early, late, early}, {0, 0})};
    EXPECT_EQ(cases_of(file, wide, 0.2)[0].finding, Finding::fails);
    const std::vector<Sample> falls{sample({1, 2}, octaves, {late, early}, {0, 0})};
    EXPECT_EQ(cases_of(file, falls, 0.99)[0].finding, Finding::holds);
    EXPECT_EQ(cases_of(file, falls, 1.01)[0].finding, Finding::undecided);
}

/// The bound of 0.5 is cleared at 20 % from 0.6 on, and missed below 0.4; the intervals of 200 are about +- 0.07.
TEST(ClaimCriterion, BoundWithAMargin)
{
    const ClaimFile file = two_axes(at_least(0.5));
    const auto findings = [&](double share) {
        std::vector<Finding> all;
        for (const double margin : margins)
            all.push_back(cases_of(file, four(share, 0, 0, 0), margin)[0].finding);
        return all;
    };
    EXPECT_EQ(findings(0.7), std::vector<Finding>(3, Finding::holds));
    EXPECT_EQ(findings(0.58), (std::vector<Finding>{Finding::holds, Finding::undecided, Finding::undecided}));
    EXPECT_EQ(findings(0.42), (std::vector<Finding>{Finding::fails, Finding::undecided, Finding::undecided}));
    EXPECT_EQ(findings(0.3), std::vector<Finding>(3, Finding::fails));
    // a probability of at least 0.9 is cleared by a part of the 0.1 that is left
    Criterion c = at_least(0.9);
    EXPECT_EQ(cases_of(two_axes(c), four(1, 0, 0, 0), 0.2)[0].finding, Finding::holds);
    // two bounds are a margin of their own
    c = at_least(0.4);
    c.at_most = 0.6;
    EXPECT_EQ(cases_of(two_axes(c), four(0.5, 0, 0, 0), 0.2)[0].finding, Finding::holds);
    // a number that is no part
    Criterion of_median;
    of_median.measure.kind = Measure::Kind::median;
    of_median.at_most = 100; // the median of 1 to 200 is 100.5
    EXPECT_EQ(cases_of(two_axes(of_median), four(0, 0, 0, 0), 0.2)[0].finding, Finding::undecided);
    of_median.at_most = 140;
    EXPECT_EQ(cases_of(two_axes(of_median), four(0, 0, 0, 0), 0)[0].finding, Finding::holds);
    EXPECT_EQ(cases_of(two_axes(of_median), four(0, 0, 0, 0), 0.2)[0].finding, Finding::undecided); // up to 115 of 112
}

TEST(ClaimCriterion, RangesInUnitsOfTheFirstFrequency)
{
    ClaimFile file = two_axes(falling_onset());
    file.tests[0].ranges = {
        {"below", {0, 0.25, {}, true}}, {"above", {0.25, 10, {}, true}}, {"none", {50, 60, {}, true}}};
    const std::vector<double> early{0, 1, 1, 1}, middle{0, 0, 1, 1}, late{0, 0, 0, 1};
    // f1 = 10 Hz: 1 and 2 Hz are below 2.5 Hz
    const auto cases = cases_of(file, {sample({1, 2, 3, 4}, octaves, {middle, early, middle, late}, {0, 0})});
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases[0].finding, Finding::holds);
    EXPECT_EQ(cases[1].finding, Finding::fails);
}

TEST(ClaimCriterion, OrderComparesAlongAnAxis)
{
    Criterion c = falling_onset();
    c.kind = Criterion::Kind::order;
    c.along = "K";
    ClaimFile file = two_axes(c);
    const std::vector<double> early{0, 1, 1, 1}, late{0, 0, 0, 1}, never{0, 0, 0, 0};
    const auto of = [&](const std::vector<double>& share, Levels levels) {
        return sample({1}, octaves, {share}, std::move(levels));
    };
    const std::vector<Sample> samples{of(late, {0, 0}), of(early, {0, 1}), of(early, {1, 0}), of(late, {1, 1})};
    auto cases = cases_of(file, samples);
    ASSERT_EQ(cases.size(), 2u); // one for each start
    EXPECT_EQ(cases[0].finding, Finding::holds);
    EXPECT_EQ(cases[1].finding, Finding::fails);
    file.tests[0].criterion.way = Criterion::Way::either;
    cases = cases_of(file, samples);
    EXPECT_EQ(cases[0].finding, Finding::holds);
    EXPECT_EQ(cases[1].finding, Finding::holds);
    // beyond the same end of the axis at both levels: nothing to compare
    const std::vector<double> always{1, 1, 1, 1};
    EXPECT_TRUE(cases_of(file, {of(never, {0, 0}), of(never, {1, 0})}).empty());
    EXPECT_TRUE(cases_of(file, {of(always, {0, 0}), of(always, {1, 0})}).empty());
    EXPECT_EQ(cases_of(file, {of(never, {0, 0}), of(always, {1, 0})}).size(), 1u);
    // one level alone makes no case
    EXPECT_TRUE(cases_of(file, {of(early, {0, 0})}).empty());
}

TEST(ClaimCriterion, OrderWithAMargin)
{
    Criterion c;
    c.kind = Criterion::Kind::order;
    c.along = "K";
    c.measure.event = Event::rocked;
    c.way = Criterion::Way::rises;
    ClaimFile file = two_axes(c);
    // soft to stiff: 0.2 to 0.9 is far more than half as much again; 0.8 to 0.95 is more, but not by half
    EXPECT_EQ(cases_of(file, four(0.2, 0.8, 0.9, 0.95), 0.5)[0].finding, Finding::holds);
    EXPECT_EQ(cases_of(file, four(0.2, 0.8, 0.9, 0.95), 0)[1].finding, Finding::holds);
    EXPECT_EQ(cases_of(file, four(0.2, 0.8, 0.9, 0.95), 0.5)[1].finding, Finding::undecided);
    // falling: from stiff to soft, and the other way
    file.tests[0].criterion.way = Criterion::Way::falls;
    EXPECT_EQ(cases_of(file, four(0.9, 0.9, 0.2, 0.8), 0.5)[0].finding, Finding::holds);
    EXPECT_EQ(cases_of(file, four(0.2, 0.8, 0.9, 0.95), 0.5)[0].finding, Finding::fails);
}

/// Pairs by hand: 60 of 200 rock in the soft variant and 100 in the stiff one, and all of the 60 among the 100; Tango's
/// interval of 40 in one direction of 200 pairs. Realizations without a partner are left out.
TEST(ClaimCriterion, PairsAreComparedByTheirNumbers)
{
    Criterion c;
    c.kind = Criterion::Kind::paired;
    c.along = "K";
    c.measure.event = Event::rocked;
    c.way = Criterion::Way::rises;
    ClaimFile file = two_axes(c);
    std::vector<Sample> samples{sample({1}, {2}, {{0.3}}, {0, 0}), sample({1}, {2}, {{0.5}}, {1, 0})};
    auto found = cases_of(file, samples);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].finding, Finding::holds);
    EXPECT_NEAR(found[0].number.value, 0.2, 1e-12);
    const PairedDifference tango = score_interval(200, 0, 40, two_sided_normal(0.95));
    // the variance within a cell has n - 1
    EXPECT_NEAR(found[0].number.lower, tango.lower, 3e-4);
    EXPECT_NEAR(found[0].number.upper, tango.upper, 3e-4);
    // 0.2 +- 0.055 is above 20 % of 0.5, and not above 35 %
    EXPECT_EQ(cases_of(file, samples, 0.2)[0].finding, Finding::holds);
    EXPECT_EQ(cases_of(file, samples, 0.35)[0].finding, Finding::undecided);
    file.tests[0].criterion.way = Criterion::Way::falls;
    EXPECT_EQ(cases_of(file, samples)[0].finding, Finding::fails);
    // the first 40 that rock in the stiff variant are not there: of 160 pairs 20 and 60 rock
    auto& stiff = samples[1].cells[0];
    stiff.erase(stiff.begin(), stiff.begin() + 40);
    EXPECT_NEAR(cases_of(file, samples)[0].number.value, 0.25, 1e-12);
    EXPECT_EQ(cases_of(file, samples)[0].number.realizations, 160U);
    // what all or none do is decided, and is no cell to compare in
    EXPECT_TRUE(cases_of(file, {sample({1}, {2}, {{0.01}}, {0, 0}), sample({1}, {2}, {{0.02}}, {1, 0})}).empty());
}

TEST(ClaimCriterion, OrderInAnyCell)
{
    Criterion c;
    c.kind = Criterion::Kind::order;
    c.along = "K";
    c.measure.event = Event::rocked;
    c.way = Criterion::Way::rises;
    ClaimFile file = two_axes(c);
    const auto finding = [&](double first, double second) {
        return cases_of(file,
                        {sample({1}, {1, 2}, {{0.2, 0.5}}, {0, 0}), sample({1}, {1, 2}, {{first, second}}, {1, 0})})[0]
            .finding;
    };
    EXPECT_EQ(finding(0.9, 0.5), Finding::undecided); // one cell of two
    file.tests[0].criterion.any = true;
    EXPECT_EQ(finding(0.9, 0.5), Finding::holds);
    EXPECT_EQ(finding(0.9, 0.1), Finding::fails); // and the other way in the other
    EXPECT_EQ(finding(0.2, 0.5), Finding::undecided);
}

TEST(ClaimCriterion, SameWayOfMoving)
{
    Criterion c;
    c.kind = Criterion::Kind::same;
    c.along = "K";
    const ClaimFile file = two_axes(c);
    auto samples = four(0.9, 0.9, 0.8, 0.9);
    for (Observation& o : samples[3].cells[0])
        o.slid = true; // most rock and slide
    auto cases = cases_of(file, samples);
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases[0].finding, Finding::holds);
    EXPECT_EQ(cases[1].finding, Finding::fails);
    samples = four(0.9, 0.9, 0.5, 0.1);
    for (std::size_t i = 0; i < 50; ++i)
        samples[2].cells[0][i].slid = true; // 50 rock, 50 do both, 100 stand
    cases = cases_of(file, samples);
    EXPECT_TRUE(cases.empty()) << "where most stand there is no way of moving to compare";
    for (Observation& o : samples[2].cells[0])
        o.rocked = true;
    for (std::size_t i = 0; i < 100; ++i)
        samples[2].cells[0][i].slid = true; // 100 rock, 100 do both
    cases = cases_of(file, samples);
    ASSERT_EQ(cases.size(), 1U);
    EXPECT_EQ(cases[0].finding, Finding::undecided);
    // of those that collapsed; too few of them: no case
    ClaimFile given = file;
    given.tests[0].criterion.measure.given = Event::collapsed;
    EXPECT_TRUE(cases_of(given, samples).empty());
    for (Sample& one : samples)
        for (std::size_t i = 0; i < 100; ++i)
            one.cells[0][i].collapsed = one.cells[0][i].rocked = one.cells[0][i].slid = true;
    cases = cases_of(given, samples);
    ASSERT_EQ(cases.size(), 2U);
    EXPECT_EQ(cases[0].finding, Finding::holds);
}

// ---- verdicts -------------------------------------------------------------------------------------------------------

TEST(ClaimVerdict, ConfirmedRefutedAndTied)
{
    const ClaimFile file = two_axes(at_least(0.5));
    EXPECT_EQ(verdict(file, four(0.9, 0.9, 0.8, 0.5)).judgement, Judgement::confirmed);
    EXPECT_EQ(verdict(file, four(0.1, 0.1, 0.2, 0.2)).judgement, Judgement::refuted);
    const Verdict tie = verdict(file, four(0.5, 0.5, 0.5, 0.9));
    EXPECT_EQ(tie.judgement, Judgement::depends);
    EXPECT_TRUE(tie.tie);
    EXPECT_EQ(counts_text(tie.at[0]), "holds 1, undecided 3");
    EXPECT_EQ(verdict(file, {}).judgement, Judgement::not_run);
}

TEST(ClaimVerdict, WhatTheMarginChangesDependsOnIt)
{
    const ClaimFile file = two_axes(at_least(0.5));
    // above the bound, but two of three not by 20 % of what is left
    const Verdict v = verdict(file, {sample({1}, {2}, {{0.9}}, {0, 0}), sample({1}, {2}, {{0.6}}, {0, 1}),
                                     sample({1}, {2}, {{0.6}}, {1, 0})});
    EXPECT_EQ(v.judgement, Judgement::depends);
    EXPECT_TRUE(v.by_margin);
    EXPECT_FALSE(v.tie);
    EXPECT_EQ(counts_text(v.at[0]), "holds 3");
    EXPECT_EQ(counts_text(v.at[2]), "holds 1, undecided 2");
}

TEST(ClaimVerdict, RanksTheAxesByThePairsThatDifferInThemAlone)
{
    const ClaimFile file = two_axes(at_least(0.5));
    const auto by = [&](const std::vector<Sample>& samples) {
        std::string text;
        for (const Influence& one : verdict(file, samples).by)
            text += fmt::format("{} {}/{} ", one.label, one.flips, one.pairs);
        return text;
    };
    Verdict v = verdict(file, four(0.9, 0.9, 0.1, 0.1));
    EXPECT_EQ(v.judgement, Judgement::depends);
    EXPECT_EQ(v.split, "holds for stiffness soft; it fails for stiffness stiff");
    EXPECT_EQ(verdict(file, four(0.9, 0.5, 0.5, 0.5)).split, "holds in 1 case and fails in 0");
    EXPECT_EQ(by(four(0.9, 0.9, 0.1, 0.1)), "stiffness 2/2 ");
    EXPECT_EQ(by(four(0.1, 0.9, 0.1, 0.9)), "start 2/2 ");
    EXPECT_EQ(by(four(0.1, 0.9, 0.9, 0.9)), "stiffness 1/2 start 1/2 ");
    // what is undecided makes no pair
    EXPECT_EQ(by(four(0.9, 0.5, 0.1, 0.1)), "stiffness 1/1 ");
}

TEST(ClaimVerdict, WhatIsImpossibleOrUntestableIsNeverConfirmed)
{
    ClaimFile file = two_axes(at_least(0.5));
    file.tests[0].impossible = "theory says no.";
    EXPECT_EQ(verdict(file, four(0.9, 0.9, 0.9, 0.9)).judgement, Judgement::untestable);
    EXPECT_EQ(verdict(file, four(0.9, 0.9, 0.1, 0.9)).judgement, Judgement::depends);
    EXPECT_EQ(verdict(file, four(0.1, 0.1, 0.1, 0.1)).judgement, Judgement::refuted);
    file.tests[0].impossible.reset();
    file.tests[0].untestable = "not stated.";
    EXPECT_EQ(verdict(file, four(0.9, 0.9, 0.9, 0.9)).judgement, Judgement::untestable);
}

TEST(ClaimVerdict, AbsentRecordsMakeNoCase)
{
    const ClaimFile file = two_axes(at_least(0.5));
    auto samples = four(0.9, 0.9, 0.9, 0.9);
    for (Sample& s : samples)
        s.why_not = "record absent: x.txt";
    EXPECT_EQ(verdict(file, samples).judgement, Judgement::not_run);
}

} // namespace
} // namespace stylobate::claims

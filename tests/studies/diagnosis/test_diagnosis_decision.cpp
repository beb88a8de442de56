/// What chance gives and the rule that names causes, on evidence that is written down here.

#include "studies/diagnosis/decision/decision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace stylobate {
namespace {

CauseFit fit_of(const std::string& mechanism, std::vector<double> by_run, double size = 0.5,
                const std::string& place = "joint 0")
{
    CauseFit fit;
    fit.cause = {mechanism, place, "p", "", 1};
    fit.size = size;
    fit.sd = 0.01;
    for (const double gain : by_run)
        fit.gain += gain;
    fit.gain_by_run = std::move(by_run);
    return fit;
}

/// 0.1, 0.2, ... 4: the 95 % quantile is 3.805, linear between the 38th and the 39th of 40.
ChanceGains chance_of_forty()
{
    ChanceGains chance;
    std::vector<double> gains;
    for (int i = 1; i <= 40; ++i)
        gains.push_back(0.1 * i);
    std::shuffle(gains.begin(), gains.end(), std::mt19937(1));
    for (const double gain : gains) {
        chance.add(Channel::balance, {fit_of("joint_friction", {gain}), fit_of("drag", {gain / 2}, 1),
                                      fit_of("stribeck", {gain}), fit_of("dowel", {gain}, 1)});
        chance.add({StructureFit{{}, gain, 0, 0, {}}});
    }
    return chance;
}

struct Told {
    Decided decided;
    int rounds = 0;
};

/// @param again what the second round sees
Told decide_on(const std::vector<CauseFit>& causes, const std::vector<CauseFit>& again = {},
               const std::vector<StructureFit>& structures = {}, const DirectResult& direct = {},
               const ChanceGains& chance = chance_of_forty())
{
    BalanceEvidence balance, left;
    balance.causes = best_of_each(causes);
    balance.structures = structures;
    left.causes = best_of_each(again);
    const DecisionRule rule;
    Told told;
    told.decided = decide(direct, balance, judge(balance, {}, {}, chance, rule), chance, rule, [&](const JudgedCause&) {
        ++told.rounds;
        return judge(left, {}, {}, chance, rule);
    });
    return told;
}

std::vector<std::string> names(const std::vector<JudgedCause>& judged)
{
    std::vector<std::string> all;
    for (const JudgedCause& j : judged)
        all.push_back(j.fit.cause.mechanism);
    return all;
}

using Names = std::vector<std::string>;

TEST(ChanceGains, QuantileIsCounted)
{
    const ChanceGains chance = chance_of_forty();
    EXPECT_EQ(chance.campaigns(Channel::balance), 40u);
    EXPECT_EQ(chance.campaigns(Channel::windows), 0u);
    EXPECT_NEAR(chance.quantile95(Channel::balance, "joint_friction"), 3.8 + 0.05 * 0.1, 1e-12);
    EXPECT_NEAR(chance.quantile95(Channel::balance, "drag"), 1.9025, 1e-12);
    EXPECT_NEAR(chance.quantile95_of_structures(), 3.805, 1e-12);
    EXPECT_EQ(chance.quantile95(Channel::balance, "wedge"), 0);
    EXPECT_EQ(chance.quantile95(Channel::windows, "drag"), 0);
    // within the sample the probability is a count: of 40, 40 - k + 1 are at least 0.1 k
    for (int k : {1, 10, 30})
        EXPECT_NEAR(chance.probability(Channel::balance, "joint_friction", 0.1 * k - 0.05), (41.0 - k + 1) / 41, 1e-12);
    EXPECT_EQ(chance.probability(Channel::balance, "wedge", 5), 1);
}

TEST(ChanceGains, TheLargestOfEachMechanismCounts)
{
    ChanceGains chance;
    chance.add(Channel::balance, {fit_of("drag", {2}), fit_of("drag", {5}, 1, "joint 1"), fit_of("dowel", {1})});
    chance.add(Channel::balance, {fit_of("wedge", {3})});
    using Gains = std::vector<double>;
    EXPECT_EQ(chance.gains().at({Channel::balance, "drag"}), (Gains{5, 0}));
    EXPECT_EQ(chance.gains().at({Channel::balance, "dowel"}), (Gains{1, 0}));
    EXPECT_EQ(chance.gains().at({Channel::balance, "wedge"}), (Gains{0, 3}));
}

TEST(ChanceGains, CampaignsThatNameNothingCount)
{
    ChanceGains chance;
    for (int i = 0; i < 3; ++i)
        chance.add(Channel::balance, {});
    EXPECT_EQ(chance.campaigns(Channel::balance), 3u);
    EXPECT_FALSE(chance.tell_of(Channel::balance, "drag"));
    EXPECT_EQ(chance.probability(Channel::balance, "drag", 9), 1);
    chance.add(Channel::balance, {fit_of("drag", {4})});
    chance.add(Channel::balance, {});
    chance.add(Channel::balance, {fit_of("dowel", {2})});
    EXPECT_EQ(chance.campaigns(Channel::balance), 6u);
    EXPECT_TRUE(chance.tell_of(Channel::balance, "drag"));
    using Gains = std::vector<double>;
    EXPECT_EQ(chance.gains().at({Channel::balance, "drag"}), (Gains{0, 0, 0, 4, 0, 0}));
    EXPECT_EQ(chance.gains().at({Channel::balance, "dowel"}), (Gains{0, 0, 0, 0, 0, 2}));
    // two of six gain at least 1
    EXPECT_NEAR(chance.probability(Channel::balance, "drag", 1), 2.0 / 7, 1e-12);
    EXPECT_EQ(chance.campaigns(Channel::windows), 0u);
}

TEST(ChanceGains, TailOfAnExponentialSampleIsContinued)
{
    // gains with P(> g) = exp(-g / 3): the tail is known far beyond the sample
    std::mt19937_64 random(11);
    std::exponential_distribution<double> draw(1.0 / 3);
    std::vector<double> gains(4000);
    for (double& gain : gains)
        gain = draw(random);
    ChanceGains chance;
    chance.set(Channel::balance, "drag", gains);
    double before = 1;
    for (const double gain : {1.0, 5.0, 9.0, 20.0, 40.0}) {
        const double p = chance.probability(Channel::balance, "drag", gain);
        // the mean excess of 400 is known to 5 %: in ln p that is 5 % of the distance beyond the upper tenth (6.9)
        EXPECT_NEAR(std::log(p), -gain / 3, 0.15 + 0.15 * std::max(0.0, gain - 6.9) / 3) << gain;
        EXPECT_LT(p, before);
        before = p;
    }
    // a tail is never taken for thinner than chi square's
    chance.set(Channel::balance, "dowel", std::vector<double>(100, 0.0));
    EXPECT_NEAR(chance.probability(Channel::balance, "dowel", 8), 11.0 / 101 * std::exp(-8), 1e-12);
}

TEST(Decision, NothingBeyondChanceIsNone)
{
    const Told told = decide_on({fit_of("joint_friction", {3, 3}), fit_of("drag", {1, 2})});
    EXPECT_EQ(told.decided.verdict, Verdict::none);
    EXPECT_TRUE(told.decided.named.empty());
    EXPECT_EQ(told.rounds, 0);
    ASSERT_EQ(told.decided.judged.size(), 2u);
    for (const JudgedCause& j : told.decided.judged) {
        EXPECT_FALSE(j.considered);
        EXPECT_FALSE(j.why_not.empty());
        EXPECT_EQ(j.probability, 0);
    }
    EXPECT_EQ(decide_on({}).decided.verdict, Verdict::none);
}

TEST(Decision, AClearCauseIsNamed)
{
    const Told told = decide_on({fit_of("joint_friction", {15, 14, 16}), fit_of("drag", {2, 1, 1}, 1)});
    EXPECT_EQ(told.decided.verdict, Verdict::named);
    EXPECT_EQ(names(told.decided.named), Names{"joint_friction"});
    EXPECT_TRUE(told.decided.in_set.empty());
    EXPECT_EQ(told.rounds, 1);
    const JudgedCause& named = told.decided.named.front();
    EXPECT_NEAR(named.chance95, 3.805, 1e-12);
    EXPECT_GT(named.probability, 0.9);
    EXPECT_LE(named.probability, 0.97);
}

TEST(Decision, OneRunAloneDoesNotCount)
{
    const Told told = decide_on({fit_of("joint_friction", {45, 0.5, -0.5})});
    EXPECT_EQ(told.decided.verdict, Verdict::none);
    EXPECT_NE(told.decided.judged.front().why_not.find("without the run"), std::string::npos);
    // the same gain from two runs does
    EXPECT_EQ(decide_on({fit_of("joint_friction", {22, 22.5, 0.5})}).decided.verdict, Verdict::named);
}

TEST(Decision, ASmallSizeDoesNotMatter)
{
    EXPECT_EQ(decide_on({fit_of("joint_friction", {20, 20}, 0.95)}).decided.verdict, Verdict::none);
    EXPECT_EQ(decide_on({fit_of("stribeck", {20, 20}, 0.95)}).decided.verdict, Verdict::none);
    EXPECT_EQ(decide_on({fit_of("stribeck", {20, 20}, 0.8)}).decided.verdict, Verdict::named);
}

TEST(Decision, ImpossibleSizesAreNotJudged)
{
    EXPECT_TRUE(decide_on({fit_of("drag", {20, 20}, -1)}).decided.judged.empty());
    EXPECT_TRUE(decide_on({fit_of("stribeck", {20, 20}, 1.2)}).decided.judged.empty());
    CauseFit worn = fit_of("friction_wear", {20, 20}, 12);
    worn.cause.fixed = 0.08; // 0.96 of the friction is gone when it ends
    EXPECT_EQ(decide_on({worn}).decided.judged.size(), 1u);
    worn.size = 13; // more than all of it
    EXPECT_TRUE(decide_on({worn}).decided.judged.empty());
}

TEST(Decision, WhatExplainsAlikeIsInTheSet)
{
    const Told told = decide_on(
        {fit_of("joint_friction", {20, 20}), fit_of("stribeck", {19, 19.5}, 0.6), fit_of("dowel", {10, 10}, 5)});
    EXPECT_EQ(told.decided.verdict, Verdict::named);
    EXPECT_EQ(names(told.decided.named), Names{"joint_friction"});
    EXPECT_EQ(names(told.decided.in_set), Names{"stribeck"});
}

TEST(Decision, ASecondCauseIsJudgedBesideTheFirst)
{
    const Told told =
        decide_on({fit_of("joint_friction", {30, 30}), fit_of("drag", {20, 20}, 1)}, {fit_of("drag", {18, 18}, 1)});
    EXPECT_EQ(names(told.decided.named), (Names{"joint_friction", "drag"}));
    EXPECT_EQ(told.rounds, 1); // no third
    // what the first one explains is gone in the second round
    EXPECT_EQ(
        names(decide_on({fit_of("joint_friction", {30, 30}), fit_of("drag", {20, 20}, 1)}, {fit_of("drag", {1, 1}, 1)})
                  .decided.named),
        Names{"joint_friction"});
}

TEST(Decision, TheSecondCauseStandsBehindTheFirst)
{
    // the first one has a rival, the second one, judged beside it, has none
    DirectResult direct;
    direct.found = {fit_of("sensor_gain", {50}, 1.1, "base")};
    const Told told = decide_on(
        {fit_of("joint_friction", {20, 20}), fit_of("stribeck", {19.9, 19.9}, 0.6), fit_of("drag", {9, 9}, 1)},
        {fit_of("drag", {18, 18}, 1)}, {}, direct);
    EXPECT_EQ(names(told.decided.named), (Names{"sensor_gain", "joint_friction", "drag"}));
    EXPECT_EQ(names(told.decided.in_set), Names{"stribeck"});
    const std::vector<JudgedCause>& named = told.decided.named;
    EXPECT_LT(named[1].probability, 0.6); // two that explain alike
    EXPECT_LE(named[2].probability, named[1].probability);
    EXPECT_GT(named[2].probability, 0.3);
}

TEST(Decision, ForcesOfNoKnownKindAreUnexplained)
{
    const auto structure = [](std::vector<double> by_run) {
        StructureFit fit{{1, "x", "velocity", "a sideways force"}, 0, 1, 0.1, by_run};
        for (const double gain : by_run)
            fit.gain += gain;
        return fit;
    };
    const Told told = decide_on({fit_of("joint_friction", {8, 8})}, {}, {structure({20, 20, 20})});
    EXPECT_EQ(told.decided.verdict, Verdict::unexplained);
    ASSERT_TRUE(told.decided.unexplained);
    EXPECT_EQ(told.decided.unexplained->structure.depends_on, "velocity");
    EXPECT_LT(told.decided.unexplained_chance, 1e-3);
    EXPECT_TRUE(told.decided.named.empty());
    // a known mechanism that explains nearly as much is named instead
    EXPECT_EQ(decide_on({fit_of("joint_friction", {19, 19, 19})}, {}, {structure({20, 20, 20})}).decided.verdict,
              Verdict::named);
    // one run alone, or no more than chance
    EXPECT_EQ(decide_on({}, {}, {structure({60, 0, 0})}).decided.verdict, Verdict::none);
    EXPECT_EQ(decide_on({}, {}, {structure({5, 5, 5})}).decided.verdict, Verdict::none);
    // what is left without the best run is beyond chance by itself, or is not
    EXPECT_EQ(decide_on({}, {}, {structure({20, 8, 0})}).decided.verdict, Verdict::unexplained);
    EXPECT_EQ(decide_on({}, {}, {structure({20, 6, 0})}).decided.verdict, Verdict::none);
}

TEST(Decision, DirectFindingsAreNamedAndExplainWhatTheyDo)
{
    DirectResult direct;
    direct.found = {fit_of("wedge", {50}, 0.002)};
    const Told told =
        decide_on({fit_of("eccentricity", {20, 20}, 0.001), fit_of("corner_loss", {20, 20}, 0.001)}, {}, {}, direct);
    EXPECT_EQ(told.decided.verdict, Verdict::named);
    EXPECT_EQ(names(told.decided.named), Names{"wedge"});
    EXPECT_EQ(told.decided.named.front().channel, Channel::direct);
}

TEST(Decision, WithoutKnownChanceOnlyDirectTestsName)
{
    const Told told = decide_on({fit_of("joint_friction", {50, 50})}, {}, {}, {}, ChanceGains());
    EXPECT_EQ(told.decided.verdict, Verdict::none);
    EXPECT_EQ(told.decided.judged.front().why_not, "the null distribution is unknown");
}

TEST(Decision, WhatIsLessProbableThanNotIsPossibleAndNotNamed)
{
    // 3 nats beyond chance: considered, with even odds against none, less 1
    const Told alone = decide_on({fit_of("joint_friction", {3.65, 3.6})});
    EXPECT_EQ(alone.decided.verdict, Verdict::none);
    EXPECT_TRUE(alone.decided.named.empty());
    ASSERT_EQ(alone.decided.judged.size(), 1U);
    EXPECT_LT(alone.decided.judged.front().probability, 0.5);
    EXPECT_GT(alone.decided.judged.front().probability, 0.2);
    EXPECT_EQ(alone.decided.judged.front().why_not.substr(0, 8), "possible");
    EXPECT_EQ(alone.rounds, 0) << "there is nothing to be judged beside";
    // two that explain alike: each is less probable than not, one of them is there
    const Told tied = decide_on({fit_of("joint_friction", {5, 5}), fit_of("stribeck", {5, 5})});
    EXPECT_EQ(tied.decided.verdict, Verdict::named);
    EXPECT_EQ(tied.decided.in_set.size(), 1U);
    EXPECT_LT(tied.decided.named.front().probability, 0.5);
}

} // namespace
} // namespace stylobate

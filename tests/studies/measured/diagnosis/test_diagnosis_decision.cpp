/// The rule that names causes, on evidence that is written down here.

#include "studies/measured/diagnosis/decision.hpp"
#include "studies/measured/diagnosis/evidence/balance_evidence.hpp"
#include "studies/measured/diagnosis/prediction.hpp"
#include "studies/measured/diagnosis/presentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {
namespace {

using Names = std::vector<std::string>;

CauseFit fit_of(const std::string& mechanism, double gain, double size = 0.5, const std::string& place = "joint 0")
{
    CauseFit fit;
    fit.cause = {mechanism, place, "p", "", 1};
    fit.size = size;
    fit.sd = 0.01;
    fit.gain = gain;
    return fit;
}

Names names(const std::vector<JudgedCause>& judged)
{
    Names all;
    for (const JudgedCause& j : judged)
        all.push_back(j.fit.cause.mechanism);
    return all;
}

/// What simulated campaigns say: friction of joint 0 best, then drag, then a dowel; null gains 0.1, 0.2 ... 10.
EnsembleDiagnosis ensemble_of(double friction, double drag, double dowel)
{
    EnsembleDiagnosis e;
    for (const char* mechanism : {"joint_friction", "drag", "dowel"}) {
        CandidateCause candidate;
        candidate.cause = {mechanism, "joint 0", "p", "", 1};
        candidate.at_one = 0.5;
        candidate.ratio = true;
        e.causes.push_back(candidate);
        e.mechanisms.push_back(mechanism);
    }
    EnsembleVerdict& v = e.by_statistics;
    v.causes = {{friction, 1, 0.8, 1.2}, {drag, 0.5, 0.2, 0.8}, {dowel, 0.5, 0.2, 0.8}};
    v.best = 0;
    for (int i = 1; i <= 100; ++i)
        v.null_gains.push_back(0.1 * i);
    v.null_weights.assign(100, 1);
    v.p_value = conformal_p_value(v.null_gains, friction, v.null_weights);
    v.named = v.p_value <= EnsembleRule{}.named;
    v.probability = v.set_probability = 0.8;
    e.scored.structures = {{1, "x", "velocity", "a sideways force"}};
    e.forces.nulls.assign(100, 0.5);
    return e;
}

/// With a force of no known kind, of this score in units of healthy campaigns.
std::pair<BalanceEvidence, EnsembleDiagnosis> with_force(double score, const std::vector<double>& by_run)
{
    EnsembleDiagnosis e = ensemble_of(2, 1, 1);
    e.forces.variant = 0;
    e.forces.score = score;
    e.forces.p_value = 0.005;
    BalanceEvidence balance;
    StructureFit fit{e.scored.structures.front(), 0, 1, 0.1, by_run};
    for (const double gain : by_run)
        fit.gain += gain;
    balance.structures = {fit};
    return {balance, e};
}

TEST(Evidence, OfOneRunAloneIsNone)
{
    // without its best run a cause must keep more than a part of its gain
    EXPECT_TRUE(not_by_one_run(10, {6, 3, 1}, 0.35));
    EXPECT_FALSE(not_by_one_run(10, {6, 3, 1}, 0.45));
    EXPECT_FALSE(not_by_one_run(10, {10}, 0));
}

TEST(Power, IsTheShareOfTheLabelledCampaignsThatIsNamed)
{
    EnsembleDiagnosis e = ensemble_of(1, 1, 1);
    for (const auto& [cause, z] : {std::pair{0, 0.3}, {-1, 0.0}, {0, 0.6}, {1, 0.9}, {0, -0.9}}) {
        SimulatedCampaign row;
        row.cause = cause;
        row.z = z;
        e.ensemble.campaigns.push_back(row);
    }
    e.by_statistics.labelled_right = {true, true, false, false};
    EXPECT_EQ(e.power(0, 0), 2.0 / 3);
    EXPECT_EQ(e.power(0, 0.5), 0.5) << "of strong ones, to either side";
    EXPECT_EQ(e.power(1, 0), 0);
    EXPECT_FALSE(e.power(2, 0));
}

/// Eight runs with equal errors before; the squares after are 0.1 ... 0.8 of them. The mean of eight draws of the runs
/// is about normal: its deviation is that of these numbers, sqrt((64 - 1) / 12) / 10, over sqrt(8).
TEST(IntervalOfRatio, DrawsRunsAnew)
{
    RunErrors before{std::vector<double>(8, 40), std::vector<double>(8, 10)}, after = before;
    for (std::size_t r = 0; r < 8; ++r)
        after.squares[r] = 4 * static_cast<double>(r + 1);
    EXPECT_DOUBLE_EQ(before.rms(), 2);
    EXPECT_DOUBLE_EQ(after.rms(), 2 * std::sqrt(0.45));
    const auto found = interval_of_ratio(before, after, 3);
    ASSERT_TRUE(found);
    const double deviation = std::sqrt(63.0 / 12) / 10 / std::sqrt(8.0);
    // 2000 draws know a limit to 0.06 deviations (1 sigma)
    EXPECT_NEAR(std::pow(found->first, 2), 0.45 - 1.96 * deviation, 0.2 * deviation);
    EXPECT_NEAR(std::pow(found->second, 2), 0.45 + 1.96 * deviation, 0.2 * deviation);
    // runs with more residuals weigh more: one of all has nearly all of them
    before.counts.assign(8, 1e-3);
    before.squares.assign(8, 4e-3);
    after = before;
    before.counts[2] = 10, before.squares[2] = 40;
    after.counts[2] = 10, after.squares[2] = 10;
    const auto uneven = interval_of_ratio(before, after, 3);
    ASSERT_TRUE(uneven);
    EXPECT_NEAR(uneven->first, 0.5, 1e-3);
    EXPECT_EQ(uneven->second, 1) << "a third of the draws is without it";
    EXPECT_FALSE(interval_of_ratio({{0, 0}, {0, 0}}, {{0, 0}, {0, 0}}, 3)) << "no errors at all";
}

TEST(Decision, NothingBeyondHealthyCampaignsIsNone)
{
    const EnsembleDiagnosis e = ensemble_of(9, 1, 1); // 11 of 100 reach it
    const Decided decided = decide({}, {}, &e, {});
    EXPECT_EQ(decided.verdict, Verdict::none);
    ASSERT_EQ(decided.judged.size(), 3U);
    EXPECT_NEAR(decided.judged.front().chance, 12.0 / 101, 1e-12);
    EXPECT_EQ(decided.judged.front().why_not, "the p-value of the gain is 0.12");
    for (const JudgedCause& j : decided.judged)
        EXPECT_FALSE(j.probability) << "none was computed";
}

TEST(Decision, AnotherCauseIsSaidToBeBetterOnlyWhereOneIsNamed)
{
    const auto why = [](const Decided& decided, std::size_t judged) {
        return candidate_of(decided.judged[judged], Campaign{}, Decision::not_shown, true, decided).why;
    };
    const EnsembleDiagnosis none = ensemble_of(9, 8, 1);
    const Decided without = decide({}, {}, &none, {});
    ASSERT_EQ(without.verdict, Verdict::none);
    EXPECT_EQ(why(without, 1), "the p-value of the gain is 0.22"); // 22 of 101

    DirectResult direct; // a sensor explains other data
    direct.found = {fit_of("sensor_gain", 30)};
    const Decided sensor = decide(direct, {}, &none, {});
    ASSERT_EQ(sensor.verdict, Verdict::named);
    EXPECT_EQ(why(sensor, 1), "the p-value of the gain is 0.22");

    const EnsembleDiagnosis one = ensemble_of(20, 5, 1);
    const Decided named = decide({}, {}, &one, {});
    ASSERT_EQ(named.verdict, Verdict::named);
    EXPECT_EQ(why(named, 1), "another cause explains the same data better");

    EnsembleDiagnosis improbable = ensemble_of(20, 15, 1); // both beyond all nulls, and neither is named
    improbable.by_statistics.probability = improbable.by_statistics.set_probability = 0.3;
    const Decided possible = decide({}, {}, &improbable, {});
    ASSERT_EQ(possible.verdict, Verdict::none);
    EXPECT_EQ(why(possible, 0), "possible, with a probability of 0.30");
    EXPECT_EQ(why(possible, 1), "the candidate of the largest gain is not named, and this one gains less");
}

TEST(Decision, AClearCauseIsNamedWithItsSize)
{
    const EnsembleDiagnosis e = ensemble_of(30, 1, 1);
    const Decided decided = decide({}, {}, &e, {});
    EXPECT_EQ(decided.verdict, Verdict::named);
    ASSERT_EQ(names(decided.named), Names{"joint_friction"});
    EXPECT_DOUBLE_EQ(decided.named.front().fit.size, 0.5);
    EXPECT_NEAR(decided.named.front().fit.sd, (std::pow(0.5, 0.8) - std::pow(0.5, 1.2)) / (2 * 1.6449), 1e-12);
    EXPECT_EQ(decided.named.front().probability, 0.8);
    EXPECT_TRUE(decided.in_set.empty());
    EXPECT_NEAR(decided.named.front().chance95, 9.5, 0.06);
}

/// The best candidate as a tie of block 2 to the base.
EnsembleDiagnosis with_tie_first(double tie, double drag)
{
    EnsembleDiagnosis e = ensemble_of(tie, drag, 1);
    e.causes[0].cause = {"tie", "block 2", "stiffness_n_m", "N/m", 0, -1, 2};
    e.causes[0].ratio = false;
    e.causes[0].at_one = -40;
    e.mechanisms[0] = "tie";
    return e;
}

TEST(Decision, ATieIsNeverNamedButStandsForAForceOfNoKnownKind)
{
    EnsembleDiagnosis e = with_tie_first(30, 1);
    const Decided decided = decide({}, {}, &e, {});
    EXPECT_EQ(decided.verdict, Verdict::unexplained);
    EXPECT_TRUE(decided.named.empty());
    EXPECT_TRUE(decided.by_tie);
    ASSERT_TRUE(decided.unexplained);
    EXPECT_EQ(decided.unexplained->structure.block, 2);
    EXPECT_EQ(decided.unexplained->structure.depends_on, "position");
    EXPECT_NE(decided.unexplained->structure.text.find("drives it away"), std::string::npos);
    EXPECT_NEAR(decided.unexplained_chance, 1.0 / 101, 1e-12);

    e.by_statistics.set = {1}; // drag
    EXPECT_EQ(names(decide({}, {}, &e, {}).in_set), Names{"drag"}) << "what it may be instead";
    e.by_statistics.named = false;
    EXPECT_EQ(decide({}, {}, &e, {}).verdict, Verdict::none);
}

TEST(Decision, ATieBesideACauseIsInItsSet)
{
    EnsembleDiagnosis e = with_tie_first(28, 30);
    e.by_statistics.best = 1;
    e.by_statistics.set = {0};
    const Decided decided = decide({}, {}, &e, {});
    EXPECT_EQ(decided.verdict, Verdict::named);
    EXPECT_EQ(names(decided.named), Names{"drag"});
    EXPECT_EQ(names(decided.in_set), Names{"tie"});
}

TEST(Decision, TheBalanceOfForcesGivesTheSizeWhereItSeesTheCause)
{
    const EnsembleDiagnosis e = ensemble_of(30, 1, 1);
    BalanceEvidence balance;
    balance.causes = {fit_of("joint_friction", 20, 0.43)};
    EXPECT_DOUBLE_EQ(decide({}, balance, &e, {}).named.front().fit.size, 0.43);
    EXPECT_DOUBLE_EQ(decide({}, balance, &e, {}).named.front().fit.gain, 30) << "of the statistics still";
    balance.causes = {fit_of("joint_friction", 20, 0.43, "joint 1")};
    EXPECT_DOUBLE_EQ(decide({}, balance, &e, {}).named.front().fit.size, 0.5) << "another place";
    balance.causes = {fit_of("joint_friction", 2, 0.43)};
    EXPECT_DOUBLE_EQ(decide({}, balance, &e, {}).named.front().fit.size, 0.5) << "hardly seen";
}

TEST(Decision, WhatIsLessProbableThanNotIsPossibleAndNotNamed)
{
    EnsembleDiagnosis e = ensemble_of(30, 1, 1);
    e.by_statistics.probability = 0.4;
    e.by_statistics.set_probability = 0.45;
    const Decided decided = decide({}, {}, &e, {});
    EXPECT_EQ(decided.verdict, Verdict::none);
    EXPECT_EQ(decided.judged.front().why_not, "possible, with a probability of 0.40");
    EXPECT_EQ(decided.judged.front().probability, 0.4);
}

TEST(Decision, ASmallSizeDoesNotMatter)
{
    EnsembleDiagnosis e = ensemble_of(30, 1, 1);
    e.by_statistics.causes[0].size = 0.05; // 0.966 of the friction
    const Decided decided = decide({}, {}, &e, {});
    EXPECT_EQ(decided.verdict, Verdict::none);
    EXPECT_EQ(decided.judged.front().why_not, "its size is within the scatter between specimens");
}

TEST(Decision, MoreFrictionIsNamedWhereForcesShowItAlone)
{
    EnsembleDiagnosis e = ensemble_of(30, 1, 1);
    e.causes[0].at_one = 1.6;
    const Decided unseen = decide({}, {}, &e, {});
    EXPECT_EQ(unseen.verdict, Verdict::none);
    EXPECT_EQ(unseen.judged.front().why_not, "more friction is named only where forces in the joint show it");
    BalanceEvidence balance;
    balance.causes = {fit_of("joint_friction", 20, 1.5)};
    EXPECT_EQ(decide({}, balance, &e, {}).verdict, Verdict::named);
    balance.causes = {fit_of("joint_friction", 20, 0.6)};
    EXPECT_EQ(decide({}, balance, &e, {}).verdict, Verdict::none) << "less friction, by the forces";
    balance.causes = {fit_of("joint_friction", 2, 1.5)};
    EXPECT_EQ(decide({}, balance, &e, {}).verdict, Verdict::none) << "hardly seen";
}

TEST(Decision, WhatExplainsAlikeIsInTheSetWithWhatRemains)
{
    EnsembleDiagnosis e = ensemble_of(30, 29, 28);
    e.by_statistics.set = {1, 2};
    e.by_statistics.probability = 0.4; // one alone is less probable than not, the three are not
    e.by_statistics.set_probability = 0.6;
    const Decided decided = decide({}, {}, &e, {});
    EXPECT_EQ(names(decided.named), Names{"joint_friction"});
    ASSERT_EQ(names(decided.in_set), (Names{"drag", "dowel"}));
    EXPECT_NEAR(decided.in_set[0].probability.value() + decided.in_set[1].probability.value(), 0.2, 1e-12);
    EXPECT_NEAR(decided.in_set[0].probability.value() / decided.in_set[1].probability.value(), std::exp(1), 1e-9);
}

TEST(Decision, ForcesOfNoKnownKindAreUnexplained)
{
    const auto verdict = [](const std::pair<BalanceEvidence, EnsembleDiagnosis>& seen) {
        return decide({}, seen.first, &seen.second, {}).verdict;
    };
    const auto clear = with_force(5, {20, 20, 20});
    const Decided decided = decide({}, clear.first, &clear.second, {});
    EXPECT_EQ(decided.verdict, Verdict::unexplained);
    ASSERT_TRUE(decided.unexplained);
    EXPECT_EQ(decided.unexplained->structure.depends_on, "velocity");
    EXPECT_EQ(decided.unexplained_chance, 0.005);
    EXPECT_TRUE(decided.named.empty());
    // one run alone; not clear of healthy campaigns; a cause has nearly the same score
    EXPECT_EQ(verdict(with_force(5, {60, 0, 0})), Verdict::none);
    // nulls of 0.5 are 0.34 nats; 6 more are a score of 2.17
    EXPECT_EQ(verdict(with_force(2.1, {20, 20, 20})), Verdict::none);
    EXPECT_EQ(verdict(with_force(2.2, {20, 20, 20})), Verdict::unexplained);
    auto rival = with_force(5, {20, 20, 20});
    rival.first.causes = {fit_of("joint_friction", 55)}; // of 60 nats
    EXPECT_EQ(verdict(rival), Verdict::none);
    auto usual = with_force(5, {20, 20, 20});
    usual.second.forces.p_value = 0.05;
    EXPECT_EQ(verdict(usual), Verdict::none);
}

/// Forces that are beyond healthy campaigns, and what explains them.
std::pair<BalanceEvidence, EnsembleDiagnosis> with_forces(EnsembleDiagnosis e, const std::vector<CauseFit>& fits,
                                                          bool candidates = true)
{
    BalanceEvidence balance;
    balance.causes = fits;
    for (const CauseFit& fit : fits) {
        e.scored.causes.push_back(fit.cause);
        if (candidates) {
            e.causes.push_back({fit.cause, 0.5, true});
            e.by_statistics.causes.emplace_back();
        }
    }
    e.listed.unit.assign(fits.size(), 1);
    e.listed.p_value = 0.004;
    return {balance, e};
}

TEST(NamedByForces, SetByHand)
{
    const auto [balance, e] =
        with_forces(ensemble_of(1, 1, 1), {fit_of("drag", 20), fit_of("drag", 19.5, 0.5, "block 1"),
                                           fit_of("corner_loss", 19), fit_of("dowel", 15)});
    const auto named = [&, &b = balance, &d = e](double p) {
        EnsembleDiagnosis with_p = d;
        with_p.listed.p_value = p;
        return named_by_forces(b, with_p);
    };
    const NamedByForces forces = named(0.015);
    ASSERT_EQ(forces.causes.size(), 2U) << "the best of a mechanism, within 3 nats";
    EXPECT_TRUE(named(0.016).causes.empty());
    const auto [weak, of_weak] = with_forces(ensemble_of(1, 1, 1), {fit_of("drag", 7.9)});
    EXPECT_TRUE(named_by_forces(weak, of_weak).causes.empty());
    const auto [nowhere, of_nowhere] = with_forces(ensemble_of(1, 1, 1), {fit_of("drag", 20, 0.3, "block 1")}, false);
    EXPECT_TRUE(named_by_forces(nowhere, of_nowhere).causes.empty()) << "no candidate has this place";
}

TEST(Decision, ForcesNameWhatTheStatisticsDoNot)
{
    const auto [balance, e] = with_forces(ensemble_of(5, 1, 1), {fit_of("drag", 20, 0.3)});
    const Decided decided = decide({}, balance, &e, {});
    ASSERT_EQ(names(decided.named), Names{"drag"});
    EXPECT_EQ(decided.named.front().channel, Channel::forces);
    EXPECT_EQ(decided.named.front().fit.size, 0.3);
    EXPECT_EQ(decided.named.front().chance, 0.004);
    EXPECT_NEAR(decided.named.front().probability.value(), 0.8, 1e-12);
}

TEST(Decision, TheStatisticsChooseBetweenWhatForcesDoNotTellApart)
{
    const auto [balance, e] = with_forces(ensemble_of(5, 1, 4), {fit_of("drag", 20), fit_of("dowel", 18)});
    const Decided decided = decide({}, balance, &e, {}); // 20 + 1 nats against 18 + 4
    ASSERT_EQ(names(decided.named), Names{"dowel"});
    ASSERT_EQ(names(decided.in_set), Names{"drag"});
    EXPECT_NEAR(decided.named.front().probability.value(), 0.8 / (1 + std::exp(-1)), 1e-12);
    EXPECT_NEAR(decided.in_set.front().probability.value(), 0.8 / (1 + std::exp(1)), 1e-12);
}

TEST(Decision, ForcesOfAKnownCauseAreNoTie)
{
    const auto [balance, e] = with_forces(with_tie_first(30, 1), {fit_of("drag", 20)});
    const Decided decided = decide({}, balance, &e, {});
    EXPECT_EQ(decided.verdict, Verdict::named);
    EXPECT_EQ(names(decided.named), Names{"drag"});
    EXPECT_FALSE(decided.by_tie);
}

TEST(Decision, WhereForcesAndStatisticsAgreePlaceAndSizeAreThoseOfTheForces)
{
    const auto [balance, e] = with_forces(ensemble_of(30, 1, 1), {fit_of("joint_friction", 20, 0.7, "joint 2")});
    const Decided decided = decide({}, balance, &e, {});
    ASSERT_EQ(names(decided.named), Names{"joint_friction"});
    EXPECT_EQ(decided.named.front().fit.cause.place, "joint 2");
    EXPECT_EQ(decided.named.front().fit.size, 0.7);
    EXPECT_EQ(decided.named.front().fit.gain, 30) << "of the statistics, as those beside it in the table";
    EXPECT_EQ(decided.named.front().forces_too, 0.004);
    EXPECT_NEAR(decided.named.front().probability.value(), 0.8, 1e-12);
}

TEST(Decision, WhereForcesAndStatisticsDisagreeBothAreInTheSet)
{
    const auto [balance, e] = with_forces(ensemble_of(30, 1, 1), {fit_of("drag", 20)});
    const Decided decided = decide({}, balance, &e, {});
    ASSERT_EQ(names(decided.named), Names{"joint_friction"});
    EXPECT_EQ(decided.named.front().channel, Channel::statistics);
    ASSERT_EQ(names(decided.in_set), Names{"drag"});
    EXPECT_NEAR(decided.in_set.front().probability.value(), 0.2, 1e-12) << "what 0.8 of the named one leaves";
}

TEST(CarryingScore, IsThatOfTheCauseInHealthyAndLabelledCampaigns)
{
    EnsembleDiagnosis e = ensemble_of(1, 1, 1); // candidates: joint_friction, drag, dowel
    e.scored.causes = {e.causes[0].cause, e.causes[1].cause};
    e.scores = {0.5, 4};
    const auto row = [&](std::uint64_t number, int cause, double z, double score) {
        SimulatedCampaign campaign;
        campaign.number = number;
        campaign.cause = cause;
        campaign.z = z;
        campaign.scores = {-7, score};
        e.ensemble.campaigns.push_back(campaign);
    };
    row(0, -1, 0, 9); // a scout
    row(1, -1, 0, 0.3);
    row(2, -1, 0, std::nan(""));
    row(3, 1, 1, 3); // size 0.5
    row(4, 0, 1, 2); // of another cause
    const CarryingNumber number = carrying_score(e, 1, e.causes[1].cause);
    EXPECT_EQ(number.measured, 4);
    EXPECT_EQ(number.nulls, std::vector<double>{0.3});
    EXPECT_EQ(number.hidden, 1U);
    ASSERT_EQ(number.labelled.size(), 1U);
    EXPECT_EQ(number.labelled.front(), (std::pair{0.5, 3.0}));
}

TEST(Decision, DirectFindingsAreNamedFirst)
{
    DirectResult direct;
    direct.found = {fit_of("wedge", 50, 0.002)};
    const EnsembleDiagnosis none = ensemble_of(5, 1, 1), some = ensemble_of(30, 1, 1);
    const Decided alone = decide(direct, {}, &none, {});
    EXPECT_EQ(names(alone.named), Names{"wedge"});
    EXPECT_EQ(alone.named.front().channel, Channel::direct);
    EXPECT_EQ(names(decide(direct, {}, &some, {}).named), (Names{"wedge", "joint_friction"}));
    // an offset drum is in the simulations
    direct.found = {fit_of("drum_offset", 50, 0.002)};
    EXPECT_EQ(names(decide(direct, {}, &some, {}).named), (Names{"drum_offset", "joint_friction"}));
    // what the simulations cannot contain: joints and blocks are not judged
    direct.found = {fit_of("vertical_motion", 50, 0.002)};
    EXPECT_EQ(names(decide(direct, {}, &some, {}).named), Names{"vertical_motion"});
    // without simulated campaigns
    EXPECT_EQ(names(decide(direct, {}, nullptr, {}).named), Names{"vertical_motion"});
    EXPECT_EQ(decide({}, {}, nullptr, {}).verdict, Verdict::none);
}

TEST(Decision, DirectFindingsAreAsProbableAsTheyAreFar)
{
    DirectResult direct;
    for (int block = 0; block < 6; ++block) {
        DataTest test;
        test.name = "drum_offset";
        direct.sensor_tests.push_back(test);
    }
    const auto at = [&](double sds) {
        direct.found = {fit_of("drum_offset", 0.5 * sds * sds, 0.002, "block 2")};
        return decide(direct, {}, nullptr, {}).named.front();
    };
    // 3.83 standard deviations have a two-sided probability of 1.2814e-4, at one of six blocks of 7.6886e-4
    EXPECT_NEAR(at(3.83).chance, 7.6886e-4, 1e-8);
    EXPECT_NEAR(at(3.83).probability.value(), 0.6971, 1e-4); // odds 1/29 over e p ln(1/p)
    EXPECT_EQ(at(8).probability, 0.97);
    direct.sensor_tests.clear();
    EXPECT_NEAR(at(3.83).chance, 1.2814e-4, 1e-8);
}

TEST(Balance, TheBestOfEachMechanismAndPlaceThatIsPossible)
{
    const std::vector<CauseFit> best =
        best_of_each({fit_of("joint_friction", 5, 0.5), fit_of("joint_friction", 7, 0.6), fit_of("drag", 9, -1),
                      fit_of("joint_friction", 6, 0.5, "joint 1"), fit_of("stribeck", 8, 1.2)});
    ASSERT_EQ(best.size(), 2U) << "negative drag, and a dynamic friction above the static one, cannot be";
    EXPECT_EQ(best[0].size, 0.6);
    EXPECT_EQ(best[1].cause.place, "joint 1");
}

} // namespace
} // namespace stylobate

/// The choice of the next test, in a laboratory of Gaussian estimators.

#include "studies/measured/loop/choice.hpp"
#include "tests/studies/measured/loop/gaussian_laboratory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

using gaussian::test_of;

std::vector<TestOption> all_kinds()
{
    std::vector<TestOption> out;
    for (const RunKind test : {RunKind::pull, RunKind::slide, RunKind::push, RunKind::tilt, RunKind::drop})
        out.push_back({test, std::nullopt, 1, std::nullopt});
    return out;
}

std::optional<RatedTest> chosen_of(const SequenceModel& model, const std::vector<SeenEstimate>& seen,
                                   const std::vector<TestOption>& options, const ChoiceSettings& settings = {})
{
    return chosen_test(model, seen, rated_tests(model, seen, options, settings));
}

TEST(TestChoice, ExpectedBeliefIsThatOfItsIntegral)
{
    // one estimate, one cause: entropy and mean of Bayes' theorem, integrated over the predicted density
    const Signatures s =
        gaussian::signatures({{RunKind::push, 0, "plateau"}}, Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1),
                             0.2, {gaussian::cause("corner_loss", "joint 0", 1, 1, {{0, 3}})});
    const SequenceModel model(s, {});
    double entropy = 0, in_truth = 0;
    const double step = 0.001;
    for (double u = -9; u <= 9; u += step) {
        const double x = std::sinh(u), dx = std::cosh(u) * step;
        const double nothing = 0.5 * gaussian::student_density(x, 0, 1.04),
                     cause = 0.425 * gaussian::student_density(x, 3, 1.04 + 9 / 12.0),
                     unlisted = 0.075 * gaussian::student_density(x, 0, 1.04 * 37), all = nothing + cause + unlisted;
        for (const double part : {nothing, cause, unlisted})
            entropy -= part * std::log(part / all) * dx;
        in_truth += (cause * cause + unlisted * unlisted) / all * dx;
    }
    const ExpectedBelief found = expected_belief(model, {}, {0}, {20'000, 3});
    EXPECT_NEAR(found.entropy, entropy, 0.012);
    EXPECT_NEAR(found.in_truth, in_truth, 0.006);
    EXPECT_EQ(expected_belief(model, {}, {0}, {200, 3}).entropy, expected_belief(model, {}, {0}, {200, 3}).entropy);
    // before any test
    EXPECT_NEAR(belief_of(model, {}).entropy(),
                -0.5 * std::log(0.5) - 0.425 * std::log(0.425) - 0.075 * std::log(0.075), 1e-12);
    EXPECT_NEAR(expected_belief(model, {}, {}, {2000, 3}).in_truth, 0.425 * 0.425 + 0.075 * 0.075, 0.002);
}

TEST(TestChoice, PrefersTheGroupThatTheFirstDiagnosisSuspects)
{
    SequencePrior prior;
    prior.shares = {{"friction", {}, 0.9}};
    for (const auto& [group, first, second] : std::vector<std::tuple<std::string, RunKind, RunKind>>{
             {"friction", RunKind::pull, RunKind::slide},
             {"corners, centres and bonds", RunKind::push, RunKind::tilt}}) {
        prior.shares = {{group, {}, 0.9}};
        const SequenceModel model(gaussian::laboratory(), prior);
        const std::optional<RatedTest> chosen = chosen_of(model, {}, all_kinds());
        ASSERT_TRUE(chosen);
        EXPECT_TRUE(chosen->option.test == first || chosen->option.test == second) << group;
    }
}

TEST(TestChoice, AsksWhatTheSpecimenMayTurnOutToBe)
{
    const Signatures narrow = gaussian::laboratory(); // once the law is known
    Signatures wide = narrow;
    wide.covariance *= 25;
    wide.floor_variance *= 25;
    const SequenceModel model(wide, {}), known(narrow, {});
    const auto after_push = [&](const TestOption& option) {
        return option.test == RunKind::push ? std::vector{known} : std::vector<SequenceModel>();
    };
    const auto gain = [&](const std::vector<RatedTest>& all, RunKind test) {
        return std::ranges::find(all, test, [](const RatedTest& t) { return t.option.test; })->belief_gain;
    };
    const std::vector<RatedTest> blind = rated_tests(model, {}, all_kinds()),
                                 seeing = rated_tests(model, {}, all_kinds(), {}, after_push);
    EXPECT_GT(gain(seeing, RunKind::push), gain(blind, RunKind::push) + 0.02);
    EXPECT_EQ(gain(seeing, RunKind::pull), gain(blind, RunKind::pull));
}

TEST(TestChoice, PrefersTheCheapOneOfEqualTests)
{
    SequencePrior prior;
    prior.shares = {{"joint_friction", {}, 0.9}};
    const SequenceModel model(gaussian::laboratory(), prior);
    std::vector<TestOption> options = all_kinds();
    options[0].cost = 3;
    EXPECT_EQ(chosen_of(model, {}, options)->option.test, RunKind::slide);
    options[0].cost = 1;
    options[1].cost = 3;
    EXPECT_EQ(chosen_of(model, {}, options)->option.test, RunKind::pull);
}

TEST(TestChoice, LeavesOutWhatCannotBeDoneOrTellsNothing)
{
    Signatures s = gaussian::laboratory();
    for (Eigen::Index j = 9; j < 12; ++j)
        s.used[static_cast<std::size_t>(j)] = false; // in `tilt` everything falls
    const SequenceModel model(s, {});
    std::vector<TestOption> options = all_kinds();
    options[0].cannot = "there is no force gauge";
    const std::vector<RatedTest> rated = rated_tests(model, {}, options);
    ASSERT_EQ(rated.size(), 5U);
    int choices = 0;
    for (const RatedTest& test : rated) {
        choices += !test.left_out;
        if (test.option.test == RunKind::pull) {
            EXPECT_EQ(test.left_out, "there is no force gauge");
        }
        if (test.option.test == RunKind::tilt) {
            EXPECT_EQ(test.left_out, "it gives no estimate in more than a quarter of the simulated specimens");
        }
        if (test.option.test == RunKind::drop) {
            EXPECT_EQ(test.left_out, "no cause of the list shows in it");
        }
    }
    EXPECT_EQ(choices, 2);
    EXPECT_FALSE(rated[0].left_out);
    EXPECT_FALSE(rated[1].left_out);
    EXPECT_GE(rated[0].per_cost, rated[1].per_cost);
    options.erase(options.begin() + 1, options.begin() + 3);
    EXPECT_FALSE(chosen_of(model, {}, options));
}

TEST(TestChoice, StaysInTheGroupOfADoubtfulSign)
{
    const SequenceModel model(gaussian::laboratory(), {});
    Eigen::VectorXd values = Eigen::VectorXd::Constant(15, 10);
    values(7) += 2.9;
    const std::vector<SeenEstimate> seen = test_of(model.signatures, values, RunKind::push);
    ASSERT_TRUE(judgement_of(model, seen).doubtful);
    std::vector<TestOption> options = all_kinds();
    options[0].cost = options[1].cost = 0.01; // cheap, and of the other group
    const std::optional<RatedTest> chosen = chosen_of(model, seen, options);
    ASSERT_TRUE(chosen);
    EXPECT_TRUE(chosen->option.test == RunKind::push || chosen->option.test == RunKind::tilt);
}

TEST(TestChoice, OneJointIsWorthLessThanAll)
{
    const SequenceModel model(gaussian::laboratory(), {});
    const double before = belief_of(model, {}).entropy();
    const double one =
        before - expected_belief(model, {}, columns_of(model.signatures, {RunKind::push, 1, 1, {}}), {}).entropy;
    const double all =
        before - expected_belief(model, {}, columns_of(model.signatures, {RunKind::push, {}, 1, {}}), {}).entropy;
    EXPECT_LT(one, 0.3 * all) << "without another joint the law is not known";
    EXPECT_GT(all, 0.2);
}

TEST(TestChoice, APlanTakesTestsOfDifferentGroups)
{
    const SequenceModel model(gaussian::laboratory(), {});
    const std::vector<RatedTest> plan = planned_tests(model, all_kinds(), 3, {128, 1});
    ASSERT_GE(plan.size(), 2U);
    const auto friction = [](RunKind test) { return test == RunKind::pull || test == RunKind::slide; };
    EXPECT_NE(friction(plan[0].option.test), friction(plan[1].option.test));
    for (std::size_t i = 1; i < plan.size(); ++i)
        EXPECT_LE(plan[i].per_cost, plan[i - 1].per_cost + 0.02);
}

TEST(TestChoiceStatistics, GreedyChoiceNamesTheCause)
{
    // specimens with friction off at joint 1; the first diagnosis suspects friction, and a test of one joint costs 1
    SequencePrior prior;
    prior.shares = {{"friction", {}, 0.6}};
    const SequenceModel model(gaussian::laboratory(), prior);
    gaussian::Specimens specimens(gaussian::covariance(), 51);
    int named = 0, tests = 0;
    const int count = 10;
    for (int i = 0; i < count; ++i) {
        Eigen::VectorXd values = specimens.draw() + Eigen::VectorXd::Constant(15, 10);
        for (const auto& [column, shift] : gaussian::shifts(0, 1, 1))
            values(column) += shift;
        std::vector<SeenEstimate> seen;
        for (int k = 0; k < 3; ++k) {
            const std::optional<RatedTest> next = chosen_of(model, seen, all_kinds(), {64, 1});
            if (!next)
                break;
            gaussian::append(seen, test_of(model.signatures, values, next->option.test));
            ++tests;
            if (judgement_of(model, seen).verdict == SequenceVerdict::named)
                break;
        }
        const SequenceJudgement judgement = judgement_of(model, seen);
        named += judgement.verdict == SequenceVerdict::named && judgement.cause->label() == "joint_friction at joint 1";
    }
    EXPECT_GE(named, 9) << "of " << count;
    EXPECT_LE(tests, 2 * count);
}

} // namespace
} // namespace stylobate

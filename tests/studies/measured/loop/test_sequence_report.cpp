/// A sequence in words and as data.

#include "studies/measured/loop/sequence_report.hpp"
#include "tests/studies/measured/loop/gaussian_laboratory.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace stylobate {
namespace {

/// The three estimates of a kind, of the Gaussian laboratory.
DoneTest done(RunKind test, const std::string& name, double a, double b, double c)
{
    return {test, std::nullopt, {{name, 0, a}, {name, 1, b}, {name, 2, c}}};
}

SequenceModel suspecting_corners()
{
    SequencePrior prior;
    prior.shares = {{"corner_loss", {}, 0.8}};
    return {gaussian::laboratory(), prior};
}

std::string text_of(const SequenceReport& report)
{
    Document document;
    add_sequence(document, report);
    return console_text(document);
}

TEST(SequenceReport, HasEachStepWithWhatWasBelievedBeforeAndAfter)
{
    const SequenceModel model = suspecting_corners();
    const std::vector<DoneTest> tests = {done(RunKind::push, "plateau", 10, 13, 10),
                                         done(RunKind::push, "plateau", 10, 13, 10),
                                         done(RunKind::tilt, "bearing width", 10, 16, 10)};
    const SequenceReport report = sequence_report(model, tests, {});
    ASSERT_EQ(report.steps.size(), 3U);
    EXPECT_EQ(report.prior[0].what, "nothing");
    EXPECT_EQ(report.prior[0].share, 0.5);
    for (std::size_t i = 0; i < 3; ++i) {
        const SequenceStep& step = report.steps[i];
        EXPECT_EQ(step.repeat, i == 1);
        EXPECT_EQ(step.before[0].what, i == 0 ? "nothing" : report.steps[i - 1].after[0].what);
        double sum = 0;
        for (const BelievedShare& share : step.after)
            sum += share.share;
        EXPECT_NEAR(sum, 1, 1e-12);
        EXPECT_EQ(step.seen[0].column.joint, 1) << "the farthest first";
        EXPECT_GE(std::fabs(step.seen[0].seen.deviations), std::fabs(step.seen[1].seen.deviations));
    }
    EXPECT_EQ(report.finding.verdict, SequenceVerdict::named);
    EXPECT_EQ(report.finding.cause, "corner_loss at joint 1");
    EXPECT_EQ(report.steps.back().finding.log_evidence, report.finding.log_evidence);
    EXPECT_EQ(report.untested, std::vector<std::string>{"joint_friction"});
    const std::string text = text_of(report);
    for (const char* words :
         {"corner_loss at joint 1 acts, with a size of", "2. push at all joints, repeated", "plateau at joint 1",
          "the other joints", "Not tested: joint_friction.", "(40 is needed)"})
        EXPECT_NE(text.find(words), std::string::npos) << words << " is not in\n" << text;
}

TEST(SequenceReport, StatesWhatIsUnexplained)
{
    Signatures s = gaussian::laboratory();
    for (TestColumn& column : s.columns)
        column.depends_on = column.test == RunKind::drop ? "time" : "";
    const SequenceModel model(s, {});
    const SequenceReport report = sequence_report(model, {done(RunKind::drop, "time", 10, 30, 10)}, {});
    EXPECT_EQ(finding_words(report.finding).substr(0, 80),
              "Unexplained: time (drop at joint 1) is beyond what healthy specimens show, and n");
    EXPECT_NE(finding_words(report.finding).find("What acts depends on time."), std::string::npos);
}

TEST(SequenceReport, StatesLimitsAndReasons)
{
    const SequenceModel model = suspecting_corners();
    std::vector<RatedTest> next = {{{RunKind::pull, 1, 2, {}}, 0.2, 0.1, {}},
                                   {{RunKind::slide, {}, 1, {}}, 0, 0, "there is no shaking table"}};
    const SequenceReport report = sequence_report(model, {done(RunKind::push, "plateau", 10, 10, 10)}, next);
    EXPECT_EQ(report.finding.verdict, SequenceVerdict::none);
    const std::string text = text_of(report);
    for (const char* words : {"Nothing was found (E = ", "size at most (95 %)", "corner_loss at joint 2",
                              "pull at joint 1", "slide at all joints: there is no shaking table"})
        EXPECT_NE(text.find(words), std::string::npos) << words << " is not in\n" << text;
    const SequenceReport before = sequence_report(model, {}, {});
    EXPECT_NE(text_of(before).find("Nothing is decided yet."), std::string::npos);
    EXPECT_EQ(text_of(before).find("Limits"), std::string::npos);
}

TEST(SequenceReport, IsJson)
{
    const SequenceModel model = suspecting_corners();
    const SequenceReport report = sequence_report(model, {done(RunKind::push, "plateau", 10, 22, 10)},
                                                  {{{RunKind::slide, {}, 1, {}}, 0, 0, "there is no shaking table"}});
    const std::string text = json_of(report).text();
    const nlohmann::json json = nlohmann::json::parse(text);
    EXPECT_EQ(json["verdict"], "named");
    EXPECT_EQ(json["cause"], "corner_loss at joint 1");
    EXPECT_EQ(json["steps"].size(), 1U);
    EXPECT_EQ(json["steps"][0]["joint"], "all");
    EXPECT_EQ(json["steps"][0]["seen"][0]["joint"], 1);
    EXPECT_EQ(json["steps"][0]["seen"][0]["value"], 22);
    EXPECT_TRUE(json["limits"][1]["at_most"].is_null()) << "joint 1: the strongest size is possible";
    EXPECT_TRUE(json["limits"][0]["at_most"].is_number());
    EXPECT_EQ(json["next"][0]["left_out"], "there is no shaking table");
}

TEST(SequenceReport, APlanGivesReasonsToo)
{
    const RatedTest push{{RunKind::push, {}, 2, {}}, 0.5, 0.25, {}},
        drop{{RunKind::drop, {}, 1, {}}, 0, 0, "no thread"};
    Document document;
    add_test_plan(document, {push}, {push, drop});
    const std::string text = console_text(document);
    EXPECT_NE(text.find("push at all joints"), std::string::npos);
    EXPECT_NE(text.find("drop at all joints: no thread"), std::string::npos);
    Document nothing;
    add_test_plan(nothing, {}, {drop});
    EXPECT_NE(console_text(nothing).find("No test that the laboratory can do"), std::string::npos);
}

} // namespace
} // namespace stylobate

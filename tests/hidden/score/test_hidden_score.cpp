/// The score of diagnoses, on answers and diagnoses that are written here by hand.

#include "ensemble/model/input_error.hpp"
#include "tests/hidden/score/coverage.hpp"
#include "tests/hidden/score/score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace stylobate;
using namespace stylobate::hidden;

namespace {

AnswerEffect effect(const std::string& name, bool detectable = true, bool listed = true)
{
    return {name, listed, "joint 0", "ratio", 0.6, true, 40, detectable ? 4.0 : 0.5, 0.25, detectable};
}

Answer hiding(const std::vector<AnswerEffect>& effects)
{
    Answer answer;
    answer.seed = 7;
    answer.law = "nonsmooth";
    answer.specimen = "column of two drums";
    answer.effects = effects;
    return answer;
}

DiagnosisSummary saying(const std::vector<std::string>& names, const std::vector<std::string>& set = {})
{
    DiagnosisSummary said;
    said.verdict = "named";
    double probability = 0.8;
    for (const std::string& name : names) {
        said.causes.push_back({name, "joint 0", "ratio", probability, 0.6, 0.5, 0.7});
        probability /= 2;
    }
    said.indistinguishable = set;
    return said;
}

DiagnosisSummary verdict(const std::string& word)
{
    DiagnosisSummary said;
    said.verdict = word;
    return said;
}

TEST(Judging, NothingHidden)
{
    const Answer none = hiding({});
    EXPECT_EQ(judge(none, verdict("none")), Judgement::quiet);
    EXPECT_EQ(judge(none, verdict("unexplained")), Judgement::false_alarm);
    EXPECT_EQ(judge(none, saying({"drag"})), Judgement::false_alarm);
}

TEST(Judging, OneEffect)
{
    const Answer drag = hiding({effect("drag")});
    EXPECT_EQ(judge(drag, saying({"drag", "wedge"})), Judgement::hit);
    EXPECT_EQ(judge(drag, saying({"wedge", "drag"})), Judgement::wrong_name) << "a second cause is no set";
    EXPECT_EQ(judge(drag, saying({"wedge"}, {"wedge", "drag", "dowel"})), Judgement::in_set);
    EXPECT_EQ(judge(drag, saying({"wedge"}, {"wedge", "drag", "dowel", "adhesion"})), Judgement::wrong_name);
    EXPECT_EQ(judge(drag, verdict("none")), Judgement::abstained);
    EXPECT_EQ(judge(drag, verdict("unexplained")), Judgement::abstained);
}

TEST(Judging, TwoEffects)
{
    const Answer both = hiding({effect("drag"), effect("joint_friction")});
    EXPECT_EQ(judge(both, saying({"joint_friction", "drag"})), Judgement::hit);
    EXPECT_EQ(judge(both, saying({"joint_friction"})), Judgement::one_of_two);
    EXPECT_EQ(judge(both, saying({"wedge", "drag"})), Judgement::wrong_name);
    EXPECT_EQ(judge(both, saying({"wedge"}, {"wedge", "drag"})), Judgement::in_set);
    const Answer weaker = hiding({effect("drag", false), effect("joint_friction")});
    EXPECT_EQ(group_of(weaker), Group::single);
    EXPECT_EQ(judge(weaker, saying({"joint_friction"})), Judgement::hit);
    EXPECT_EQ(judge(weaker, saying({"drag"})), Judgement::one_of_two);
}

TEST(Judging, OutsideTheListAndBelowTheThresholds)
{
    const Answer outside = hiding({effect("magnet", true, false)});
    EXPECT_EQ(judge(outside, verdict("unexplained")), Judgement::hit);
    EXPECT_EQ(judge(outside, saying({"drag"})), Judgement::wrong_name);
    EXPECT_EQ(judge(outside, verdict("none")), Judgement::abstained);
    const Answer weak = hiding({effect("drag", false)});
    EXPECT_EQ(group_of(weak), Group::undetectable);
    EXPECT_EQ(judge(weak, verdict("none")), Judgement::quiet);
    EXPECT_EQ(judge(weak, saying({"drag"})), Judgement::hit);
    EXPECT_EQ(judge(weak, saying({"wedge"})), Judgement::wrong_name);
}

TEST(Scoring, CountsByHand)
{
    std::vector<Answer> answers;
    std::vector<std::optional<DiagnosisSummary>> said;
    const auto add = [&](const Answer& answer, const std::optional<DiagnosisSummary>& diagnosis) {
        answers.push_back(answer);
        said.push_back(diagnosis);
    };
    add(hiding({}), verdict("none"));
    add(hiding({}), verdict("unexplained"));
    add(hiding({}), saying({"drag"}));                                   // 0.8, wrong
    add(hiding({effect("drag")}), saying({"drag"}));                     // 0.8, right; size covered
    add(hiding({effect("drag")}), saying({"wedge"}, {"wedge", "drag"})); // 0.8, wrong; half
    DiagnosisSummary off = saying({"drag", "wedge"});                    // 0.8 right, 0.4 wrong
    off.causes[0].low = 0.61;
    add(hiding({effect("drag")}), off);
    DiagnosisSummary elsewhere = saying({"drag"});
    elsewhere.causes[0].place = "joint 1";
    add(hiding({effect("drag")}), elsewhere);
    DiagnosisSummary other = saying({"drag"});
    other.causes[0].parameter = "factor";
    add(hiding({effect("drag")}), other);
    add(hiding({effect("magnet", true, false)}), verdict("unexplained"));
    add(hiding({effect("dowel", false)}), verdict("none"));
    add(hiding({effect("dowel")}), std::nullopt);

    const Score total = score(answers, said);
    EXPECT_EQ(total.campaigns, 10);
    EXPECT_EQ(total.missing, std::vector<std::uint64_t>{7});
    EXPECT_EQ(total.false_alarms.of, 3);
    EXPECT_EQ(total.false_alarms.count, 2);
    EXPECT_EQ(total.named_alarms.count, 1);
    EXPECT_EQ(total.to_find, 6);
    EXPECT_DOUBLE_EQ(total.points, 5.5);
    EXPECT_EQ(total.places.of, 4);
    EXPECT_EQ(total.places.count, 3);
    EXPECT_EQ(total.coverage.of, 2);
    EXPECT_EQ(total.coverage.count, 1);
    EXPECT_EQ(total.other_parameter, 1);
    // seven causes: four right at 0.8, two wrong at 0.8, one wrong at 0.4
    EXPECT_EQ(total.stated.of, 7);
    EXPECT_EQ(total.stated.count, 4);
    EXPECT_NEAR(total.brier, (4 * 0.04 + 2 * 0.64 + 0.16) / 7, 1e-12);
    EXPECT_EQ(total.reliability[4].causes, 6);
    EXPECT_EQ(total.reliability[4].right, 4);
    EXPECT_NEAR(total.reliability[4].mean_probability, 0.8, 1e-12);
    EXPECT_EQ(total.reliability[2].causes, 1);
    EXPECT_EQ(total.confusion.at("drag").at("drag"), 4);
    EXPECT_EQ(total.confusion.at("drag").at("wedge"), 1);
    EXPECT_EQ(total.confusion.at("dowel (undetectable)").at("none"), 1);
    EXPECT_EQ(total.confusion.at("outside: magnet").at("unexplained"), 1);

    const std::string text = markdown(total);
    EXPECT_NE(text.find("| one effect | 4 | 1 | 0 | 0 | 0 | 0 | 0 | 5 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| false alarms | 2 of 3, 67 %"), std::string::npos) << text;
    EXPECT_NE(text.find("also beside the first one | 4 of 7, 57 %"), std::string::npos) << text;
    EXPECT_NE(text.find("seeds 7."), std::string::npos) << text;
}

TEST(Summaries, AreReadAsTheyArePrinted)
{
    const DiagnosisSummary said = parse_diagnosis(
        R"({"verdict": "named", "causes": [{"name": "joint_friction", "place": "joint 0", "probability": 0.83,
            "parameter": "ratio", "size": 0.57, "low": 0.49, "high": null}],
            "indistinguishable": ["joint_friction", "stribeck"], "unexplained": null, "seconds": 212})",
        "3.json");
    EXPECT_EQ(said.verdict, "named");
    ASSERT_EQ(said.causes.size(), 1u);
    EXPECT_EQ(said.causes[0].place, "joint 0");
    EXPECT_DOUBLE_EQ(said.causes[0].probability, 0.83);
    EXPECT_TRUE(std::isnan(said.causes[0].high));
    EXPECT_EQ(said.indistinguishable.size(), 2u);
    EXPECT_DOUBLE_EQ(said.seconds, 212);
}

TEST(Summaries, ThatAreNoneAreRefused)
{
    for (const char* text : {"", "{", "{}", R"({"verdict": "maybe"})", R"({"verdict": "named", "causes": []})",
                             R"({"verdict": "named", "causes": [{"name": "drag", "probability": 1.5}]})",
                             R"({"verdict": "named", "causes": [{"probability": 0.5}]})"})
        EXPECT_THROW(parse_diagnosis(text, "3.json"), InputError) << text;
}

TEST(Answers, AreReadAsTheyAreWritten)
{
    Answer answer = hiding({effect("drag"), effect("wedge", false)});
    answer.effects[1].size = -1.25e-3;
    answer.runs = 8;
    answer.collapses = 1;
    const auto file = std::filesystem::temp_directory_path() / "stylobate-hidden-answer.toml";
    std::ofstream(file) << text_of(answer);
    const Answer read = read_answer(file);
    std::filesystem::remove(file);
    EXPECT_EQ(text_of(read), text_of(answer));
    EXPECT_EQ(read.effects[1].size, -1.25e-3);
    EXPECT_EQ(read.effects[1].law_share, 0.25);
    EXPECT_FALSE(read.effects[1].detectable);
    EXPECT_EQ(read.verdict(), "named");
    EXPECT_EQ(hiding({}).verdict(), "none");
    EXPECT_EQ(hiding({effect("magnet", true, false)}).verdict(), "unexplained");
    EXPECT_THROW(read_answer(file), InputError);
}

/// What `stylobate calibrate --json` prints, as far as it counts.
std::string calibration(bool determined, double low, double high)
{
    return "{\"best_form\": \"area\", \"forms\": [{\"form\": \"points\", \"parameters\": []}, {\"form\": \"area\", "
           "\"parameters\": [{\"key\": \"contact.normal_stiffness_n_m2\", \"value\": 1, \"low\": 1, \"high\": 1, "
           "\"determined\": false}, {\"key\": \"contact.friction\", \"value\": 0.5, \"low\": " +
           std::to_string(low) + ", \"high\": " + std::to_string(high) +
           ", \"determined\": " + (determined ? "true" : "false") + "}]}]}";
}

TEST(Coverage, CountsIntervalsThatHoldTheTruthOfThoseThatThereAre)
{
    std::vector<Answer> answers(5);
    std::vector<std::optional<SaidFriction>> said;
    const double truth[] = {0.5, 0.5, 0.6, 0.5, 0.5};
    for (std::size_t k = 0; k < answers.size(); ++k) {
        answers[k].friction = truth[k];
        answers[k].law = k < 3 ? "nonsmooth" : "compliant";
        answers[k].specimen = k == 0 ? "column of 4 small blocks" : "column of 5 small blocks";
        said.emplace_back(parse_calibration(calibration(k != 1, 0.45, 0.55), "0.json"));
    }
    said[4].reset(); // was not calibrated
    const std::vector<CoverageRow> rows = coverage(answers, said);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].of, "all");
    EXPECT_EQ(rows[0].campaigns, 4);
    EXPECT_EQ(rows[0].held.of, 3) << "one is not determined";
    EXPECT_EQ(rows[0].held.count, 2) << "one misses 0.6";
    EXPECT_EQ(rows[1].of, "law nonsmooth");
    EXPECT_EQ(rows[1].held.of, 2);
    EXPECT_EQ(rows[1].held.count, 1);
    EXPECT_EQ(rows[2].of, "law compliant");
    EXPECT_EQ(rows[2].held.of, 1);
    EXPECT_EQ(rows[3].of, "column of n small blocks") << "of any number of blocks";
    EXPECT_EQ(rows[3].campaigns, 4);
    EXPECT_NEAR(rows[1].relative_half[0], 0.1, 1e-9);
    EXPECT_NEAR(rows[1].error[1], std::log(0.5 / 0.6), 1e-9);
    EXPECT_NE(markdown(rows).find("| all | 4 | 3 (75 %) | 2, 66.7 %"), std::string::npos) << markdown(rows);
    for (const char* text : {"", "{}", R"({"best_form": "area", "forms": []})"})
        EXPECT_THROW(parse_calibration(text, "0.json"), InputError) << text;
}

} // namespace

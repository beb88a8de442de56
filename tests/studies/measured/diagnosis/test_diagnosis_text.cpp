/// A diagnosis as JSON and as a page of text.

#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "tests/program/json.hpp"
#include "tests/studies/measured/diagnosis/diagnosis_sample.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace stylobate {
namespace {

std::vector<std::string> keys_of(const JsonValue& object)
{
    std::vector<std::string> keys;
    for (const auto& member : object.members)
        keys.push_back(member.name);
    return keys;
}

/// The first keys of an object are these, in this order.
void expect_first_keys(const JsonValue& object, const std::vector<std::string>& want)
{
    std::vector<std::string> keys = keys_of(object);
    keys.resize(std::min(keys.size(), want.size()));
    EXPECT_EQ(keys, want);
}

const std::vector<std::string> contract = {"verdict", "causes",    "indistinguishable", "unexplained", "wrong",
                                           "gain",    "next_test", "extended_study",    "simulations", "seconds"};

TEST(DiagnosisJson, HasTheKeysOfTheContractInTheirOrder)
{
    const JsonValue json = JsonParser::parse(diagnosis_json(filled_diagnosis()).text());
    expect_first_keys(json, contract);
    EXPECT_EQ(json["verdict"].text, "named");
    ASSERT_EQ(json["causes"].items.size(), 1U);
    const JsonValue& cause = json["causes"].items[0];
    EXPECT_EQ(keys_of(cause),
              (std::vector<std::string>{"name", "place", "probability", "parameter", "size", "low", "high"}));
    EXPECT_EQ(cause["name"].text, "joint_friction");
    EXPECT_EQ(cause["place"].text, "joint 0");
    EXPECT_EQ(cause["size"].number, 0.57);
    ASSERT_EQ(json["indistinguishable"].items.size(), 2U);
    EXPECT_EQ(json["indistinguishable"].items[1].text, "stribeck");
    expect_first_keys(json["unexplained"], {"block", "coordinate", "depends_on", "text"});
    EXPECT_EQ(json["unexplained"]["block"].number, 3);
    ASSERT_EQ(json["wrong"].items.size(), 2U);
    EXPECT_EQ(keys_of(json["wrong"].items[0]),
              (std::vector<std::string>{"run", "block", "coordinate", "from_s", "to_s", "excess"}));
    expect_first_keys(json["gain"], {"error_before", "error_after", "low", "high", "runs_left_out"});
    EXPECT_EQ(json["gain"]["runs_left_out"].items[1].text, "005");
    EXPECT_EQ(keys_of(json["next_test"]), (std::vector<std::string>{"excitation", "separates"}));
    EXPECT_EQ(json["next_test"]["excitation"].text, "push");
    EXPECT_EQ(json["next_test"]["separates"].items.size(), 2U);
    EXPECT_EQ(json["extended_study"].text, "diagnosis_extended.toml");
    EXPECT_EQ(json["simulations"].number, 61234);
    EXPECT_EQ(json["seconds"].number, 212.5);
    EXPECT_EQ(json["specimen"].text, "Seven drums <script>alert(1)</script>, 1:10, é");
    EXPECT_EQ(json["candidates"].items.size(), 4U);
    EXPECT_EQ(json["candidates"].items[3]["size"].kind, JsonValue::Kind::null);
}

TEST(DiagnosisJson, OfAnEmptyOneHasThemTooAndNoNumberThatIsNotKnown)
{
    const JsonValue json = JsonParser::parse(diagnosis_json(Diagnosis{}).text());
    expect_first_keys(json, contract);
    EXPECT_EQ(json["verdict"].text, "none");
    for (const char* list : {"causes", "indistinguishable", "wrong"}) {
        EXPECT_EQ(json[list].kind, JsonValue::Kind::list) << list;
        EXPECT_TRUE(json[list].items.empty()) << list;
    }
    for (const char* part : {"unexplained", "gain", "next_test", "extended_study"})
        EXPECT_EQ(json[part].kind, JsonValue::Kind::null) << part;
}

TEST(DiagnosisJson, NeverHasNanOrInfinity)
{
    Diagnosis d = filled_diagnosis();
    d.candidates[0].high = std::numeric_limits<double>::infinity();
    d.candidates[0].size = std::numeric_limits<double>::quiet_NaN();
    d.wrong[0].excess = std::numeric_limits<double>::infinity();
    d.cost.seconds = std::numeric_limits<double>::quiet_NaN();
    const JsonValue json = JsonParser::parse(diagnosis_json(d).text()); // throws at nan and inf
    EXPECT_EQ(json["causes"].items[0]["high"].kind, JsonValue::Kind::null);
    EXPECT_EQ(json["seconds"].kind, JsonValue::Kind::null);
}

TEST(DiagnosisJson, CausesAreThoseThatTheVerdictNamesMostProbableFirst)
{
    Diagnosis d = filled_diagnosis();
    d.candidates[1].decision = Decision::named;
    d.candidates[1].probability = 0.9;
    JsonValue json = JsonParser::parse(diagnosis_json(d).text());
    ASSERT_EQ(json["causes"].items.size(), 2U);
    EXPECT_EQ(json["causes"].items[0]["name"].text, "stribeck");
    d.verdict = Verdict::none;
    json = JsonParser::parse(diagnosis_json(d).text());
    EXPECT_TRUE(json["causes"].items.empty());
}

TEST(DiagnosisText, SaysTheVerdictFirstAndKeepsItsLinesShort)
{
    const std::string text = diagnosis_text(filled_diagnosis());
    const auto at = [&](const std::string& words) {
        const std::size_t place = text.find(words);
        EXPECT_NE(place, std::string::npos) << words << "\n" << text;
        return place;
    };
    // tests decide, so their story comes before the first diagnosis
    EXPECT_LT(at("The tests name stribeck at all"), at("First diagnosis: The cause: joint_friction"));
    EXPECT_LT(at("Test 1: pull at joints 0, 1, 2"), at("First diagnosis"));
    EXPECT_LT(at("First diagnosis: The cause: joint_friction"), at("Errors"));
    EXPECT_LT(at("Joint 0 has less friction than the others"), at("Candidates"));
    at("ratio 0.57 (0.49 to 0.66)");
    at("could not be judged");
    at("joint_friction and stribeck");
    at("from 1 to 0.58 (95 % interval 0.5 to 0.66)");
    at("not determined by these data");
    at("The sensor reads 3.1 % more than the cameras see.");
    at("61234 simulations");
    EXPECT_LT(at("The plane leaves out"), at("Errors"));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 140U) << line; // a table is as wide as its words; all else keeps to 100 letters
        EXPECT_FALSE(line.ends_with(' ')) << "'" << line << "'";
    }
    EXPECT_TRUE(text.ends_with('\n'));
}

TEST(DiagnosisText, OfNoneNamesTheBestCandidateAndShowsNoProbability)
{
    const Diagnosis d = diagnosis_without_cause();
    const std::string text = diagnosis_text(d);
    EXPECT_NE(text.find("Verdict: No cause identified; best candidate: friction of joint 0 x 0.63 (p = 0.056)\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("not shown by these data"), std::string::npos) << text;
    for (const char* wrong : {"rejected", "prob.  <", "< 0.001", "is not named if the named cause"})
        EXPECT_EQ(text.find(wrong), std::string::npos) << wrong << "\n" << text;
    const JsonValue json = JsonParser::parse(diagnosis_json(d).text());
    EXPECT_EQ(json["heading"].text, verdict_heading(d));
    for (const JsonValue& c : json["candidates"].items) {
        EXPECT_EQ(c["probability"].kind, JsonValue::Kind::null) << c["name"].text;
        EXPECT_EQ(c["decision"].text, "not shown by these data");
    }
}

TEST(DiagnosisWords, NameTheBestCandidateByPlaceAndSize)
{
    const auto heading = [](const char* mechanism, const char* place, const char* parameter, const char* unit) {
        Diagnosis d = diagnosis_without_cause();
        Candidate& c = d.candidates.front();
        c.mechanism = mechanism, c.place = place, c.parameter = parameter, c.unit = unit;
        const std::string text = verdict_heading(d), before = "No cause identified; best candidate: ";
        EXPECT_TRUE(text.starts_with(before)) << text;
        return text.substr(before.size());
    };
    EXPECT_EQ(heading("corner_loss", "joint 2", "loss_m", "m"), "corner loss at joint 2, 0.63 m (p = 0.056)");
    EXPECT_EQ(heading("stribeck", "all", "dynamic_ratio", ""), "stribeck everywhere, dynamic_ratio 0.63 (p = 0.056)");
    EXPECT_EQ(heading("tie", "block 2", "dashpot_n_s_m", "N s/m"),
              "a force of unknown kind at block 2, 0.63 N s/m (p = 0.056)");
}

TEST(DiagnosisText, OfDirectFindingsAloneDoesNotMentionTheNullDistribution)
{
    Diagnosis d = filled_diagnosis();
    d.nulls.clear();
    d.candidates.resize(1);
    d.candidates.front().p.reset();
    d.candidates.front().null95.reset();
    const std::string text = diagnosis_text(d);
    EXPECT_NE(text.find("Candidates (gain in nats over the calibrated baseline)\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("null campaigns"), std::string::npos) << text;
    EXPECT_EQ(text.find("null distribution"), std::string::npos) << text;
}

TEST(DiagnosisText, OfAnEmptyOneSaysThatNothingIsWrong)
{
    const std::string text = diagnosis_text(Diagnosis{});
    EXPECT_NE(text.find("Verdict: No cause identified\n"), std::string::npos);
    EXPECT_EQ(text.find("null"), std::string::npos) << "no campaign was simulated";
    EXPECT_EQ(text.find("not known"), std::string::npos) << text;
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(DiagnosisWords, SayWhatIsNotKnown)
{
    EXPECT_EQ(interval_words({}, 2.0), "up to 2");
    EXPECT_EQ(interval_words(2.0, {}), "2 or more");
    EXPECT_EQ(estimate_words({}, {}, {}, "m"), "not known");
    EXPECT_EQ(probability_words(0.0004), "< 0.001");
    EXPECT_EQ(list_words({"a", "b", "c"}), "a, b and c");
    EXPECT_EQ(block_words(-1), "the base");
}

} // namespace
} // namespace stylobate

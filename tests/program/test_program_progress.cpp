/// Progress on standard error: the styles of `--progress`, and the objects of `--progress json` against the line, the
/// summary and the results.

#include "io/measured/campaign_writer.hpp"
#include "studies/workflow/workflow.hpp"
#include "tests/ensemble/tracking/synthetic_campaign.hpp"
#include "tests/io/measured/measured_samples.hpp"
#include "tests/program/program.hpp"

#include <sstream>

namespace stylobate {
namespace {

using JsonKind = JsonValue::Kind;

class ProgressObjects : public Program {
protected:
    /// The objects on standard error, one a line, without anything else.
    static std::vector<JsonValue> objects(const Ended& ended)
    {
        std::vector<JsonValue> all;
        std::istringstream lines(ended.err);
        for (std::string line; std::getline(lines, line);)
            try {
                all.push_back(JsonParser::parse(line));
            } catch (const std::exception& error) {
                ADD_FAILURE() << error.what() << ": " << line;
            }
        return all;
    }

    /// Those of progress. All have every key; the last one of all objects is one, and it alone may be finished.
    static std::vector<JsonValue> progress_of(const Ended& ended, const std::string& verb)
    {
        std::vector<JsonValue> all;
        const std::vector<JsonValue> any = objects(ended);
        for (const JsonValue& object : any) {
            EXPECT_EQ(object["verb"].text, verb);
            if (object["event"].text == "progress")
                all.push_back(object);
        }
        EXPECT_FALSE(all.empty()) << testing::PrintToString(ended);
        EXPECT_TRUE(any.empty() || any.back()["event"].text == "progress") << ended.err;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const JsonValue& object = all[i];
            for (const char* key :
                 {"total", "rate_per_s", "seconds", "seconds_left", "simulated_s", "simulated_most_s"})
                EXPECT_TRUE(object[key].kind == JsonKind::number || object[key].kind == JsonKind::null) << key;
            EXPECT_EQ(object["done"].kind, JsonKind::number);
            EXPECT_EQ(object["finished"].kind, JsonKind::boolean);
            if (object["estimate"].kind != JsonKind::null) {
                EXPECT_LE(object["estimate"]["lower"].number, object["estimate"]["collapse_probability"].number);
                EXPECT_LE(object["estimate"]["collapse_probability"].number, object["estimate"]["upper"].number);
            }
            EXPECT_TRUE(i + 1 == all.size() || !object["finished"].boolean) << ended.err;
        }
        return all;
    }

    static const inline std::vector<std::string> as_json = {"--progress", "json"};
};

JsonValue object_of(const Progress& progress)
{
    Json json = Json::object();
    return JsonParser::parse(add_progress(json, progress).text());
}

TEST(Progress, ObjectsHaveTheNumbersOfTheLine)
{
    Progress p{.done = 200, .total = 1000, .invalid = 3, .seconds = 4, .rate = 50};
    p.share = 0.12;
    p.share_lower = 0.091;
    p.share_upper = 0.154;
    EXPECT_EQ(progress_line(p), "200 of 1000 realizations, 50/s, 16 s left, 12.0 % collapsed (9.1 to 15.4), 3 invalid");
    JsonValue object = object_of(p);
    EXPECT_EQ(object["done"].number, 200);
    EXPECT_EQ(object["total"].number, 1000);
    EXPECT_FALSE(object["total_estimated"].boolean);
    EXPECT_EQ(object["rate_per_s"].number, 50);
    EXPECT_EQ(object["seconds"].number, 4);
    EXPECT_EQ(object["seconds_left"].number, 16);
    EXPECT_EQ(object["estimate"]["collapse_probability"].number, 0.12);
    EXPECT_EQ(object["estimate"]["lower"].number, 0.091);
    EXPECT_EQ(object["estimate"]["upper"].number, 0.154);
    EXPECT_EQ(object["invalid"].number, 3);

    p.open_end = true; // `total` is then only the most that it can take
    object = object_of(p);
    EXPECT_EQ(progress_line(p), "200 realizations, 50/s, 12.0 % collapsed (9.1 to 15.4), 3 invalid");
    EXPECT_EQ(object["total"].kind, JsonKind::null);
    EXPECT_EQ(object["seconds_left"].kind, JsonKind::null);
    p.expected = 300;
    object = object_of(p);
    EXPECT_TRUE(progress_line(p).starts_with("200 of about 300 realizations, 50/s, about 2 s left"));
    EXPECT_EQ(object["total"].number, 300);
    EXPECT_TRUE(object["total_estimated"].boolean);
    EXPECT_EQ(object["seconds_left"].number, 2);

    Progress first{.total = 1, .seconds = 60}; // nothing is known of the share, and no realization has ended
    first.furthest = {2, 200};
    object = object_of(first);
    EXPECT_EQ(progress_line(first), "0 of 1 realizations, 2 of at most 200 s simulated, at most 1 h 39 min left");
    EXPECT_EQ(object["seconds_left"].number, 60 * 99);
    EXPECT_EQ(object["simulated_s"].number, 2);
    EXPECT_EQ(object["simulated_most_s"].number, 200);
    for (const char* key : {"rate_per_s", "estimate"})
        EXPECT_EQ(object[key].kind, JsonKind::null) << key;
}

TEST_F(ProgressObjects, EndWithTheNumbersOfTheSummary)
{
    const Words words =
        run_words(column_study, eight_realizations, with({"-o", "a.h5", "--json", "--threads", "1"}, as_json));
    const Ended ended = run(words);
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue summary = json_of(ended), last = progress_of(ended, "run").back();
    EXPECT_TRUE(last["finished"].boolean);
    EXPECT_EQ(last["unit"].text, "realizations");
    EXPECT_TRUE(last["line"].text.starts_with("8 of 8 realizations, ")) << last["line"].text;
    EXPECT_EQ(last["done"].number, 8);
    EXPECT_EQ(last["total"].number, 8);
    EXPECT_EQ(last["seconds"].number, summary["seconds"].number);
    EXPECT_EQ(last["rate_per_s"].number, summary["realizations_per_second"].number);
    EXPECT_EQ(last["estimate"]["collapse_probability"].number, summary["collapse_probability"].number);
    EXPECT_EQ(last["estimate"]["lower"].number, summary["collapse_lower"].number);
    EXPECT_EQ(last["estimate"]["upper"].number, summary["collapse_upper"].number);

    // finished before: it took no time
    const JsonValue again = progress_of(run(words), "run").back();
    EXPECT_TRUE(again["finished"].boolean);
    EXPECT_EQ(again["done"].number, 8);
    EXPECT_EQ(again["seconds"].kind, JsonKind::null);
}

TEST_F(ProgressObjects, OfAnInterruptedRunAreNotFinished)
{
    const Ended ended = run({.arguments = run_words(column_study, {"study.realizations=100"},
                                                    with({"-o", "a.h5", "--threads", "1", "--quiet"}, as_json)),
                             .signal = SIGINT,
                             .when = [](const std::string& err) { return err.find('\n') != std::string::npos; }});
    ASSERT_EQ(ended.status, 130) << testing::PrintToString(ended);
    const std::vector<JsonValue> all = progress_of(ended, "run");
    ASSERT_GE(all.size(), 2U); // the first one, and that at the end
    EXPECT_FALSE(all.back()["finished"].boolean);
    EXPECT_EQ(all.back()["total"].number, 25600);
    EXPECT_EQ(all.back()["done"].number, static_cast<double>(ResultReader(folder / "a.h5").done()));
    for (std::size_t i = 1; i < all.size(); ++i)
        EXPECT_GE(all[i]["done"].number, all[i - 1]["done"].number);
}

TEST_F(ProgressObjects, OfCalibrationsCountParameterSets)
{
    SyntheticCampaign c;
    c.runs = 2;
    write_campaign(measure(c), folder / "m.h5");
    const Ended ended =
        run({.arguments = with({"calibrate", "m.h5", "-o", "c.h5", "--threads", "1", "--quiet"}, as_json),
             .signal = SIGINT,
             .when = [](const std::string& err) { return err.find('\n') != std::string::npos; }});
    ASSERT_EQ(ended.status, 130) << testing::PrintToString(ended);
    const std::vector<JsonValue> all = progress_of(ended, "calibrate");
    EXPECT_FALSE(all.back()["finished"].boolean);
    for (const JsonValue& object : all) {
        EXPECT_EQ(object["unit"].text, "parameter sets");
        EXPECT_GT(object["total"].number, 0);
        EXPECT_NE(object["line"].text.find(" parameter sets"), std::string::npos) << object["line"].text;
    }
}

TEST_F(ProgressObjects, EndEveryVerb)
{
    for (const char* shard : {"1/2", "2/2"})
        ASSERT_EQ(run(run_words(column_study, eight_realizations,
                                {"--shard", shard, "-o", shard[0] == '1' ? "p.h5" : "q.h5"}))
                      .status,
                  0);
    ASSERT_EQ(run(run_words(column_study, with(eight_realizations, {"contact.friction=0.6"}), {"-o", "v.h5"})).status,
              0);
    Words check = run_words(column_study, eight_realizations, {"--pilot", "16", "--trial-seconds", "0.1"});
    check.front() = "check";
    for (const Words& words :
         {Words{"merge", "p.h5", "q.h5", "-o", "m.h5"}, check, Words{"verify-file", "m.h5", "--replay", "1"},
          Words{"report", "m.h5"}, Words{"compare", "m.h5", "v.h5"}, Words{"export", "m.h5", "--to", "html"}}) {
        const Ended ended = run(with(words, as_json));
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_TRUE(progress_of(ended, words.front()).back()["finished"].boolean) << words.front();
    }
}

TEST_F(ProgressObjects, NotesAndWarningsAreObjectsToo)
{
    const std::string study = STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml";
    const Words settings = {"contact.friction=0.05"}; // lower than any stone's
    const auto warnings = [](const std::vector<JsonValue>& all) {
        return std::ranges::count_if(all, [](const JsonValue& object) {
            return object["event"].text == "warning" && object["text"].text.find("friction") != std::string::npos;
        });
    };
    const Ended loud = run(run_words(study, settings, with({"-o", "a.h5"}, as_json)));
    EXPECT_EQ(loud.status, 0) << testing::PrintToString(loud);
    EXPECT_GT(warnings(objects(loud)), 0) << loud.err;
    const Ended quiet = run(run_words(study, settings, with({"-o", "b.h5", "--quiet"}, as_json)));
    EXPECT_EQ(warnings(objects(quiet)), 0) << quiet.err;
    EXPECT_TRUE(progress_of(quiet, "run").back()["finished"].boolean);
}

TEST_F(ProgressObjects, StylesOnATerminal)
{
    const auto shown = [&](const Words& style) {
        fs::remove(folder / "a.h5");
        const Ended ended = run(
            {.arguments = run_words(column_study, eight_realizations, with({"-o", "a.h5"}, style)), .terminal = true});
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        return ended.err;
    };
    EXPECT_NE(shown({"--progress", "auto"}).find("\x1b[K"), std::string::npos);
    EXPECT_EQ(shown({"--progress", "none"}), "");
    EXPECT_EQ(shown({"--progress", "auto", "--quiet"}), "");
    for (const Words& style : {Words{"--progress", "plain"}, as_json})
        EXPECT_EQ(shown(style).find('\x1b'), std::string::npos) << style.back();
    expect_refused(run_words(column_study, eight_realizations, {"-o", "b.h5", "--progress", "jsn"}),
                   {"--progress: jsn not in {auto,plain,json,none}"});
}

} // namespace
} // namespace stylobate

/// Every kind of file given to every verb: taken, or told what it is and which verb takes it; what `info` says of each.

#include "io/measured/campaign_writer.hpp"
#include "tests/program/program.hpp"

#include "io/measured/measured_file.hpp"
#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/report/left_out.hpp"
#include "tests/io/measured/measured_samples.hpp"
#include "tests/studies/measured/calibration/calibration_sample.hpp"
#include "tests/studies/measured/diagnosis/diagnosis_sample.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

namespace stylobate {
namespace {

const std::string rocking_study = STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml";

class Kinds : public Program {
protected:
    /// One file of each kind, by its name; the folders are files too.
    void SetUp() override
    {
        Program::SetUp();
        write_bytes(folder / "study.toml", read_bytes(rocking_study));
        done({"run", "study.toml", "-o", "results.h5", "--quiet"});
        done({"replay", "results.h5", "--realization", "0", "-o", "replay.h5", "--quiet"});
        done({"export", "results.h5", "--to", "csv", "-o", "tables", "--quiet"});
        done({"report", "results.h5", "-o", "page.html", "--quiet"});
        write_diagnosis(filled_diagnosis(), folder / "diagnosis.h5");
        write_calibration(sample_calibration(), sample_calibration().forms[0].study, "0.1.0",
                          folder / "calibration.h5");
        write_campaign(sample_campaign(), folder / "campaign.h5");
        write_campaign(sample_campaign(), folder / "campaign");
        write_bytes(folder / "outcomes.csv", "motion_id,pga_m_s2,frequency_hz,fell\n1,3,2,1\n2,1,2,0\n");
        write_bytes(folder / "record.at2", Burst{}.at2());
    }
    void done(const Words& words) const
    {
        const Ended ended = run(words);
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    }
};

struct Sample {
    const char* file;
    const char* is;    ///< in messages
    const char* holds; ///< of info --json
    std::set<std::string> verbs;
};
const Sample samples[] = {
    {"study.toml", "is a study file", "study", {"check", "compare", "run"}},
    {"results.h5",
     "is the results of a study of kind 'single'",
     "results",
     {"compare", "export", "report", "replay", "verify-file"}},
    {"replay.h5", "is one realization that was run again", "results", {"export", "report", "replay", "verify-file"}},
    {"diagnosis.h5", "is a diagnosis", "diagnosis", {"report"}},
    {"calibration.h5", "is a calibration", "calibration", {"report"}},
    {"campaign.h5", "is a measured campaign", "measured campaign", {"diagnose", "calibrate"}},
    {"campaign", "is a measured campaign", "measured campaign", {"diagnose", "calibrate"}},
    {"outcomes.csv", "is a table of measured outcomes", "measured outcomes", {"calibrate"}},
    {"record.at2", "is a record of ground motion (peer-at2)", "record", {"record"}},
    {"tables", "is a table that 'stylobate export' wrote", "a table that 'stylobate export' wrote", {}},
    {"tables/realizations.csv",
     "is a table that 'stylobate export' wrote",
     "a table that 'stylobate export' wrote",
     {}},
    {"page.html", "is a page (HTML)", "a page (HTML)", {}},
};

TEST_F(Kinds, InfoSaysWhatItIsAndWhatTakesIt)
{
    for (const Sample& sample : samples) {
        const JsonValue json = json_of(run(Words{"info", sample.file, "--json"}));
        EXPECT_EQ(json["holds"].text, sample.holds) << sample.file;
        EXPECT_EQ(json["file"].text, sample.file);
        std::set<std::string> verbs;
        for (const JsonValue& verb : json["verbs"].items)
            verbs.insert(verb.text);
        EXPECT_EQ(verbs, sample.verbs) << sample.file;
        const Ended told = run(Words{"info", sample.file});
        EXPECT_EQ(told.status, 0) << testing::PrintToString(told);
        EXPECT_TRUE(told.out.starts_with(sample.file + std::string(": "))) << told.out;
        for (const std::string& verb : sample.verbs)
            EXPECT_NE(told.out.find("stylobate " + verb + " " + sample.file), std::string::npos) << told.out;
    }
    // a study with all that decides its outcomes
    const std::string study = run(Words{"info", "study.toml"}).out;
    for (const char* part : {"a study of kind single, 1 realization", "1 drum", "the base is at rest",
                             "rotated beyond its own slenderness angle"})
        EXPECT_NE(study.find(part), std::string::npos) << part << "\n" << study;
    // a calibration with what it did not determine
    EXPECT_NE(run(Words{"info", "calibration.h5"}).out.find("nothing slides"), std::string::npos);
}

/// What the plane leaves out holds for fits to measured data too.
TEST_F(Kinds, DiagnosesAndCalibrationsNameWhatThePlaneLeavesOut)
{
    const std::string sentence = left_out_text(2);
    for (const std::string name : {"diagnosis", "calibration"}) {
        EXPECT_NE(run(Words{"info", name + ".h5"}).out.find(sentence + "\n"), std::string::npos) << name;
        EXPECT_EQ(json_of(run(Words{"info", name + ".h5", "--json"}))["left_out"].text, sentence) << name;
        ASSERT_EQ(run(Words{"report", name + ".h5", "--quiet"}).status, 0) << name;
        EXPECT_EQ(count_of(read_page(folder / (name + ".html")), sentence), 1U) << name;
    }
}

/// Findings of one kind are counted, rare ones come first, and what matters is not lost among them.
TEST_F(Kinds, InfoGroupsWhatItFindsInMeasuredData)
{
    Campaign campaign = sample_campaign();
    const MeasuredRun run_of = campaign.runs.front();
    campaign.runs.clear();
    constexpr int runs = 12;
    for (int i = 0; i < runs; ++i) {
        MeasuredRun each = run_of;
        each.name = fmt::format("{:03}", i);
        each.motion_id = i;
        each.base_source = BaseSource::command;
        for (int k = 0; k <= i; ++k) // notes that differ in their numbers alone
            each.blocks.x_m.values[static_cast<std::size_t>(campaign.specimen.blocks() * (100 + 10 * k))] = NAN;
        campaign.runs.push_back(each);
    }
    campaign.runs[7].collapse_time_s = 2; // and the outcome is no collapse
    write_campaign(campaign, folder / "many.h5");
    const std::string note = "it is the command, not the measured motion of the table.";
    const std::string grouped = run(Words{"info", "many.h5"}).out;
    EXPECT_EQ(count_of(grouped, note), 1U) << grouped;
    EXPECT_NE(grouped.find("  and 11 more of this kind; --all prints them\n"), std::string::npos) << grouped;
    EXPECT_NE(grouped.find("values are missing (NaN).\n  and 10 more of this kind"), std::string::npos) << grouped;
    const std::string all = run(Words{"info", "many.h5", "--all"}).out;
    EXPECT_EQ(count_of(all, note), runs) << all;
    EXPECT_EQ(all.find("more of this kind"), std::string::npos);
    std::size_t in_json = 0;
    const JsonValue json = json_of(run(Words{"info", "many.h5", "--json"}));
    for (const JsonValue& finding : json["findings"].items)
        in_json += finding["text"].text == note;
    EXPECT_EQ(in_json, runs);
    const std::string warning = "warning: run 007, collapsed: the outcome is no collapse, but collapse_time_s = 2.\n";
    EXPECT_NE(grouped.find(warning), std::string::npos) << grouped;
    EXPECT_LT(grouped.rfind("warning: "), grouped.find("note: ")) << grouped;
}

TEST_F(Kinds, InfoSaysWhatTheVerbsRefuse)
{
    // what run refuses is no warning
    const std::string study = run(Words{"info", "study.toml", "--set", "contact.friction=5"}).out;
    const Ended ran = run(Words{"run", "study.toml", "-o", "x.h5", "--set", "contact.friction=5"});
    ASSERT_EQ(ran.status, 2) << testing::PrintToString(ran);
    EXPECT_NE(study.find("refused: run: "), std::string::npos) << study;
    EXPECT_NE(study.find("study.allow = ["), std::string::npos) << study;
    EXPECT_EQ(study.find("warning: "), std::string::npos) << study;
    const JsonValue json = json_of(run(Words{"info", "study.toml", "--json", "--set", "contact.friction=5"}));
    EXPECT_EQ(json["refused"].items.size(), 1U);
    EXPECT_EQ(json["warnings"].items.size(), 0U);
    const Ended missing = run(Words{"info", record_study, "--set", "excitation.file=none.at2"});
    EXPECT_EQ(missing.status, 0) << testing::PrintToString(missing);
    EXPECT_NE(missing.out.find("refused: run: none.at2: "), std::string::npos) << missing.out;
    // a record without its unit
    std::string columns;
    for (int i = 0; i < 40; ++i)
        columns += fmt::format("{:.2f} {:.1f}\n", 0.01 * i, 0.1 * (i * 7 % 5 - 2));
    write_bytes(folder / "plain.txt", columns);
    EXPECT_EQ(run(Words{"record", "plain.txt"}).status, 2);
    EXPECT_NE(run(Words{"info", "plain.txt"}).out.find("refused: record: plain columns do not contain the unit"),
              std::string::npos);
    // what diagnose refuses
    Campaign campaign = sample_campaign();
    for (MeasuredRun& each : campaign.runs)
        each.blocks.theta_rad = Series{};
    write_campaign(campaign, folder / "flat.h5");
    EXPECT_EQ(run(Words{"diagnose", "flat.h5", "--nulls", "0"}).status, 2);
    const std::string told = run(Words{"info", "flat.h5"}).out;
    EXPECT_NE(told.find("refused: diagnose: "), std::string::npos) << told;
    EXPECT_EQ(run(Words{"info", "campaign.h5"}).out.find("refused"), std::string::npos);
}

TEST_F(Kinds, AVerbSaysWhatAnotherFileIs)
{
    const std::map<std::string, Words> more = {{"replay", {"--realization", "0"}}, {"export", {"--to", "csv"}}};
    for (const Sample& sample : samples)
        for (const std::string verb :
             {"run", "replay", "verify-file", "export", "report", "record", "diagnose", "calibrate"}) {
            if (sample.verbs.contains(verb))
                continue;
            Words words = {verb, sample.file};
            if (more.contains(verb))
                words.insert(words.end(), more.at(verb).begin(), more.at(verb).end());
            Words parts = {std::string(sample.file) + ": " + sample.is, "stylobate " + verb + " takes ",
                           std::string("stylobate info ") + sample.file};
            for (const std::string& other : sample.verbs)
                if (other != "compare" || sample.holds == std::string("study")) // few results have variants
                    parts.push_back("stylobate " + other + " " + sample.file);
            expect_refused(words, parts);
        }
}

TEST_F(Kinds, AnOptionSaysSoToo)
{
    expect_refused(Words{"run", "study.toml", "-o", "diagnosis.h5"}, {"-o diagnosis.h5: is a diagnosis", "results"});
    for (const char* verb : {"diagnose", "calibrate"})
        expect_refused(Words{verb, "campaign.h5", "--study", "results.h5"},
                       {"--study results.h5: is the results of a study", "it takes a study file (TOML)"});
}

TEST_F(Kinds, OnlyAStudyIsSet)
{
    for (const Sample& sample : samples)
        if (const std::string file = sample.file; file != "study.toml") {
            expect_refused(Words{"info", file, "--set", "study.seed=2"},
                           {"--set study.seed=2: only a study can be set; " + file + " " + sample.is});
        }
    EXPECT_NE(run(Words{"info", "study.toml", "--set", "study.seed=2"}).out.find("seed 2"), std::string::npos);
    expect_refused(Words{"record", "record.at2", "--set", "study.seed=2"}, {"--set"});
}

TEST_F(Kinds, ARecordThatDoesNotSayItsUnitIsOneAllTheSame)
{
    write_bytes(folder / "columns.txt", Burst{}.columns());
    const Ended told = run(Words{"info", "columns.txt"});
    EXPECT_EQ(told.status, 0) << testing::PrintToString(told);
    for (const char* part :
         {"may be a record of ground motion", "do not contain the unit", "stylobate record columns.txt"})
        EXPECT_NE(told.out.find(part), std::string::npos) << told.out;
}

TEST_F(Kinds, WhatIsNoneIsSaid)
{
    write_bytes(folder / "notes.txt", "some words\nof nobody\n");
    expect_refused(Words{"info", "notes.txt"}, {"notes.txt: is not a file that stylobate reads"});
    expect_refused(Words{"info", "none.h5"}, {"none.h5", "there is no such file"});
    fs::create_directory(folder / "empty");
    expect_refused(Words{"info", "empty"}, {"empty: is not a file"});
    // damage is told as damage, not as another kind
    std::string bytes = read_bytes(folder / "diagnosis.h5");
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write_bytes(folder / "damaged.h5", bytes);
    for (const Words& words : {Words{"info", "damaged.h5"}, Words{"replay", "damaged.h5", "--realization", "0"},
                               Words{"report", "damaged.h5"}})
        expect_refused(words, {"damaged.h5", "is damaged"});
    // a calibration has no seal: what is missing in it is found by its reader
    bytes = read_bytes(folder / "calibration.h5");
    const std::size_t at = bytes.find("best_form");
    ASSERT_NE(at, std::string::npos);
    bytes[at] = 'B';
    write_bytes(folder / "torn.h5", bytes);
    expect_refused(Words{"report", "torn.h5"}, {"torn.h5", "calibration"});
}

TEST_F(Kinds, ReportOfACalibrationIsAPage)
{
    const Ended ended = run(Words{"report", "calibration.h5", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(json_of(ended)["written"].text, "calibration.html");
    const std::string page = read_bytes(folder / "calibration.html");
    for (const char* part : {"Calibration: ", "contact.friction", "not determined", "nothing slides"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(Kinds, ARareEventHasAPicture)
{
    done(run_words(STYLOBATE_SOURCE_DIR "/studies/inputs/rare_collapse.toml", {"rare.samples=200", "rare.repeats=5"},
                   {"-o", "rare.h5", "--quiet"}));
    done({"export", "rare.h5", "--to", "png", "-o", "rare.png"});
    EXPECT_TRUE(read_bytes(folder / "rare.png").starts_with("\x89PNG"));
    done({"report", "rare.h5", "-o", "rare.html", "--quiet"});
    const std::string page = read_bytes(folder / "rare.html");
    EXPECT_EQ(count_of(page, "class=\"figure-data\""), 2U); // the levels, and what each repeat found
    EXPECT_NE(page.find("\"name\": \"repeat 4\""), std::string::npos);
    EXPECT_NE(page.find("\"name\": \"mean\""), std::string::npos);
    expect_refused(Words{"export", "results.h5", "--to", "png", "--picture", "rare"}, {"'single'", "rare"});
    const JsonValue json = json_of(run(Words{"info", "rare.h5", "--json"}));
    for (const JsonValue& verb : json["verbs"].items)
        EXPECT_NE(verb.text, "replay"); // no realization of a chain can be run by itself
}

} // namespace
} // namespace stylobate

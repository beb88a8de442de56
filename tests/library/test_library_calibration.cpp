/// The library's calibration is the program's.

#include "io/measured/campaign_writer.hpp"
#include "stylobate/stylobate.hpp"
#include "tests/ensemble/tracking/synthetic_campaign.hpp"
#include "tests/program/program.hpp"

#include "io/measured/measured_file.hpp"
#include "studies/measured/calibration/calibration_file.hpp"

#include <fmt/format.h>

#include <regex>

namespace stylobate {
namespace {

class LibraryCalibration : public Program {
protected:
    const fs::path two_drums = STYLOBATE_SOURCE_DIR "/tests/library/two_drums";

    void SetUp() override
    {
        Program::SetUp();
        for (const char* file : {"two_drums.toml", "tests.csv"})
            fs::copy(two_drums / file, folder);
    }
    api::CalibrationOptions of_table() const
    {
        return {.study = api::Study::from_file(folder / "two_drums.toml"),
                .hold = {"contact.tangential_stiffness_n_m", "contact.tangential_damping_ratio"}};
    }
    const Words table_words{"calibrate", "tests.csv",
                            "--study",   "two_drums.toml",
                            "--hold",    "contact.tangential_stiffness_n_m",
                            "--hold",    "contact.tangential_damping_ratio"};

    /// Without the time and the names of files.
    static std::string steady(const std::string& json)
    {
        static const std::regex unsteady("\"seconds\": [^,}]*|, \"results\": \"[^\"]*\"|, \"calibrated_study\": "
                                         "\"[^\"]*\"|\"measured\": \"[^\"]*\"");
        return std::regex_replace(json, unsteady, "");
    }
    static void expect_parameters(const api::CalibratedForm& form, const JsonValue& said)
    {
        EXPECT_EQ(form.form, said["form"].text);
        EXPECT_EQ(form.score, said["score"].number);
        EXPECT_EQ(form.start_score, said["nominal_score"].number);
        ASSERT_EQ(form.parameters.size(), said["parameters"].items.size());
        for (std::size_t i = 0; i < form.parameters.size(); ++i) {
            const api::CalibratedParameter& p = form.parameters[i];
            const JsonValue& want = said["parameters"].items[i];
            EXPECT_EQ(p.key, want["key"].text);
            EXPECT_EQ(p.start, want["start"].number) << p.key;
            EXPECT_EQ(p.value, want["value"].number) << p.key;
            EXPECT_EQ(p.lower, want["low"].number) << p.key;
            EXPECT_EQ(p.upper, want["high"].number) << p.key;
            EXPECT_EQ(p.range_from, want["range_low"].number) << p.key;
            EXPECT_EQ(p.range_to, want["range_high"].number) << p.key;
            EXPECT_EQ(p.determined, want["determined"].boolean) << p.key;
            EXPECT_EQ(p.effective, want["effective"].boolean) << p.key;
            EXPECT_EQ(p.bounded_below, want["bounded_below"].boolean) << p.key;
            EXPECT_EQ(p.bounded_above, want["bounded_above"].boolean) << p.key;
            EXPECT_EQ(p.note, want["note"].text) << p.key;
        }
        ASSERT_EQ(form.runs.size(), said["runs"].items.size());
        for (std::size_t i = 0; i < form.runs.size(); ++i) {
            const JsonValue& want = said["runs"].items[i];
            EXPECT_EQ(form.runs[i].run, want["run"].text);
            EXPECT_EQ(static_cast<double>(form.runs[i].units), want["units"].number);
            EXPECT_EQ(form.runs[i].start, want["nominal_score"].number);
            EXPECT_EQ(form.runs[i].calibrated, want["calibrated_score"].number);
        }
    }
};

TEST_F(LibraryCalibration, OfHistoriesHasTheResultsOfTheProgram)
{
    SyntheticCampaign c;
    c.runs = 2;
    write_campaign(measure(c), folder / "m.h5");
    const Words held = {"contact.tangential_stiffness_n_m", "contact.normal_damping_ratio",
                        "contact.tangential_damping_ratio"}; // or it takes long
    Words words = {"calibrate", "m.h5", "-o", "c.h5", "--threads", "1", "--json", "--quiet"};
    for (const std::string& key : held)
        words.insert(words.end(), {"--hold", key});
    const Ended ended = run(words);
    const JsonValue said = json_of(ended);
    std::vector<std::string> lines;
    const std::optional<api::Calibration> found = api::calibrate(
        folder / "m.h5", {.hold = held, .threads = 2, .tell = [&](const std::string& line) { lines.push_back(line); }});
    ASSERT_TRUE(found);
    EXPECT_EQ(steady(found->json()) + "\n", steady(ended.out));
    EXPECT_EQ(found->evidence(), "histories");
    ASSERT_EQ(found->forms().size(), 1U);
    EXPECT_EQ(found->best().form, said["best_form"].text);
    expect_parameters(found->best(), said["forms"].items.front());
    ASSERT_TRUE(found->best().held_out);
    EXPECT_EQ(found->best().held_out->nats, said["forms"].items.front()["held_out_gain"]["nats"].number);
    EXPECT_EQ(found->notes().size(), said["notes"].items.size());
    EXPECT_EQ(static_cast<double>(found->parameter_sets()), said["parameter_sets"].number);
    EXPECT_EQ(found->calibrated_study(), read_bytes(folder / "c_calibrated.toml"));
    ASSERT_GT(lines.size(), 3U);
    EXPECT_NE(lines.back().find("parameter sets"), std::string::npos);

    found->write(folder / "l.h5");
    const StoredCalibration want = read_calibration(folder / "c.h5"), got = read_calibration(folder / "l.h5");
    EXPECT_EQ(got.start_toml, want.start_toml);
    EXPECT_EQ(got.code_version, want.code_version);
    EXPECT_EQ(got.block_steps, want.block_steps);
    EXPECT_EQ(got.best_form, want.best_form);
    EXPECT_EQ(got.best().study_toml, want.best().study_toml);
    const Ended page = run({"report", "l.h5", "--quiet"});
    EXPECT_EQ(page.status, 0) << testing::PrintToString(page);
    EXPECT_THROW(found->write(folder / "none" / "l.h5"), api::InputError);
}

TEST_F(LibraryCalibration, OfOutcomesWithFormsAndKeysOfOnesOwn)
{
    const Ended ended = run(with(table_words, {"--form", "area,points", "--fit", "contact.friction=0.4:0.9",
                                               "--no-held-out", "-o", "c.h5", "--json", "--quiet"}));
    const JsonValue said = json_of(ended);
    api::CalibrationOptions options = of_table();
    options.forms = {"area", "points", "area"}; // once
    options.fit = {"contact.friction=0.4:0.9"};
    options.held_out = false;
    const std::optional<api::Calibration> found = api::calibrate(folder / "tests.csv", options);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->evidence(), "outcomes");
    EXPECT_EQ(steady(found->json()) + "\n", steady(ended.out));
    ASSERT_EQ(found->forms().size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        expect_parameters(found->forms()[i], said["forms"].items[i]);
        EXPECT_FALSE(found->forms()[i].held_out);
        EXPECT_EQ(found->forms()[i].parameters.back().range_to, 0.9);
    }
    EXPECT_EQ(found->best().form, said["best_form"].text);
    EXPECT_EQ(found->calibrated_study(), read_bytes(folder / "c_calibrated.toml"));
    const std::string text = found->text();
    for (const char* part : {"  These data determine ", "\n  Contact form area\n", "\n  Contact form points\n"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find(fmt::format("\n{} parameter sets, ", found->parameter_sets())), std::string::npos) << text;
}

TEST_F(LibraryCalibration, WhatAStopKeepsTheProgramGoesOnWith)
{
    api::CalibrationOptions options = of_table();
    options.cache = folder / "c_sets.bin";
    bool portion = false; // is done, after the first set of all
    options.tell = [&](const std::string& line) {
        portion = portion || std::atoi(line.c_str() + line.find(": ") + 2) > 1;
    };
    options.go_on = [&] { return !portion; };
    EXPECT_FALSE(api::calibrate(folder / "tests.csv", options));
    ASSERT_TRUE(fs::exists(*options.cache));

    const Ended ended = run(with(table_words, {"-o", "c.h5", "--json", "--quiet"}));
    EXPECT_GE(json_of(ended)["restored_sets"].number, 16);
    EXPECT_FALSE(fs::exists(*options.cache));
    const std::optional<api::Calibration> whole = api::calibrate(folder / "tests.csv", of_table());
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->restored_sets(), 0U);
    EXPECT_EQ(whole->calibrated_study(), read_bytes(folder / "c_calibrated.toml"));
}

TEST_F(LibraryCalibration, RefusesWhatTheProgramRefusesWithItsWords)
{
    const auto message = [](const fs::path& file, const api::CalibrationOptions& options) -> std::string {
        try {
            api::calibrate(file, options);
        } catch (const api::InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    const auto line = [](const std::string& text) { return "stylobate: " + text + "\n"; };
    const auto said = [&](const Words& words) {
        const Ended ended = run(words);
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(ended);
        return ended.err;
    };
    write_bytes(folder / "no.h5", "nothing");
    for (const char* file : {"no.h5", "none.h5", "two_drums.toml", "tests.csv"}) {
        const std::string path = folder / file;
        EXPECT_EQ(line(message(path, {})), said({"calibrate", path, "-o", "c.h5"})) << file;
    }
    const std::string table = folder / "tests.csv";
    const auto refused = [&](const api::CalibrationOptions& extra, const Words& more) {
        api::CalibrationOptions options = extra;
        options.study = of_table().study;
        EXPECT_EQ(line(message(table, options)),
                  said(with({"calibrate", table, "--study", "two_drums.toml", "-o", "c.h5"}, more)));
    };
    refused({.fit = {"contact.frction"}}, {"--fit", "contact.frction"});
    refused({.fit = {"contact.friction=0.9:0.3"}}, {"--fit", "contact.friction=0.9:0.3"});
    refused({.fit = {"contact.friction=a:b"}}, {"--fit", "contact.friction=a:b"});
    refused({.hold = {"contact.damping"}}, {"--hold", "contact.damping"});
    EXPECT_NE(message(table, {.study = of_table().study, .forms = {"point"}}).find("Did you mean points?"),
              std::string::npos);

    // a cache that is something else stays
    api::CalibrationOptions wrong = of_table();
    wrong.cache = folder / "two_drums.toml";
    EXPECT_NE(message(table, wrong).find("keeps no parameter sets"), std::string::npos);
    EXPECT_EQ(read_bytes(folder / "two_drums.toml"), read_bytes(two_drums / "two_drums.toml"));
}

} // namespace
} // namespace stylobate

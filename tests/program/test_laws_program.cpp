/// `stylobate run --laws`, as its user runs it.

#include "tests/program/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

class LawsProgram : public Program {
protected:
    void SetUp() override
    {
        Program::SetUp();
        write_study("col.toml", "kind = \"surface\"\nrealizations = 12");
    }

    /// Four cells of a short column.
    void write_study(const std::string& file, const std::string& of_study, const std::string& more = "",
                     const std::string& contact = "normal_stiffness_n_m2 = 4e6\ntangential_stiffness_n_m = 2e5\n") const
    {
        write_bytes(folder / file, "[study]\n" + of_study +
                                       "\n[structure]\nblocks = 4\ndrum_width_m = 0.048\ndrum_height_m = 0.029\n"
                                       "depth_m = 0.048\ndrum_mass_kg = 0.1355\n[contact]\nfriction = 0.68\n" +
                                       contact + R"([excitation]
kind = "harmonic"
cycles = 4
[surface]
frequency_hz = { from = 4.0, to = 8.0, count = 2 }
pga_m_s2 = { from = 4.0, to = 14.0, count = 2 }
[perturbation]
friction = { distribution = "normal", cov = 0.10, per = "joint" }
drum_offset = { distribution = "normal", sd_m = 0.00024, per = "block" }
phase = { distribution = "uniform" }
)" + more);
    }

    /// Share of each cell, and of all cells with equal weights, that the rows of a file give.
    std::vector<double> shares(const std::string& file) const
    {
        std::vector<double> fell(5), n(5);
        const ResultReader reader(folder / file);
        reader.for_each_row([&](const ResultRow& row) {
            fell[row.cell] += row.outcome.state == State::collapsed;
            n[row.cell] += 1;
        });
        for (std::size_t cell = 0; cell < 4; ++cell) {
            fell[cell] /= n[cell];
            fell[4] += fell[cell] / 4;
        }
        return fell;
    }
};

const std::vector<std::string> laws = {"softer", "stiffer", "rigid", "ends"};

TEST_F(LawsProgram, TheBandIsThatOfTheRows)
{
    ASSERT_EQ(run({"run", "col.toml", "-o", "plain.h5"}).status, 0);
    const Ended ended = run({"run", "col.toml", "--laws", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_TRUE(bytes("col.h5") == bytes("plain.h5")); // the study's own results know nothing of it
    EXPECT_NE(ended.err.find("contact laws: softer "), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("times that"), std::string::npos) << ended.err;

    const JsonValue band = json_of(ended)["contact_laws"], collapse = band["limit_states"]["collapse"];
    EXPECT_EQ(band["file"].text, "col_laws.h5");
    std::vector<std::vector<double>> all = {shares("col.h5")};
    for (const std::string& law : laws)
        all.push_back(shares("col_law_" + law + ".h5"));
    bool wide = false;
    for (std::size_t cell = 0; cell < 5; ++cell) {
        const JsonValue place = cell < 4 ? collapse["cells"].items[cell] : collapse["overall"];
        double low = 1, high = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            low = std::min(low, all[i][cell]);
            high = std::max(high, all[i][cell]);
            EXPECT_NEAR(place["probability"][i == 0 ? "as given" : laws[i - 1]].number, all[i][cell], 1e-12);
        }
        EXPECT_NEAR(place["lowest"].number, low, 1e-12) << cell;
        EXPECT_NEAR(place["highest"].number, high, 1e-12) << cell;
        EXPECT_EQ(place["probability"][place["lowest_law"].text].number, place["lowest"].number);
        EXPECT_EQ(place["probability"][place["highest_law"].text].number, place["highest"].number);
        wide = wide || high > low;
    }
    EXPECT_TRUE(wide);

    // again: nothing is run
    const std::string file = bytes("col_laws.h5");
    const auto written = fs::last_write_time(folder / "col_laws.h5");
    for (const std::string& law : laws)
        fs::remove(folder / ("col_law_" + law + ".h5")); // they are not needed any more
    const Ended again = run({"run", "col.toml", "--laws"});
    EXPECT_EQ(again.status, 0) << testing::PrintToString(again);
    EXPECT_NE(again.out.find("contact law: "), std::string::npos) << again.out;
    EXPECT_EQ(fs::last_write_time(folder / "col_laws.h5"), written);
    EXPECT_FALSE(fs::exists(folder / "col_law_rigid.h5"));

    // what reads the results finds it
    const std::string line = again.out.substr(again.out.find("contact law: "));
    const std::string words = line.substr(0, line.find(", "));
    EXPECT_NE(run({"info", "col.h5"}).out.find(words), std::string::npos);
    EXPECT_EQ(
        json_of(run({"info", "col.h5", "--json"}))["contact_laws"]["limit_states"]["collapse"]["overall"]["lowest"]
            .number,
        collapse["overall"]["lowest"].number);
    ASSERT_EQ(run({"export", "col.h5", "--to", "csv"}).status, 0);
    const std::string csv = bytes("col_csv/contact_laws.csv");
    EXPECT_TRUE(csv.starts_with("limit_state,cell,frequency_hz,pga_m_s2,lowest,lowest_law,highest,highest_law,"
                                "probability_as_given,probability_softer"))
        << csv;
    EXPECT_NE(csv.find("collapse,3,"), std::string::npos);
    EXPECT_NE(csv.find("collapse,all,"), std::string::npos);
    const Ended page = run({"report", "col.h5", "--animate", "0"});
    ASSERT_EQ(page.status, 0) << testing::PrintToString(page);
    EXPECT_NE(read_page(folder / "col.html").find("C" + words.substr(1)), std::string::npos); // its own sentence
    EXPECT_NE(bytes("col.html").find("Contact law"), std::string::npos);
    EXPECT_EQ(bytes("col.html").find("--laws"), std::string::npos);
    // the picture differs from that of the same results without a band
    const Ended with = run({"export", "col.h5", "-o", "with.svg"}),
                without = run({"export", "plain.h5", "-o", "no.svg"});
    ASSERT_EQ(with.status, 0) << testing::PrintToString(with);
    EXPECT_NE(bytes("with.svg").find(words), std::string::npos);
    EXPECT_EQ(without.status, 0);
    EXPECT_EQ(bytes("no.svg").find("contact law"), std::string::npos);
}

TEST_F(LawsProgram, WithoutABandThePageAndTheSummaryStateHowItIsMeasured)
{
    const Ended ended = run({"run", "col.toml"});
    EXPECT_NE(ended.out.find("The answer depends on the contact law: stylobate run STUDY.toml --laws measures"),
              std::string::npos)
        << ended.out;
    ASSERT_EQ(run({"report", "col.h5", "--animate", "0"}).status, 0);
    EXPECT_NE(bytes("col.html").find("The answer depends on the contact law: stylobate run STUDY.toml --laws"),
              std::string::npos);
    EXPECT_FALSE(json_of(run({"info", "col.h5", "--json"})).has("contact_laws"));
    // the band of another study, or a file of that name that is none, is not its band
    ASSERT_EQ(run({"run", "col.toml", "--laws", "--set", "study.seed=2", "-o", "other.h5"}).status, 0);
    fs::copy_file(folder / "other_laws.h5", folder / "col_laws.h5");
    EXPECT_FALSE(json_of(run({"info", "col.h5", "--json"})).has("contact_laws"));
    expect_refused({"run", "col.toml", "--laws"}, {"col_laws.h5", "comparison of other studies", "-o"});
    write_bytes(folder / "col_laws.h5", "no such thing");
    EXPECT_EQ(run({"report", "col.h5", "--animate", "0", "--force"}).status, 0);
}

TEST_F(LawsProgram, ContinuesWhatWasInterrupted)
{
    write_study("col.toml", "kind = \"surface\"\nrealizations = 150");
    ASSERT_EQ(run({"run", "col.toml", "--laws", "-o", "whole.h5"}).status, 0);
    int interruptions = 0;
    Ended ended;
    for (int part = 0; part < 6; ++part) {
        ProgramRun program{.arguments = {"run", "col.toml", "--laws", "--threads", part % 2 ? "2" : "1"}};
        program.signal = part % 2 == 0 ? SIGINT : SIGKILL;
        program.when = when_there(folder / (part < 2 ? "col_law_softer.h5" : "col_law_rigid.h5"));
        if (part == 5)
            program.signal = 0;
        ended = run(program);
        if (ended.status == 0)
            break;
        if (ended.status == 130) {
            ++interruptions;
            EXPECT_NE(ended.out.find("the study is complete, its runs under other contact laws are not"),
                      std::string::npos)
                << ended.out;
            EXPECT_FALSE(fs::exists(folder / "col_laws.h5"));
        }
    }
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_GT(interruptions, 0);
    EXPECT_TRUE(bytes("col.h5") == bytes("whole.h5"));
    for (const std::string& law : laws)
        EXPECT_TRUE(bytes("col_law_" + law + ".h5") == bytes("whole_law_" + law + ".h5")) << law;
}

TEST_F(LawsProgram, RefusesWhatHasNoPairsAndNoLaw)
{
    const std::string adaptive = "surface.adaptive={ budget = 40 }", counts = "output.realizations=\"none\"";
    expect_refused({"run", "col.toml", "--laws", "--set", adaptive}, {"--laws", "surface.adaptive"});
    expect_refused({"run", "col.toml", "--laws", "--set", counts}, {"--laws", "output.realizations = \"all\""});
    write_study("rigid.toml", "kind = \"surface\"\nrealizations = 4", "", "form = \"rigid\"\n");
    expect_refused({"run", "rigid.toml", "--laws"},
                   {"no other contact law applies", "softer", "two_corner", "rigid contacts are then among the laws"});
    EXPECT_EQ(run({"run", "col.toml", "--laws", "--shard", "1/2"}).status, 2);
    write_bytes(folder / "col_law_rigid.h5", "something");
    expect_refused({"run", "col.toml", "--laws"}, {"col_law_rigid.h5"});
    EXPECT_FALSE(fs::exists(folder / "col.h5"));
}

TEST_F(LawsProgram, AFragilityStudyHasABandOfEachStripe)
{
    write_bytes(folder / "frag.toml", short_fragility_study("from = 4, to = 12, count = 3", ""));
    const Ended ended = run({"run", "frag.toml", "--laws", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue limits = json_of(ended)["contact_laws"]["limit_states"];
    EXPECT_EQ(limits["collapse"]["cells"].items.size(), 3U);
    EXPECT_TRUE(limits.has("peak_0.35"));
    ASSERT_EQ(run({"export", "frag.h5", "--to", "json"}).status, 0);
    EXPECT_NE(bytes("frag_json/contact_laws.json").find("\"lowest_law\""), std::string::npos);
    ASSERT_EQ(run({"report", "frag.h5", "--animate", "0"}).status, 0);
    EXPECT_NE(bytes("frag.html").find("The contact law of a monument is not known."), std::string::npos);
}

TEST_F(LawsProgram, CheckReportsTheBandBesideTheNumerics)
{
    const Ended text = run({"check", "col.toml", "--pilot", "32", "--trial-seconds", "0"});
    ASSERT_EQ(text.status, 0) << testing::PrintToString(text);
    EXPECT_NE(text.out.find("contact law: "), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("; numerics: "), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("stylobate run col.toml --laws"), std::string::npos) << text.out;
    EXPECT_NE(text.err.find("realizations under each, about"), std::string::npos) << text.err;
    const JsonValue band =
        json_of(run({"check", "col.toml", "--pilot", "32", "--trial-seconds", "0", "--json"}))["contact_law"];
    EXPECT_TRUE(band["measured"].boolean);
    EXPECT_EQ(band["laws"].items.size(), 4U);
    double low = band["as_given"].number, high = low;
    for (const JsonValue& law : band["laws"].items) {
        low = std::min(low, law["collapse_probability"].number);
        high = std::max(high, law["collapse_probability"].number);
        EXPECT_EQ(law["realizations"].number, 32);
    }
    EXPECT_EQ(band["lowest"].number, low);
    EXPECT_EQ(band["highest"].number, high);
    const JsonValue skipped =
        json_of(run({"check", "col.toml", "--pilot", "32", "--trial-seconds", "0", "--law-seconds", "0", "--json"}));
    EXPECT_FALSE(skipped["contact_law"]["measured"].boolean);
    EXPECT_TRUE(skipped.has("error_of_the_numerics"));
}

} // namespace
} // namespace stylobate

/// `stylobate diagnose` as its user runs it, on short campaigns of the virtual laboratory.

#include "io/measured/campaign_writer.hpp"
#include "tests/io/measured/measured_samples.hpp"
#include "tests/program/program.hpp"

#include "io/measured/measured_file.hpp"

namespace stylobate {
namespace {

/// Made by the fixture `hidden_campaigns`.
const fs::path campaigns = STYLOBATE_HIDDEN_CAMPAIGNS;

std::string campaign(int seed)
{
    return (campaigns / ("campaign_" + std::to_string(seed) + ".h5")).string();
}

class DiagnosisProgram : public Program {
protected:
    void SetUp() override
    {
        Program::SetUp();
        for (const int seed : {1, 4, 19})
            ASSERT_TRUE(fs::exists(campaign(seed)))
                << campaign(seed) << " is absent: ctest makes it, or hidden_campaigns generate --short";
    }

    JsonValue diagnosed(int seed, const Words& more = {}) const
    {
        Words words = {"diagnose", campaign(seed), "-o", "d.h5", "--nulls", "6", "--threads", "1", "--json", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        return json_of(ended);
    }
    void expect_none(int seed)
    {
        const JsonValue d = diagnosed(seed);
        EXPECT_EQ(d["verdict"].text, "none") << d["text"].text;
        EXPECT_TRUE(d["causes"].items.empty());
        EXPECT_EQ(d["nulls"].items.size(), 1u);
        EXPECT_EQ(names(), (Words{"d.h5", "d_campaigns.txt"}));
    }
};

TEST_F(DiagnosisProgram, NothingHiddenIsNone)
{
    expect_none(1);
}

TEST_F(DiagnosisProgram, NothingHiddenUnderTheOtherLawIsNoneLong)
{
    expect_none(19);
}

TEST_F(DiagnosisProgram, APitchingTableIsNamedLong)
{
    // the laboratory's own answer: what is hidden, and how much
    const std::string answer = read_bytes(campaigns / "answers" / "4.toml");
    ASSERT_NE(answer.find("name = \"table_pitch\""), std::string::npos) << answer;
    const std::size_t at = answer.find("\nsize = ");
    ASSERT_NE(at, std::string::npos) << answer;
    const double size = std::stod(answer.substr(at + 8));

    const JsonValue d = diagnosed(4);
    EXPECT_EQ(d["verdict"].text, "named") << d["text"].text;
    ASSERT_EQ(d["causes"].items.size(), 1u);
    const JsonValue& cause = d["causes"].items.front();
    EXPECT_EQ(cause["name"].text, "table_pitch");
    EXPECT_EQ(cause["place"].text, "base");
    EXPECT_NEAR(cause["size"].number, size, 0.2 * size); // soft contacts lean by a tenth
    EXPECT_GT(cause["probability"].number, 0.5);
    EXPECT_EQ(names(), (Words{"d.h5", "d_campaigns.txt", "d_extended.toml"}));
    EXPECT_NE(read_bytes(folder / "d_extended.toml").find("table_pitch"), std::string::npos);

    // the page: the motion where the simulation is wrong, measured and simulated; and the gain of what is named, which
    // was found without campaigns that say what chance gives
    ASSERT_EQ(run({"report", "d.h5", "--quiet"}).status, 0);
    const std::string page = read_bytes(folder / "d.html");
    const std::size_t motions = count_of(page, ">measured, ± 2 sd of the noise</text>");
    EXPECT_GE(motions, 2u);
    EXPECT_EQ(motions % 2, 0u) << "x and rotation of each run";
    EXPECT_EQ(count_of(page, ">calibrated baseline, restarted in each window</text>"), motions);
    EXPECT_GE(count_of(page, ">error above noise and a short lag</text>"), 1u);
    EXPECT_EQ(count_of(page, "id=\"animations\""), 1u);
    EXPECT_EQ(count_of(page, ">worst of all</td>"), 1u);
    EXPECT_EQ(count_of(page, ">typical: the median</td>"), 1u);
    EXPECT_EQ(count_of(page, ">extended study</text>"), 1u); // of the still picture's legend
    const std::size_t chart = page.find("aria-label=\"Gain of each cause");
    ASSERT_NE(chart, std::string::npos);
    const std::string svg = page.substr(chart, page.find("</svg>", chart) - chart);
    EXPECT_NE(svg.find(">named as the cause</text>"), std::string::npos);
    EXPECT_NE(svg.find(">table_pitch, base</text>"), std::string::npos);
    fs::remove(folder / "d.html");

    // again: what chance gives is not simulated anew, and nothing else comes of it
    const std::string kept = read_bytes(folder / "d_campaigns.txt");
    // what it is of, and a line for each campaign: 36 scouts, 24 of the rounds, 6 nulls, 3 of each cause
    const std::size_t lines = count_of(kept, "\n");
    EXPECT_GT(lines, 1u + 66u);
    EXPECT_EQ((lines - 1 - 66) % 3, 0u);
    expect_refused({"diagnose", campaign(4), "-o", "d.h5", "--quiet"}, {"d.h5", "exists already", "--force"});
    const JsonValue again = diagnosed(4, {"--force"});
    EXPECT_EQ(read_bytes(folder / "d_campaigns.txt"), kept);
    EXPECT_LT(again["simulations"].number, d["simulations"].number);
    EXPECT_EQ(again["text"].text, d["text"].text);
}

TEST_F(DiagnosisProgram, WithAStudyOfItsOwnLong)
{
    const std::string study = (campaigns / "campaign_4.toml").string();
    const JsonValue d = diagnosed(4, {"--study", study});
    EXPECT_EQ(d["verdict"].text, "named") << d["text"].text;
    ASSERT_EQ(d["causes"].items.size(), 1u);
    EXPECT_EQ(d["causes"].items.front()["name"].text, "table_pitch");
}

TEST_F(DiagnosisProgram, BadInputLeavesNothing)
{
    expect_refused({"diagnose", "absent.h5", "-o", "d.h5"}, {"absent.h5"});
    write_bytes(folder / "no.h5", "not HDF5");
    expect_refused({"diagnose", "no.h5", "-o", "d.h5"}, {"no.h5"});
    expect_refused({"diagnose", campaign(4), "--study", "absent.toml", "-o", "d.h5"}, {"absent.toml"});
    expect_refused({"diagnose", campaign(4), "-o", folder.string()}, {"it is a folder"});

    // what is to keep the simulated campaigns is somebody's own
    const std::string own = "my campaigns of last year\n";
    write_bytes(folder / "d_campaigns.txt", own);
    expect_refused({"diagnose", campaign(4), "-o", "d.h5", "--quiet"}, {"d_campaigns.txt", "keeps no simulated"});
    EXPECT_EQ(read_bytes(folder / "d_campaigns.txt"), own);
    fs::remove(folder / "d_campaigns.txt");

    // blocks of which x and y were measured, but not how they turn: no forces
    Campaign blind = sample_campaign();
    for (MeasuredRun& run : blind.runs)
        run.blocks.theta_rad = {};
    write_campaign(blind, folder / "blind.h5");
    expect_refused({"diagnose", "blind.h5", "-o", "d.h5", "--quiet"}, {"blind.h5", "rotation"});
    // and none at all
    for (MeasuredRun& run : blind.runs)
        run.blocks = {};
    fs::remove(folder / "blind.h5");
    try {
        write_campaign(blind, folder / "blind.h5");
    } catch (const InputError&) {
        return; // such a file cannot even be written
    }
    expect_refused({"diagnose", "blind.h5", "-o", "d.h5", "--quiet"}, {"blind.h5"});
}

} // namespace
} // namespace stylobate

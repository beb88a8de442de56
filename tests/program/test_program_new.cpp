/// `stylobate new` and `stylobate schema`: a study for who has none, and what is known of its keys.

#include "tests/program/program.hpp"

namespace stylobate {
namespace {

class NewStudy : public Program {};

TEST_F(NewStudy, RunsAsItStands)
{
    // as few realizations as each kind allows, and a short motion
    const std::map<std::string, Words> kinds = {
        {"single", {}},
        {"surface",
         {"study.realizations=1", "surface.frequency_hz.count=1", "surface.frequency_hz.from=2",
          "surface.pga_m_s2.count=1", "surface.pga_m_s2.from=8"}},
        {"fragility", {"study.realizations=1", "fragility.motions=8", "fragility.intensity.count=2"}},
        {"sensitivity", {"sensitivity.samples=2"}},
        {"rare", {"rare.samples=200", "rare.repeats=5", "excitation.pga_m_s2=8"}},
        {"survival",
         {"study.realizations=1", "surface.frequency_hz.count=1", "surface.frequency_hz.from=2",
          "surface.pga_m_s2.count=3", "surface.pga_m_s2.from=6"}}};
    for (const auto& [kind, settings] : kinds) {
        const Ended made = run({"new", kind});
        ASSERT_EQ(made.status, 0) << testing::PrintToString(made);
        EXPECT_EQ(made.err, "");
        const std::size_t check = made.out.find("\n  stylobate check " + kind + ".toml "),
                          runs = made.out.find("\n  stylobate run " + kind + ".toml\n");
        EXPECT_LT(check, runs) << made.out;
        EXPECT_NE(runs, std::string::npos) << made.out;
        const Ended ended = run(run_words(kind + ".toml", settings, {"-o", kind + ".h5", "--quiet"}));
        EXPECT_EQ(ended.status, 0) << kind << testing::PrintToString(ended);
        EXPECT_EQ(ended.err, "") << "no warnings";
        EXPECT_TRUE(fs::exists(folder / (kind + ".h5"))) << kind;
    }
}

TEST_F(NewStudy, ReplacesNothing)
{
    ASSERT_EQ(run({"new", "single", "--quiet", "-o", "mine.toml"}).out, "mine.toml\n");
    const std::string before = read_bytes(folder / "mine.toml");
    expect_refused({"new", "surface", "-o", "mine.toml"}, {"mine.toml", "exists already", "--force"});
    EXPECT_EQ(read_bytes(folder / "mine.toml"), before);
    EXPECT_EQ(run({"new", "surface", "-o", "mine.toml", "--force"}).status, 0);
    EXPECT_NE(read_bytes(folder / "mine.toml"), before);
}

TEST_F(NewStudy, RefusesWhatIsNoKind)
{
    expect_refused({"new"}, {"KIND is required"});
    expect_refused({"new", "surfac"}, {"surfac", "surface"});
    expect_refused({"new", "single", "--structure", "temple"}, {"temple", "colonnade"});
    expect_refused({"new", "colonnade"}, {"stylobate new surface --structure colonnade"});
    expect_refused({"new", "survival", "--dimensions", "3"}, {"\"survival\" cannot have structure.dimensions = 3"});
    expect_refused({"new", "single", "--dimensions", "4"}, {"dimensions", "4"});
    expect_refused({"new", "rare", "--excitation", "noise"}, {"\"rare\" cannot have excitation.kind = \"noise\""});
    expect_refused({"new", "single", "-o", "no_such_folder/a.toml"}, {"no_such_folder"});
}

TEST_F(NewStudy, NamesTheKeyOfTheRecordThatIsMissing)
{
    ASSERT_EQ(run({"new", "single", "--excitation", "record", "--quiet"}).status, 0);
    expect_refused({"run", "single.toml"}, {"record.at2", "no such file", "excitation.file"});
}

TEST_F(NewStudy, IsToldWithoutBlanksAtTheEndsOfLines)
{
    for (const char* kind : {"single", "surface", "fragility"}) {
        ASSERT_EQ(run({"new", kind, "--quiet"}).status, 0);
        const Ended told = run({"info", std::string(kind) + ".toml"});
        EXPECT_EQ(told.out.find(" \n"), std::string::npos) << told.out;
    }
}

/// The frequencies to begin with are those between which the column's fate changes: half of them leave it standing.
TEST_F(NewStudy, ASurfaceShowsWhereTheColumnFalls)
{
    ASSERT_EQ(run({"new", "surface", "--quiet"}).status, 0);
    const Ended ended = run(run_words("surface.toml", {"study.realizations=2"}, {"-o", "s.h5"}));
    EXPECT_NE(ended.out.find("128 of 128 realizations"), std::string::npos) << testing::PrintToString(ended);
    const double collapsed =
        json_of(run({"run", "surface.toml", "--set", "study.realizations=2", "-o", "s.h5", "--json"}))["collapsed"]
            .number;
    EXPECT_GT(collapsed, 128 / 4);
    EXPECT_LT(collapsed, 128 / 2);
}

TEST_F(NewStudy, WritesACampaignForEachKindOfTest)
{
    const Ended made = run({"new", "campaign", "--test", "push", "-o", "lab"});
    ASSERT_EQ(made.status, 0) << testing::PrintToString(made);
    EXPECT_EQ(made.err, "");
    EXPECT_NE(made.out.find("lab/campaign.toml\nlab/runs/push_1.csv\n"), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("stylobate info lab "), std::string::npos) << made.out;
    expect_refused({"info", "lab"}, {"run push_1", "no samples"});
    std::ofstream(folder / "lab/runs/push_1.csv", std::ios::app) << "0,0,0,14.5,0,0,43.5,0\n0.01,0,0,14.5,0,0,43.5,0\n";
    const Ended told = run({"info", "lab"});
    EXPECT_EQ(told.status, 0) << testing::PrintToString(told);
    EXPECT_NE(told.out.find("tests of joints: 1 push"), std::string::npos) << told.out;

    EXPECT_EQ(run({"new", "campaign", "--test", "rest", "--quiet"}).out, "campaign/campaign.toml\n");
    EXPECT_EQ(run({"info", "campaign"}).status, 0);
    expect_refused({"new", "campaign", "-o", "lab"}, {"lab", "holds files already", "--force"});
    EXPECT_EQ(run({"new", "campaign", "-o", "lab", "--force"}).status, 0);
    expect_refused({"new", "campaign", "--test", "pul"}, {"pul", "pull"});
    expect_refused({"new", "campaign", "--structure", "column"}, {"--structure", "not of a campaign"});
    expect_refused({"new", "single", "--test", "pull"}, {"--test is of a campaign"});
}

TEST_F(NewStudy, TheSchemaIsOneJsonObject)
{
    const Ended schema = run({"schema"});
    EXPECT_EQ(schema.status, 0);
    EXPECT_EQ(schema.err, "");
    EXPECT_TRUE(json_of(schema)["properties"].has("structure"));
    const Ended page = run({"schema", "--markdown"});
    EXPECT_EQ(page.out, read_bytes(fs::path(STYLOBATE_SOURCE_DIR) / "docs/study_reference.md"));
}

} // namespace
} // namespace stylobate

/// What the program says, writes and refuses of the results of a structure in space.

#include "tests/program/program.hpp"

#include "ensemble/spatial/spatial_poses.hpp"

namespace stylobate {
namespace {

class SpatialResultsProgram : public Program {
protected:
    /// Two realizations in each of four cells of the round column.
    void make(const std::string& results) const
    {
        const Ended ended =
            run({"run", std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/round_column.toml", "--set",
                 "study.realizations=2", "--set", "surface.frequency_hz={from=0.5,to=1.0,count=2}", "--set",
                 "surface.pga_m_s2={from=2.0,to=8.0,count=2}", "-o", results, "--quiet"});
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    }
    /// One realization in each of four cells of direction and PGA of a column of two drums.
    void make_over_directions(const std::string& results) const
    {
        write_bytes(folder / "round.toml", R"([study]
kind = "surface"
realizations = 1
[structure]
dimensions = 3
blocks = 2
drum_width_m = 0.5
drum_height_m = 0.8
density_kg_m3 = 2700
[contact]
normal_stiffness_n_m3 = 1e9
friction = 0.7
[excitation]
kind = "full_sine"
frequency_hz = 1.5
tail_s = 0.5
[surface]
direction_deg = { from = 0, to = 60, count = 2 }
pga_m_s2 = { from = 2, to = 4, count = 2 }
)");
        const Ended ended = run({"run", "round.toml", "-o", results, "--quiet"});
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    }
    void ends_well(const Words& words) const
    {
        const Ended ended = run(words);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    }
};

TEST_F(SpatialResultsProgram, AreReplayedVerifiedAndExported)
{
    make("a.h5");
    const Ended replayed = run({"replay", "a.h5", "--realization", "5", "-o", "one.h5", "--json"});
    const JsonValue json = json_of(replayed);
    EXPECT_TRUE(json["same_bits"].boolean);
    const ResultRow row = ResultReader(folder / "a.h5").row(5);
    EXPECT_EQ(json["max_twist_rad"].number, row.outcome.max_twist_rad);
    EXPECT_EQ(json["out_of_plane_share"].number, row.outcome.out_of_plane_share);
    EXPECT_TRUE(json.has("fall_azimuth_rad") && json.has("fallen_column") && !json.has("top_path_m"));

    const ResultReader one(folder / "one.h5");
    EXPECT_EQ(one.header().dimensions, 3);
    const Trajectory t = one.trajectory(5);
    ASSERT_TRUE(is_spatial(t));
    ASSERT_EQ(t.blocks(), 6U);
    for (std::size_t i = 0; i < t["q_w"].size(); ++i) {
        const double length = std::hypot(std::hypot(t["q_w"][i], t["q_x"][i]), std::hypot(t["q_y"][i], t["q_z"][i]));
        ASSERT_NEAR(length, 1, 1e-3) << i;
    }
    for (const char* file : {"a.h5", "one.h5"})
        ends_well({"verify-file", file});
    ends_well({"export", "a.h5", "--to", "csv", "-o", "tables"});
    ends_well({"export", "one.h5", "--to", "csv", "-o", "one_tables"});
    EXPECT_TRUE(fs::exists(folder / "one_tables" / "trajectory_5.csv"));
    ends_well({"export", "one.h5", "--to", "vtk", "-o", "vtk"});
    EXPECT_TRUE(fs::exists(folder / "vtk" / "realization_5.pvd"));
    EXPECT_NE(bytes("vtk/realization_5_00000.vtp").find("Name=\"tilt\""), std::string::npos);
}

TEST_F(SpatialResultsProgram, HaveDirectionsAsRows)
{
    make_over_directions("d.h5");
    const ResultReader reader(folder / "d.h5");
    EXPECT_EQ(reader.header().direction_deg, (std::vector<double>{0, 60}));
    EXPECT_TRUE(reader.header().frequency_hz.empty());
    EXPECT_EQ(reader.surface().trials, (std::vector<std::uint64_t>{1, 1, 1, 1}));
    EXPECT_EQ(reader.row(2).frequency_hz, 1.5);
    ends_well({"verify-file", "d.h5"});
    ends_well({"export", "d.h5", "--to", "csv", "-o", "tables"});
    const std::string cells = bytes("tables/surface.csv"), rows = bytes("tables/realizations.csv");
    EXPECT_EQ(cells.substr(0, cells.find(",trials")), "cell,direction_deg,pga_m_s2");
    EXPECT_NE(cells.find("\n2,60,2,1,"), std::string::npos) << cells;
    EXPECT_NE(rows.find(",pga_m_s2,direction_deg,"), std::string::npos) << rows;
    EXPECT_NE(rows.find("\n3,3,1.5,4,60,"), std::string::npos) << rows;
    ends_well({"report", "d.h5", "-o", "page.html"});
    EXPECT_NE(bytes("page.html").find("direction of the shaking [°]"), std::string::npos);
    const Ended replayed = run({"replay", "d.h5", "--direction", "60", "--pga", "4", "--nth", "1", "--json"});
    EXPECT_EQ(json_of(replayed)["realization"].number, 3);
    EXPECT_TRUE(json_of(replayed)["same_bits"].boolean);
    const Ended other = run({"replay", "d.h5", "--frequency", "1.5"});
    EXPECT_EQ(other.status, 2) << testing::PrintToString(other);
    EXPECT_NE(other.err.find("--direction and --pga"), std::string::npos) << other.err;
    const Ended slice = run({"export", "d.h5", "--to", "png", "--frequency", "60"});
    EXPECT_EQ(slice.status, 2) << testing::PrintToString(slice);
    EXPECT_NE(slice.err.find("a surface over directions"), std::string::npos) << slice.err;
}

TEST_F(SpatialResultsProgram, AreShownInMotionOnPagesAndInPictures)
{
    make("a.h5");
    const Ended strip = run({"export", "a.h5", "--to", "png", "--picture", "strip", "--realization", "1"});
    EXPECT_EQ(strip.status, 0) << testing::PrintToString(strip);
    EXPECT_EQ(bytes("a_strip_realization_1.png").substr(1, 3), "PNG");
    const Ended film = run({"export", "a.h5", "--to", "html", "--realization", "1"});
    EXPECT_EQ(film.status, 0) << testing::PrintToString(film);
    EXPECT_NE(bytes("a_realization_1.html").find("canvas"), std::string::npos);
    const Ended page = run({"report", "a.h5", "-o", "page.html"});
    EXPECT_EQ(page.status, 0) << testing::PrintToString(page);
}

} // namespace
} // namespace stylobate

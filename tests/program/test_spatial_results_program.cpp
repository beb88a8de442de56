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

TEST_F(SpatialResultsProgram, AreShownInMotionOnPagesAndHaveNoStripYet)
{
    make("a.h5");
    const Ended strip = run({"export", "a.h5", "--to", "png", "--picture", "strip", "--realization", "1"});
    EXPECT_EQ(strip.status, 2) << testing::PrintToString(strip);
    EXPECT_NE(strip.err.find("in space"), std::string::npos) << strip.err;
    const Ended film = run({"export", "a.h5", "--to", "html", "--realization", "1"});
    EXPECT_EQ(film.status, 0) << testing::PrintToString(film);
    EXPECT_NE(bytes("a_realization_1.html").find("canvas"), std::string::npos);
    const Ended page = run({"report", "a.h5", "-o", "page.html"});
    EXPECT_EQ(page.status, 0) << testing::PrintToString(page);
}

} // namespace
} // namespace stylobate

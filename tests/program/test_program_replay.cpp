/// `stylobate replay` as its user runs it: choosing a realization by where it stands and how it ended, and what is told
/// of its collapse and of its top.

#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

class Replay : public Program {
protected:
    void make(const std::string& study, const Words& settings, const std::string& results) const
    {
        const Ended ended = run(run_words(study, settings, {"-o", results, "--quiet"}));
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    }
    Ended replay(const std::string& results, const Words& more) const
    {
        Words words = {"replay", results};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    std::vector<ResultRow> rows(const std::string& results) const { return ResultReader(folder / results).rows(); }
    /// The realization that was chosen.
    std::uint64_t chosen(const std::string& results, Words more) const
    {
        more.push_back("--json");
        return static_cast<std::uint64_t>(json_of(replay(results, more))["realization"].number);
    }
    void refused(const std::string& results, const Words& more, const std::string& part) const
    {
        const Ended ended = replay(results, more);
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(ended);
        EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
        EXPECT_EQ(ended.out, "");
    }
};

TEST_F(Replay, ChoosesByCellAndOutcome)
{
    make(column_study, short_surface(8), "a.h5"); // 4 to 8 Hz, 4 to 25 m/s2, four of each
    const std::vector<ResultRow> all = rows("a.h5");
    ASSERT_EQ(all.size(), 128U);
    // which cell has both, so that the choice matters
    std::uint64_t mixed = 16;
    std::vector<std::vector<std::uint64_t>> fell(16), stood(16);
    for (const ResultRow& row : all)
        (row.outcome.state == State::collapsed ? fell : stood)[row.cell].push_back(row.index);
    for (std::uint64_t cell = 0; cell < 16; ++cell)
        if (fell[cell].size() >= 2 && stood[cell].size() >= 2)
            mixed = cell;
    ASSERT_LT(mixed, 16U);
    const ResultRow& there = all[fell[mixed][1]];
    // not the axis' values themselves: the nearest are meant
    const std::string frequency = std::to_string(std::clamp(there.frequency_hz + 0.2, 4.0, 8.0));
    const std::string pga = std::to_string(std::clamp(there.pga_m_s2 - 1.0, 4.0, 25.0));
    const Words cell = {"--frequency", frequency, "--pga", pga};
    const auto with = [&](Words more) {
        more.insert(more.begin(), cell.begin(), cell.end());
        return more;
    };
    EXPECT_EQ(chosen("a.h5", with({"--fallen", "--nth", "2"})), fell[mixed][1]);
    EXPECT_EQ(chosen("a.h5", with({"--stood"})), stood[mixed][0]);
    EXPECT_EQ(chosen("a.h5", with({"--stood", "--nth", "2"})), stood[mixed][1]);
    EXPECT_EQ(chosen("a.h5", with({"--nth", "8"})), 8 * mixed + 7);
    // of all cells
    const auto first = std::find_if(all.begin(), all.end(),
                                    [](const ResultRow& row) { return row.outcome.state == State::collapsed; });
    EXPECT_EQ(chosen("a.h5", {"--fallen"}), first->index);

    const Ended told = replay("a.h5", with({"--fallen", "--nth", "2"}));
    EXPECT_EQ(told.status, 0);
    EXPECT_TRUE(told.out.starts_with("realization " + std::to_string(fell[mixed][1]) + " at ")) << told.out;
    EXPECT_NE(told.out.find("number 2 of the " + std::to_string(fell[mixed].size()) + " that fell, of 8 at "),
              std::string::npos)
        << told.out;
    EXPECT_NE(told.out.find("bitwise identical"), std::string::npos) << told.out;

    refused("a.h5", {"--frequency", "9", "--fallen"}, "--frequency 9: the axis of a.h5 goes from 4 to 8 Hz");
    refused("a.h5", {"--pga", "3", "--fallen"}, "--pga 3: the axis of a.h5 goes from 4 to 25 m/s2");
    refused("a.h5", {"--frequency", "nan"}, "--frequency");
    refused("a.h5", with({"--fallen", "--nth", "9"}), "--nth 9: only " + std::to_string(fell[mixed].size()) + " of 8");
    refused("a.h5", with({"--nth", "0"}), "counts from 1");
    refused("a.h5", {"--fallen", "--stood"}, "give one of them");
    refused("a.h5", {"--realization", "3", "--fallen"}, "omit the options");
    refused("a.h5", {"--realization", "128"}, "has realizations 0 to 127");
    refused("a.h5", {"--motion", "0"}, "not of a fragility study. Choose by --frequency and --pga.");
    refused("a.h5", {}, "no realization is given");
}

TEST_F(Replay, SaysWhereThereIsNone)
{
    Words settings = short_surface(4);
    settings.back() = "surface.pga_m_s2={from=0.1,to=0.2,count=2}";
    make(column_study, settings, "still.h5");
    refused("still.h5", {"--frequency", "4", "--pga", "0.2", "--fallen"},
            "no realization fell: 0 of 4 at 4 Hz, 0.2 m/s2");

    settings.push_back("output.realizations=\"none\"");
    make(column_study, settings, "counted.h5");
    refused("counted.h5", {"--fallen"}, "has no rows");
    EXPECT_EQ(chosen("counted.h5", {"--frequency", "8", "--pga", "0.1", "--nth", "3"}), 3U * 2 * 4 + 2);
}

TEST_F(Replay, ChoosesByMotionAndIntensity)
{
    make(STYLOBATE_SOURCE_DIR "/studies/inputs/fragility_column.toml",
         {"study.realizations=6", "fragility.motions=8",
          "fragility.intensity={measure=\"pgv\",from=0.3,to=2.4,count=4,spacing=\"log\"}"},
         "f.h5");
    const ResultReader reader(folder / "f.h5");
    const std::string name = reader.header().motions.names.at(3);
    // levels 0.3, 0.6, 1.2, 2.4; on the logarithmic axis 1.6 is nearer to 1.2 (0.29 of a factor e) than to 2.4 (0.41)
    for (const std::string& motion : {name, std::string("3")})
        EXPECT_EQ(chosen("f.h5", {"--motion", motion, "--intensity", "1.6", "--nth", "2"}), (3U * 4 + 2) * 6 + 1);
    std::uint64_t first = 0;
    for (first = 0; reader.row(first).outcome.state != State::collapsed || first / 6 % 4 != 3;)
        ++first;
    EXPECT_EQ(chosen("f.h5", {"--intensity", "2.4", "--fallen"}), first);
    refused("f.h5", {"--intensity", "3"}, "goes from 0.3 to 2.4 of pgv");
    refused("f.h5", {"--motion", "8"}, "by number from 0 to 7");
    refused("f.h5", {"--pga", "3"}, "Choose by --motion and --intensity");
}

TEST_F(Replay, TellsATotalCollapseOnlyWhereItIsKnown)
{
    // seven drums, ended at the first fall: what would have become of the others is not known
    make(column_study, eight_realizations, "first.h5");
    const Ended first = replay("first.h5", {"--fallen"});
    EXPECT_NE(first.out.find("collapsed at"), std::string::npos) << first.out;
    EXPECT_EQ(first.out.find("total collapse"), std::string::npos) << first.out;
    EXPECT_NE(first.out.find("computed only until the first fall"), std::string::npos) << first.out;
    EXPECT_EQ(json_of(replay("first.h5", {"--fallen", "--json"}))["total_collapse_time_s"].kind, JsonValue::Kind::null);
    const Ended standing = replay("first.h5", {"--stood"});
    EXPECT_EQ(standing.out.find("first fall"), std::string::npos) << standing.out;

    // one free block: its fall is all there is
    Words alone = eight_realizations;
    alone.insert(alone.end(), {"structure.blocks=2", "structure.drum_height_m=0.2", "structure.drum_mass_kg=0.9"});
    make(column_study, alone, "alone.h5");
    const JsonValue json = json_of(replay("alone.h5", {"--fallen", "--json"}));
    EXPECT_EQ(json["total_collapse_time_s"].number, json["collapse_time_s"].number);
    EXPECT_NE(replay("alone.h5", {"--fallen"}).out.find("total collapse at"), std::string::npos);

    // followed to rest
    Words rest = eight_realizations;
    rest.insert(rest.end(), {"outcome.follow=\"rest\"", "study.realizations=1"});
    make(column_study, rest, "rest.h5");
    EXPECT_NE(replay("rest.h5", {"--fallen"}).out.find("total collapse at"), std::string::npos);
}

TEST_F(Replay, OneReferenceForTheTop)
{
    // A block that leans by theta about its corner: its centre is h sin(theta) + b (1 - cos(theta)) from upright, and
    // rocks to and fro between such places, a little less each time.
    make(STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml", {}, "rocking.h5");
    const ResultReader reader(folder / "rocking.h5");
    const Trajectory t = reader.trajectory(0);
    const double b = t["half_width_m"][0], h = t["half_height_m"][0], theta = std::abs(t["theta_rad"][0]);
    const double leaned = h * std::sin(theta) + b * (1 - std::cos(theta));
    ASSERT_EQ(t["rest_x_m"].size(), 1U);
    EXPECT_EQ(t["rest_y_m"][0], h); // upright, its face just touching the base
    double peak = 0;
    for (const double x : t["x_m"])
        peak = std::max(peak, std::abs(x - t["rest_x_m"][0]));
    EXPECT_NEAR(peak, leaned, 1e-3 * leaned);
    EXPECT_NEAR(reader.row(0).outcome.peak_top_displacement_m, leaned, 1e-3 * leaned);
    EXPECT_NEAR(reader.row(0).outcome.peak_top_displacement_m, peak, 1e-6);
}

} // namespace
} // namespace stylobate

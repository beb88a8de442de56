/// Single studies by the program: which trajectories are kept, what they weigh, how fast it goes; and what a study that
/// can hardly be meant is told.

#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"
#include "studies/kinds/single/single_kind.hpp"
#include "studies/workflow/console.hpp"

namespace stylobate {
namespace {

using Single = Program;

const std::string mechanisms = STYLOBATE_SOURCE_DIR "/studies/inputs/mechanisms.toml";

/// Five seconds of shaking and one after it at 1000 samples a second: 6001 samples of 7 blocks at most.
std::vector<std::string> seven_blocks(int realizations, const std::vector<std::string>& more = {})
{
    std::vector<std::string> settings = {"study.realizations=" + std::to_string(realizations),
                                         "contact.normal_stiffness_n_m2=1e7",
                                         "excitation.frequency_hz=2",
                                         "excitation.pga_m_s2=1",
                                         "excitation.tail_s=1",
                                         "output.trajectory_rate_hz=1000"};
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}
constexpr double each_mb = 6001 * (2 + 3 * 7) * 8 / 1e6; // 1.104

TEST(Progress, SlowRatesAreNotZero)
{
    Progress p;
    p.done = 2;
    p.total = 10;
    p.rate = 0.4;
    EXPECT_TRUE(progress_line(p).starts_with("2 of 10 realizations, 0.4/s, 20 s left")) << progress_line(p);
    p.rate = 0.03125;
    EXPECT_TRUE(progress_line(p).starts_with("2 of 10 realizations, 0.031/s, 4 min 16 s left")) << progress_line(p);
    p.rate = 3.21;
    EXPECT_TRUE(progress_line(p).starts_with("2 of 10 realizations, 3.2/s, 2 s left")) << progress_line(p);
    p.rate = 1873.6;
    EXPECT_TRUE(progress_line(p).starts_with("2 of 10 realizations, 1874/s, 0 s left")) << progress_line(p);
    p.rate = 0; // nothing is known yet
    EXPECT_EQ(progress_line(p), "2 of 10 realizations");
}

TEST(Progress, OfALongRealizationIsItsSimulatedTime)
{
    Progress p;
    p.total = 1;
    p.seconds = 60;
    p.furthest = {2, 200};
    EXPECT_EQ(progress_line(p), "0 of 1 realizations, 2 of at most 200 s simulated, at most 1 h 39 min left");
    p.total = 5;
    EXPECT_EQ(progress_line(p), "0 of 5 realizations, 2 of at most 200 s simulated");
    p.done = 1;
    EXPECT_EQ(progress_line(p), "1 of 5 realizations");
}

TEST_F(Single, RateAndBlockStepsAreCounted)
{
    const Ended ended = run(run_words(mechanisms, seven_blocks(3), {"-o", "a.h5", "--json"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    const double seconds = json["seconds"].number;
    EXPECT_GT(seconds, 0);
    EXPECT_NEAR(json["realizations_per_second"].number * seconds, 3, 1e-9);
    double steps = 0; // six free blocks
    for (const ResultRow& row : ResultReader(folder / "a.h5").rows())
        steps += 6 * std::round(row.outcome.end_time_s / row.outcome.step_s);
    EXPECT_NEAR(json["block_steps_per_second"].number * seconds / steps, 1, 1e-3);
    const Ended words = run(run_words(mechanisms, seven_blocks(3), {"-o", "b.h5"}));
    EXPECT_EQ(words.out.find(" 0 realizations/s"), std::string::npos) << words.out;
}

TEST_F(Single, TheFirstTrajectoriesThatFitAreKept)
{
    EXPECT_EQ(trajectory_bytes(2, 6001, 7), 6001U * 23 * 8);
    EXPECT_EQ(trajectory_bytes(3, 6001, 7), 6001U * 53 * 8); // time, base, and places and attitudes of seven blocks
    const Ended ended = run(run_words(mechanisms, seven_blocks(6, {"output.most_mb=2.5"}), {"-o", "a.h5"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    for (const char* part :
         {"Trajectories are kept of the first 2 of 6 realizations: about 2.21 of 6.63 MB at 1000 Hz.",
          "stylobate replay", "output.trajectories = \"all\", output.most_mb = 7"})
        EXPECT_NE(ended.err.find(part), std::string::npos) << part << '\n' << ended.err;
    const ResultReader reader(folder / "a.h5");
    EXPECT_EQ(reader.rows().size(), 6U) << "of rows there is one each";
    EXPECT_EQ(reader.trajectory_indices(), (std::vector<std::uint64_t>{0, 1}));
    const auto bytes = static_cast<double>(fs::file_size(folder / "a.h5"));
    EXPECT_GT(bytes, 0.5e6 * 2 * each_mb);
    EXPECT_LT(bytes, 1e6 * (2 * each_mb + 0.2)) << "the estimate, and the rows";

    const Ended replay = run({"replay", "a.h5", "--realization", "5", "-o", "five.h5"});
    EXPECT_EQ(replay.status, 0) << testing::PrintToString(replay);
    EXPECT_NE(replay.out.find("bitwise identical to the results"), std::string::npos) << replay.out;
    EXPECT_EQ(ResultReader(folder / "five.h5").trajectory_indices(), std::vector<std::uint64_t>{5});
}

TEST_F(Single, AllOrSoManyAreKeptWhereTheyFit)
{
    const std::vector<std::pair<std::string, std::size_t>> choices = {
        {"output.trajectories=all", 4}, {"output.trajectories=3", 3}, {"output.trajectories=0", 0}};
    for (const auto& [setting, count] : choices) {
        const Ended ended = run(run_words(mechanisms, seven_blocks(4, {setting}), {"-o", setting + ".h5"}));
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_EQ(ResultReader(folder / (setting + ".h5")).trajectory_indices().size(), count) << setting;
    }
}

TEST_F(Single, MoreThanTheLimitIsRefusedWithTheEstimate)
{
    expect_refused(
        run_words(mechanisms, seven_blocks(6, {"output.trajectories=all", "output.most_mb=6"})),
        {"of 6 of 6 realizations need about 6.63 MB", "output.most_mb = 6", "output.most_mb = 7", "\"fit\""});
    expect_refused(run_words(mechanisms, seven_blocks(6, {"output.trajectories=5", "output.most_mb=5"})),
                   {"of 5 of 6 realizations need about 5.52 MB"});
    expect_refused(run_words(mechanisms, seven_blocks(6, {"output.most_mb=1"})),
                   {"of 1 of 6 realizations need about 1.1 MB", "output.trajectories = 0"});
    expect_refused(run_words(column_study, {"output.trajectories=3"}), {"trajectories", "\"surface\""});
    expect_refused(run_words(mechanisms, {"output.trajectories=\"some\""}), {"\"fit\", \"all\""});
}

TEST_F(Single, WhatCanHardlyBeMeantIsSaidAndKept)
{
    // 1.661569e-6 m at 1e8 N/m2 for six drums: 0.083 mm at 2e6, 0.29 % of their height
    const std::vector<std::string> soft = seven_blocks(1, {"contact.normal_stiffness_n_m2=2e6"});
    const Ended ended = run(run_words(mechanisms, soft, {"-o", "soft.h5"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_TRUE(ended.err.starts_with("warning: ")) << ended.err;
    EXPECT_EQ(count_of(ended.err, "warning: "), 1U) << ended.err;
    for (const char* part : {"0.0831 mm", "0.29 % of its size", "study.allow = [\"sinkage\"]"})
        EXPECT_NE(ended.err.find(part), std::string::npos) << part << '\n' << ended.err;
    const std::vector<std::string> kept = ResultReader(folder / "soft.h5").header().warnings;
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_NE(kept[0].find("0.0831 mm"), std::string::npos);
    EXPECT_NE(run({"info", "soft.h5"}).out.find("\nwarning: " + kept[0]), std::string::npos);
    EXPECT_NE(run({"info", "soft.h5", "--json"}).out.find("\"warnings\": [\"Under its own weight"), std::string::npos);
    ASSERT_EQ(run({"report", "soft.h5"}).status, 0);
    EXPECT_NE(read_bytes(folder / "soft.html").find("0.0831 mm"), std::string::npos);

    std::vector<std::string> meant = soft;
    meant.emplace_back("study.allow=[\"sinkage\"]");
    const Ended silent = run(run_words(mechanisms, meant, {"-o", "meant.h5", "--quiet"}));
    EXPECT_EQ(silent.status, 0);
    EXPECT_EQ(silent.err, "");
    EXPECT_TRUE(ResultReader(folder / "meant.h5").header().warnings.empty());
}

TEST_F(Single, WhatIsAbsurdIsRefusedUnlessItIsMeant)
{
    expect_refused(run_words(column_study, {"surface.pga_m_s2={from=100.0,to=1000.0,count=4}"}),
                   {"m/s2", "Did you mean cm/s2 (10 m/s2) or mm/s2 (1 m/s2)?", "study.allow = [\"pga\"]"});
    expect_refused(run_words(STYLOBATE_SOURCE_DIR "/studies/inputs/doric_column.toml", {"structure.density_kg_m3=2.7"}),
                   {"2.7 kg/m3", "Did you mean 2700 kg/m3", "study.allow = [\"density\"]"});
    expect_refused(
        run_words(STYLOBATE_SOURCE_DIR "/studies/inputs/near_fault_pulse.toml", {"contact.normal_stiffness_n_m2=3e6"}),
        {"42.4 mm", "study.allow = [\"sinkage\"]"});
    const Ended meant =
        run(run_words(mechanisms,
                      seven_blocks(1, {"contact.friction=5",
                                       "perturbation.friction={ distribution = \"normal\", cov = 0.1, min = 1 }",
                                       "study.allow=[\"friction\"]"}),
                      {"--quiet"}));
    EXPECT_EQ(meant.status, 0) << testing::PrintToString(meant);
}

} // namespace
} // namespace stylobate

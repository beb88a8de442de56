/// An adaptive surface as its user runs it: the same bytes whatever the threads and interruptions, realizations of the
/// whole study, its tables and pictures, refusals.

#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"
#include "kernels/isa.hpp"

#include <map>

namespace stylobate {
namespace {

const std::vector<std::string> small = short_surface(300);

const std::vector<std::string> adaptive = with(small, {"surface.adaptive={budget=4000,half_width=0.1}"});

class AdaptiveProgram : public ColumnProgram {};

TEST_F(AdaptiveProgram, ThreadsInstructionSetsAndInterruptionsChangeNoByte)
{
    expect_no_byte_changes([](const std::string& results, const char* threads, const std::string& simd) {
        return words(adaptive, results, threads, simd);
    });
}

TEST_F(AdaptiveProgram, ItsRealizationsAreThoseOfTheWholeStudy)
{
    ASSERT_EQ(run(words(adaptive, "some.h5", "2")).status, 0);
    ASSERT_EQ(run(words(small, "all.h5", "2")).status, 0);
    const ResultReader some(folder / "some.h5");
    const ResultReader all(folder / "all.h5");
    std::map<std::uint64_t, std::uint64_t> trials, collapses;
    for (const ResultRow& row : some.rows()) {
        EXPECT_TRUE(same_bits(row, all.row(row.index))) << row.index;
        EXPECT_EQ(row.index, row.cell * 300 + trials[row.cell]) << "a cell takes them in their order";
        ++trials[row.cell];
        collapses[row.cell] += row.outcome.state == State::collapsed;
    }
    const SurfaceTable table = some.surface();
    ASSERT_EQ(table.method.size(), 16U);
    for (std::size_t cell = 0; cell < 16; ++cell) {
        EXPECT_EQ(table.trials[cell], trials[cell]);
        EXPECT_EQ(table.collapses[cell], collapses[cell]);
        EXPECT_GE(table.trials[cell], 8U);
        EXPECT_LE(table.upper[cell] - table.lower[cell], 0.2) << cell;
        EXPECT_LE(table.lower[cell], table.probability[cell]);
        EXPECT_GE(table.upper[cell], table.probability[cell]);
    }
    EXPECT_LT(some.rows().size(), 16U * 97U); // 97: what every cell would get if one at 1/2 is to reach 0.1
}

/// The share among its realizations leans to the cells that took more of them; what is told is the mean over the cells.
TEST_F(AdaptiveProgram, ItsMeanIsThatOfTheUniformSurface)
{
    const Ended ended = run(words(adaptive, "some.h5", "2"));
    ASSERT_EQ(ended.status, 0);
    ASSERT_EQ(run(words(small, "all.h5", "2")).status, 0);
    double uniform = 0, leaning = 0;
    for (const ResultRow& row : ResultReader(folder / "all.h5").rows())
        uniform += row.outcome.state == State::collapsed ? 1.0 / (16 * 300) : 0.0;
    const ResultReader some(folder / "some.h5");
    for (const ResultRow& row : some.rows())
        leaning += row.outcome.state == State::collapsed ? 1.0 / static_cast<double>(some.done()) : 0.0;
    const JsonValue json = json_of(ended);
    const double mean = json["adaptive"]["mean_probability"].number;
    const double error = json["adaptive"]["mean_standard_error"].number;
    EXPECT_NEAR(mean, uniform, 3 * error);
    EXPECT_LT(error, 0.03);
    EXPECT_GT(std::fabs(leaning - uniform), std::fabs(mean - uniform)) << leaning << ' ' << mean << ' ' << uniform;
    const Ended text = run(run_words(column_study, adaptive, {"-o", "some.h5"}));
    EXPECT_NE(text.out.find("mean of the surface"), std::string::npos) << text.out;
    EXPECT_EQ(text.out.find("in brackets"), std::string::npos) << text.out;
}

TEST_F(AdaptiveProgram, WhereTheBudgetEndsItSaysSoAndTheWidestComeFirst)
{
    const auto settings = with(small, {"surface.adaptive={budget=400,half_width=0.02,minimum=16,borrow=false}"});
    const Ended ended = run(words(settings, "short.h5", "2"));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const ResultReader reader(folder / "short.h5");
    EXPECT_LE(reader.rows().size(), 400U);
    EXPECT_GE(reader.rows().size(), 390U);
    const SurfaceTable table = reader.surface();
    double widest = 0;
    for (std::size_t cell = 0; cell < 16; ++cell) {
        EXPECT_EQ(table.method[cell], IntervalMethod::own);
        widest = std::max(widest, (table.upper[cell] - table.lower[cell]) / 2);
    }
    EXPECT_GT(widest, 0.02);
    ASSERT_EQ(run({"report", "short.h5", "-o", "short.html"}).status, 0);
    EXPECT_NE(bytes("short.html").find("are not within"), std::string::npos);
}

TEST_F(AdaptiveProgram, TablesPicturesPageAndReplay)
{
    ASSERT_EQ(run(words(adaptive, "a.h5", "2")).status, 0);
    ASSERT_EQ(run({"export", "a.h5", "--to", "csv"}).status, 0);
    const std::string surface = bytes("a_csv/surface.csv");
    EXPECT_NE(surface.find("interval,method\n"), std::string::npos) << surface.substr(0, 200);
    EXPECT_NE(surface.find(",adaptive 0.95,surface\n"), std::string::npos);
    ASSERT_EQ(run({"export", "a.h5", "--to", "png"}).status, 0);
    EXPECT_GT(bytes("a_surface.png").size(), 10000U);
    ASSERT_EQ(run({"report", "a.h5", "-o", "a.html"}).status, 0);
    EXPECT_NE(bytes("a.html").find("every cell is within"), std::string::npos);
    const Ended in = run({"replay", "a.h5", "--realization", "303"});
    EXPECT_EQ(in.status, 0);
    EXPECT_NE(in.out.find("bitwise identical"), std::string::npos) << in.out;
    const Ended out = run({"replay", "a.h5", "--realization", "299"});
    EXPECT_EQ(out.status, 0);
    EXPECT_NE(out.out.find("not needed by the run"), std::string::npos) << out.out;
    EXPECT_EQ(run({"replay", "a.h5", "--realization", "4800"}).status, 2);
}

TEST_F(AdaptiveProgram, BadInputIsRefusedWithItsRange)
{
    const auto refused = [&](const std::string& setting, const std::string& says) {
        const Ended ended = run(words(with(small, {setting}), "none.h5", "1"));
        EXPECT_EQ(ended.status, 2) << setting;
        EXPECT_NE(ended.err.find(says), std::string::npos) << setting << '\n' << ended.err;
        EXPECT_FALSE(fs::exists(folder / "none.h5"));
    };
    refused("surface.adaptive={minimum=8}", "surface.adaptive.budget");
    refused("surface.adaptive={budget=127}", "surface.adaptive.budget = 127 is outside [128, 1000000000]");
    refused("surface.adaptive={budget=1000,minimum=301}", "surface.adaptive.minimum = 301 is outside [1, 300]");
    refused("surface.adaptive={budget=1000,minimum=0}", "is outside [1, 300]");
    refused("surface.adaptive={budget=1000,half_width=0.3}",
            "surface.adaptive.half_width = 0.3 is outside [0.01, 0.25]");
    refused("surface.adaptive={budget=1000,halfwidth=0.1}", "Did you mean half_width?");
    refused("surface.adaptive={budget=1000,borrow=1}", "surface.adaptive.borrow");
    refused("surface.adaptive=true", "surface.adaptive");
}

} // namespace
} // namespace stylobate

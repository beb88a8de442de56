/// What the examples print, built against the installed package alone, is what the program computes.

#include "tests/program/program.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace stylobate {
namespace {

/// Left by the test `install`.
const fs::path installed = STYLOBATE_INSTALL_CHECK;

using Examples = Program;

TEST_F(Examples, TheSurfaceIsTheProgramsSurface)
{
    ASSERT_EQ(run(run_words(column_study,
                            {"study.realizations=16", "surface.frequency_hz={ from = 1.0, to = 4.0, count = 2 }",
                             "surface.pga_m_s2={ from = 2.0, to = 8.0, count = 3 }"},
                            {"-o", "s.h5", "--quiet"}))
                  .status,
              0);
    const SurfaceTable table = ResultReader(folder / "s.h5").surface();
    std::string want;
    for (std::size_t i = 0; i < 6; ++i)
        want += fmt::format("{:.2f} Hz, {:.2f} m/s2: {} of {} collapse, {:.4f} ({:.4f} to {:.4f})\n",
                            table.frequency_hz[i / 3], table.pga_m_s2[i % 3], table.collapses[i], table.trials[i],
                            table.probability[i], table.lower[i], table.upper[i]);
    const std::string got = read_bytes(installed / "surface.txt");
    EXPECT_EQ(got.substr(0, want.size()), want);
    const JsonValue all =
        json_of(run({"run", column_study, "--set", "study.realizations=16", "--set",
                     "surface.frequency_hz={ from = 1.0, to = 4.0, count = 2 }", "--set",
                     "surface.pga_m_s2={ from = 2.0, to = 8.0, count = 3 }", "-o", "s.h5", "--json"}));
    EXPECT_EQ(got.substr(want.size()),
              fmt::format("all cells: {:.4f} ({:.4f} to {:.4f}, {})\n", all["collapse_probability"].number,
                          all["collapse_lower"].number, all["collapse_upper"].number, table.interval));
}

TEST_F(Examples, TheFunctionOfTimeShakesAsItsSamplesInAFile)
{
    // the study as it stands in the example, under a file of the function's samples
    const std::string code = read_bytes(STYLOBATE_SOURCE_DIR "/examples/custom_excitation.cpp");
    const std::size_t begin = code.find("R\"(") + 3;
    write_bytes(folder / "study.toml", code.substr(begin, code.find(")\"", begin) - begin));
    std::string samples;
    for (int i = 0; i <= 800; ++i) {
        const double t = 0.005 * i;
        samples += fmt::format("{:.3f} {}\n", t,
                               7 * std::sin(std::numbers::pi * t / 4) * std::sin(2 * std::numbers::pi * 1.5 * t));
    }
    write_bytes(folder / "pulse.txt", samples);
    const JsonValue said = json_of(run(run_words(
        "study.toml", {"excitation={ kind = \"record\", file = \"pulse.txt\", unit = \"m/s2\", baseline = false }"},
        {"-o", "r.h5", "--json"})));
    std::string want;
    for (const char* limit : {"collapse", "rocked"}) {
        const JsonValue& share = said["limit_states"][limit];
        want += fmt::format("{}: {} of {}, {:.4f} ({:.4f} to {:.4f})\n", limit, share["count"].number,
                            said["limit_states"]["trials"].number, share["probability"].number, share["lower"].number,
                            share["upper"].number);
    }
    double largest_m = 0;
    ResultReader(folder / "r.h5").for_each_row([&](const ResultRow& row) {
        largest_m = std::fmax(largest_m, row.outcome.peak_top_displacement_m);
    });
    want += fmt::format("largest displacement of the top: {:.6f} m\n", largest_m);
    EXPECT_EQ(read_bytes(installed / "custom_excitation.txt"), want);
}

TEST_F(Examples, TheFollowedRealizationIsTheReplayedOne)
{
    ASSERT_EQ(run(run_words(column_study,
                            {"study.realizations=16", "surface.frequency_hz={ from = 1.0, to = 1.0, count = 1 }",
                             "surface.pga_m_s2={ from = 6.0, to = 6.0, count = 1 }"},
                            {"-o", "s.h5", "--quiet"}))
                  .status,
              0);
    ASSERT_EQ(run({"replay", "s.h5", "--realization", "3", "-o", "t.h5", "--quiet"}).status, 0);
    const ResultReader reader(folder / "t.h5");
    const Outcome outcome = reader.row(3).outcome;
    const Trajectory t = reader.trajectory(3);
    const std::string got = read_bytes(installed / "replay.txt");
    ASSERT_EQ(outcome.state, State::collapsed);
    std::string want =
        fmt::format("realization 3 collapsed after {:.6f} s\n{} fell first, at {:.6f} s\n", outcome.end_time_s,
                    t.name[static_cast<std::size_t>(outcome.first_collapse_block)], outcome.collapse_time_s);
    for (std::size_t sample = 0; sample < t.time_s.size(); sample += 500) // 1000 a second
        want += fmt::format("{:.3f} s: {} at x = {:.6f} m, turned by {:.6f} rad\n", t.time_s[sample], t.name[6],
                            t["x_m"][sample * 7 + 6], t["theta_rad"][sample * 7 + 6]);
    EXPECT_EQ(got.substr(0, want.size()), want);
    const std::string svg = read_bytes(installed / "replay.svg");
    EXPECT_EQ(count_of(svg, "<polygon"), 7U);
    EXPECT_NE(svg.find(fmt::format("{:.3f} s</text>", t.time_s.back())), std::string::npos);
}

TEST_F(Examples, TheComparisonAndItsRiskAreTheProgramsOnes)
{
    fs::copy(STYLOBATE_SOURCE_DIR "/tests/library/small_fragility.toml", folder / "small.toml");
    const JsonValue said = json_of(run({"compare", "small.toml", "-o", "comparison.h5", "--json"}));
    std::string want;
    for (const JsonValue& variant : said["variants"].items)
        for (const JsonMember& limit : variant["limit_states"].members) {
            const JsonValue& overall = limit.value["overall"];
            want += fmt::format("{}, {}: {:+.4f} ({:+.4f} to {:+.4f}), {}\n", variant["name"].text, limit.name,
                                overall["difference"].number, overall["lower"].number, overall["upper"].number,
                                overall["verdict"].text);
        }
    EXPECT_EQ(read_bytes(installed / "compare.txt"), want);
    EXPECT_EQ(read_bytes(installed / "decisions/comparison.h5"), bytes("comparison.h5"));
    const std::string risk = run({"risk", "comparison.h5", "--hazard", "k0=1e-3,k=3,measure=pga", "-o", "risk.h5"}).out;
    const std::string got = read_bytes(installed / "risk.txt");
    EXPECT_TRUE(got.starts_with(risk.substr(0, risk.rfind("risk.h5")))) << got << risk;
    EXPECT_NE(got.find("base_annual_frequency_lower, 1/year\n"), std::string::npos) << got;
    EXPECT_GT(read_bytes(installed / "decisions/risk.html").size(), 10000U);
}

} // namespace
} // namespace stylobate

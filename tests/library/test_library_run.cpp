/// The library against the program: one study, the same numbers and the same bytes.

#include "stylobate/stylobate.hpp"
#include "tests/library/inputs.hpp"
#include "tests/program/program.hpp"

#include "io/study/study_file.hpp"
#include "io/tables/kind_tables.hpp"
#include "studies/kinds/surface/surface_kind.hpp"

#include <fmt/format.h>

#include <cmath>
#include <thread>

namespace stylobate {
namespace {

struct SmallStudy {
    std::string name; ///< of the test
    std::string input;
    std::vector<std::string> settings;
};

void PrintTo(const SmallStudy& study, std::ostream* to)
{
    *to << study.name;
}

class LibraryRun : public Program {
protected:
    /// What `stylobate run` makes of a study.
    fs::path by_program(const std::string& input, const std::vector<std::string>& settings) const
    {
        const Ended ended = run(run_words(inputs + input, settings, {"-o", "program.h5", "--quiet"}));
        EXPECT_TRUE(ended.status == 0 || ended.status == 3) << testing::PrintToString(ended);
        return folder / "program.h5";
    }
};

class LibraryKinds : public LibraryRun, public testing::WithParamInterface<SmallStudy> {};

TEST_P(LibraryKinds, WritesTheBytesOfTheProgramInOneGoOrInParts)
{
    const SmallStudy& small = GetParam();
    const fs::path want = by_program(small.input, small.settings);
    const api::Experiment experiment(api::Study::from_file(inputs + small.input, small.settings));

    const api::Result whole = api::run_to_file(experiment, folder / "whole.h5", {.threads = 2});
    EXPECT_TRUE(whole.complete());
    EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(want));

    int asked = 0;
    const auto soon = [&](const api::Progress&) { return ++asked > 1; };
    const api::Result part =
        api::run_to_file(experiment, folder / "parts.h5", {.threads = 1, .simd = "scalar", .progress = soon});
    EXPECT_LE(part.realizations(), whole.realizations());
    EXPECT_TRUE(api::run_to_file(experiment, folder / "parts.h5").complete());
    EXPECT_TRUE(read_bytes(folder / "parts.h5") == read_bytes(want));

    // a file that is complete is read
    EXPECT_EQ(api::run_to_file(experiment, folder / "whole.h5").realizations(), whole.realizations());
    EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(want));
}

TEST_P(LibraryKinds, InMemoryItHasTheNumbersOfTheFile)
{
    const SmallStudy& small = GetParam();
    const ResultReader reader(by_program(small.input, small.settings));
    const api::Experiment experiment(api::Study::from_file(inputs + small.input, small.settings));
    const api::Result result = api::run(experiment);
    EXPECT_TRUE(result.complete());
    EXPECT_EQ(result.kind(), reader.header().kind);
    EXPECT_EQ(result.study_text(), reader.header().study_toml);
    EXPECT_EQ(result.realizations(), reader.done());
    EXPECT_EQ(result.input_names(), reader.header().input_names);
    EXPECT_EQ(result.block_names(), reader.header().block_names);
    const std::vector<ResultRow> rows = reader.rows();
    ASSERT_EQ(result.outcomes().size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const api::Outcome& got = result.outcomes()[i];
        const Outcome& want = rows[i].outcome;
        EXPECT_EQ(got.index, rows[i].index);
        EXPECT_EQ(got.pga_m_s2, rows[i].pga_m_s2);
        EXPECT_STREQ(to_string(got.state), to_string(want.state));
        EXPECT_EQ(got.collapse_time_s, want.collapse_time_s);
        EXPECT_EQ(got.peak_top_displacement_m, want.peak_top_displacement_m);
        EXPECT_EQ(got.total_sliding_m, want.total_sliding_m);
        EXPECT_STREQ(to_string(got.invalid_reason), to_string(want.invalid_reason));
        EXPECT_EQ(got.top_path_m, want.top_path_m);
        EXPECT_EQ(got.sliding_path_m, want.sliding_path_m);
        EXPECT_EQ(got.rocking_path_rad, want.rocking_path_rad);
        EXPECT_EQ(got.energy_kinetic_j, want.energy_kinetic_j);
        EXPECT_EQ(got.energy_potential_j, want.energy_potential_j);
        EXPECT_EQ(got.energy_spring_j, want.energy_spring_j);
        EXPECT_EQ(got.energy_base_work_j, want.energy_base_work_j);
        EXPECT_EQ(got.steps, want.steps);
        EXPECT_EQ(got.fall_time_s, want.fall_time_s);
        EXPECT_EQ(got.inputs, rows[i].inputs);
    }
    if (const SurfaceTable table = reader.surface(); !table.frequency_hz.empty()) {
        const api::Surface surface = result.surface();
        EXPECT_EQ(surface.trials, table.trials);
        EXPECT_EQ(surface.reached, table.collapses);
        EXPECT_EQ(surface.probability, table.probability);
        EXPECT_EQ(surface.lower, table.lower);
        EXPECT_EQ(surface.upper, table.upper);
        const api::Cell cell = surface.cell(1, 0);
        EXPECT_EQ(cell.frequency_hz, table.frequency_hz[1]);
        EXPECT_EQ(cell.upper, table.upper[table.pga_m_s2.size()]);
        EXPECT_THROW(surface.cell(2, 0), std::out_of_range);
    } else {
        EXPECT_THROW(result.surface(), api::InputError);
    }
    if (const FragilityTable table = fragility_table(reader.table("fragility")); !table.empty()) {
        const api::Fragility fragility = result.fragility();
        EXPECT_EQ(fragility.measure, table.measure);
        ASSERT_EQ(fragility.curves.size(), table.states.size());
        for (std::size_t s = 0; s < table.states.size(); ++s) {
            const api::FragilityCurve& curve = fragility.curves[s];
            EXPECT_EQ(curve.limit_state, table.states[s]);
            EXPECT_EQ(curve.reached, table.reached[s]);
            const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
            EXPECT_TRUE(same(curve.median.value, table.median.value[s]));
            EXPECT_TRUE(same(curve.median.upper, table.median.upper[s]));
            EXPECT_TRUE(same(curve.probability.at(7).lower, table.curve.lower[s * table.grid.size() + 7]));
            EXPECT_TRUE(same(curve.share.at(1).value, table.share.value[s * table.stripe.size() + 1]));
        }
    } else {
        EXPECT_THROW(result.fragility(), api::InputError);
    }
    EXPECT_THROW(result.share("fallen"), api::InputError);
}

TEST_P(LibraryKinds, TheShareOfTheCollapseIsTheProgramsWithItsInterval)
{
    const SmallStudy& small = GetParam();
    by_program(small.input, small.settings);
    // of a complete file it tells what it told before
    const JsonValue said =
        json_of(run(run_words(inputs + small.input, small.settings, {"-o", "program.h5", "--json"})));
    const api::Share share = api::Result::from_file(folder / "program.h5").share();
    if (said["kind"].text == "rare") {
        EXPECT_EQ(share.probability, said["rare"]["probability"].number);
        EXPECT_EQ(share.upper, said["rare"]["upper"].number);
        return;
    }
    EXPECT_EQ(share.trials, said["limit_states"]["trials"].number);
    EXPECT_EQ(share.count, said["limit_states"]["collapse"]["count"].number);
    const bool by_cells = said["kind"].text == "surface";
    const JsonValue& from = by_cells ? said : said["limit_states"]["collapse"];
    EXPECT_EQ(share.probability, from[by_cells ? "collapse_probability" : "probability"].number);
    EXPECT_EQ(share.lower, from[by_cells ? "collapse_lower" : "lower"].number);
    EXPECT_EQ(share.upper, from[by_cells ? "collapse_upper" : "upper"].number);
}

const std::vector<std::string> four_cells = {"study.realizations=4", "surface.frequency_hz={from=1.0,to=4.0,count=2}",
                                             "surface.pga_m_s2={from=4.0,to=12.0,count=2}"};

INSTANTIATE_TEST_SUITE_P(
    Kinds, LibraryKinds,
    testing::Values(SmallStudy{"single", "free_rocking.toml", {}},
                    SmallStudy{"surface", "small_scale_column.toml", four_cells},
                    SmallStudy{"counted", "small_scale_column.toml", with(four_cells, {"output.realizations=none"})},
                    SmallStudy{
                        "adaptive", "small_scale_column_adaptive.toml",
                        with(four_cells, {"surface.adaptive={budget=60,minimum=4,half_width=0.05,borrow=true}"})},
                    SmallStudy{"replicas", "twins_column.toml", with(four_cells, {"twins.followed=1"})},
                    SmallStudy{"fragility",
                               "fragility_column.toml",
                               {"study.realizations=6", "fragility.motions=8",
                                "fragility.intensity={measure=\"pgv\",from=0.5,to=3.0,count=3,spacing=\"log\"}"}},
                    SmallStudy{"sensitivity",
                               "sensitivity_column.toml",
                               {"sensitivity.samples=6", "sensitivity.inner=2", "excitation.pga_m_s2=7"}},
                    SmallStudy{"rare", "rare_collapse.toml", {"rare.samples=200", "rare.repeats=5"}}),
    [](const auto& tested) { return tested.param.name; });

TEST_F(LibraryRun, OfAStoppedRunTheFairPartCounts)
{
    const api::Experiment experiment(api::Study::from_file(column_study, with(four_cells, {"study.realizations=200"})));
    int asked = 0;
    const auto stop = [&](const api::Progress& p) { return p.done < 100 || ++asked < 3; };
    const api::Result memory = api::run(experiment, {.threads = 1, .progress = stop});
    EXPECT_FALSE(memory.complete());
    EXPECT_LT(memory.realizations(), 800U);
    EXPECT_EQ(memory.outcomes().size(), memory.realizations());
    const api::Share share = memory.share();
    EXPECT_GT(share.trials, 0U);
    EXPECT_LE(share.trials, memory.realizations());
    const api::Surface surface = memory.surface();
    std::uint64_t trials = 0;
    for (const std::uint64_t cell : surface.trials) {
        EXPECT_NEAR(static_cast<double>(cell), static_cast<double>(share.trials) / 4, 2) << "spread over the cells";
        trials += cell;
    }
    EXPECT_EQ(trials, share.trials);

    // what the program draws of a file that was left so
    asked = 0;
    const api::Result file = api::run_to_file(experiment, folder / "part.h5", {.threads = 1, .progress = stop});
    EXPECT_FALSE(file.complete());
    const ResultReader reader(folder / "part.h5");
    const Study study = read_study(column_study, with(four_cells, {"study.realizations=200"}));
    const SurfaceTable drawn = surface_so_far(reader, study, "part.h5", LimitState::collapse);
    EXPECT_EQ(file.surface().trials, drawn.trials);
    EXPECT_EQ(file.surface().reached, drawn.collapses);
    EXPECT_EQ(file.surface().upper, drawn.upper);
}

TEST_F(LibraryRun, RunsOfSeveralThreadsDoNotDisturbEachOther)
{
    const api::Experiment experiment(api::Study::from_file(column_study, four_cells));
    const api::Result want = api::run(experiment);
    std::vector<std::vector<api::Outcome>> got(4);
    std::vector<std::thread> threads;
    for (std::vector<api::Outcome>& outcomes : got)
        threads.emplace_back([&] { outcomes = api::run(experiment, {.threads = 2}).outcomes(); });
    for (std::thread& thread : threads)
        thread.join();
    for (const std::vector<api::Outcome>& outcomes : got) {
        ASSERT_EQ(outcomes.size(), want.outcomes().size());
        for (std::size_t i = 0; i < outcomes.size(); ++i)
            EXPECT_EQ(outcomes[i].peak_top_displacement_m, want.outcomes()[i].peak_top_displacement_m);
    }
}

TEST_F(LibraryRun, FollowsARealizationAsReplayDoes)
{
    by_program("small_scale_column.toml", four_cells);
    ASSERT_EQ(run({"replay", "program.h5", "--realization", "9", "-o", "t.h5", "--quiet"}).status, 0);
    const ResultReader reader(folder / "t.h5");
    const Trajectory want = reader.trajectory(9);
    const api::Experiment experiment(api::Study::from_file(inputs + "small_scale_column.toml", four_cells));
    const api::Trajectory got = api::replay(experiment, 9);
    EXPECT_EQ(got.time_s, want.time_s);
    EXPECT_EQ(got.x_m, want["x_m"]);
    EXPECT_EQ(got.y_m, want["y_m"]);
    EXPECT_EQ(got.theta_rad, want["theta_rad"]);
    EXPECT_EQ(got.base_x_m, want["base_x_m"]);
    EXPECT_EQ(got.half_width_m, want["half_width_m"]);
    EXPECT_EQ(got.name, want.name);
    EXPECT_EQ(got.outcome.peak_top_displacement_m, reader.row(9).outcome.peak_top_displacement_m);
    EXPECT_TRUE(got.fixed.front());
    EXPECT_FALSE(got.fixed.back());
    EXPECT_EQ(got.sample_at(-1), 0U);
    EXPECT_EQ(got.sample_at(got.time_s[5]), 5U);
    EXPECT_EQ(got.sample_at(1e9), got.time_s.size() - 1);
    EXPECT_THROW(api::replay(experiment, 16), api::InputError);

    const api::Result result = api::Result::from_file(folder / "program.h5");
    int asked = 0;
    EXPECT_EQ(api::replay(result, 9, {}, [&] { return ++asked > 0; }).x_m, want["x_m"]);
    EXPECT_GT(asked, 10);
    EXPECT_THROW(api::replay(result, 9, {}, [] { return false; }), api::Stopped);
    EXPECT_THROW(api::replay(result, 16), api::InputError);
    EXPECT_THROW(api::replay(result, 9, {"contact.friction=0.5"}), api::InputError);
    EXPECT_EQ(result.too_many_invalid(), std::nullopt);
    EXPECT_EQ(result.input_units().size(), result.input_names().size());

    api::write_svg(got, 0, folder / "t.svg");
    const std::string svg = read_bytes(folder / "t.svg");
    EXPECT_EQ(count_of(svg, "<polygon"), 7U);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    api::write_strip(got, folder / "t.png", "a fall");
    EXPECT_TRUE(read_bytes(folder / "t.png").starts_with("\x89PNG"));
    api::Trajectory broken = got;
    broken.x_m.pop_back();
    EXPECT_THROW(api::write_svg(broken, 0, folder / "broken.svg"), api::InputError);
    EXPECT_THROW(api::write_svg(got, 0, folder / "none" / "t.svg"), api::InputError);
}

TEST_F(LibraryRun, FollowsAStructureInSpace)
{
    const std::vector<std::string> settings = {"study.realizations=2", "surface.frequency_hz={from=0.5,to=1.0,count=2}",
                                               "surface.pga_m_s2={from=2.0,to=8.0,count=2}"};
    by_program("round_column.toml", settings);
    ASSERT_EQ(run({"replay", "program.h5", "--realization", "3", "-o", "t.h5", "--quiet"}).status, 0);
    const Trajectory want = ResultReader(folder / "t.h5").trajectory(3);
    const api::Result result = api::Result::from_file(folder / "program.h5");
    EXPECT_EQ(result.dimensions(), 3);
    const api::Trajectory got = api::replay(result, 3);
    EXPECT_EQ(got.dimensions, 3);
    EXPECT_EQ(got.blocks(), 6U);
    EXPECT_EQ(got.time_s, want.time_s);
    EXPECT_EQ(got.x_m, want["x_m"]);
    EXPECT_EQ(got.z_m, want["z_m"]);
    EXPECT_EQ(got.q_w, want["q_w"]);
    EXPECT_EQ(got.q_y, want["q_y"]);
    EXPECT_EQ(got.base_z_m, want["base_z_m"]);
    EXPECT_EQ(got.top_half_z_m, want["top_half_z_m"]);
    EXPECT_EQ(got.round, std::vector<double>(6, 1));
    EXPECT_TRUE(got.half_width_m.empty());
    EXPECT_FALSE(got.fixed.back());
    EXPECT_TRUE(std::isnan(got.outcome.top_path_m));
    EXPECT_GT(got.outcome.out_of_plane_share, 0);
    EXPECT_EQ(got.outcome.out_of_plane_share, result.outcomes()[3].out_of_plane_share);
    api::write_svg(got, 0, folder / "t.svg");
    const std::string svg = read_bytes(folder / "t.svg");
    EXPECT_EQ(count_of(svg, "<polygon"), 1 + 6 * (12 + 1 + 1U)) << "the ground; sides, top and outline of each drum";
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    api::write_strip(got, folder / "t.png");
    EXPECT_TRUE(read_bytes(folder / "t.png").starts_with("\x89PNG"));
    api::Trajectory broken = got;
    broken.top_half_z_m[2] = 0;
    EXPECT_THROW(api::write_svg(broken, 0, folder / "broken.svg"), api::InputError);
    broken = got;
    broken.q_w.pop_back();
    EXPECT_THROW(api::write_svg(broken, 0, folder / "broken.svg"), api::InputError);
}

TEST_F(LibraryRun, RefusesWhatTheProgramRefusesWithItsWords)
{
    const auto message = [](const auto& f) -> std::string {
        try {
            f();
        } catch (const api::InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    const std::string column = inputs + "small_scale_column.toml";
    for (const std::vector<std::string>& settings : {std::vector<std::string>{"contact.frction=0.5"},
                                                     {"contact.friction=-1"},
                                                     {"structure.fixed_blocks=9"},
                                                     {"structure.drum_mass_kg=1e-9"},
                                                     {"run.step_s=1", "run.step_bound=blocks"}}) {
        const Ended ended = run(run_words(column, settings, {"--quiet"}));
        EXPECT_EQ(ended.status, 2);
        const std::string said =
            message([&] { api::run(api::Experiment(api::Study::from_file(column, settings)), {.threads = 1}); });
        EXPECT_EQ("stylobate: " + said + "\n", ended.err);
    }
    EXPECT_NE(message([&] { api::Study::from_file(folder / "none.toml"); }).find("none.toml"), std::string::npos);
    EXPECT_NE(message([&] { api::Result::from_file(folder / "none.h5"); }).find("none.h5"), std::string::npos);
    const api::Experiment small(api::Study::from_file(column, four_cells));
    EXPECT_NE(message([&] { api::run(small, {.simd = "sse9"}); }).find("sse9"), std::string::npos);
    api::run_to_file(small, folder / "small.h5");
    api::Study other = small.study();
    other.set("study.seed=2");
    EXPECT_NE(message([&] { api::run_to_file(api::Experiment(other), folder / "small.h5"); }).find("small.h5"),
              std::string::npos);
}

} // namespace
} // namespace stylobate

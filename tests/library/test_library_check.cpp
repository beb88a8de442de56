/// The library's check of a study is the program's.

#include "stylobate/stylobate.hpp"
#include "tests/library/inputs.hpp"
#include "tests/program/program.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <regex>

namespace stylobate {
namespace {

class LibraryCheck : public Program {
protected:
    static Words check_words(const std::string& input, const Words& settings, const Words& more)
    {
        Words words = run_words(inputs + input, settings, more);
        words.front() = "check";
        return words;
    }
    /// Without what depends on the process, and on the time that it has.
    static std::string steady(const std::string& text)
    {
        static const std::regex unsteady("\"memory_bytes\": [^,]*,|memory: [^\n]*\n");
        return std::regex_replace(text, unsteady, "");
    }
};

TEST_F(LibraryCheck, HasTheTextAndTheJsonOfTheProgram)
{
    const std::vector<std::pair<std::string, Words>> studies{
        {"small_scale_column.toml", {"study.realizations=4"}},     // it has two weak spots
        {"small_scale_monolith.toml", {"surface.pga_m_s2.to=40"}}, // it has a warning
        {"rigid_column.toml", {"run.accuracy=0.2"}},
        {"mechanisms.toml", {}},
        {"small_scale_column_adaptive.toml", {"study.realizations=64"}},
        {"fragility_column.toml", {"fragility.motions=30"}},
        {"sensitivity_column.toml", {"sensitivity.samples=100"}},
        {"rare_collapse.toml", {}},
        {"twins_column.toml", {"study.realizations=22"}}};
    for (const auto& [input, settings] : studies) {
        const std::optional<api::Check> check =
            api::check(api::Study::from_file(inputs + input, settings), {.trial_seconds = 0});
        ASSERT_TRUE(check) << input;
        const Words brief = {"--pilot", "0", "--trial-seconds", "0"};
        EXPECT_EQ(steady(check->text()), steady(run(check_words(input, settings, brief)).out)) << input;
        const Ended json = run(check_words(input, settings, with(brief, {"--json", "--quiet"})));
        EXPECT_EQ(steady(check->json()) + "\n", steady(json.out)) << input;

        const JsonValue said = json_of(json);
        EXPECT_EQ(check->kind(), said["kind"].text);
        EXPECT_EQ(check->form(), said["form"].text);
        EXPECT_EQ(static_cast<double>(check->realizations()), said["realizations"].number);
        EXPECT_EQ(check->at_most(), said["realizations_at_most"].boolean);
        EXPECT_EQ(static_cast<double>(check->cells()), said["cells"].number);
        EXPECT_EQ(check->blocks(), said["blocks"].number);
        EXPECT_EQ(check->free_blocks(), said["free_blocks"].number);
        EXPECT_EQ(check->step_s().lower, said["step_s"]["low"].number);
        EXPECT_EQ(check->longest_steps().upper, said["longest_steps"]["high"].number);
        EXPECT_EQ(check->file_bytes(), said["file_bytes"].number);
        EXPECT_GT(check->memory_bytes(), 5e6);
        EXPECT_FALSE(check->trial() || check->time() || check->pilot());
        ASSERT_EQ(check->weak_spots().size(), said["weak_spots"].items.size()) << input;
        for (std::size_t i = 0; i < check->weak_spots().size(); ++i) {
            EXPECT_EQ(check->weak_spots()[i].name, said["weak_spots"].items[i]["name"].text);
            EXPECT_EQ(check->weak_spots()[i].text, said["weak_spots"].items[i]["text"].text);
            EXPECT_EQ(check->weak_spots()[i].remedy, said["weak_spots"].items[i]["todo"].text);
        }
        ASSERT_EQ(check->chosen().size(), said["chosen"].items.size()) << input;
        for (std::size_t i = 0; i < check->chosen().size(); ++i)
            EXPECT_EQ(check->chosen()[i].value, said["chosen"].items[i]["value"].text);
        ASSERT_EQ(check->warnings().size(), said["warnings"].items.size()) << input;
        EXPECT_EQ(check->weak_spots().empty(), input == "rigid_column.toml") << input; // of the others the damping
        EXPECT_EQ(check->chosen().empty(), input != "rigid_column.toml") << input;
        EXPECT_EQ(check->warnings().empty(), input != "small_scale_monolith.toml") << input;
    }
}

/// A trial of a study that is small is the whole of it, and a pilot is drawn by the study alone.
TEST_F(LibraryCheck, HasTheTrialAndThePilotOfTheProgram)
{
    const Words settings{"study.realizations=4", "surface.frequency_hz.count=3", "surface.pga_m_s2.count=3",
                         "run.accuracy=0.2"};
    const JsonValue said = json_of(run(
        check_words("small_scale_monolith.toml", settings, {"--pilot", "16", "--json", "--quiet", "--threads", "1"})));
    std::vector<std::string> lines;
    const std::optional<api::Check> check =
        api::check(api::Study::from_file(inputs + "small_scale_monolith.toml", settings),
                   {.pilot = 16, .threads = 2, .tell = [&](const std::string& line) { lines.push_back(line); }});
    ASSERT_TRUE(check && check->trial() && check->time() && check->pilot());
    EXPECT_EQ(check->trial()->realizations, 36U);
    EXPECT_TRUE(check->trial()->whole);
    EXPECT_EQ(static_cast<double>(check->trial()->valid), said["trial"]["valid"].number);
    EXPECT_EQ(static_cast<double>(check->trial()->collapsed), said["trial"]["collapsed"].number);
    EXPECT_EQ(check->time()->block_steps, said["time"]["block_steps"].number);
    EXPECT_EQ(check->time()->steps.upper, said["time"]["steps"]["high"].number);
    EXPECT_LE(check->time()->range_s.lower, check->time()->seconds);
    EXPECT_GE(check->time()->range_s.upper, check->time()->seconds);
    EXPECT_NEAR(check->time()->processor_s, 2 * check->time()->seconds, 1e-9);
    EXPECT_EQ(static_cast<double>(check->pilot()->realizations), said["pilot"].number);
    EXPECT_EQ(check->pilot()->difference, said["error_of_the_numerics"].number);
    EXPECT_EQ(check->pilot()->standard_error, said["its_standard_error"].number);
    EXPECT_EQ(check->pilot()->accuracy_missed, said["accuracy_missed"].boolean);
    ASSERT_GE(lines.size(), 3U);
    EXPECT_EQ(lines.front(), "trial of 2 s");
    EXPECT_NE(std::find(lines.begin(), lines.end(), "pilot of 16 realizations, run twice"), lines.end());
}

TEST_F(LibraryCheck, DrawsAsTheProgramDoes)
{
    const std::optional<api::Check> check =
        api::check(api::Study::from_file(inputs + "doric_column.toml"), {.trial_seconds = 0});
    ASSERT_TRUE(check);
    const Ended drawn =
        run(check_words("doric_column.toml", {}, {"--pilot", "0", "--trial-seconds", "0", "-o", "a.svg"}));
    check->draw(folder / "b.svg");
    check->draw(folder / "b.svg"); // replaces it
    EXPECT_EQ(read_bytes(folder / "a.svg"), read_bytes(folder / "b.svg"));
    EXPECT_THROW(check->draw(folder / "b.txt"), api::InputError);
    EXPECT_THROW(check->draw(folder / "none" / "b.svg"), api::InputError);
    EXPECT_EQ(names(), (Words{"a.svg", "b.svg"}));
}

TEST_F(LibraryCheck, OfAMotionOfOnesOwn)
{
    const auto weak = [](double amplitude_m_s2) {
        api::Study study = api::Study::from_file(inputs + "free_rocking.toml");
        const auto sway = [&](double t) { return amplitude_m_s2 * std::sin(2 * std::numbers::pi * 3 * t); };
        study.set("initial={ tilt_rad = 0.0 }");
        return api::check(api::Experiment(study, sway, 0.005, 4), {.trial_seconds = 0})->weak_spots();
    };
    const std::vector<api::WeakSpot> spots = weak(0.01);
    ASSERT_FALSE(spots.empty());
    EXPECT_EQ(spots.front().name, "below_limit");
    for (const api::WeakSpot& spot : weak(8))
        EXPECT_NE(spot.name, "below_limit");
}

/// What is stopped here would else take longer than a test may.
TEST_F(LibraryCheck, CanBeStopped)
{
    api::Study study = api::Study::from_file(inputs + "small_scale_column.toml");
    const auto stop_at = [&](const std::string& line, const api::CheckOptions& wanted) {
        api::CheckOptions options = wanted;
        bool told = false;
        options.tell = [&](const std::string& said) { told = told || said.starts_with(line); };
        options.go_on = [&] { return !told; };
        EXPECT_FALSE(api::check(study, options)) << line;
        EXPECT_TRUE(told) << line;
    };
    stop_at("trial", {.trial_seconds = 3600});
    stop_at("pilot", {.pilot = 10'000'000, .trial_seconds = 0});
    study.set("study.realizations=1000000"); // to draw them all takes most of an hour
    study.set("output.realizations=\"none\"");
    int asked = 0;
    EXPECT_FALSE(api::check(study, {.trial_seconds = 0, .go_on = [&] { return ++asked < 3; }}));
    EXPECT_EQ(asked, 3) << "no is for ever";
}

TEST_F(LibraryCheck, RefusesWhatTheProgramRefusesWithItsWords)
{
    const auto message = [](const std::string& input, const Words& settings, const api::CheckOptions& options) {
        try {
            api::check(api::Study::from_file(inputs + input, settings), options);
        } catch (const api::InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const auto said = [&](const std::string& input, const Words& settings, const Words& more) {
        const Ended ended = run(check_words(input, settings, with({"--trial-seconds", "0"}, more)));
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(ended);
        return ended.err;
    };
    const auto line = [](const std::string& text) { return "stylobate: " + text + "\n"; };
    EXPECT_EQ(line(message("doric_column.toml", {}, {.pilot = 3, .trial_seconds = 0})),
              said("doric_column.toml", {}, {"--pilot", "3"}));
    EXPECT_EQ(line(message("rare_collapse.toml", {}, {.pilot = 16, .trial_seconds = 0})),
              said("rare_collapse.toml", {}, {"--pilot", "16"}));
    EXPECT_EQ(line(message("doric_column.toml", {"structure.drum_mass_kg=1e-9"}, {.trial_seconds = 0})),
              said("doric_column.toml", {"structure.drum_mass_kg=1e-9"}, {}));
    EXPECT_EQ(line(message("doric_column.toml", {}, {.trial_seconds = 0, .simd = "sse9"})),
              line(message("doric_column.toml", {}, {.simd = "sse9"})));
    for (const double seconds : {-1.0, 3601.0, std::nan("")})
        EXPECT_NE(message("doric_column.toml", {}, {.trial_seconds = seconds}).find("0 to 3600 s"), std::string::npos);
}

} // namespace
} // namespace stylobate

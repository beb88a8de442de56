/// `stylobate check`, as its user runs it.

#include "tests/program/program.hpp"

namespace stylobate {
namespace {

class Check : public Program {
protected:
    static std::string input(const std::string& name)
    {
        return std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/" + name + ".toml";
    }
    static Words with(Words words, const Words& settings)
    {
        for (const std::string& setting : settings)
            words.insert(words.end(), {"--set", setting});
        return words;
    }
    Ended check(const Words& settings) const
    {
        return run(with({"check", input("rigid_column"), "--quiet", "--json", "--pilot", "16", "--trial-seconds", "0"},
                        settings));
    }
    /// Without what takes time.
    Ended look(const std::string& name, const Words& settings = {}) const
    {
        return run(with({"check", input(name), "--json", "--pilot", "0", "--trial-seconds", "0"}, settings));
    }
};

TEST_F(Check, ReportsWhatAnAccuracyHasChosen)
{
    // the file gives its form; two corners need a stiffness, and it does not
    const Ended rigid = check({"run.accuracy=0.2"}),
                corners = check({"contact.form=\"two_corner\"", "run.accuracy=0.2"});
    EXPECT_EQ(rigid.status, 0) << testing::PrintToString(rigid);
    EXPECT_EQ(json_of(rigid)["form"].text, "rigid");
    EXPECT_EQ(rigid.out.find("\"key\": \"contact."), std::string::npos) << rigid.out;
    EXPECT_NE(rigid.out.find("\"key\": \"run.precision\""), std::string::npos) << rigid.out;
    EXPECT_EQ(json_of(corners)["form"].text, "two_corner");
    EXPECT_NE(corners.out.find("\"key\": \"contact.normal_stiffness_n_m2\""), std::string::npos) << corners.out;
}

TEST_F(Check, RefusesAnAccuracyThatNoChoiceReaches)
{
    const Ended ended = check({"contact.form=\"two_corner\"", "run.accuracy=0.01"});
    EXPECT_EQ(ended.status, 2) << testing::PrintToString(ended);
    EXPECT_NE(ended.err.find("is not reached by any stiffness"), std::string::npos) << ended.err;
}

/// 0.05 to 0.6 m/s2 are 0.05 to 0.6 g: `check`, `run`, `info` and the results all say so.
TEST_F(Check, AWeakShakingIsSaidByEveryVerb)
{
    const Words in_g = {"surface.pga_m_s2={from=0.05,to=0.6,count=2}", "surface.frequency_hz={from=2,to=2,count=1}",
                        "study.realizations=2"};
    const std::string name = "Did you mean g (0.6 g is 5.884 m/s2)?", monolith = input("small_scale_monolith");
    const JsonValue warnings = json_of(look("small_scale_monolith", in_g))["warnings"];
    ASSERT_EQ(warnings.items.size(), 1U);
    EXPECT_NE(warnings.items[0].text.find(name), std::string::npos) << warnings.items[0].text;
    const Ended info = run(with({"info", monolith}, in_g));
    EXPECT_NE(info.out.find(name), std::string::npos) << info.out;
    const Ended ran = run(with({"run", monolith, "-o", "weak.h5"}, in_g));
    EXPECT_EQ(ran.status, 0) << testing::PrintToString(ran);
    EXPECT_NE(ran.err.find(name), std::string::npos) << ran.err;
    EXPECT_NE(run({"info", "weak.h5"}).out.find(name), std::string::npos);
}

TEST_F(Check, TellsWhatWillBeRun)
{
    const JsonValue surface = json_of(look("small_scale_column"));
    EXPECT_EQ(surface["kind"].text, "surface");
    EXPECT_EQ(surface["realizations"].number, 16 * 16 * 256);
    EXPECT_EQ(surface["cells"].number, 256);
    EXPECT_EQ(surface["blocks"].number, 7);
    EXPECT_EQ(surface["free_blocks"].number, 6);
    EXPECT_LT(surface["step_s"]["low"].number, surface["step_s"]["high"].number);
    EXPECT_FALSE(surface["realizations_at_most"].boolean);
    EXPECT_EQ(surface["counted_trials"].number, 256);
    EXPECT_NEAR(surface["worst_half_width"].number, 0.061, 5e-4); // as README.md states of this grid
    EXPECT_FALSE(surface.has("trial"));
    EXPECT_FALSE(surface.has("time"));
    EXPECT_FALSE(surface.has("pilot"));
    ASSERT_EQ(surface["weak_spots"].items.size(), 1U); // the dashpots of the paper
    EXPECT_EQ(surface["weak_spots"].items[0]["name"].text, "hardly_damped");
    EXPECT_NEAR(surface["first_mode"]["frequency_hz"].number, 36.925220, 1e-5);
    EXPECT_LT(surface["first_mode"]["damping_ratio"].number, 2e-4);
    EXPECT_GT(surface["free_rocking"]["returned"].number, 0);
    const JsonValue ends = json_of(look("small_scale_column", {"contact.damping=\"ends\""}));
    EXPECT_NEAR(ends["first_mode"]["damping_ratio"].number, 0.0114, 2e-4);
    EXPECT_EQ(ends["not_looked_for"].items.size(), 1U) << "no trial was run";
}

/// What others choose has no pilot, and of its realizations only the most is known.
TEST_F(Check, OfStudiesThatGoInRounds)
{
    for (const auto& [name, most] : {std::pair{"small_scale_column_adaptive", 40000.0},
                                     {"rare_collapse", 121000.0},
                                     {"sensitivity_column", 80000.0}}) {
        const JsonValue json = json_of(look(name));
        EXPECT_EQ(json["realizations"].number, most) << name;
        EXPECT_EQ(json["realizations_at_most"].boolean, std::string(name) != "sensitivity_column") << name;
        expect_refused({"check", input(name), "--pilot", "16", "--trial-seconds", "0"},
                       {"--pilot runs a part of a study twice", "Check the same structure and shaking as a surface."});
    }
}

/// A trial of a study that is small is the whole of it.
TEST_F(Check, TriesTheStudy)
{
    const Words settings{"study.realizations=2", "surface.frequency_hz.count=2", "surface.pga_m_s2.count=2"};
    const Words words = with({"check", input("small_scale_monolith"), "--quiet", "--json", "--pilot", "0"}, settings);
    const JsonValue json = json_of(run(words));
    EXPECT_EQ(json["trial"]["realizations"].number, 8);
    EXPECT_TRUE(json["trial"]["whole"].boolean);
    const Ended ran = run(with({"run", input("small_scale_monolith"), "--quiet", "--json", "-o", "r.h5"}, settings));
    EXPECT_EQ(json["trial"]["collapsed"].number, json_of(ran)["collapsed"].number);
    const JsonValue real = json_of(ran);
    EXPECT_NEAR(json["time"]["block_steps"].number, real["block_steps_per_second"].number * real["seconds"].number, 1);
    EXPECT_LE(json["time"]["range_s"]["low"].number, json["time"]["seconds"].number);
    EXPECT_GE(json["time"]["range_s"]["high"].number, json["time"]["seconds"].number);
    EXPECT_GT(json["memory_bytes"].number, 5e6);
}

TEST_F(Check, KnowsTheSizeOfTheResults)
{
    const std::vector<std::pair<std::string, Words>> studies{
        {"small_scale_monolith", {"study.realizations=8"}},
        {"small_scale_monolith", {"study.realizations=16", "output.realizations=\"none\""}},
        {"mechanisms", {"study.realizations=20"}},
        {"mechanisms", {"study.realizations=20", "output.trajectories=0"}},
        {"near_fault_pulse", {"study.realizations=4"}},
        {"fragility_column", {"study.realizations=6", "fragility.motions=10", "fragility.intensity.count=3"}}};
    for (const auto& [name, settings] : studies) {
        const Ended checked = run(with({"check", input(name), "--quiet", "--json", "--pilot", "0"}, settings));
        ASSERT_EQ(checked.status, 0) << testing::PrintToString(checked);
        const Ended ran = run(with({"run", input(name), "--quiet", "-o", "r.h5"}, settings));
        ASSERT_EQ(ran.status, 0) << testing::PrintToString(ran);
        const auto real = static_cast<double>(fs::file_size(folder / "r.h5"));
        EXPECT_NEAR(json_of(checked)["file_bytes"].number, real, 0.1 * real)
            << name << testing::PrintToString(settings);
        fs::remove(folder / "r.h5");
    }
}

TEST_F(Check, ShowsWhatIsImplausibleAndWhatIsWeak)
{
    const Ended ended = look("small_scale_monolith", {"surface.pga_m_s2.to=40", "study.realizations=4"});
    EXPECT_EQ(ended.status, 0);
    EXPECT_NE(ended.err.find("warning: "), std::string::npos) << ended.err;
    const JsonValue json = json_of(ended);
    ASSERT_EQ(json["warnings"].items.size(), 1U);
    EXPECT_NE(json["warnings"].items[0].text.find("study.allow = [\"pga\"]"), std::string::npos);
    ASSERT_EQ(json["weak_spots"].items.size(), 2U);
    EXPECT_EQ(json["weak_spots"].items[0]["name"].text, "wide_interval");
    EXPECT_EQ(json["weak_spots"].items[1]["name"].text, "hardly_damped");
    const Ended text = run(with({"check", input("small_scale_monolith"), "--pilot", "0", "--trial-seconds", "0"},
                                {"study.realizations=4"}));
    EXPECT_NE(text.out.find("weak: wide_interval: 4 runs of a cell fix"), std::string::npos) << text.out;
}

TEST_F(Check, DrawsTheStructure)
{
    const Words words{"check", input("doric_column"), "--pilot", "0", "--trial-seconds", "0", "--quiet"};
    const auto and_also = [&](const Words& more) {
        Words all = words;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    const Ended ended = run(and_also({"--to", "svg"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_NE(ended.out.find("picture: doric_column_structure.svg\n"), std::string::npos) << ended.out;
    EXPECT_NE(read_bytes(folder / "doric_column_structure.svg").find("capital"), std::string::npos);
    EXPECT_EQ(run(and_also({"-o", "column.PNG"})).status, 0);
    EXPECT_TRUE(read_bytes(folder / "column.PNG").starts_with("\x89PNG"));

    const Words in_space{"check", input("round_column"), "--pilot", "0", "--trial-seconds", "0", "--quiet", "--to",
                         "svg"};
    EXPECT_EQ(run(in_space).status, 0);
    const std::string space = read_bytes(folder / "round_column_structure.svg");
    for (const char* words : {"from the front", "from the side", ">plan<", "drums 1 to 6: diameter 1 m, height 1 m"})
        EXPECT_NE(space.find(words), std::string::npos) << words;

    expect_refused(and_also({"--to", "svg"}), {"doric_column_structure.svg", "exists already", "--force"});
    EXPECT_EQ(run(and_also({"--to", "svg", "--force"})).status, 0);
    expect_refused(and_also({"--to", "gif"}), {"--to", "gif"});
    expect_refused(and_also({"-o", "column.txt"}), {"-o column.txt", ".png, .svg or .pdf"});
    expect_refused(and_also({"--to", "png", "-o", "new.svg"}), {"--to png and -o new.svg"});
    expect_refused({"check", input("doric_column"), "--pilot", "3"}, {"--pilot 3", "16"});
    expect_refused({"check", input("doric_column"), "--trial-seconds", "-1"}, {"--trial-seconds"});
}

TEST_F(Check, CanBeInterruptedInTheTrial)
{
    ProgramRun program;
    program.arguments = {"check", input("small_scale_column"), "--trial-seconds", "3600", "--to", "svg"};
    program.signal = SIGINT;
    program.when = when_there(folder / "small_scale_column_structure.svg"); // it is drawn before the trial
    const Ended ended = run(program);
    EXPECT_EQ(ended.status, 130) << testing::PrintToString(ended);
    EXPECT_EQ(ended.out, "");
    EXPECT_NE(ended.err.find("Interrupted"), std::string::npos);
}

} // namespace
} // namespace stylobate

/// What no study can mean: each check at both sides of its limit, with expected values by hand, and silent for every
/// study that is ready to run.

#include "ensemble/model/nominal.hpp"
#include "ensemble/planar/structure/nominal_statics.hpp"
#include "ensemble/sampling/plausible.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace stylobate {
namespace {

namespace fs = std::filesystem;
const fs::path root = STYLOBATE_SOURCE_DIR;

/// Six free drums of 48 x 29 mm on a fixed one.
const std::string drums = R"(
[structure]
blocks = 7
fixed_blocks = 1
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.1355
[contact]
normal_stiffness_n_m2 = 1e8
friction = 0.68
)";
const std::string sine = R"(
[study]
kind = "single"
[excitation]
kind = "harmonic"
frequency_hz = 2
pga_m_s2 = 3
)";
const std::string noise = R"(
[study]
kind = "single"
[excitation]
kind = "noise"
frequency_hz = 2.5
pga_m_s2 = 3
)";

Study read(const std::string& text, const std::vector<std::string>& settings = {})
{
    return parse_study(text, "temple.toml", settings);
}

/// What a check makes of a study: "", "warns" or "refuses"; and that no other check says anything, unless it is named.
std::string verdict(const Study& study, const std::string& check, const StudyFacts& facts = {},
                    const std::vector<std::string>& others = {})
{
    std::string found;
    for (const Implausibility& one : implausibilities(study, facts)) {
        if (one.check == check)
            found = one.refused ? "refuses" : "warns";
        else
            EXPECT_NE(std::find(others.begin(), others.end(), one.check), others.end())
                << one.check << ": " << one.text;
        EXPECT_TRUE(one.text.ends_with('.') || one.text.ends_with('?')) << one.text;
        EXPECT_EQ(one.text.find('\n'), std::string::npos) << one.text;
    }
    return found;
}

std::string text_of(const Study& study, const std::string& check)
{
    for (const Implausibility& one : implausibilities(study))
        if (one.check == check)
            return one.text;
    return "";
}

TEST(Plausible, SinkageIsTheWeightOverTheBed)
{
    // W / (K_N B): 6, 5 ... 1 drums of 0.1355 kg on beds of 48 mm
    const std::vector<double> sinkage = static_sinkage_m(read(sine + drums));
    ASSERT_EQ(sinkage.size(), 6U);
    EXPECT_NEAR(sinkage[0], 1.661569e-6, 1e-12);
    EXPECT_NEAR(sinkage[5], 2.769281e-7, 1e-13);

    // two columns of two drums of 0.375 kg, 60 mm wide; each carries half an epistyle of 1.14 kg
    const Study colonnade = read(sine + R"(
[structure]
kind = "colonnade"
depth_m = 0.06
columns = 2
column_spacing_m = 0.09
drums = [ { width_m = 0.06, height_m = 0.05, mass_kg = 0.375, count = 2 } ]
epistyle_height_m = 0.06
epistyle_mass_kg = 1.14
[contact]
normal_stiffness_n_m2 = 1e8
friction = 0.68
)");
    const std::vector<double> beds = static_sinkage_m(colonnade);
    ASSERT_EQ(beds.size(), 6U);
    EXPECT_NEAR(beds[0], (0.75 + 0.57) * 9.81 / (1e8 * 0.06), 1e-15);
    EXPECT_NEAR(beds[3], (0.375 + 0.57) * 9.81 / (1e8 * 0.06), 1e-15);
    EXPECT_NEAR(beds[4], 0.57 * 9.81 / (1e8 * 0.06), 1e-15); // the seats, their whole faces
}

TEST(Plausible, SinkageOverTheSizeOfABlock)
{
    // 1.661569e-6 m at 1e8: 2e-3 of 29 mm at 2.8648e6, 2e-2 at 2.8648e5
    const auto with = [](const std::string& K_N) {
        return verdict(read(sine + drums, {"contact.normal_stiffness_n_m2=" + K_N}), "sinkage", {},
                       {"stiffness", "first_frequency"});
    };
    EXPECT_EQ(with("2.9e6"), "");
    EXPECT_EQ(with("2.8e6"), "warns");
    EXPECT_EQ(with("2.9e5"), "warns");
    EXPECT_EQ(with("2.8e5"), "refuses");
}

TEST(Plausible, AThousandTimesTooSoft)
{
    // the small column: 1.66 mm, and it buckles below 148349 N/m2
    const Study small = read_study(root / "studies/inputs/small_scale_column.toml",
                                   {"contact.normal_stiffness_n_m2=1e5", "contact.tangential_stiffness_n_m=4.8e3"});
    EXPECT_NE(text_of(small, "sinkage").find("1.66 mm"), std::string::npos) << text_of(small, "sinkage");
    EXPECT_EQ(verdict(small, "sinkage", {}, {"stiffness", "first_frequency"}), "refuses");
    EXPECT_NE(text_of(small, "first_frequency").find("buckles"), std::string::npos);

    // a marble column of 4.8 m on one metre: 2700 kg/m3 x 9.81 m/s2 x 4.8 m over 3e6 N/m3 = 42.4 mm
    const Study marble =
        read_study(root / "studies/inputs/near_fault_pulse.toml", {"contact.normal_stiffness_n_m2=3e6"});
    EXPECT_NE(text_of(marble, "sinkage").find("42.4 mm"), std::string::npos) << text_of(marble, "sinkage");
    EXPECT_EQ(verdict(marble, "sinkage", {}, {"stiffness", "first_frequency"}), "refuses");
}

/// The check is made for every size: cubes of a metre on beds of 3 GPa/m.
TEST(Plausible, TallStacksBuckle)
{
    for (const char* blocks : {"100", "101", "200"}) {
        const Study stack =
            read("[study]\nkind = \"single\"\n[structure]\ndrum_width_m = 1\ndrum_height_m = 1\ndepth_m = "
                 "1\ndensity_kg_m3 = 2700\n[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.6\n"
                 "[excitation]\nkind = \"none\"\nduration_s = 10\n",
                 {std::string("structure.blocks=") + blocks});
        EXPECT_NE(text_of(stack, "first_frequency").find("buckles"), std::string::npos) << blocks;
    }
}

TEST(Plausible, FirstFrequencyAgainstTheShaking)
{
    EXPECT_NEAR(first_frequency_hz(read(sine + drums)), 36.925220, 1e-5);
    EXPECT_NEAR(first_frequency_hz(read(sine + drums, {"contact.normal_stiffness_n_m2=1e7"})), 11.600457, 1e-5);
    const auto at = [](const std::string& hz, const std::string& K_N) {
        return verdict(read(sine + drums, {"excitation.frequency_hz=" + hz, "contact.normal_stiffness_n_m2=" + K_N}),
                       "first_frequency", {}, {"sinkage", "stiffness"});
    };
    EXPECT_EQ(at("36.9", "1e8"), "");
    EXPECT_EQ(at("37.0", "1e8"), "warns");
    EXPECT_EQ(at("11.5", "1e7"), "");
    EXPECT_EQ(at("11.7", "1e7"), "warns");
    EXPECT_EQ(at("0.1", "150000"), "");
    EXPECT_EQ(at("0.1", "148360"), "warns") << "it stands down to 148349";
    EXPECT_EQ(at("0.1", "148300"), "refuses") << "and buckles below";

    Study record =
        read("[study]\nkind = \"single\"\n[excitation]\nkind = \"record\"\nfile = \"a\"\ntime_scale = 0.1" + drums);
    EXPECT_EQ(verdict(record, "first_frequency", {.pga_m_s2 = 3, .motion_frequency_hz = 3.6}), "");
    EXPECT_EQ(verdict(record, "first_frequency", {.pga_m_s2 = 3, .motion_frequency_hz = 3.7}), "warns");
}

TEST(Plausible, AccelerationOfTheGroundAgainstRecords)
{
    const auto with = [](const std::string& pga) {
        return verdict(read(noise + drums, {"excitation.pga_m_s2=" + pga}), "pga");
    };
    EXPECT_EQ(with("30"), "");
    EXPECT_EQ(with("30.1"), "warns");
    EXPECT_EQ(with("100"), "warns");
    EXPECT_EQ(with("101"), "refuses");
    EXPECT_NE(text_of(read(noise + drums, {"excitation.pga_m_s2=350"}), "pga").find("3.5 m/s2"), std::string::npos)
        << "what was meant";

    const Study record = read("[study]\nkind = \"single\"\n[excitation]\nkind = \"record\"\nfile = \"a\"" + drums);
    EXPECT_EQ(verdict(record, "pga", {.pga_m_s2 = 29}), "");
    EXPECT_EQ(verdict(record, "pga", {.pga_m_s2 = 31}), "warns");
    EXPECT_EQ(verdict(record, "pga", {.pga_m_s2 = 350}), "refuses");

    const auto fragility = [](const std::string& intensity) {
        return verdict(read_study(root / "studies/inputs/fragility_column.toml", {"fragility.intensity=" + intensity}),
                       "pga");
    };
    EXPECT_EQ(fragility("{ measure = \"pga\", from = 1, to = 30, count = 3 }"), "");
    EXPECT_EQ(fragility("{ measure = \"pga\", from = 1, to = 31, count = 3 }"), "warns");
    EXPECT_EQ(fragility("{ measure = \"sa\", period_s = 1, from = 1, to = 74, count = 3 }"), "");
    EXPECT_EQ(fragility("{ measure = \"sa\", period_s = 1, from = 1, to = 76, count = 3 }"), "warns");
    EXPECT_EQ(fragility("{ measure = \"pgv\", from = 1, to = 5, count = 3 }"), "");
    EXPECT_EQ(fragility("{ measure = \"pgv\", from = 1, to = 5.1, count = 3 }"), "warns");
    EXPECT_EQ(fragility("{ measure = \"pgv\", from = 20, to = 90, count = 3 }"), "refuses") << "cm/s";
}

TEST(Plausible, AccelerationOfASineAgainstItsVelocity)
{
    const auto at = [](double hz, double velocity) {
        const double pga = 2 * std::numbers::pi * hz * velocity;
        return verdict(read(sine + drums, {"excitation.frequency_hz=" + std::to_string(hz),
                                           "excitation.pga_m_s2=" + std::to_string(pga)}),
                       "pga", {}, {"first_frequency"});
    };
    EXPECT_EQ(at(20, 0.39), "") << "49 m/s2";
    EXPECT_EQ(at(20, 0.41), "warns") << "51.5 m/s2, which no table for columns has";
    EXPECT_EQ(at(1, 4.99), "");
    EXPECT_EQ(at(1, 5.01), "warns");
    EXPECT_EQ(at(2, 49.9), "warns");
    EXPECT_EQ(at(2, 50.1), "refuses");
    EXPECT_EQ(at(0.5, 9), "") << "28.3 m/s2, which records have too";

    // the surface in cm/s2: 1200 m/s2 at 0.5 Hz
    const Study surface = read_study(root / "studies/inputs/small_scale_column.toml",
                                     {"surface.pga_m_s2={ from = 100, to = 1200, count = 16 }"});
    EXPECT_EQ(verdict(surface, "pga"), "refuses");
    EXPECT_NE(text_of(surface, "pga").find("Did you mean cm/s2 (12 m/s2) or mm/s2 (1.2 m/s2)?"), std::string::npos)
        << text_of(surface, "pga");
}

TEST(Plausible, FrequencyOfTheShaking)
{
    const auto at = [](const std::string& hz) {
        return verdict(read(sine + drums, {"excitation.frequency_hz=" + hz, "excitation.pga_m_s2=0.01"}),
                       "shaking_frequency", {}, {"first_frequency"});
    };
    EXPECT_EQ(at("0.05"), "");
    EXPECT_EQ(at("0.049"), "warns");
    EXPECT_EQ(at("100"), "");
    EXPECT_EQ(at("101"), "warns");
}

TEST(Plausible, DensityOfStone)
{
    const double volume = 0.048 * 0.029 * 0.048;
    const auto with = [&](double density) {
        return verdict(read(sine + drums, {"structure.drum_mass_kg=" + std::to_string(density * volume)}), "density");
    };
    EXPECT_EQ(with(1010), "");
    EXPECT_EQ(with(990), "warns");
    EXPECT_EQ(with(3990), "");
    EXPECT_EQ(with(4010), "warns");
    EXPECT_EQ(with(7850), "warns") << "steel";

    const Study gram = read_study(root / "studies/inputs/doric_column.toml", {"structure.density_kg_m3=2.7"});
    EXPECT_EQ(verdict(gram, "density"), "refuses");
    EXPECT_NE(text_of(gram, "density").find("Did you mean 2700 kg/m3"), std::string::npos) << text_of(gram, "density");
    EXPECT_EQ(with(24900), "warns");
    EXPECT_EQ(with(25100), "refuses") << "and what is above 30000 the reader refuses";
    EXPECT_EQ(with(99), "refuses");
}

TEST(Plausible, SizesAndStiffnessPerDepth)
{
    const auto size = [](const std::vector<std::string>& settings) {
        return verdict(read(sine + drums, settings), "size", {}, {"density", "stiffness", "sinkage"});
    };
    EXPECT_EQ(size({"structure.drum_height_m=0.0051"}), "");
    EXPECT_EQ(size({"structure.drum_height_m=0.0049"}), "warns");
    EXPECT_EQ(size({"structure.depth_m=0.95"}), "");
    EXPECT_EQ(size({"structure.depth_m=0.97"}), "warns") << "20 times as deep as wide";

    const auto bed = [](const std::string& depth, const std::string& K_N) {
        return verdict(read(sine + drums, {"structure.depth_m=" + depth, "contact.normal_stiffness_n_m2=" + K_N}),
                       "stiffness", {}, {"density", "sinkage", "first_frequency"});
    };
    EXPECT_EQ(bed("0.048", "4.9e5"), "");
    EXPECT_EQ(bed("0.048", "4.7e5"), "warns");
    EXPECT_EQ(bed("0.048", "4.7e11"), "");
    EXPECT_EQ(bed("0.048", "4.9e11"), "warns");

    const std::string tall = "[structure]\nblocks = 4\ndrum_width_m = 3\ndepth_m = 3\ndensity_kg_m3 = 2700\n"
                             "drum_height_m = 8.7\n[contact]\nnormal_stiffness_n_m2 = 1e11\nfriction = 0.7\n";
    EXPECT_EQ(verdict(read(sine + tall), "size", {}, {"first_frequency"}), "");
    EXPECT_EQ(verdict(read(sine + tall, {"structure.drum_height_m=8.8"}), "size", {}, {"first_frequency"}), "warns");
}

/// Lengths in millimetres or centimetres, and one that is a thousandth of what was meant: said before what they make of
/// the rest, with the key and the unit.
TEST(Plausible, ProportionsOfOtherUnits)
{
    std::string stone = sine + drums;
    const std::string mass = "drum_mass_kg = 0.1355";
    stone.replace(stone.find(mass), mass.size(), "density_kg_m3 = 2028");
    const auto first_refusal = [&](const std::string& setting) {
        for (const Implausibility& one : implausibilities(read(stone, {setting})))
            if (one.refused)
                return one.check + ": " + one.text;
        return std::string();
    };
    const auto expect = [&](const std::string& setting, const std::string& part) {
        const std::string text = first_refusal(setting);
        EXPECT_TRUE(text.starts_with("size: ")) << setting << ": " << text;
        EXPECT_TRUE(text.ends_with(part)) << setting << ": " << text;
    };
    expect("structure.drum_height_m=29",
           "drum_height_m (or height_m) = 29 is in metres. Did you mean mm (0.029 m) or cm (0.29 m)?");
    expect("structure.drum_height_m=2.9", "drum_height_m (or height_m) = 2.9 is in metres. Did you mean cm (0.029 m)?");
    expect("structure.drum_width_m=4.8e-5", "drum_width_m (or width_m) = 4.8e-05 is in metres.");
    expect("structure.drum_width_m=4.8", "drum_width_m (or width_m) = 4.8 is in metres. Did you mean cm (0.048 m)?");
    expect("structure.drum_height_m=2.9e-5", "drum_height_m (or height_m) = 2.9e-05 is in metres.");
    // 7 drums of 29 mm: the top is at 203 mm, 100 times 2.03 mm
    EXPECT_EQ(first_refusal("structure.drum_width_m=0.0021").find("size: "), std::string::npos);
    EXPECT_EQ(first_refusal("structure.drum_width_m=0.0020").find("size: "), 0U);
    // 48 mm over 100 is 0.48 mm
    EXPECT_EQ(first_refusal("structure.drum_height_m=0.00049").find("size: "), std::string::npos);
    EXPECT_EQ(first_refusal("structure.drum_height_m=0.00047").find("size: "), 0U);
}

TEST(Plausible, ObelisksAreHigh)
{
    const std::string obelisk = "[structure]\nblocks = 1\ndrum_width_m = 2.8\ndepth_m = 2.8\ndensity_kg_m3 = 2700\n"
                                "drum_height_m = 32\n[contact]\nnormal_stiffness_n_m2 = 1e11\nfriction = 0.7\n";
    EXPECT_EQ(verdict(read(sine + obelisk), "size", {}, {"first_frequency"}), "") << "Lateran obelisk";
    const Study wide = read(sine + obelisk, {"structure.drum_width_m=12"});
    EXPECT_EQ(verdict(wide, "size", {}, {"first_frequency"}), "warns");
    EXPECT_NE(text_of(wide, "size").find("12 mm would be 0.012 m, 12 cm would be 0.12 m"), std::string::npos);
}

TEST(Plausible, MotionsOfASet)
{
    Study study = read(noise + drums);
    study.fragility = FragilitySpec{};
    study.fragility->motions = 9;
    study.fragility->measure = IntensityMeasure::arias;
    const auto found = [&](const std::string& check, const StudyFacts& facts) {
        for (const Implausibility& one : implausibilities(study, facts))
            if (one.check == check)
                return (one.refused ? "refuses: " : "warns: ") + one.text;
        return std::string();
    };
    StudyFacts facts;
    facts.scaled = {{"a.AT2", 10}, {"b.AT2", 0.01}};
    EXPECT_EQ(found("scale", facts), "");
    facts.scaled = {{"a.AT2", 10.1}, {"b.AT2", 357}, {"c.AT2", 2}};
    const std::string scale = found("scale", facts);
    EXPECT_TRUE(scale.starts_with("warns: 2 of 3 motions")) << scale;
    EXPECT_NE(scale.find("b.AT2 (factor 357) and a.AT2 (factor 10.1)"), std::string::npos) << scale;

    facts.equal_motions = {{"a", "b", "c"}, {"x", "y"}};
    const std::string equal = found("equal_motions", facts);
    EXPECT_NE(equal.find("a, b and c; x and y. 3 of the 9 motions are"), std::string::npos) << equal;

    facts.vertical_motions = {"v.AT2"};
    EXPECT_TRUE(found("direction", facts).starts_with("refuses: Vertical component would shake")) << "a vertical one";
    facts.vertical_motions.clear();
    facts.vertical_motion = "h.AT2";
    EXPECT_TRUE(found("direction", facts).starts_with("warns: The vertical motion h.AT2")) << "no vertical one";

    EXPECT_EQ(found("left_out", facts), "");
    study.fragility->left_out = {"x.VT2"};
    EXPECT_NE(found("left_out", facts).find("1 file or component of fragility.folder is no horizontal"),
              std::string::npos)
        << found("left_out", facts);
    study.allow = {"scale", "equal_motions", "direction", "left_out"};
    for (const std::string& check : study.allow)
        EXPECT_EQ(found(check, facts), "") << check;
}

TEST(Plausible, FrictionAndDamping)
{
    const auto friction = [](const std::vector<std::string>& settings) {
        return verdict(read(sine + drums, settings), "friction");
    };
    EXPECT_EQ(friction({"contact.friction=0.1"}), "");
    EXPECT_EQ(friction({"contact.friction=0.09"}), "warns");
    EXPECT_EQ(friction({"contact.friction=1.2"}), "");
    EXPECT_EQ(friction({"contact.friction=1.21"}), "warns");
    EXPECT_EQ(friction({"contact.friction=3.1"}), "refuses");
    EXPECT_EQ(friction({"perturbation.friction={ distribution = \"uniform\", from = 0.4, to = 1.3 }"}), "warns");

    const auto damping = [](const std::vector<std::string>& settings) {
        return verdict(read(sine + drums, settings), "damping");
    };
    EXPECT_EQ(damping({"contact.normal_damping_ratio=0.7"}), "");
    EXPECT_EQ(damping({"contact.normal_damping_ratio=0.71"}), "warns");
    // 2 xi sqrt(K_N B m) = 2 x 0.7 x sqrt(1e8 x 0.048 x 0.1355) = 1129.07
    EXPECT_EQ(damping({"contact.normal_damping_n_s_m=1129"}), "");
    EXPECT_EQ(damping({"contact.normal_damping_n_s_m=1130"}), "warns");
}

TEST(Plausible, Spreads)
{
    const auto spread = [](const std::string& perturbation) {
        return verdict(read(sine + drums, {"perturbation." + perturbation}), "spread");
    };
    EXPECT_EQ(spread("drum_width={ distribution = \"normal\", sd_m = 0.0095, min = 0.01 }"), "") << "0.2 x 48 mm";
    EXPECT_EQ(spread("drum_width={ distribution = \"normal\", sd_m = 0.0097, min = 0.01 }"), "warns");
    EXPECT_EQ(spread("drum_height={ distribution = \"normal\", sd_m = 0.0057, min = 0.01 }"), "") << "0.2 x 29 mm";
    EXPECT_EQ(spread("drum_height={ distribution = \"normal\", sd_m = 0.0059, min = 0.01 }"), "warns");
    EXPECT_EQ(spread("drum_offset={ distribution = \"normal\", sd_m = 0.0097 }"), "warns");
    EXPECT_EQ(spread("tilt={ distribution = \"normal\", sd_rad = 0.099 }"), "");
    EXPECT_EQ(spread("tilt={ distribution = \"normal\", sd_rad = 0.101 }"), "warns");
    EXPECT_EQ(spread("friction={ distribution = \"normal\", cov = 0.5, min = 0.1 }"), "");
    EXPECT_EQ(spread("friction={ distribution = \"normal\", cov = 0.51, min = 0.1 }"), "warns");
    EXPECT_EQ(spread("normal_stiffness={ distribution = \"lognormal\", sigma_ln = 1.5 }"), "");
    EXPECT_EQ(spread("normal_stiffness={ distribution = \"lognormal\", sigma_ln = 1.6 }"), "warns");
}

TEST(Plausible, SizeOfTheResults)
{
    const Study study = read(sine + drums);
    EXPECT_EQ(verdict(study, "file_size", {.file_bytes = 4e9}), "");
    EXPECT_EQ(verdict(study, "file_size", {.file_bytes = 4.1e9}), "warns");
    EXPECT_EQ(verdict(study, "file_size", {.file_bytes = 1.1e11}), "refuses");
}

TEST(Plausible, AKeySilencesOneCheck)
{
    const std::vector<std::string> absurd = {"contact.friction=9", "structure.drum_mass_kg=1.355"};
    std::vector<std::string> settings = absurd;
    EXPECT_EQ(verdict(read(sine + drums, settings), "friction", {}, {"density", "sinkage"}), "refuses");
    settings.emplace_back("study.allow=[\"friction\"]");
    EXPECT_EQ(verdict(read(sine + drums, settings), "friction", {}, {"density", "sinkage"}), "");
    EXPECT_NE(verdict(read(sine + drums, settings), "density", {}, {"sinkage"}), "");
    for (const std::string& name : check_names()) // each name is one that the key takes
        EXPECT_EQ(read(sine + drums, {"study.allow=[\"" + name + "\"]"}).allow, std::vector<std::string>{name});
    EXPECT_EQ(read(sine + drums, {"study.allow=[\"friction\", \"pga\", \"friction\"]"}).allow,
              (std::vector<std::string>{"pga", "friction"}));
    const auto refused = [](const std::string& value, const std::string& part) {
        try {
            read(sine + drums, {"study.allow=" + value});
            ADD_FAILURE() << value;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    };
    refused("[\"frictoin\"]", "Did you mean \"friction\"?");
    refused("[1]", "not a check");
    refused("\"pga\"", "not a list");
}

TEST(Plausible, EveryReadyStudyIsSilent)
{
    int studies = 0;
    for (const char* folder : {"studies/inputs", "studies/evidence/paper"})
        for (const auto& entry : fs::directory_iterator(root / folder)) {
            if (entry.path().extension() != ".toml")
                continue;
            std::vector<std::string> settings;
            if (entry.path().filename() == "record.toml") // that the user names
                settings = {"excitation.file=a.txt"};
            for (const Implausibility& one : implausibilities(read_study(entry.path(), settings)))
                ADD_FAILURE() << entry.path() << ": " << one.check << ": " << one.text;
            ++studies;
        }
    EXPECT_GE(studies, 25);
}

} // namespace
} // namespace stylobate

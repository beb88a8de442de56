/// Mechanisms and contact forms in a study file: what is read, written and refused, and with which words.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <vector>

namespace stylobate::test_study_mechanisms {
namespace {

/// [mechanisms] begins in line 16; six joints, seven blocks of which block 0 is fixed.
std::string study(const std::string& mechanisms, const std::string& contact = {},
                  const std::string& excitation = "kind = \"harmonic\"\nfrequency_hz = 2\npga_m_s2 = 3")
{
    std::string text = "[study]\nkind = \"single\"\n[structure]\nblocks = 7\nfixed_blocks = 1\ndrum_width_m = 0.048\n"
                       "drum_height_m = 0.029\ndepth_m = 0.048\ndrum_mass_kg = 0.1355\n[excitation]\n" +
                       excitation + "\n";
    text += std::string(static_cast<std::size_t>(14 - std::count(text.begin(), text.end(), '\n')), '\n');
    return text + "\n[mechanisms]\n" + mechanisms + "\n[contact]\nnormal_stiffness_n_m2 = 1e8\nfriction = 0.68\n" +
           contact + "\n";
}

Study read(const std::string& mechanisms, const std::string& contact = {})
{
    return parse_study(study(mechanisms, contact), "temple.toml");
}

/// Expects a refusal in a line whose message has all the words.
void expect_refused(const std::string& text, int line, const std::vector<std::string>& words)
{
    try {
        parse_study(text, "temple.toml");
        ADD_FAILURE() << "accepted; expected a refusal in line " << line << "\n" << text;
    } catch (const InputError& error) {
        const std::string message = error.what(), place = "temple.toml:" + std::to_string(line) + ": ";
        EXPECT_EQ(message.substr(0, place.size()), place) << message << "\n" << text;
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in:\n" << message;
    }
}

void expect_refused(const std::string& mechanisms, const std::vector<std::string>& words)
{
    expect_refused(study(mechanisms), 17, words);
}

/// One of each, each with other values than the neutral ones.
const std::string all_mechanisms = R"(stribeck = { dynamic_friction = 0.5, velocity_m_s = 0.05 }
joint_friction = [ { joint = 2, ratio = 0.57 }, { joints = [0, 5], ratio = 1.2 } ]
drag = { block = 6, coefficient_n_s2_m2 = 0.1 }
corner_loss = { joint = 1, left_m = 0.002, right_m = 0.003 }
hertz = { exponent = 1.2 }
rate_damping = { rate_s_m = 0.3 }
face_damping = { share = 0.4, joints = [4, 3] }
friction_wear = { rate_per_m = 0.5 }
corner_wear = { loss_m_rad = 1e-3 }
table_pitch = { rotation_rad_s2_m = 1e-4 }
vertical_motion = { ratio = 0.3 }
harmonic_distortion = { second = 0.02, third_quadrature = -0.01 }
time_offset = { offset_s = -0.0127 }
sensor_gain = { gain = 0.88 }
dowel = { joint = 0, stiffness_n_m = 1e5, yield_n = 20, gap_m = 1e-3 }
adhesion = { force_n_m = 3, tension_n_m = 2 }
eccentricity = { blocks = [1, 3], offset_m = -0.001 }
wedge = { joint = 0, angle_rad = 0.0041 }
drum_offset = { block = 2, offset_m = 0.0005 }
tie = { block = 4, stiffness_n_m = -50, dashpot_n_s_m = 2, force_n = 0.1, turning_dashpot_n_m_s = 0.01 }
tendon = { block = 6, stiffness_n_m = 1e6, prestress_n = 500, yield_n = 2000 }
bearing = { joint = 0, stiffness_n_m = 2e4, dashpot_n_s_m = 30, curvature_per_m = 0.5 }
mortar = { joints = [2, 3], tensile_strength_pa = 2e5, cohesion_pa = 3e5 }
pull_out = { joint = 1, hold_n = 50, stiffness_n_m = 1e6, length_m = 0.01, spread_m = 0.012 }
rod = { block = 2, to_right_n_m = 2e4, height_m = 0.02, speed_m_s = 0.02, start_s = 0.2, travel_m = 0.01, laboratory = 1 }
table_tilt = { angle_rad = -0.6, rate_rad_s = 0.035, start_s = 0.5 }
)";

const MechanismSpec& only(const Study& study, Mechanism mechanism)
{
    const auto at = std::find_if(study.mechanisms.begin(), study.mechanisms.end(),
                                 [&](const MechanismSpec& spec) { return spec.mechanism == mechanism; });
    return *at;
}

/// Of a mechanism's parameters, in their order; the others are 0.
std::array<double, most_parameters> values(std::initializer_list<double> first)
{
    std::array<double, most_parameters> all{};
    std::copy(first.begin(), first.end(), all.begin());
    return all;
}

TEST(StudyMechanisms, ReadsEveryMechanism)
{
    const Study s = read(all_mechanisms);
    for (const MechanismRule& rule : mechanism_rules())
        ASSERT_TRUE(s.names(rule.mechanism) || rule.mechanism == Mechanism::clamp) << rule.name;
    ASSERT_EQ(s.mechanisms.size(), 27u); // joint_friction has two; there is nothing to clamp
    for (std::size_t i = 1; i < s.mechanisms.size(); ++i)
        EXPECT_LE(s.mechanisms[i - 1].mechanism, s.mechanisms[i].mechanism);

    const MechanismSpec& stribeck = only(s, Mechanism::stribeck);
    EXPECT_EQ(stribeck.values, values({0.5, 0.05, 0.0, 0.0}));
    EXPECT_TRUE(stribeck.places.empty());
    EXPECT_EQ(s.mechanisms[1].places, (std::vector{0, 5})); // in the order of the places
    EXPECT_EQ(s.mechanisms[1].values[0], 1.2);
    EXPECT_EQ(s.mechanisms[2].places, std::vector{2});
    EXPECT_EQ(only(s, Mechanism::drag).places, std::vector{6});
    EXPECT_EQ(only(s, Mechanism::corner_loss).values, values({0.002, 0.003, 0.0, 0.0}));
    EXPECT_EQ(only(s, Mechanism::hertz).values, values({1.2, 0.0, 0.0, 0.0}));
    EXPECT_EQ(only(s, Mechanism::face_damping).places, (std::vector{3, 4}));
    EXPECT_EQ(only(s, Mechanism::harmonic_distortion).values, values({0.02, 0.0, 0.0, -0.01}));
    EXPECT_EQ(only(s, Mechanism::dowel).values, values({1e5, 20.0, 1e-3, 0.0}));
    EXPECT_EQ(only(s, Mechanism::tie).values, values({-50.0, 2.0, 0.1, 0.01}));
    EXPECT_EQ(only(s, Mechanism::eccentricity).places, (std::vector{1, 3}));
    EXPECT_EQ(only(s, Mechanism::tendon).values, values({1e6, 500, 2000}));
    EXPECT_TRUE(only(s, Mechanism::tendon).places.empty()); // the uppermost drum
    EXPECT_EQ(only(s, Mechanism::bearing).values, values({2e4, 30, 0.5}));
    EXPECT_TRUE(only(s, Mechanism::bearing).places.empty()); // the lowest joint
    EXPECT_EQ(only(s, Mechanism::mortar).values, values({2e5, 3e5}));
    EXPECT_EQ(only(s, Mechanism::pull_out).values, values({50, 1e6, 0.01, 0.012}));
    EXPECT_EQ(only(s, Mechanism::adhesion).values, values({3, 0, 2}));
    EXPECT_EQ(only(s, Mechanism::rod).values, values({2e4, 0, 0.02, 0.02, 0.2, 0.01, 1}));
    EXPECT_EQ(only(s, Mechanism::rod).places, std::vector{2});
    EXPECT_EQ(only(s, Mechanism::table_tilt).values, values({-0.6, 0.035, 0.5}));
    EXPECT_FALSE(s.vertical);
}

TEST(StudyMechanisms, OfALaboratoryRefusesWhatDoesNothing)
{
    expect_refused("rod = { block = 2, to_left_n_m = 1e4, speed_m_s = 0.1 }", {"speed_m_s", "travel_m"});
    expect_refused("rod = { block = 2, to_left_n_m = 1e4, height_m = 1 }", {"height_m", "above block 2"});
    expect_refused("rod = { block = 2, height_m = 0.01 }", {"to_right_n_m", "to_left_n_m"});
    expect_refused("adhesion = { force_n_m = 0, tension_n_m = 2 }", {"tension_n_m", "force_n_m"});
    expect_refused("table_tilt = { angle_rad = 0.1 }", {"rate_rad_s"});
}

TEST(StudyMechanisms, WritesWhatItReads)
{
    const std::vector<std::string> all = {
        all_mechanisms, "vertical_motion = { file = \"up.at2\", component = \"UP\", unit = \"gal\", baseline = false }",
        all_mechanisms + "[perturbation.mechanisms]\nstribeck.velocity_m_s = { distribution = \"lognormal\", sigma_ln "
                         "= 0.3, per = \"structure\" }\nwedge = { angle_rad = { distribution = \"normal\", sd_rad = "
                         "0.001 } }\njoint_friction.ratio = { distribution = \"normal\", cov = 0.05, min = 0.2 }\n"};
    std::vector<std::string> texts;
    for (const std::string& mechanisms : all) {
        const Study s = read(mechanisms);
        const Study again = parse_study(s.text, "again.toml");
        EXPECT_EQ(again.text, s.text);
        EXPECT_EQ(again.mechanisms, s.mechanisms);
        EXPECT_EQ(again.mechanism_perturbations.size(), s.mechanism_perturbations.size());
        texts.push_back(s.text);
    }
    EXPECT_NE(texts[0], texts[2]);
    EXPECT_EQ(parse_study(texts[1], "again.toml").vertical->unit, "cm/s2");
}

TEST(StudyMechanisms, EqualStudiesHaveEqualTexts)
{
    const std::string text = read("wedge = { joints = [1, 2], angle_rad = 0.001 }").text;
    EXPECT_EQ(read("wedge = [ { joint = 2, angle_rad = 1e-3 }, { joint = 1, angle_rad = 0.001 } ]").text, text);
    EXPECT_EQ(read("[[mechanisms.wedge]]\njoint = 2\nangle_rad = 1e-3\n[[mechanisms.wedge]]\njoint = 1\nangle_rad = "
                   "1e-3")
                  .text,
              text);
    // everywhere, said in three ways
    const std::string drag = read("drag = { coefficient_n_s2_m2 = 0.1 }").text;
    EXPECT_EQ(read("drag = { coefficient_n_s2_m2 = 0.1, blocks = [1, 2, 3, 4, 5, 6] }").text, drag);
    EXPECT_EQ(read("drag = [ { coefficient_n_s2_m2 = 0.1, blocks = [1, 2, 3] }, { coefficient_n_s2_m2 = 0.1, blocks = "
                   "[4, 5, 6] } ]")
                  .text,
              drag);
}

TEST(StudyMechanisms, TextsDifferWhereverMechanismsDo)
{
    const Study base = read(all_mechanisms);
    for (std::size_t i = 0; i < base.mechanisms.size(); ++i) {
        const std::size_t count = rule_of(base.mechanisms[i].mechanism).parameters.size();
        for (std::size_t p = 0; p < count; ++p) {
            if (rule_of(base.mechanisms[i].mechanism).parameters[p].models == MechanismModels::spatial)
                continue;
            Study changed = base;
            double& value = changed.mechanisms[i].values[p];
            value = std::nextafter(value, 1e300);
            EXPECT_NE(study_text(changed), base.text) << i << ' ' << p;
        }
        if (rule_of(base.mechanisms[i].mechanism).place != MechanismPlace::base) {
            Study changed = base;
            changed.mechanisms[i].places = {4, 5};
            EXPECT_NE(study_text(changed), base.text) << i;
        }
        Study without = base;
        without.mechanisms.erase(without.mechanisms.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_NE(study_text(without), base.text) << i;
    }
}

TEST(StudyMechanisms, SettingsOfTheCommandLine)
{
    const std::string text = study("stribeck = { dynamic_friction = 0.68, velocity_m_s = 0.05 }");
    const Study s = parse_study(text, "temple.toml",
                                {"mechanisms.stribeck.dynamic_friction=0.5", "mechanisms.wedge.angle_rad=0.002"});
    EXPECT_EQ(only(s, Mechanism::stribeck).values[0], 0.5);
    EXPECT_EQ(only(s, Mechanism::wedge).values[0], 0.002);
}

TEST(StudyMechanisms, NeutralValuesAreAccepted)
{
    for (const MechanismRule& rule : mechanism_rules()) {
        const MechanismSpec neutral = neutral_spec(rule.mechanism, 0.68);
        if (rule.mechanism == Mechanism::clamp)
            continue; // a column has nothing to clamp
        std::string entry = std::string(rule.name) + " = { ";
        for (std::size_t i = 0; i < rule.parameters.size(); ++i)
            if (rule.parameters[i].models != MechanismModels::spatial)
                // the yield force of a dowel has no neutral value
                entry += (i > 0 ? ", " : "") + rule.parameters[i].key() + " = " +
                         (rule.parameters[i].role == ParameterRole::needed ? "1.5" : std::to_string(neutral.values[i]));
        const Study s = read(entry + " }");
        ASSERT_EQ(s.mechanisms.size(), 1u) << rule.name;
        EXPECT_FALSE(acts(s.mechanisms[0], s.contact.friction)) << rule.name;
        EXPECT_EQ(parse_study(s.text, "again.toml").text, s.text);
    }
}

TEST(StudyMechanisms, SaysWhatIsWrong)
{
    expect_refused("stribek = { dynamic_friction = 0.5 }", {"mechanisms.stribek", "Did you mean stribeck?"});
    expect_refused("stribeck = { dynamic_friction = 0.5, velocity = 0.05 }",
                   {"mechanisms.stribeck.velocity", "Did you mean velocity_m_s?"});
    expect_refused("stribeck = { dynamic_friction = 0.5 }", {"stribeck.velocity_m_s is missing", "In m/s"});
    expect_refused("stribeck = { velocity_m_s = 0.5 }", {"stribeck.dynamic_friction is missing"});
    expect_refused("stribeck = { dynamic_friction = -1, velocity_m_s = 0.05 }", {"is outside (0, 10]"});
    expect_refused("stribeck = 0.5", {"mechanisms.stribeck = 0.5 is a number, not a table"});
    expect_refused("stribeck = []", {"mechanisms.stribeck", "is empty"});
    expect_refused("corner_loss = { joint = 1 }", {"mechanisms.corner_loss has no value", "left_m, right_m"});
    expect_refused("corner_loss = { joint = 1, left_m = 0.03, right_m = 0.02 }",
                   {"left_m = 0.03", "nothing of joint 1", "0.048 m"});
    expect_refused("dowel = { stiffness_n_m = 1e5 }", {"mechanisms.dowel.yield_n is missing"});
    expect_refused("eccentricity = { offset_m = 0.024 }", {"is outside block 1", "0.048 m wide"});
    expect_refused("time_offset = [ { offset_s = 0.01 } ]", {"is a list, and there is one base"});
    expect_refused("time_offset = { block = 1, offset_s = 0.01 }", {"time_offset.block"});
    expect_refused("vertical_motion = { ratio = 0.3, file = \"a\" }", {"ratio = 0.3 and file exclude each other"});
    expect_refused("vertical_motion = { ratio = 0.3, unit = \"g\" }", {"unit", "a vertical motion without a file"});
    expect_refused("vertical_motion = {}", {"mechanisms.vertical_motion.ratio is missing"});
    expect_refused("vertical_motion = { file = \"a\", unit = \"feet\" }", {"unit = \"feet\"", "\"m/s2\""});
}

TEST(StudyMechanisms, SaysWhichPlacesThereAre)
{
    expect_refused("wedge = { joint = 6, angle_rad = 0.001 }",
                   {"wedge.joint = 6 is outside [0, 5]", "6 joints", "0 is drum 2 on drum 1"});
    expect_refused("wedge = { joints = [0, 7], angle_rad = 0.001 }", {"joints", "contains 7", "[0, 5]", "6 joints"});
    expect_refused("wedge = { joints = [0, 1.5], angle_rad = 0.001 }", {"contains 1.5"});
    expect_refused("wedge = { joints = [-1], angle_rad = 0.001 }", {"contains -1"});
    expect_refused("wedge = { joints = [], angle_rad = 0.001 }", {"mechanisms.wedge.joints", "is empty"});
    expect_refused("wedge = { joints = 2, angle_rad = 0.001 }", {"not a list", "joints = [NUMBER, ...]"});
    expect_refused("wedge = { joint = 1, joints = [2], angle_rad = 0.001 }", {"and joint exclude each other"});
    expect_refused("wedge = { block = 1, angle_rad = 0.001 }", {"wedge.block"});
    expect_refused("drag = { block = 7, coefficient_n_s2_m2 = 0.1 }", {"drag.block = 7 is outside [0, 6]", "7 blocks"});
    expect_refused("drag = { block = 0, coefficient_n_s2_m2 = 0.1 }",
                   {"contains 0, which is fixed to the shaking table"});
    expect_refused("wedge = { joints = [1, 1], angle_rad = 0.001 }", {"joint 1 occurs twice"});
    expect_refused("wedge = [ { joint = 1, angle_rad = 0.001 }, { joint = 1, angle_rad = 0.002 } ]",
                   {"joint 1 occurs twice", "Give one entry"});
    expect_refused("wedge = [ { joint = 1, angle_rad = 0.001 }, { angle_rad = 0.002 } ]",
                   {"acts everywhere", "joint 1 occurs twice", "Give the place"});
}

TEST(StudyMechanisms, SaysWhatCannotStrengthen)
{
    expect_refused("tendon = { prestress_n = 500 }", {"mechanisms.tendon.stiffness_n_m is missing"});
    expect_refused("tendon = { stiffness_n_m = 1e6, prestress_n = -5 }", {"prestress_n = -5 is outside [0, "});
    expect_refused("tendon = { stiffness_n_m = 0, prestress_n = 5 }",
                   {"prestress_n = 5 has no effect without a stiffness"});
    expect_refused("tendon = { stiffness_n_m = 1e6, prestress_n = 500, yield_n = 400 }",
                   {"prestress_n = 500 is above yield_n = 400"});
    expect_refused("tendon = { block = 0, stiffness_n_m = 1e6 }", {"contains 0, which is fixed"});
    expect_refused("mortar = { tensile_strength_pa = 1e5 }", {"mechanisms.mortar.cohesion_pa is missing"});
    expect_refused(study("mortar = { tensile_strength_pa = 1e5, cohesion_pa = 1e5 }", "form = \"points\""), 17,
                   {"mechanisms.mortar", "is not available with contact.form = \"points\""});
    expect_refused("clamp = { stiffness_n_m = 1e6, strength_n = 100 }",
                   {"mechanisms.clamp acts nowhere", "Give the place by block"});
    expect_refused("clamp = { block = 3, stiffness_n_m = 1e6, strength_n = 100 }",
                   {"contains 3, which has no neighbour at its right"});
    // the stone carries (sqrt 2 - 1) x 60e6 Pa x 0.006 m x 0.03 m = 4473.5 N
    const std::string stone = ", stone_strength_pa = 60e6, diameter_m = 0.006, embedment_m = 0.03 }";
    EXPECT_NO_THROW(read("dowel = { stiffness_n_m = 1e6, yield_n = 4470" + stone));
    expect_refused("dowel = { stiffness_n_m = 1e6, yield_n = 4480" + stone,
                   {"yield_n = 4480 is above 4474 N, at which the stone is crushed"});
    expect_refused("dowel = { stiffness_n_m = 1e6, yield_n = 400, stone_strength_pa = 60e6 }",
                   {"needs diameter_m and embedment_m"});
}

TEST(StudyMechanisms, ADowelsTextHasTheStoneOnlyWhereItIsGiven)
{
    const std::string text = read("dowel = { stiffness_n_m = 1e6, yield_n = 400 }").text;
    EXPECT_NE(text.find("dowel = { stiffness_n_m = 1000000.0, yield_n = 400.0, gap_m = 0.0 }"), std::string::npos)
        << text;
}

TEST(StudyMechanisms, StrengtheningActsAtTheirUsualPlaces)
{
    const std::string structure =
        "[study]\nkind = \"single\"\n[structure]\nkind = \"colonnade\"\ndepth_m = 1\ndensity_kg_m3 = 2700\ncolumns = "
        "3\ncolumn_spacing_m = 3\nblocks = 3\nfixed_blocks = 1\ndrum_width_m = 1\ndrum_height_m = "
        "2\nepistyle_height_m = 0.5\nepistyle_bays = 1\n[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = "
        "0.7\n[excitation]\nkind = \"none\"\nduration_s = 1\n[mechanisms]\n";
    const Study s =
        parse_study(structure + "tendon = { stiffness_n_m = 1e6 }\nbearing = { stiffness_n_m = 1e6 }\nclamp "
                                "= { stiffness_n_m = 1e6, strength_n = 100 }\n",
                    "temple.toml");
    const Layout layout = lay_out(s.structure);
    EXPECT_EQ(usual_places(rule_of(Mechanism::tendon), layout), (std::vector{2, 5, 8}));
    EXPECT_EQ(usual_places(rule_of(Mechanism::bearing), layout), (std::vector{0, 2, 4}));
    EXPECT_EQ(usual_places(rule_of(Mechanism::clamp), layout), (std::vector{9}));
    EXPECT_EQ(right_neighbour(layout, 9), 10);
    EXPECT_EQ(right_neighbour(layout, 1), 4);
    EXPECT_EQ(right_neighbour(layout, 10), -1);
    // named one by one it is the same study
    const Study named =
        parse_study(structure + "tendon = { blocks = [8, 2, 5], stiffness_n_m = 1e6 }\nbearing = { joints = [0, 2, 4], "
                                "stiffness_n_m = 1e6 }\nclamp = { block = 9, stiffness_n_m = 1e6, strength_n = 100 }\n",
                    "temple.toml");
    EXPECT_EQ(named.text, s.text);
    const auto refused = [&](const std::string& mechanism) {
        try {
            parse_study(structure + mechanism, "temple.toml");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(refused("tendon = { block = 9, stiffness_n_m = 1e6 }").find("is no drum"), std::string::npos);
    EXPECT_NE(refused("clamp = { stiffness_n_m = 1e6, strength_n = 100, height_m = 0.3 }").find("outside block 9"),
              std::string::npos);
}

TEST(StudyMechanisms, OfTheBaseNeedAMotionThatHasThem)
{
    const std::string still = "kind = \"none\"\nduration_s = 2";
    for (const std::string mechanism :
         {"time_offset = { offset_s = 0.1 }", "sensor_gain = { gain = 0.9 }", "table_pitch = { rotation_rad_s2_m = 0 }",
          "vertical_motion = { ratio = 0.1 }", "harmonic_distortion = { second = 0.1 }"})
        expect_refused(study(mechanism, "", still), 17, {"is not used by excitation.kind = \"none\""});
    for (const std::string kind : {"half_sine", "full_sine", "ricker", "pulse"}) {
        const std::string pulse = "kind = \"" + kind + "\"\nfrequency_hz = 2\npga_m_s2 = 3";
        expect_refused(study("harmonic_distortion = { second = 0.1 }", "", pulse), 17,
                       {"is not used by excitation.kind = \"" + kind + "\"", "a pulse has no harmonics"});
        EXPECT_NO_THROW(parse_study(study("time_offset = { offset_s = 0.1 }", "", pulse), "temple.toml"));
    }
}

TEST(StudyMechanisms, ContactForms)
{
    EXPECT_EQ(read("").contact.form, ContactForm::area);
    EXPECT_EQ(read("").contact.damping, DampingAt::centroid);
    for (const auto& [word, form] :
         {std::pair{"two_corner", ContactForm::two_corner}, {"points", ContactForm::points}}) {
        const Study s = read("", std::string("damping = \"ends\"\nform = \"") + word + "\"");
        EXPECT_EQ(s.contact.form, form);
        EXPECT_EQ(s.contact.damping, DampingAt::ends);
        EXPECT_EQ(parse_study(s.text, "again.toml").text, s.text);
        EXPECT_NE(s.text, read("").text);
    }
    expect_refused(study("face_damping = { share = 0.5 }", "damping = \"ends\""), 17,
                   {"and contact.damping = \"ends\" exclude each other"});
}

TEST(StudyMechanisms, ReadsTheirPerturbations)
{
    const Study s = read("joint_friction = { joints = [1, 2], ratio = 0.6 }\nwedge = { angle_rad = 0.0 }\n"
                         "[perturbation.mechanisms]\njoint_friction.ratio = { distribution = \"lognormal\", sigma_ln = "
                         "0.2 }\nwedge.angle_rad = { distribution = \"normal\", sd_rad = 0.001, per = \"structure\" }\n"
                         "[perturbation]\nfriction = { distribution = \"normal\", cov = 0.1, min = 0.2 }");
    ASSERT_EQ(s.mechanism_perturbations.size(), 2u);
    ASSERT_EQ(s.perturbations.size(), 1u);
    const MechanismPerturbation& ratio = s.mechanism_perturbations[0];
    EXPECT_EQ(ratio.mechanism, Mechanism::joint_friction);
    EXPECT_EQ(ratio.distribution, DistributionKind::lognormal);
    EXPECT_EQ(ratio.sigma_ln, 0.2);
    EXPECT_EQ(ratio.per, Per::joint);
    EXPECT_EQ(s.mechanism_perturbations[1].mechanism, Mechanism::wedge);
    EXPECT_EQ(s.mechanism_perturbations[1].sd, 0.001);
    EXPECT_EQ(s.mechanism_perturbations[1].per, Per::structure);
}

TEST(StudyMechanisms, RefusesPerturbationsThatMeanNothing)
{
    const auto with = [](const std::string& perturbation) {
        return study("joint_friction = { joint = 1, ratio = 0.6 }\nvertical_motion = { ratio = 0.3 }\n"
                     "[perturbation.mechanisms]\n" +
                     perturbation);
    };
    const std::string uniform = "{ distribution = \"uniform\", from = 0.5, to = 0.7 }";
    expect_refused(with("wedge.angle_rad = " + uniform), 20, {"mechanisms.wedge", "[mechanisms] does not name it"});
    expect_refused(with("joint_friction.ration = " + uniform), 20, {"Did you mean ratio?"});
    expect_refused(with("joint_friktion.ratio = " + uniform), 20, {"Did you mean joint_friction?"});
    expect_refused(with("joint_friction.ratio = { distribution = \"normal\", sd = 0.1 }"), 20, {"min is missing"});
    expect_refused(with("joint_friction.ratio = { distribution = \"normal\", sd_m = 0.1 }"), 20, {"sd_m"});
    expect_refused(with("joint_friction.ratio = { distribution = \"uniform\", from = -1, to = 1 }"), 20,
                   {"is outside (0, 10]"});
    expect_refused(with("vertical_motion.ratio = { distribution = \"normal\", sd = 0.1, per = \"joint\" }"), 20,
                   {"per = \"joint\"", "\"structure\""});
    expect_refused(with("joint_friction.ratio = { distribution = \"uniform\", from = 0.5, to = 0.7, per = \"block\" }"),
                   20, {"per = \"block\"", "\"joint\", \"structure\""});
}

TEST(StudyMechanisms, ATableIsAnExcitation)
{
    const auto with = [](const std::string& excitation) { return study("", "", excitation); };
    const Study s =
        parse_study(with("kind = \"table\"\nfile = \"base.csv\"\ntime_scale = 2\ntail_s = 1"), "temple.toml");
    EXPECT_EQ(s.excitation.kind, ExcitationKind::table);
    EXPECT_EQ(s.excitation.file, "base.csv");
    EXPECT_EQ(s.excitation.time_scale, 2);
    EXPECT_EQ(s.excitation.pga_m_s2, 0);
    EXPECT_EQ(parse_study(s.text, "again.toml").text, s.text);
    EXPECT_EQ(s.text.find("baseline"), std::string::npos); // there is none to correct
    expect_refused(with("kind = \"table\""), 10, {"excitation.file is missing", "table of samples"});
    expect_refused(with("kind = \"table\"\nfile = \"a\"\nbaseline = true"), 13,
                   {"baseline", "is not used by excitation.kind = \"table\""});
}

} // namespace
} // namespace stylobate::test_study_mechanisms

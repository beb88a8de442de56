/// Studies with rigid contacts: what they have, and what is refused with them.

#include "ensemble/experiment.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "tests/io/study/study_lines.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace stylobate {
namespace {

Lines rigid_lines()
{
    Lines lines = surface_lines();
    lines[12] = "form = \"rigid\"";
    return lines;
}

TEST(StudyFileRigid, HasFrictionAndRestitutionAlone)
{
    auto lines = rigid_lines();
    const Study plain = parse_study(joined(lines), "study.toml");
    EXPECT_EQ(plain.contact.form, ContactForm::rigid);
    EXPECT_EQ(plain.contact.normal_stiffness_n_m2, 0);
    EXPECT_EQ(plain.contact.restitution, 0);
    lines[13] = "friction = 0.68\nrestitution = 0.3";
    const Study newton = parse_study(joined(lines), "study.toml");
    EXPECT_EQ(newton.contact.restitution, 0.3);
    EXPECT_EQ(newton.contact.restitution_law, RestitutionLaw::newton);
    lines[13] = "friction = 0.68\nrestitution = 0.3\nrestitution_law = \"poisson\"";
    EXPECT_EQ(parse_study(joined(lines), "study.toml").contact.restitution_law, RestitutionLaw::poisson);
}

TEST(StudyFileRigid, EachBedMayHaveItsOwnRestitution)
{
    auto lines = rigid_lines();
    for (const int line : {5, 7, 8, 10})
        lines.erase(line);
    lines[5] = "drums = [ { width_m = 0.05, height_m = 0.03, mass_kg = 1, count = 2 },\n"
               "          { width_m = 0.05, height_m = 0.03, mass_kg = 1, restitution = 0.4 } ]";
    lines[13] = "friction = 0.68\nrestitution = 0.1";
    const Study study = parse_study(joined(lines), "study.toml");
    const Realization r = Experiment(study).sampler().realization(0);
    ASSERT_EQ(r.beds(), 2);
    EXPECT_EQ(r.joints[0].restitution, 0.1);
    EXPECT_EQ(r.joints[1].restitution, 0.4);
    // the study's own text says the same
    EXPECT_EQ(Experiment(parse_study(study.text, "text")).sampler().realization(0).joints[1].restitution, 0.4);
    lines[12] = "normal_stiffness_n_m2 = 1e8";
    lines[13] = "friction = 0.68";
    try {
        parse_study(joined(lines), "study.toml");
        ADD_FAILURE() << "accepted with contacts that yield";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("restitution"), std::string::npos) << error.what();
    }
}

TEST(StudyFileRigid, WhatABedMayNotHaveIsRefusedWhereItIsGiven)
{
    const auto refusal = [](const std::string& structure, const std::string& contact) {
        try {
            parse_study(
                "[study]\nkind = \"surface\"\nrealizations = 8\n[structure]\ndepth_m = 0.05\ndensity_kg_m3 = 2600\n"
                "drum_width_m = 0.05\ndrum_height_m = 0.03\n" +
                    structure + "\n[contact]\nfriction = 0.6\n" + contact +
                    "\n[excitation]\nkind = \"harmonic\"\n[surface]\n"
                    "frequency_hz = { from = 1.0, to = 2.0, count = 2 }\n"
                    "pga_m_s2 = { from = 1.0, to = 2.0, count = 2 }\n",
                "study.toml");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const std::string yields = "normal_stiffness_n_m2 = 1e8", rigid = "form = \"rigid\"";
    const auto column_with = [](const std::string& key) {
        return "blocks = 3\ncapital = { width_m = 0.06, height_m = 0.02, " + key + " }";
    };
    const auto colonnade_with = [](const std::string& key) {
        return "kind = \"colonnade\"\nepistyles = []\nblocks = 2\ncolumn_list = [ { x_m = 0.0 },\n"
               "{ x_m = 1.0, capital = { width_m = 0.06, height_m = 0.02, " +
               key + " } } ]";
    };
    EXPECT_EQ(refusal(column_with("friction = 0.5"), yields), "accepted");
    EXPECT_EQ(refusal(colonnade_with("friction = 0.5"), yields), "accepted");
    for (const auto& with : {std::function<std::string(std::string)>(column_with), {colonnade_with}}) {
        const std::string line =
            with("x").find("colonnade") == std::string::npos ? "study.toml:10: " : "study.toml:13: ";
        const std::string restitution = refusal(with("restitution = 0.3"), yields);
        EXPECT_TRUE(restitution.starts_with(line)) << restitution;
        EXPECT_NE(restitution.find("capital.restitution = 0.3"), std::string::npos) << restitution;
        const std::string stiffness = refusal(with("normal_stiffness_n_m2 = 1e9"), rigid);
        EXPECT_TRUE(stiffness.starts_with(line)) << stiffness;
        EXPECT_NE(stiffness.find("capital.normal_stiffness_n_m2 = 1000000000 is not used by"), std::string::npos)
            << stiffness;
    }
}

/// What has fallen is handed over to contacts that yield, and single precision steps columns.
TEST(StudyFileRigid, MayFollowWhatFallsAndBeInSinglePrecision)
{
    auto lines = rigid_lines();
    lines[22] = "[outcome]\nfollow = \"rest\"\n[run]\nprecision = \"single\"";
    const Study study = parse_study(joined(lines), "study.toml");
    EXPECT_EQ(study.outcome.follow, Follow::rest);
    EXPECT_EQ(study.run.precision, Precision::single);
    EXPECT_GT(Experiment(study).sampler().realization(0).watched, 0);
}

TEST(StudyFileRigid, RefusesWhatNeedsAContactThatYields)
{
    const auto refused = [](const Lines& lines, const std::vector<std::string>& words,
                            const std::vector<std::string>& settings = {}) {
        try {
            parse_study(joined(lines), "study.toml", settings);
            ADD_FAILURE() << "accepted, without " << words.front();
        } catch (const InputError& error) {
            for (const std::string& word : words)
                EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    auto lines = rigid_lines();
    lines[13] = "friction = 0.68\nnormal_stiffness_n_m2 = 1e8";
    refused(lines, {"study.toml:14", "normal_stiffness_n_m2", "is not used by contact.form = \"rigid\""});
    lines[13] = "friction = 0.68\ndamping = \"ends\"";
    refused(lines, {"study.toml:14", "contact.damping"});
    lines = rigid_lines();
    lines[21] = "normal_stiffness = { distribution = \"lognormal\", sigma_ln = 0.7 }";
    refused(lines, {"study.toml:21", "normal_stiffness", "rigid"});
    lines = rigid_lines();
    lines[22] = "[mechanisms]\nstribeck = { dynamic_friction = 0.5, velocity_m_s = 0.01 }";
    refused(lines, {"stribeck", "is not available with contact.form = \"rigid\"", "two_corner"});
    for (const auto& [text, word] :
         {std::pair{"step_fraction = 0.5", "run.step_fraction"}, {"step_bound = \"structure\"", "run.step_bound"}}) {
        lines = rigid_lines();
        lines[22] = std::string("[run]\n") + text;
        refused(lines, {word, "rigid"});
    }
    lines = rigid_lines();
    lines[12] = "normal_stiffness_n_m2 = 1e8"; // contacts by area have dashpots
    lines[13] = "friction = 0.68\nrestitution = 0.3";
    refused(lines, {"study.toml:14", "contact.restitution", "is not used by contact.form = \"area\""});
}

} // namespace
} // namespace stylobate

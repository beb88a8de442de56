/// Studies with rigid contacts: what they have, and what is refused with them.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace stylobate {
namespace {

/// By their numbers.
using RigidLines = std::map<int, std::string>;

RigidLines rigid_lines()
{
    return {{1, "[study]"},
            {2, "kind = \"surface\""},
            {3, "realizations = 8"},
            {4, "[structure]"},
            {5, "blocks = 7"},
            {6, "fixed_blocks = 1"},
            {7, "drum_width_m = 0.048"},
            {8, "drum_height_m = 0.029"},
            {9, "depth_m = 0.048"},
            {10, "drum_mass_kg = 0.1355"},
            {11, "[contact]"},
            {12, "form = \"rigid\""},
            {13, "friction = 0.68"},
            {14, "[excitation]"},
            {15, "kind = \"harmonic\""},
            {16, "cycles = 8"},
            {17, "[surface]"},
            {18, "frequency_hz = { from = 0.5, to = 8, count = 5, spacing = \"log\" }"},
            {19, "pga_m_s2 = { from = 1, to = 9, count = 3 }"},
            {20, "[perturbation]"},
            {21, "friction = { distribution = \"normal\", cov = 0.10, min = 0.3 }"}};
}

std::string text_of(const RigidLines& lines)
{
    std::string text;
    for (const auto& [number, line] : lines)
        text += line + '\n';
    return text;
}

TEST(StudyFileRigid, HasFrictionAndRestitutionAlone)
{
    auto lines = rigid_lines();
    const Study plain = parse_study(text_of(lines), "study.toml");
    EXPECT_EQ(plain.contact.form, ContactForm::rigid);
    EXPECT_EQ(plain.contact.normal_stiffness_n_m2, 0);
    EXPECT_EQ(plain.contact.restitution, 0);
    lines[13] = "friction = 0.68\nrestitution = 0.3";
    EXPECT_EQ(parse_study(text_of(lines), "study.toml").contact.restitution, 0.3);
}

TEST(StudyFileRigid, RefusesWhatNeedsAContactThatYields)
{
    const auto refused = [](const RigidLines& lines, const std::vector<std::string>& words,
                            const std::vector<std::string>& settings = {}) {
        try {
            parse_study(text_of(lines), "study.toml", settings);
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
    for (const auto& [text, word] : {std::pair{"step_fraction = 0.5", "run.step_fraction"},
                                     {"step_bound = \"structure\"", "run.step_bound"},
                                     {"precision = \"single\"", "run.precision"}}) {
        lines = rigid_lines();
        lines[22] = std::string("[run]\n") + text;
        refused(lines, {word, "rigid"});
    }
    lines = rigid_lines();
    lines[22] = "[outcome]\nfollow = \"rest\"";
    refused(lines, {"outcome.follow", "two_corner"});
    lines = rigid_lines();
    lines[12] = "normal_stiffness_n_m2 = 1e8"; // contacts by area have dashpots
    lines[13] = "friction = 0.68\nrestitution = 0.3";
    refused(lines, {"study.toml:14", "contact.restitution", "is not used by contact.form = \"area\""});
}

} // namespace
} // namespace stylobate

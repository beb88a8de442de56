/// The line of conventions: what each key of a study puts into it, and that every page with a headline number has the
/// line of the study that the number is of.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/conventions.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

const std::string ready_studies = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/";

std::string line_of(const std::string& study, const std::vector<std::string>& settings = {})
{
    return conventions_text(read_study(ready_studies + study, settings));
}

std::string column(const std::vector<std::string>& settings = {})
{
    return line_of("small_scale_column.toml", settings);
}

void expect_parts(const std::string& line, const std::vector<std::string>& parts)
{
    for (const std::string& part : parts)
        EXPECT_NE(line.find(part), std::string::npos) << part << " is not in: " << line;
}

/// The whole line of one study, by hand from its file.
TEST(Conventions, OfTheSmallScaleColumn)
{
    EXPECT_EQ(column(),
              "contact by area, K_N 1e+08 N/m² (drawn: lognormal, sigma_ln 0.7), dashpots at the centroid of the "
              "contact with a ratio drawn from 0.05 to 0.5; harmonic of 10 cycles in all, of which the smooth start "
              "takes 2 and the smooth end 2, phase drawn");
}

TEST(Conventions, NameWhatAStudyChanges)
{
    expect_parts(column({"contact.damping=\"ends\""}), {"dashpots at the ends of the contact"});
    expect_parts(line_of("round_column.toml", {}), {"dashpots spread over the contact with"});
    expect_parts(line_of("round_column.toml", {"contact.damping=\"ends\""}),
                 {"dashpots at the ends of the contact with"});
    expect_parts(column({"contact.form=\"two_corner\""}), {"contact at two corners", "dashpots at its points"});
    expect_parts(column({"contact.form=\"points\""}), {"contact at points", "dashpots at its points"});
    expect_parts(column({"excitation.cycles=20", "excitation.ramp_cycles=1"}),
                 {"harmonic of 20 cycles in all, of which the smooth start takes 1 and the smooth end 1"});
    expect_parts(column({"excitation.start=\"abrupt\""}),
                 {"harmonic of 10 cycles in all, abrupt start, of which the smooth end takes 2"});
    expect_parts(column({"excitation.start=\"abrupt\"", "excitation.end=\"abrupt\""}),
                 {"harmonic of 10 cycles in all, abrupt start and end"});
    expect_parts(column({"contact.normal_stiffness_n_m2=3e9"}), {"K_N 3e+09 N/m²"});
}

/// Of rigid contacts the restitution stands for K_N and the dashpots, which they do not have.
TEST(Conventions, OfRigidContacts)
{
    const std::string line = line_of("rigid_column.toml");
    expect_parts(line, {"rigid contacts with restitution 0 (Newton)"});
    EXPECT_EQ(line.find("K_N"), std::string::npos) << line;
    EXPECT_EQ(line.find("dashpot"), std::string::npos) << line;
}

TEST(Conventions, OfOtherShakings)
{
    expect_parts(line_of("synthetic_earthquake.toml"),
                 {"filtered noise of 2 s of rise, 6 s of strong shaking and a decay of 2 s"});
    expect_parts(line_of("near_fault_pulse.toml"), {"velocity pulse"});
    expect_parts(line_of("rare_collapse.toml"), {"one full sine of acceleration from rest"});
    expect_parts(line_of("free_rocking.toml"), {"no shaking"});
    expect_parts(line_of("full_scale_colonnade_two.toml"), {"harmonic of "});
    expect_parts(line_of("fragility_column.toml"),
                 {"velocity pulse of ", "K_N 3e+09 N/m² (drawn: lognormal, sigma_ln 0.7)"});
}

TEST(Conventions, OfTheShakingInSpace)
{
    const std::string study = "[study]\nkind = \"single\"\n[structure]\ndimensions = 3\nblocks = 3\ndrum_width_m = 1\n"
                              "drum_height_m = 1\ndensity_kg_m3 = 2700\n[contact]\nnormal_stiffness_n_m3 = 3e9\n"
                              "friction = 0.7\n[excitation]\nkind = \"noise\"\nfrequency_hz = 2\npga_m_s2 = 3\n";
    expect_parts(conventions_text(parse_study(study, "study")), {"along 0 degrees from x"});
    expect_parts(conventions_text(
                     parse_study(study + "direction_deg = 30\nsecond_ratio = 0.8\nvertical_ratio = 0.5\n", "study")),
                 {"along 30 degrees from x with 0.8 of it across, vertically 0.5 of it"});
    expect_parts(
        conventions_text(parse_study(study + "[perturbation]\ndirection = { distribution = \"uniform\" }\n", "study")),
        {"direction drawn"});
}

/// A text that this version cannot read has no line; one that it can has the same as the study.
TEST(Conventions, OfTheTextOfAStudy)
{
    const Study study = read_study(ready_studies + "small_scale_column.toml");
    EXPECT_EQ(conventions_text_of(study.text), conventions_text(study));
    EXPECT_EQ(conventions_text_of("[study]\nkind = \"of another time\"\n"), std::nullopt);
}

/// Pages with a headline number have the line of its study below a mark "<!-- conventions of STUDY.toml -->":
/// `stylobate info studies/inputs/STUDY.toml` prints it.
TEST(Conventions, StandBesideTheNumbersOfThePages)
{
    const std::string mark = "<!-- conventions of ";
    for (const auto& [page, least] : std::map<std::string, int>{{"README.md", 1},
                                                                {"docs/check.md", 1},
                                                                {"docs/decisions.md", 6},
                                                                {"docs/fragility.md", 2},
                                                                {"docs/past.md", 1},
                                                                {"docs/risk.md", 1},
                                                                {"docs/sensitivity.md", 2},
                                                                {"docs/twins.md", 1}}) {
        std::ifstream file(std::string(STYLOBATE_SOURCE_DIR) + "/" + page);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        int marks = 0;
        for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
            const std::size_t from = at + mark.size(), to = text.find(" -->", from);
            const std::string line = "*Conventions:* " + line_of(text.substr(from, to - from)) + ". [";
            EXPECT_EQ(text.substr(to + 5, line.size()), line) << page;
            ++marks;
        }
        EXPECT_GE(marks, least) << page;
    }
}

/// Every ready study has a line with a contact and a shaking.
TEST(Conventions, EveryReadyStudyHasThem)
{
    int studies = 0;
    for (const auto& file : fs::directory_iterator(ready_studies)) {
        if (file.path().extension() != ".toml" || file.path().stem() == "record")
            continue; // its record is not part of the project
        ++studies;
        const std::string line = line_of(file.path().filename().string());
        EXPECT_NE(line.find("; "), std::string::npos) << file.path() << ": " << line;
        EXPECT_NE(line.find("contact"), std::string::npos) << file.path() << ": " << line;
    }
    EXPECT_GT(studies, 20);
}

} // namespace
} // namespace stylobate

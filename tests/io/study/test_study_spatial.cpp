/// Studies in space: the ways to write columns and colonnades, what each misuse says, and which keys are of the plane.

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/layout_in_space.hpp"
#include "ensemble/model/nominal.hpp"
#include "ensemble/sampling/plausible.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace stylobate::test_study_spatial {
namespace {

constexpr double pi = std::numbers::pi;

/// @param structure from line 4 on
std::string in_space(const std::string& structure, const std::string& rest = "")
{
    return "[study]\nkind = \"single\"\n[structure]\ndimensions = 3\n" + structure +
           "[contact]\nnormal_stiffness_n_m3 = 3e9\nfriction = 0.7\n"
           "[excitation]\nkind = \"harmonic\"\nfrequency_hz = 1\npga_m_s2 = 3\n" +
           rest;
}

const std::string six_drums = "blocks = 6\ndrum_width_m = 1.0\ndrum_height_m = 1.0\ndensity_kg_m3 = 2700\n";

const std::string portal = R"(kind = "colonnade"
columns = 2
column_spacing_m = 4.0
blocks = 3
drum_width_m = 1.0
drum_height_m = 1.2
density_kg_m3 = 2700
capital = { width_m = 1.2, height_m = 0.4 }
epistyle_height_m = 0.8
epistyle_width_m = 1.1
)";

Study read(const std::string& structure, const std::string& rest = "")
{
    const Study study = parse_study(in_space(structure, rest), "temple.toml");
    const Study again = parse_study(study.text, "again.toml");
    EXPECT_EQ(again.text, study.text);
    EXPECT_EQ(again.structure, study.structure) << study.text;
    return study;
}

/// @param words all of the message
void expect_refused(const std::string& text, const std::vector<std::string>& words)
{
    try {
        parse_study(text, "temple.toml");
        ADD_FAILURE() << "accepted, but should say: " << words.front();
    } catch (const InputError& error) {
        const std::string message = error.what();
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
    }
}

TEST(StudyInSpace, RoundDrums)
{
    const Study study = read(six_drums);
    ASSERT_TRUE(study.structure.spatial());
    ASSERT_EQ(study.structure.columns[0].drums.size(), 6U);
    const DrumSpec& drum = study.structure.columns[0].drums[2];
    EXPECT_EQ(drum.shape, Shape::round);
    EXPECT_EQ(drum.depth_m, 1.0);
    EXPECT_EQ(drum.top_width_m, 1.0);
    EXPECT_NEAR(drum.mass_kg, 2700 * pi / 4, 1e-9);
    EXPECT_EQ(study.contact.normal_stiffness_n_m3, 3e9);
    EXPECT_EQ(study.contact.tangential_stiffness_n_m3, 3e9);
    EXPECT_EQ(study.contact.normal_stiffness_n_m2, 0);
    // (weight above) / (k A), A of the disc
    EXPECT_NEAR(static_sinkage_m(study)[0], 6 * 2700.0 * 9.81 / 3e9, 1e-15);
    EXPECT_TRUE(implausibilities(study).empty()) << implausibilities(study).front().text;
    EXPECT_EQ(study.text.find("depth_m"), std::string::npos) << study.text;
    EXPECT_NE(study.text.find("dimensions = 3"), std::string::npos);
}

TEST(StudyInSpace, DrumsOfATaperAreFrusta)
{
    const Study study = read(six_drums + "top_width_m = 0.7\nbed_inner_ratio = 0.6\n");
    const std::vector<DrumSpec>& drums = study.structure.columns[0].drums;
    EXPECT_EQ(drums.front().width_m, 1.0);
    EXPECT_DOUBLE_EQ(drums.back().top_width_m, 0.7);
    for (std::size_t i = 1; i < drums.size(); ++i)
        EXPECT_EQ(drums[i].width_m, drums[i - 1].top_width_m);
    double mass = 0;
    for (const DrumSpec& drum : drums) {
        mass += drum.mass_kg;
        EXPECT_EQ(drum.bed.inner_ratio, 0.6);
    }
    // all together are the frustum of one cone: pi h (R2 + R r + r2) / 3
    EXPECT_NEAR(mass, 2700 * pi * 6 * (0.25 + 0.5 * 0.35 + 0.35 * 0.35) / 3, 1e-8);
}

TEST(StudyInSpace, RectanglesAndListedDrums)
{
    const Study study = read("shape = \"rectangle\"\ndrum_depth_m = 2.0\ndrum_width_m = 1.0\ndensity_kg_m3 = 2000\n"
                             "drums = [ { height_m = 1.0, count = 2 }, { height_m = 0.5, shape = \"square\", "
                             "top_width_m = 0.8 }, { height_m = 0.5, depth_m = 1.5, offset_z_m = 0.1, "
                             "normal_stiffness_n_m3 = 1e9, bed_inner_ratio = 0.2 } ]\n");
    const std::vector<DrumSpec>& drums = study.structure.columns[0].drums;
    ASSERT_EQ(drums.size(), 4U);
    EXPECT_EQ(drums[1].depth_m, 2.0);
    EXPECT_NEAR(drums[1].mass_kg, 4000, 1e-9);
    EXPECT_EQ(drums[2].shape, Shape::square);
    EXPECT_NEAR(drums[2].mass_kg, 2000 * 0.5 * (1 + 0.8 + 0.64) / 3, 1e-9);
    EXPECT_EQ(drums[3].depth_m, 1.5);
    EXPECT_EQ(drums[3].offset_z_m, 0.1);
    EXPECT_EQ(drums[3].bed.normal_stiffness_n_m3, 1e9);
    EXPECT_EQ(drums[3].bed.inner_ratio, 0.2);
}

TEST(StudyInSpace, ColonnadesAlongBothAxes)
{
    const Study row = read(portal);
    ASSERT_EQ(row.structure.epistyles.size(), 1U);
    const EpistyleSpec& beam = row.structure.epistyles[0];
    EXPECT_EQ(beam.along, Along::x);
    EXPECT_NEAR(beam.length_m, 4 + 1.2, 1e-12); // flush with the outer faces of the capitals
    EXPECT_EQ(beam.width_m, 1.1);
    EXPECT_NEAR(beam.mass_kg, 2700 * 5.2 * 1.1 * 0.8, 1e-8);
    EXPECT_EQ(row.structure.columns[0].drums.back().shape, Shape::square);
    EXPECT_EQ(row.outcome.follow, Follow::collapse);

    std::string corner = portal;
    corner.replace(corner.find("columns = 2\ncolumn_spacing_m = 4.0\n"), 35, "");
    corner += "column_list = [ { x_m = 0.0 }, { x_m = 4.0 }, { x_m = 0.0, z_m = 4.0 } ]\n"
              "epistyles = [ { first_column = 0, last_column = 1, length_m = 4.6, x_m = 2.3 }, "
              "{ first_column = 0, last_column = 2, length_m = 4.0, z_m = 2.55 } ]\n";
    const Study round = read(corner);
    EXPECT_EQ(round.structure.epistyles[1].along, Along::z);
    const Layout layout = lay_out(round.structure);
    const PlacedBlock& second = layout.blocks.back();
    EXPECT_EQ(second.depth_m, 4.0);
    EXPECT_EQ(second.width_m, 1.1);
    EXPECT_EQ(second.x_m(), 0);
    EXPECT_EQ(layout.beds.size(), 3U * 4U + 4U);
}

TEST(StudyInSpace, AnEchinusIsAPartOfItsCapital)
{
    const Study study = read(six_drums + "top_width_m = 0.8\ncapital = { width_m = 1.2, height_m = 0.5, "
                                         "echinus_height_m = 0.3 }\n");
    const DrumSpec& capital = study.structure.columns[0].drums.back();
    EXPECT_EQ(capital.echinus_height_m, 0.3);
    EXPECT_DOUBLE_EQ(capital.echinus_width_m, 0.8); // of the drum below
    // pi h (R2 + R r + r2) / 3 and the prism
    const double volume = pi * 0.3 * (0.16 + 0.24 + 0.36) / 3 + 1.44 * 0.2;
    EXPECT_NEAR(capital.mass_kg, 2700 * volume, 1e-9);
    const Layout layout = lay_out(study.structure);
    EXPECT_TRUE(bottom_face(layout.blocks.back()).round);
    EXPECT_DOUBLE_EQ(bottom_face(layout.blocks.back()).half_x_m, 0.4);
    EXPECT_FALSE(top_face(layout.blocks.back()).round);
    EXPECT_DOUBLE_EQ(top_face(layout.blocks.back()).half_z_m, 0.6);

    const std::string capital_of = "capital = { width_m = 1.2, height_m = 0.5, ";
    expect_refused(in_space(six_drums + capital_of + "echinus_width_m = 1.0 }\n"),
                   {"temple.toml:9", "structure.capital.echinus_width_m", "there is none", "Give echinus_height_m."});
    expect_refused(in_space(six_drums + capital_of + "echinus_height_m = 0.5 }\n"),
                   {"structure.capital.echinus_height_m", "leaves no abacus: the capital is 0.5 m high"});
    expect_refused(in_space(six_drums + capital_of + "echinus_height_m = 0.3, echinus_width_m = 1.3 }\n"),
                   {"structure.capital.echinus_width_m", "is above the width of the abacus, 1.2 m"});
    expect_refused(in_space(six_drums + capital_of + "echinus_height_m = 0.3, echinus_width_m = 0.9 }\n"),
                   {"capital is 900 mm x 900 mm wide at its bottom, smaller than the top of drum 6, 1 m x 1 m"});
    // its abacus, whatever the echinus is
    expect_refused(in_space(six_drums + "capital = { width_m = 0.9, height_m = 0.5, echinus_height_m = 0.3 }\n"),
                   {"capital is 900 mm x 900 mm wide at its bottom, smaller than the top of drum 6, 1 m x 1 m"});
}

TEST(StudyInSpace, EpistylesAbreast)
{
    std::string three = portal;
    three.replace(three.find("columns = 2"), 11, "columns = 3");
    three.replace(three.find("epistyle_width_m = 1.1"), 22, "epistyle_width_m = 0.6");
    const Study study = read(three + "epistyle_bays = \"all\"\nepistyle_abreast = 2\n");
    const std::vector<EpistyleSpec>& beams = study.structure.epistyles;
    ASSERT_EQ(beams.size(), 2U);
    EXPECT_DOUBLE_EQ(beams[0].z_m, -0.3);
    EXPECT_DOUBLE_EQ(beams[1].z_m, 0.3);
    for (const EpistyleSpec& beam : beams)
        EXPECT_NEAR(beam.mass_kg, 2700 * 9.2 * 0.6 * 0.8, 1e-8);
    // both lie on the column in the middle too, whose axis is under neither
    EXPECT_EQ(lay_out(study.structure).beds.size(), 3U * 4U + 2U * 3U);
    // one of a list, turned, and the default of the list
    std::string turned = portal;
    turned.replace(turned.find("columns = 2\ncolumn_spacing_m = 4.0\n"), 35,
                   "column_list = [ { x_m = 0 }, { x_m = 0, z_m = 4 } ]\n");
    const Study listed = read(turned + "epistyles = [ { first_column = 0, last_column = 1, length_m = 4.6, width_m = "
                                       "0.4, abreast = 3 } ]\n");
    ASSERT_EQ(listed.structure.epistyles.size(), 3U);
    EXPECT_EQ(listed.structure.epistyles[0].along, Along::z);
    EXPECT_DOUBLE_EQ(listed.structure.epistyles[0].x_m, -0.4);
    EXPECT_EQ(listed.structure.epistyles[1].x_m, 0);
    EXPECT_EQ(read(turned + "epistyle_abreast = 2\nepistyles = [ { first_column = 0, last_column = 1, length_m = 4.6, "
                            "width_m = 0.6 } ]\n")
                  .structure.epistyles.size(),
              2U);
}

TEST(StudyInSpace, StructuresThatCannotStandSayWhy)
{
    const std::string listed = "drum_width_m = 1.0\ndrum_height_m = 1.0\ndensity_kg_m3 = 2700\ndrums = ";
    expect_refused(in_space(listed + "[ { }, { offset_m = 0.8, offset_z_m = 0.8 } ]\n"),
                   {"temple.toml:3", "drum 2 is beside drum 1", "131.4 mm apart"});
    expect_refused(
        in_space(listed + "[ { }, { offset_m = 0.4, offset_z_m = 0.4 } ]\n"),
        {"not stable at rest", "x = 0.4 m, z = 0.4 m", "65.69 mm outside the bed between drum 1 and drum 2"});
    // inside the square that encloses the disc, outside the disc
    read(listed + "[ { shape = \"square\" }, { shape = \"square\", offset_m = 0.4, offset_z_m = 0.4 } ]\n");
    expect_refused(in_space(listed + "[ { }, { width_m = 0.5, bed_inner_ratio = 0.6 } ]\n"),
                   {"drum 2 is 500 mm wide, and the hole of the bed under it, in drum 1, is 600 mm wide"});
    expect_refused(in_space(six_drums + "capital = { width_m = 0.9, height_m = 0.3 }\n"),
                   {"capital is 900 mm x 900 mm wide at its bottom, smaller than the top of drum 6"});
    std::string apart = portal;
    apart += "epistyles = [ { first_column = 0, last_column = 1, length_m = 4.6, z_m = 1.3 } ]\n";
    expect_refused(in_space(apart), {"epistyle 1 along x has no seat on column 1", "150 mm apart"});
    apart = portal + "epistyles = [ { first_column = 0, last_column = 1, length_m = 4.6, along = \"z\" } ]\n";
    expect_refused(in_space(apart), {"epistyle 1 along z has no seat on column 1"});
    // its seats are the edges of two capitals, and its centre of mass is beside them
    apart = portal + "epistyles = [ { first_column = 0, last_column = 1, length_m = 4.6, z_m = 0.7 } ]\n";
    expect_refused(in_space(apart), {"epistyle 1 is not stable at rest", "z = 0.7 m, is not between its seats"});
    std::string near = portal;
    near.replace(near.find("4.0"), 3, "1.1");
    expect_refused(in_space(near), {"capital of column 1 and capital of column 2 overlap by 100 mm"});
    std::string crooked = portal;
    crooked.replace(crooked.find("columns = 2\ncolumn_spacing_m = 4.0\n"), 35,
                    "column_list = [ { x_m = 0 }, { x_m = 4, z_m = 1 } ]\n");
    expect_refused(in_space(crooked), {"structure.column_list", "do not stand in one row", "epistyles = [ {"});
}

TEST(StudyInSpace, RefusesKeysOfThePlane)
{
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
        {"contact.normal_stiffness_n_m2=1e9", {"is not used by structure.dimensions = 3", "normal_stiffness_n_m3"}},
        {"contact.form=rigid", {"contact.form", "is not used by structure.dimensions = 3"}},
        {"contact.damping=centroid",
         {"contact.damping", "is not available with structure.dimensions = 3", "spread over the contact"}},
        {"contact.damping_per=chord", {"contact.damping_per", "spread over the contact"}},
        {"contact.restitution=0.5", {"structure.dimensions = 2"}},
        {"structure.depth_m=1", {"structure.depth_m = 1 is not used by structure.dimensions = 3", "drum_depth_m"}},
        {"run.precision=single", {"run.precision", "double precision"}},
        {"run.accuracy=0.1", {"run.accuracy", "structure.dimensions = 2"}},
        {"outcome.follow=rest", {"outcome.follow", "until a block has fallen"}},
        {"mechanisms.table_pitch={ rotation_rad_s2_m = 0.1 }", {"mechanisms.table_pitch"}},
        {"mechanisms.hertz={ exponent = 1.5 }", {"mechanisms.hertz", "is not used by structure.dimensions = 3"}},
        {"mechanisms.adhesion={ force_n_m = 10 }", {"mechanisms.adhesion.force_n_m", "strength_pa"}},
        {"mechanisms.vertical_motion={ ratio = 0.5 }", {"excitation.vertical_ratio"}},
        {"perturbation.normal_stiffness={ distribution = \"normal\", sd_n_m2 = 1e7 }", {"sd_n_m2", "Give cov"}},
        {"perturbation.normal_stiffness={ distribution = \"normal\" }", {"normal_stiffness.cov is missing"}},
        {"structure.drum_depth_m=2", {"structure.drum_depth_m", "is not used by shape = \"round\""}},
        {"structure.shape=rectangle", {"structure.drum_depth_m is missing"}},
        {"structure.dimensions=4", {"structure.dimensions = 4 is outside [2, 3]"}},
    };
    for (const auto& [setting, words] : cases) {
        try {
            parse_study(in_space(six_drums), "temple.toml", {setting});
            ADD_FAILURE() << setting;
        } catch (const InputError& error) {
            for (const std::string& word : words)
                EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " in: " << error.what();
        }
    }
    expect_refused("[study]\nkind = \"survival\"\nrealizations = 8\n[structure]\ndimensions = 3\n" + six_drums +
                       "[contact]\nnormal_stiffness_n_m3 = 3e9\nfriction = 0.7\n[excitation]\nkind = \"harmonic\"\n"
                       "[surface]\nfrequency_hz = { from = 1, to = 2, count = 2 }\n"
                       "pga_m_s2 = { from = 1, to = 2, count = 2 }\n",
                   {"study.kind = \"survival\" is not available with structure.dimensions = 3"});
}

/// Also in lists: the line, the key and what to give instead.
TEST(StudyInSpace, KeysOfTheOtherModelAreNamedWhereTheyStand)
{
    const std::string listed = "drum_width_m = 1.0\ndrum_height_m = 1.0\ndensity_kg_m3 = 2700\ndrums = [ { },\n  { ";
    expect_refused(in_space(listed + "normal_stiffness_n_m2 = 1e9 } ]\n"),
                   {"temple.toml:9: structure.drums[1].normal_stiffness_n_m2 = 1000000000 is not used by "
                    "structure.dimensions = 3",
                    "Give normal_stiffness_n_m3"});
    expect_refused(in_space(listed + "restitution = 0.2 } ]\n"),
                   {"temple.toml:9: structure.drums[1].restitution", "Remove it, or give structure.dimensions = 2."});
    const std::string plane = "[study]\nkind = \"single\"\n[structure]\ndepth_m = 1\n";
    const std::string rest = "[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.7\n"
                             "[excitation]\nkind = \"none\"\nduration_s = 1\n";
    expect_refused(plane + listed + "top_width_m = 0.9 } ]\n" + rest,
                   {"temple.toml:9: structure.drums[1].top_width_m = 0.9 is not used by structure.dimensions = 2",
                    "Remove it, or give structure.dimensions = 3."});
    const std::string columns = "kind = \"colonnade\"\nblocks = 1\n" + listed.substr(0, listed.find("drums")) +
                                "epistyle_height_m = 0.5\ncolumn_list = [ { x_m = 0 },\n  { x_m = 3";
    expect_refused(plane + columns + ", z_m = 1 } ]\n" + rest,
                   {"structure.column_list[1].z_m = 1 is not used by structure.dimensions = 2"});
    for (const std::string key : {"along = \"z\"", "abreast = 2", "width_m = 0.6", "z_m = 0.1"})
        expect_refused(
            plane + columns + " } ]\nepistyles = [ { first_column = 0, last_column = 1, length_m = 4, " + key +
                " } ]\n" + rest,
            {"structure.epistyles[0]." + key.substr(0, key.find(' ')), "is not used by structure.dimensions = 2"});
    expect_refused(plane + columns + " } ]\nepistyle_abreast = 2\n" + rest,
                   {"structure.epistyle_abreast = 2 is not used by structure.dimensions = 2"});
}

TEST(StudyInSpace, KeysOfSpaceAreRefusedInThePlane)
{
    const std::string plane = "[study]\nkind = \"single\"\n[structure]\ndepth_m = 1\n" + six_drums +
                              "[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.7\n"
                              "[excitation]\nkind = \"none\"\nduration_s = 1\n";
    EXPECT_EQ(parse_study(plane, "temple.toml").text.find("dimensions"), std::string::npos);
    EXPECT_EQ(parse_study(plane, "temple.toml", {"structure.dimensions=2"}).text,
              parse_study(plane, "temple.toml").text);
    for (const std::string setting :
         {"structure.shape=round", "structure.bed_inner_ratio=0.5", "structure.drum_depth_m=1",
          "contact.normal_stiffness_n_m3=3e9", "contact.tangential_stiffness_n_m3=3e9", "initial.tilt_direction_rad=0",
          "mechanisms.wedge={ angle_x_rad = 0.01 }", "mechanisms.eccentricity={ offset_z_m = 0.01 }",
          "structure.capital={ width_m = 1.2, height_m = 0.2, shape = \"square\" }",
          "structure.capital={ width_m = 1.2, height_m = 0.2, echinus_height_m = 0.1 }"}) {
        try {
            parse_study(plane, "temple.toml", {setting});
            ADD_FAILURE() << setting;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find("is not used by structure.dimensions = 2"), std::string::npos) << message;
            EXPECT_NE(message.find("structure.dimensions = 3"), std::string::npos) << message;
        }
    }
}

TEST(StudyInSpace, TextsDifferWhereStudiesDo)
{
    const std::string base = read(six_drums).text;
    for (const std::string setting :
         {"structure.shape=square", "structure.bed_inner_ratio=0.5", "structure.top_width_m=0.9",
          "contact.normal_stiffness_n_m3=2e9", "contact.damping=ends", "mechanisms.face_damping={ share = 0.5 }",
          "contact.tangential_stiffness_n_m3=2e9", "initial.tilt_direction_rad=0.5",
          "structure.capital={ width_m = 1.2, height_m = 0.2 }", "mechanisms.wedge={ angle_x_rad = 0.01 }",
          "mechanisms.eccentricity={ offset_z_m = 0.01 }", "mechanisms.adhesion={ strength_pa = 1e4 }",
          "mechanisms.drum_offset={ block = 2, offset_z_m = 0.01 }"}) {
        const Study changed = parse_study(in_space(six_drums), "temple.toml", {setting});
        EXPECT_NE(changed.text, base) << setting;
        EXPECT_EQ(parse_study(changed.text, "again.toml").text, changed.text) << setting;
    }
}

TEST(StudyInSpace, ImplausibleValuesAreFound)
{
    const auto check_of = [](const std::string& setting) {
        const std::vector<Implausibility> found =
            implausibilities(parse_study(in_space(six_drums), "temple.toml", {setting}));
        return found.empty() ? std::string() : found.front().check + ": " + found.front().text;
    };
    EXPECT_EQ(check_of("run.step_fraction=0.9"), "");
    EXPECT_TRUE(check_of("contact.normal_stiffness_n_m3=1e6").starts_with("sinkage: "));
    EXPECT_TRUE(check_of("contact.normal_stiffness_n_m3=1e14").starts_with("stiffness: "));
    EXPECT_TRUE(check_of("structure.density_kg_m3=2.7").starts_with("density: "));
    EXPECT_TRUE(check_of("structure.drum_width_m=30").starts_with("size: "));
    EXPECT_TRUE(check_of("perturbation.drum_offset={ distribution = \"normal\", sd_m = 0.3 }").starts_with("spread: "));
}

} // namespace
} // namespace stylobate::test_study_spatial

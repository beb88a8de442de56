/// The [structure] of a study file: the ways to write columns and colonnades, and what each misuse says.

#include "ensemble/model/input_error.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/motions.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::test_study_structure {
namespace {

/// @param structure from line 4 on; the rest is the same for all
std::string with(const std::string& structure)
{
    return "[study]\nkind = \"single\"\n[structure]\n" + structure +
           "\n[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.7\n"
           "[excitation]\nkind = \"none\"\nduration_s = 1\n";
}

Study read(const std::string& structure, const std::string& rest = "")
{
    const Study study = parse_study(with(structure) + rest, "temple.toml");
    const Study again = parse_study(study.text, "again.toml");
    EXPECT_EQ(again.text, study.text);
    EXPECT_EQ(again.structure, study.structure);
    return study;
}

/// @param start place and text up to what follows
void expect_refused(const std::string& structure, const std::string& start, const std::vector<std::string>& words = {},
                    const std::string& rest = "")
{
    try {
        parse_study(with(structure) + rest, "temple.toml");
        ADD_FAILURE() << "accepted, but should say: " << start;
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.substr(0, start.size()), start) << message;
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
    }
}

const std::string drums_of_seven = R"(blocks = 7
fixed_blocks = 1
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.1355
)";

const std::string two_by_two = R"(kind = "colonnade"
columns = 2
column_spacing_m = 0.09
blocks = 2
drum_width_m = 0.06
drum_height_m = 0.05
drum_mass_kg = 0.375
depth_m = 0.06
epistyle_height_m = 0.06
)";

TEST(StudyStructure, EqualDrumsInEitherWay)
{
    const Study study = read(drums_of_seven);
    EXPECT_EQ(study.structure, equal_column(7, 1, 0.048, 0.029, 0.048, 0.1355));
    EXPECT_NE(study.text.find("blocks = 7\n"), std::string::npos);
    const Study listed = read("fixed_blocks = 1\ndepth_m = 0.048\ndrums = [\n  { width_m = 0.048, height_m = 0.029, "
                              "mass_kg = 0.1355, count = 7 },\n]\n");
    EXPECT_EQ(listed.text, study.text);
    EXPECT_EQ(study.outcome.follow, Follow::collapse);
    EXPECT_EQ(read(drums_of_seven, "[outcome]\nfollow = \"rest\"\n").outcome.follow, Follow::rest);
}

TEST(StudyStructure, ListedDrumsTakeTheCommonValuesAsDefaults)
{
    const Study study = read(R"(depth_m = 2
drum_width_m = 1.5
drum_height_m = 0.5
density_kg_m3 = 2000
drums = [
    { count = 2 },
    { width_m = 1.25, offset_m = -0.02, friction = 0.3, normal_stiffness_n_m2 = 1e9, tangential_stiffness_n_m = 2e9 },
    { height_m = 0.25, mass_kg = 1400 },
    { density_kg_m3 = 1000 },
])");
    const auto& drums = study.structure.columns[0].drums;
    ASSERT_EQ(drums.size(), 5U);
    EXPECT_EQ(drums[0], (DrumSpec{.width_m = 1.5, .height_m = 0.5, .mass_kg = 3000}));
    EXPECT_EQ(drums[1], drums[0]);
    EXPECT_EQ(drums[2], (DrumSpec{.width_m = 1.25,
                                  .height_m = 0.5,
                                  .mass_kg = 2500,
                                  .offset_m = -0.02,
                                  .bed = {.friction = 0.3,
                                          .normal_stiffness_n_m2 = 1e9,
                                          .tangential_stiffness_n_m = 2e9,
                                          .restitution = {}}}));
    EXPECT_EQ(drums[3], (DrumSpec{.width_m = 1.5, .height_m = 0.25, .mass_kg = 1400}));
    EXPECT_EQ(drums[4], (DrumSpec{.width_m = 1.5, .height_m = 0.5, .mass_kg = 1500}));
    EXPECT_EQ(study.contact.tangential_stiffness_n_m, 3e9 * 1.5); // the widest drum's
}

TEST(StudyStructure, ALayerHasADampingOfItsOwn)
{
    const Study study = read(R"(depth_m = 2
drum_width_m = 1.5
drum_height_m = 0.5
density_kg_m3 = 2000
drums = [
    { count = 2 },
    { normal_stiffness_n_m2 = 1e9, normal_damping_ratio = 0.4, tangential_damping_ratio = 0.3 },
])");
    const BedSpec& bed = study.structure.columns[0].drums[2].bed;
    EXPECT_EQ(bed.normal_damping_ratio, 0.4);
    EXPECT_EQ(bed.tangential_damping_ratio, 0.3);
    EXPECT_EQ(parse_study(study.text, "again.toml").structure, study.structure);
}

TEST(StudyStructure, TaperAndCapital)
{
    const Study study = read(R"(depth_m = 1
blocks = 5
drum_width_m = 1.5
top_width_m = 1.0
drum_height_m = 0.8
density_kg_m3 = 2500
capital = { width_m = 1.75, height_m = 0.4 }
)");
    const auto& drums = study.structure.columns[0].drums;
    ASSERT_EQ(drums.size(), 6U);
    const double width[] = {1.5, 1.375, 1.25, 1.125, 1.0, 1.75};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(drums[i].width_m, width[i], 1e-15);
        EXPECT_EQ(drums[i].height_m, i < 5 ? 0.8 : 0.4);
        EXPECT_NEAR(drums[i].mass_kg, 2500 * width[i] * drums[i].height_m, 1e-9);
        EXPECT_EQ(drums[i].capital, i == 5);
    }
    const std::vector<PlacedBlock> blocks = lay_out(study.structure).blocks;
    EXPECT_EQ(blocks[4].name, "drum 5");
    EXPECT_EQ(blocks[5].name, "capital");
    // the canonical text says which one is the capital
    EXPECT_EQ(parse_study(study.text, "again").structure, study.structure);
}

TEST(StudyStructure, ColonnadeFlushWithItsOuterFaces)
{
    const Study study = read(two_by_two + "epistyle_mass_kg = 1.14\n");
    const StructureSpec& s = study.structure;
    EXPECT_EQ(s.kind, StructureKind::colonnade);
    ASSERT_EQ(s.columns.size(), 2U);
    EXPECT_EQ(s.columns[0].x_m, -0.045); // about x = 0
    EXPECT_EQ(s.columns[1].x_m, 0.045);
    EXPECT_EQ(s.columns[1].drums, equal_column(2, 0, 0.06, 0.05, 0.06, 0.375).columns[0].drums);
    ASSERT_EQ(s.epistyles.size(), 1U);
    EXPECT_NEAR(s.epistyles[0].x_m, 0, 1e-17);
    EXPECT_NEAR(s.epistyles[0].length_m, 0.15, 1e-16);
    EXPECT_EQ(s.epistyles[0].height_m, 0.06);
    EXPECT_EQ(s.epistyles[0].mass_kg, 1.14);
    EXPECT_EQ(study.outcome.follow, Follow::rest);
    EXPECT_EQ(read(two_by_two + "epistyle_mass_kg = 1.14\n", "[outcome]\nfollow = \"collapse\"\n").outcome.follow,
              Follow::collapse);
}

TEST(StudyStructure, EpistylesByBays)
{
    const std::string five = R"(kind = "colonnade"
columns = 5
column_spacing_m = 3
blocks = 1
drum_width_m = 1
drum_height_m = 4.4
density_kg_m3 = 2700
depth_m = 1
capital = { width_m = 1.2, height_m = 0.2 }
epistyle_height_m = 0.8
)";
    const auto ends = [](const StructureSpec& s) {
        std::vector<double> all;
        for (const EpistyleSpec& e : s.epistyles)
            all.insert(all.end(), {static_cast<double>(e.first_column), static_cast<double>(e.last_column),
                                   e.x_m - e.length_m / 2, e.x_m + e.length_m / 2});
        return all;
    };
    const auto expect_ends = [](const std::vector<double>& got, const std::vector<double>& want) {
        ASSERT_EQ(got.size(), want.size());
        for (std::size_t i = 0; i < got.size(); ++i)
            EXPECT_NEAR(got[i], want[i], 1e-14) << i;
    };
    // over the axes, and flush with the capitals at both ends
    expect_ends(ends(read(five).structure), {0, 1, -6.6, -3, 1, 2, -3, 0, 2, 3, 0, 3, 3, 4, 3, 6.6});
    EXPECT_NEAR(read(five).structure.epistyles[0].mass_kg, 2700 * 3.6 * 0.8, 1e-9); // the structure's density
    EXPECT_NEAR(read(five + "epistyle_density_kg_m3 = 2000\n").structure.epistyles[1].mass_kg, 2000 * 3 * 0.8, 1e-9);
    expect_ends(ends(read(five + "epistyle_bays = 2").structure), {0, 2, -6.6, 0, 2, 4, 0, 6.6});
    expect_ends(ends(read(five + "epistyle_length_m = 2.9").structure),
                {0, 1, -5.95, -3.05, 1, 2, -2.95, -0.05, 2, 3, 0.05, 2.95, 3, 4, 3.05, 5.95});
    const std::string three = "kind = \"colonnade\"\ncolumns = 3\ncolumn_spacing_m = 3\nblocks = 1\ndrum_width_m = 1\n"
                              "drum_height_m = 4\ndensity_kg_m3 = 2700\ndepth_m = 1\nepistyle_height_m = 0.8\n";
    expect_ends(ends(read(three + "epistyle_bays = \"all\"").structure), {0, 2, -3.5, 3.5});

    expect_refused(five + "epistyle_bays = 3",
                   "temple.toml:14: structure.epistyle_bays = 3 does not divide the 4 bays");
    expect_refused(five + "epistyle_bays = 5", "temple.toml:14: structure.epistyle_bays = 5 is outside [1, 4]");
    expect_refused(five + "epistyle_bays = \"each\"", "temple.toml:14: structure.epistyle_bays = \"each\"",
                   {"\"all\""});
    std::string far_apart = five;
    far_apart.replace(far_apart.find("column_spacing_m = 3"), 20, "column_spacing_m = 12");
    expect_refused(far_apart + "epistyle_bays = \"all\"",
                   "temple.toml:13: structure.epistyle_height_m = 0.8 belongs to an", {"49.2 m, longer than 40 m"});
    expect_refused(five + "epistyle_mass_kg = 5000",
                   "temple.toml:14: structure.epistyle_mass_kg = 5000 is one mass for",
                   {"epistyles of 3.6 m and of 3 m", "epistyle_density_kg_m3"});
    expect_refused(five + "epistyle_length_m = 3.01", "temple.toml:3: structure: epistyle 1 and epistyle 2 overlap by",
                   {"10 mm"});
    expect_refused(five + "epistyle_length_m = 1.7", "temple.toml:3: structure: epistyle 1 has no seat on column 1",
                   {"50 mm apart"});
}

TEST(StudyStructure, ColumnsAndEpistylesOneByOne)
{
    const Study study = read(R"(kind = "colonnade"
depth_m = 1
blocks = 2
drum_width_m = 1
drum_height_m = 2
density_kg_m3 = 2500
column_list = [
    { x_m = -4, drums = [ { height_m = 3 } ] },
    { x_m = 0, fixed_blocks = 1, drums = [
        { width_m = 1.2, height_m = 0.5 },
        { height_m = 3.5 }
    ] },
    { x_m = 3 },
    { x_m = 5, blocks = 1, capital = { width_m = 1.5, height_m = 0.25, density_kg_m3 = 2000 } },
]
epistyles = [ { first_column = 1, last_column = 2, length_m = 4.1, height_m = 0.75, friction = 0.5 } ]
)");
    const StructureSpec& s = study.structure;
    ASSERT_EQ(s.columns.size(), 4U);
    EXPECT_EQ(s.columns[0].drums, (std::vector<DrumSpec>{{.width_m = 1, .height_m = 3, .mass_kg = 7500}}));
    EXPECT_EQ(s.columns[0].x_m, -4);
    EXPECT_EQ(s.columns[1].fixed_blocks, 1);
    EXPECT_EQ(s.columns[1].drums[0].mass_kg, 1500);
    EXPECT_EQ(s.columns[2].drums.size(), 2U);
    EXPECT_EQ(s.columns[2].drums[1].height_m, 2);
    EXPECT_EQ(s.columns[3].drums[1], (DrumSpec{.width_m = 1.5, .height_m = 0.25, .mass_kg = 750, .capital = true}));
    ASSERT_EQ(s.epistyles.size(), 1U);
    EXPECT_EQ(s.epistyles[0].x_m, 1.5); // the middle of its bay
    EXPECT_EQ(s.epistyles[0].mass_kg, 2500 * (4.1 * 0.75 * 1));
    EXPECT_EQ(s.epistyles[0].bed.friction, 0.5);

    // the other spelling of an array of tables, and columns without an epistyle
    EXPECT_EQ(read(two_by_two + "epistyle_mass_kg = 1.14\nepistyles = []").structure.epistyles.size(), 0U);
    const Study sections = read(two_by_two + "[[structure.epistyles]]\nfirst_column = 0\nlast_column = 1\n"
                                             "length_m = 0.15\nmass_kg = 1.14\nx_m = 0.001\n");
    EXPECT_EQ(sections.structure.epistyles[0].height_m, 0.06);
    EXPECT_EQ(sections.structure.epistyles[0].x_m, 0.001);
}

TEST(StudyStructure, RefusesMisusedKeysOfColumns)
{
    expect_refused(drums_of_seven + "columns = 2", "temple.toml:10: structure.columns = 2 is not used by "
                                                   "structure.kind = \"column\"");
    expect_refused(drums_of_seven + "drums = []", "temple.toml:4: structure.blocks = 7 and drums exclude each other");
    expect_refused("depth_m = 1\ndrums = []", "temple.toml:5: structure.drums = [ ... ] is empty");
    expect_refused("depth_m = 1\ndrums = 3", "temple.toml:5: structure.drums = 3 is a whole number, not an array",
                   {"[ { ... }, { ... } ]"});
    expect_refused("depth_m = 1\ndrums = [\n3]",
                   "temple.toml:6: structure.drums[0] = 3 is a whole number, not a table");
    expect_refused("depth_m = 1\ndrums = [\n{ width_m = 1, height_m = 1, mass_kg = 1 },\n{ widht_m = 1 } ]",
                   "temple.toml:7: unknown key structure.drums[1].widht_m", {"Did you mean width_m?"});
    expect_refused("depth_m = 1\ndrums = [ { height_m = 1, mass_kg = 1 } ]",
                   "temple.toml:5: structure.drums[0].width_m is missing", {"or drum_width_m for all", "(0, 40]"});
    expect_refused("depth_m = 1\ndrums = [ { width_m = 1, height_m = 1 } ]",
                   "temple.toml:5: structure.drums[0].mass_kg is missing", {"or density_kg_m3"});
    expect_refused("depth_m = 1\ndrums = [ { width_m = 1, height_m = 1, mass_kg = 1, density_kg_m3 = 2000 } ]",
                   "temple.toml:5: structure.drums[0].density_kg_m3 = 2000 and mass_kg exclude each other");
    expect_refused("depth_m = 1\ndrums = [ { width_m = 1, height_m = 1, mass_kg = 100000 } ]",
                   "temple.toml:5: structure.drums[0].mass_kg = 100000 makes a density of 100000 kg/m3");
    expect_refused("depth_m = 1\ndrums = [ { width_m = 1, height_m = 1, mass_kg = 1, offset_m = 1.5 } ]",
                   "temple.toml:5: structure.drums[0].offset_m = 1.5 is outside [-1, 1]");
    expect_refused("depth_m = 1\ndrums = [ { width_m = 1, height_m = 1, mass_kg = 1, count = 201 } ]",
                   "temple.toml:5: structure.drums[0].count = 201 is outside [1, 200]");
    expect_refused("depth_m = 1\ndrums = [ { width_m = 1, height_m = 1, mass_kg = 1, count = 200 }, "
                   "{ width_m = 1, height_m = 1, mass_kg = 1 } ]",
                   "temple.toml:5: structure.drums = [ ... ] makes a column of 201 blocks", {"At most 200"});
    expect_refused("depth_m = 1\ntop_width_m = 1\ndrums = [ { width_m = 1, height_m = 1, mass_kg = 1 } ]",
                   "temple.toml:5: structure.top_width_m = 1 is not used with drums");
    expect_refused(drums_of_seven + "top_width_m = 0.04",
                   "temple.toml:9: structure.drum_mass_kg = 0.1355 is not used "
                   "with top_width_m",
                   {"density_kg_m3"});
    expect_refused(
        "depth_m = 1\nblocks = 1\ndrum_width_m = 1\ntop_width_m = 0.8\ndrum_height_m = 1\ndensity_kg_m3 = 2e3",
        "temple.toml:7: structure.top_width_m = 0.8 tapers a column of one drum");
    expect_refused("depth_m = 1\nblocks = 3\ndrum_width_m = 1\ntop_width_m = 0.8\ndrum_height_m = 1",
                   "temple.toml:3: structure.density_kg_m3 is missing", {"kg/m3"});
    expect_refused(drums_of_seven + "capital = { width_m = 0.05, height_m = 0.01 }",
                   "temple.toml:10: structure.capital.mass_kg is missing", {"density_kg_m3"});
    expect_refused(drums_of_seven + "capital = { height_m = 0.01, mass_kg = 0.1 }",
                   "temple.toml:10: structure.capital.width_m is missing");
    expect_refused(drums_of_seven + "capital = { width_m = 0.05, height_m = 0.01, mass_kg = 0.01, count = 2 }",
                   "temple.toml:10: unknown key structure.capital.count");
    expect_refused("depth_m = 1\ndrums = [ { width_m = 1, height_m = 1, mass_kg = 9, count = 2 }, "
                   "{ width_m = 1, height_m = 1, mass_kg = 9, offset_m = 0.51 } ]",
                   "temple.toml:3: structure: the blocks on drum 2 are not stable at rest", {"10 mm outside"});
}

TEST(StudyStructure, RefusesMisusedKeysOfColonnades)
{
    expect_refused(two_by_two, "temple.toml:3: structure.epistyle_mass_kg is missing", {"epistyle_density_kg_m3"});
    const std::string without_epistyle = two_by_two.substr(0, two_by_two.find("epistyle_height_m"));
    expect_refused(without_epistyle, "temple.toml:3: structure.epistyle_height_m is missing", {"epistyles = []"});
    expect_refused("kind = \"colonnade\"\ndepth_m = 1", "temple.toml:3: structure.columns is missing",
                   {"[2, 50]", "column_list"});
    expect_refused(two_by_two + "column_list = []", "temple.toml:5: structure.columns = 2 and column_list exclude");
    expect_refused("kind = \"colonnade\"\ndepth_m = 1\ncolumn_list = []",
                   "temple.toml:6: structure.column_list = ", {"has 0 columns"});
    expect_refused(
        "kind = \"colonnade\"\ndepth_m = 1\ncolumn_list = [ { drums = [ { width_m = 1, height_m = 1, mass_kg "
        "= 1 } ] } ]",
        "temple.toml:6: structure.column_list[0].x_m is missing");
    expect_refused("kind = \"colonnade\"\ndepth_m = 1\ncolumn_list = [ { x_m = 0 } ]",
                   "temple.toml:3: structure.blocks is missing", {"drums = [ { ... }, ... ]"});
    const std::string lone = "kind = \"colonnade\"\ndepth_m = 1\ncolumn_list = [ { x_m = 0, drums = [ { width_m = 1, "
                             "height_m = 1, mass_kg = 1 } ] } ]\n";
    expect_refused(lone + "epistyle_height_m = 1", "temple.toml:6: structure.column_list = ", {"no bay"});
    EXPECT_EQ(read(lone + "epistyles = []").structure.columns.size(), 1U);
    expect_refused(two_by_two + "epistyles = []\nepistyle_bays = 1",
                   "temple.toml:14: structure.epistyle_bays = 1 is not used with epistyles");
    expect_refused(two_by_two + "epistyles = [ { first_column = 0, last_column = 2 } ]",
                   "temple.toml:13: structure.epistyles[0].last_column = 2 is outside [0, 1]", {"counted from 0"});
    expect_refused(two_by_two + "epistyles = [ { first_column = 1, last_column = 0 } ]",
                   "temple.toml:13: structure.epistyles[0].last_column = 0 is outside [1, 1]");
    expect_refused(two_by_two + "epistyles = [ { first_column = 0, last_column = 1, mass_kg = 1 } ]",
                   "temple.toml:13: structure.epistyles[0].length_m is missing", {"epistyle_length_m for all"});
    std::string close = two_by_two + "epistyle_mass_kg = 1\n";
    close.replace(close.find("0.09"), 4, "0.05");
    expect_refused(close, "temple.toml:3: structure: drum 1 of column 1 and drum 1 of column 2 overlap by 10 mm");
    std::string many = two_by_two + "epistyle_density_kg_m3 = 1000\n";
    many.replace(many.find("columns = 2"), 11, "columns = 50").replace(many.find("\nblocks = 2"), 11, "\nblocks = 4");
    expect_refused(many, "temple.toml:3: structure: 249 blocks in all. At most 200.");
}

TEST(StudyStructure, TiltFromABlock)
{
    EXPECT_EQ(read(drums_of_seven).initial.tilt_from_block, 0);
    EXPECT_EQ(read(drums_of_seven, "[initial]\ntilt_from_block = 6\n").initial.tilt_from_block, 6);
    expect_refused(drums_of_seven, "temple.toml:18: initial.tilt_from_block = 7 is outside [0, 6]", {"of each column"},
                   "[initial]\ntilt_from_block = 7\n");
    const Study raised = read(drums_of_seven, "[initial]\ntilt_from_block = 6\nlift_m = 0.003\n");
    EXPECT_EQ(raised.initial.lift_m, 0.003);
    EXPECT_EQ(parse_study(raised.text, "again.toml").initial.lift_m, 0.003);
    EXPECT_EQ(read(drums_of_seven).text.find("lift_m"), std::string::npos) << "texts of before stay";
    expect_refused(drums_of_seven, "temple.toml:18: outcome.follow = \"fall\" is not allowed",
                   {"\"collapse\", \"rest\""}, "[outcome]\nfollow = \"fall\"\n");
}

TEST(StudyStructure, PerturbationsOfBlocksThatDiffer)
{
    const std::string structure = two_by_two + "epistyle_mass_kg = 1.14\n";
    const auto perturbed = [&](const std::string& line) { return "[perturbation]\n" + line + "\n"; };
    const Study study = read(structure, perturbed("drum_width = { distribution = \"normal\", cov = 0.01 }\n"
                                                  "drum_height = { distribution = \"normal\", sd_m = 0.0002 }"));
    EXPECT_EQ(study.perturbations.size(), 2U);
    expect_refused(structure,
                   "temple.toml:22: perturbation.drum_width.distribution = \"uniform\" replaces nominal values",
                   {"from 0.06 to 0.15", "normal or lognormal"},
                   perturbed("drum_width = { distribution = \"uniform\", from = 0.05, to = 0.07 }"));
    expect_refused(structure, "temple.toml:22: perturbation.drum_width.max = 0.1 leaves less than one draw",
                   {"nominal value in [structure] is 0.15"},
                   perturbed("drum_width = { distribution = \"normal\", cov = 0.01, max = 0.1 }"));
    expect_refused(structure, "temple.toml:22: perturbation.drum_height.sd_m = 0.055 is outside (0, 0.05]", {},
                   perturbed("drum_height = { distribution = \"normal\", sd_m = 0.055, min = 0.01 }"));
    // equal drums by density: their densities differ by rounding only
    const std::string by_density = "depth_m = 0.3\nblocks = 4\ndrum_width_m = 0.7\ntop_width_m = 0.6\n"
                                   "drum_height_m = 0.3\ndensity_kg_m3 = 2700\n";
    EXPECT_EQ(read(by_density, perturbed("density = { distribution = \"uniform\", from = 2500, to = 2900 }"))
                  .perturbations.size(),
              1U);
}

TEST(StudyStructure, EveryStudyOfTheCatalogueIsReadAndDrawn)
{
    int studies = 0;
    for (const auto& entry : std::filesystem::directory_iterator(STYLOBATE_SOURCE_DIR "/studies/inputs")) {
        if (entry.path().extension() != ".toml")
            continue;
        std::vector<std::string> settings;
        if (entry.path().filename() == "record.toml")
            settings = {"excitation.file=quake.at2"};
        const Study study = read_study(entry.path(), settings);
        EXPECT_EQ(parse_study(study.text, "again.toml").text, study.text) << entry.path();
        if (study.excitation.kind != ExcitationKind::record) {
            std::shared_ptr<const MotionSet> motions;
            if (study.fragility)
                motions = std::make_shared<const MotionSet>(load_motions(study));
            const Sampler sampler(study, nullptr, nullptr, motions);
            for (std::uint64_t i = 0; i < study.total(); i += 1 + study.total() / 100)
                EXPECT_NO_THROW(sampler.realization(i)) << entry.path() << ' ' << i;
        }
        ++studies;
    }
    EXPECT_GE(studies, 10);
}

} // namespace
} // namespace stylobate::test_study_structure

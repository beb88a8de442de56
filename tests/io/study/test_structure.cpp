/// Structures: where the blocks stand, what cannot stand, and how realizations are built from them.

#include "tests/kernels/column_reference.hpp"

#include "ensemble/experiment.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace stylobate {
namespace {

DrumSpec drum(double width, double height, double mass, double offset = 0)
{
    return {.width_m = width, .height_m = height, .mass_kg = mass, .offset_m = offset};
}

/// Two columns, 90 mm apart, of a drum of 60 x 100 mm and of two of 60 x 50 mm; an epistyle, flush with their faces.
StructureSpec two_columns()
{
    StructureSpec s;
    s.kind = StructureKind::colonnade;
    s.depth_m = 0.06;
    s.columns = {{.x_m = 0, .drums = {drum(0.06, 0.1, 0.75)}},
                 {.x_m = 0.09, .drums = {drum(0.06, 0.05, 0.375), drum(0.06, 0.05, 0.375)}}};
    s.epistyles = {
        {.first_column = 0, .last_column = 1, .x_m = 0.045, .length_m = 0.15, .height_m = 0.06, .mass_kg = 1.14}};
    return s;
}

/// Three columns of two drums, two epistyles that meet over the middle one.
StructureSpec three_columns()
{
    StructureSpec s;
    s.kind = StructureKind::colonnade;
    s.depth_m = 1;
    for (const double x : {-3.0, 0.0, 3.0})
        s.columns.push_back({.x_m = x, .drums = {drum(1.1, 2.0, 5940), drum(1, 2.4, 6480)}});
    s.epistyles = {
        {.first_column = 0, .last_column = 1, .x_m = -1.75, .length_m = 3.5, .height_m = 0.8, .mass_kg = 7560},
        {.first_column = 1, .last_column = 2, .x_m = 1.75, .length_m = 3.5, .height_m = 0.8, .mass_kg = 7560}};
    return s;
}

Study study_of(const StructureSpec& structure, std::vector<Perturbation> perturbations = {})
{
    Study study;
    study.seed = 11;
    study.realizations = 1000;
    study.structure = structure;
    study.contact.normal_stiffness_n_m2 = 3e9;
    study.contact.tangential_stiffness_n_m = 3e9;
    study.contact.friction = 0.7;
    study.excitation.kind = ExcitationKind::none;
    study.excitation.duration_s = 1;
    study.outcome.follow = structure.kind == StructureKind::colonnade ? Follow::rest : Follow::collapse;
    study.perturbations = std::move(perturbations);
    return study;
}

Perturbation normal(Quantity quantity, Per per, double sd, double cov = 0)
{
    Perturbation p;
    p.quantity = quantity;
    p.per = per;
    p.sd = sd;
    p.cov = cov;
    return p;
}

void expect_refused(const std::function<void()>& action, const std::string& text)
{
    try {
        action();
        ADD_FAILURE() << "accepted, but should say: " << text;
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(), text);
    }
}

void expect_refused(const StructureSpec& structure, const std::string& text)
{
    expect_refused([&] { lay_out(structure); }, "structure: " + text);
}

void expect_block(const PlacedBlock& block, const char* name, BlockRole role, int column, double width, double height,
                  double mass, double x, double y, bool fixed)
{
    EXPECT_EQ(block.name, name);
    EXPECT_EQ(block.role, role) << name;
    EXPECT_EQ(block.column, column) << name;
    EXPECT_EQ(block.width_m, width) << name;
    EXPECT_EQ(block.height_m, height) << name;
    EXPECT_EQ(block.mass_kg, mass) << name;
    EXPECT_NEAR(block.x_m(), x, 1e-15) << name;
    EXPECT_NEAR(block.y_m, y, 1e-15) << name;
    EXPECT_EQ(block.fixed, fixed) << name;
}

// ---- where the blocks stand -----------------------------------------------------------------------------------------

TEST(Layout, ColumnOfUnequalDrums)
{
    StructureSpec s;
    s.depth_m = 1;
    s.columns = {{.fixed_blocks = 1, .drums = {drum(1.4, 0.3, 900), drum(1.2, 1.0, 2000, 0.01), drum(1.0, 0.8, 1500)}}};
    s.columns[0].drums[2].bed.friction = 0.3;
    const Layout layout = lay_out(s);
    ASSERT_EQ(layout.blocks.size(), 3U);
    expect_block(layout.blocks[0], "drum 1", BlockRole::drum, 0, 1.4, 0.3, 900, 0, 0.15, true);
    expect_block(layout.blocks[1], "drum 2", BlockRole::drum, 0, 1.2, 1.0, 2000, 0.01, 0.8, false);
    expect_block(layout.blocks[2], "drum 3", BlockRole::drum, 0, 1.0, 0.8, 1500, 0, 1.7, false);
    ASSERT_EQ(layout.beds.size(), 2U); // none under a fixed drum
    EXPECT_EQ(layout.beds[0].lower, 0);
    EXPECT_EQ(layout.beds[0].upper, 1);
    EXPECT_FALSE(layout.beds[0].bed.friction);
    EXPECT_EQ(layout.beds[1].lower, 1);
    EXPECT_EQ(layout.beds[1].upper, 2);
    EXPECT_EQ(layout.beds[1].bed.friction, 0.3);
}

TEST(Layout, TwoColumnsAndAnEpistyle)
{
    const Layout layout = lay_out(two_columns());
    ASSERT_EQ(layout.blocks.size(), 4U);
    expect_block(layout.blocks[0], "drum 1 of column 1", BlockRole::drum, 0, 0.06, 0.1, 0.75, 0, 0.05, false);
    expect_block(layout.blocks[1], "drum 1 of column 2", BlockRole::drum, 1, 0.06, 0.05, 0.375, 0.09, 0.025, false);
    expect_block(layout.blocks[2], "drum 2 of column 2", BlockRole::drum, 1, 0.06, 0.05, 0.375, 0.09, 0.075, false);
    expect_block(layout.blocks[3], "epistyle 1", BlockRole::epistyle, -1, 0.15, 0.06, 1.14, 0.045, 0.13, false);
    const int want[][2] = {{-1, 0}, {-1, 1}, {1, 2}, {0, 3}, {2, 3}};
    ASSERT_EQ(layout.beds.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(layout.beds[i].lower, want[i][0]) << i;
        EXPECT_EQ(layout.beds[i].upper, want[i][1]) << i;
    }
}

TEST(Layout, EpistylesThatMeetOverAColumnShareItsTop)
{
    const Layout layout = lay_out(three_columns());
    ASSERT_EQ(layout.blocks.size(), 8U);
    EXPECT_EQ(layout.blocks[7].name, "epistyle 2");
    EXPECT_NEAR(layout.blocks[7].y_m, 4.8, 1e-15);
    const int seats[][2] = {{1, 6}, {3, 6}, {3, 7}, {5, 7}};
    ASSERT_EQ(layout.beds.size(), 10U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(layout.beds[6 + i].lower, seats[i][0]) << i;
        EXPECT_EQ(layout.beds[6 + i].upper, seats[i][1]) << i;
    }
}

TEST(Layout, FlushNeighboursStand)
{
    StructureSpec s = two_columns();
    s.columns[1].x_m = 0.06; // the columns touch
    s.epistyles[0].x_m = 0.03;
    s.epistyles[0].length_m = 0.12;
    EXPECT_EQ(lay_out(s).blocks.size(), 4U);
    s.epistyles.clear();
    s.columns[0].drums = {drum(0.06, 0.3, 1)}; // free-standing ones of any height
    EXPECT_EQ(lay_out(s).blocks.size(), 3U);
}

// ---- what cannot stand ----------------------------------------------------------------------------------------------

TEST(Layout, RefusesEpistylesWithoutASeat)
{
    StructureSpec s = two_columns();
    s.columns[1].drums[1].height_m = 0.038;
    expect_refused(s, "epistyle 1 has no seat on column 2: the column's top, at 0.088 m, is 12 mm below that of column "
                      "1. The columns of one epistyle must be equally high.");
    s = two_columns();
    s.epistyles[0].length_m = 0.1;
    s.epistyles[0].x_m = 0.005;
    expect_refused(s, "epistyle 1 has no seat on column 2: it reaches from x = -0.045 to 0.055 m and the column's top "
                      "from 0.06 to 0.12 m, 5 mm apart. Lengthen it, move it, or omit the column.");
    s = two_columns();
    s.epistyles[0].last_column = 2;
    expect_refused(s, "epistyle 1 lies on the columns from 1 to 3, but the columns are 1 to 2, counted from the left.");
    s = two_columns();
    s.epistyles[0].last_column = 0;
    s.columns[1].x_m = 1;
    expect_refused(s,
                   "epistyle 1 is not stable at rest: its centre of mass, at x = 0.045 m, is 15 mm outside its seats, "
                   "which reach from -0.03 to 0.03 m. Move it.");
}

TEST(Layout, RefusesBlocksInOnePlace)
{
    StructureSpec s = two_columns();
    s.columns[1].x_m = 0.055;
    expect_refused(s, "drum 1 of column 1 and drum 1 of column 2 overlap by 5 mm at rest. Move them apart.");
    s = three_columns();
    s.epistyles[1].length_m = 3.52;
    expect_refused(s, "epistyle 1 and epistyle 2 overlap by 10 mm at rest. Move them apart.");
    s = two_columns();
    s.columns.push_back({.x_m = 0.145, .drums = {drum(0.06, 0.13, 1)}}); // beside the epistyle's end
    expect_refused(s, "drum 1 of column 2 and drum 1 of column 3 overlap by 5 mm at rest. Move them apart.");
    s.columns[2] = {.x_m = 0.16, .drums = {drum(0.05, 0.1, 1), drum(0.09, 0.03, 1)}};
    s.columns[1].drums[1].width_m = 0.05;
    expect_refused(s, "drum 2 of column 3 and epistyle 1 overlap by 5 mm at rest. Move them apart.");
}

TEST(Layout, RefusesDrumsThatFallByThemselves)
{
    StructureSpec s;
    s.depth_m = 1;
    // corbelled: the upper two together lie beyond the lowest one's edge at 0.5, the topmost one is fine
    s.columns = {{.drums = {drum(1, 0.5, 100), drum(1, 0.5, 100, 0.45), drum(1, 0.5, 100, 0.6)}}};
    expect_refused(s, "the blocks on drum 1 are not stable at rest: their centre of mass, at x = 0.525 m, is 25 mm "
                      "outside the bed between drum 1 and drum 2, from -0.05 to 0.5 m. Lower "
                      "the offsets.");
    s.columns[0].drums[2].offset_m = 0.54;
    EXPECT_NO_THROW(lay_out(s)); // 0.495 on the lowest one, 0.33 on the ground
    s.columns[0].drums[2].offset_m = 1.46;
    expect_refused(s, "drum 3 is beside drum 2, not on it: they are 10 mm apart. Lower the "
                      "offset.");
    s.columns = {{.drums = {drum(0.4, 0.5, 100), drum(2, 0.5, 600, 0.15), drum(0.4, 0.5, 300, 0.4)}}};
    expect_refused(s, "the blocks on drum 1 are not stable at rest: their centre of mass, at x = 0.233333 m, is "
                      "33.33 mm outside the bed between drum 1 and drum 2, from -0.2 to 0.2 m. "
                      "Lower the offsets.");
    // on the table what is fixed holds whatever stands on it
    s.columns = {{.fixed_blocks = 1, .drums = {drum(1, 0.5, 100, 5), drum(1, 0.5, 100, 5)}}};
    EXPECT_NO_THROW(lay_out(s));
}

TEST(Layout, RefusesWhatIsNoStructure)
{
    StructureSpec s;
    expect_refused(s, "there is no column.");
    s.columns.resize(1);
    expect_refused(s, "column 1 has no drum.");
    s.columns[0] = {.fixed_blocks = 1, .drums = {drum(1, 1, 1)}};
    expect_refused(s, "1 of the 1 drums of column 1 are fixed. At least one must be free.");
    s.columns[0] = {.drums = {drum(1, 0, 1)}};
    expect_refused(s, "drum 1 is 1 m wide, 0 m high, has 1 kg and stands at x = 0 m. Sizes and masses must "
                      "be above 0.");
    s = two_columns();
    std::swap(s.columns[0], s.columns[1]);
    expect_refused(s, "column 2 stands at x = 0 m, not to the right of column 1 at 0.09 m. List the columns from the "
                      "left.");
    s = three_columns();
    std::swap(s.epistyles[0], s.epistyles[1]);
    expect_refused(s, "epistyle 2 lies at x = -1.75 m, not to the right of epistyle 1 at 1.75 m. List the epistyles "
                      "from the left.");
    s = two_columns();
    s.kind = StructureKind::column;
    expect_refused(
        s, "a column stands alone, at x = 0, without an epistyle. For several columns, give kind = \"colonnade\".");
}

// ---- realizations ---------------------------------------------------------------------------------------------------

TEST(StructureRealization, ColumnsOfEqualDrumsKeepTheirBits)
{
    for (const ColumnReference& want : column_reference) {
        const Study study = read_study(STYLOBATE_SOURCE_DIR "/studies/inputs/small_scale_column.toml", want.settings);
        const Realization r = Sampler(study, nullptr).realization(want.index);
        std::vector<double> got = {r.step_s};
        got.insert(got.end(), r.inputs.begin(), r.inputs.end());
        for (const Block& b : r.blocks)
            got.insert(got.end(), {b.half_width_m, b.half_height_m, b.mass_kg, b.inertia_kg_m2, b.x_m, b.y_m});
        for (const Joint& j : r.joints)
            got.insert(got.end(), {j.normal_stiffness_n_m2, j.tangential_stiffness_n_m, j.normal_damping_n_s_m,
                                   j.tangential_damping_n_s_m, j.damping_chord_m, j.friction});
        EXPECT_EQ(got, want.values) << want.index;
        EXPECT_EQ(r.watched, 0);
    }
}

TEST(StructureRealization, ColonnadeWithItsGroundAndWatchedPairs)
{
    StructureSpec s = two_columns();
    s.columns[0].drums = {drum(0.06, 0.04, 0.3), drum(0.06, 0.06, 0.45)};
    s.columns[0].fixed_blocks = 1;
    s.columns[1].fixed_blocks = 1;
    s.epistyles[0].bed.friction = 0.4;
    const Realization r = Experiment(study_of(s)).sampler().realization(0);
    ASSERT_EQ(r.blocks.size(), 6U); // 2 + 2 drums, the epistyle, the ground
    EXPECT_EQ(r.drums, 5);
    EXPECT_EQ(r.blocks[4].role, BlockRole::epistyle);
    EXPECT_EQ(r.blocks[5].role, BlockRole::ground); // there to fall on, though the columns stand on fixed drums
    EXPECT_EQ(r.blocks[5].y_m + r.blocks[5].half_height_m, 0);
    EXPECT_TRUE(r.blocks[5].fixed);
    EXPECT_GT(r.blocks[5].half_width_m, 1);
    EXPECT_EQ(r.blocks[3].column, 1);

    const int want[][2] = {{0, 1}, {2, 3}, {1, 4}, {3, 4},         // beds
                           {0, 3}, {0, 4}, {1, 2}, {1, 3}, {2, 4}, // watched; {0, 2} are both fixed
                           {5, 1}, {5, 3}, {5, 4}};                // the ground last, and not under what is fixed
    ASSERT_EQ(r.joints.size(), std::size(want));
    EXPECT_EQ(r.watched, 8);
    EXPECT_EQ(r.beds(), 4);
    for (std::size_t i = 0; i < std::size(want); ++i) {
        EXPECT_EQ(r.joints[i].lower, want[i][0]) << i;
        EXPECT_EQ(r.joints[i].upper, want[i][1]) << i;
    }
    EXPECT_EQ(r.joints[2].friction, 0.4);
    EXPECT_EQ(r.joints[4].friction, 0.7);
    EXPECT_EQ(r.joints[2].damping_chord_m, 0);

    // 0 and 3: the shorter of their long faces is 0.06; 3 alone is free, with 0.375 kg
    EXPECT_EQ(r.joints[4].damping_chord_m, 0.06);
    EXPECT_NEAR(r.joints[4].normal_damping_n_s_m, 0.2 * std::sqrt(3e9 * 0.06 * 0.375), 1e-9);
    EXPECT_NEAR(r.joints[4].tangential_damping_n_s_m, 0.2 * std::sqrt(3e9 * 0.375), 1e-9);
    // 2 and 4: 2 is fixed, 4 has 1.14 kg, and 2's long face is the shorter one
    EXPECT_EQ(r.joints[8].damping_chord_m, 0.06);
    EXPECT_NEAR(r.joints[8].normal_damping_n_s_m, 0.2 * std::sqrt(3e9 * 0.06 * 1.14), 1e-9);
    // 1 and 3: 0.375 kg is less than 0.45
    EXPECT_NEAR(r.joints[7].normal_damping_n_s_m, 0.2 * std::sqrt(3e9 * 0.06 * 0.375), 1e-9);
}

TEST(StructureRealization, PairsOfAColumnAreWatchedWhereItIsFollowedToRest)
{
    Study study = study_of(equal_column(4, 1, 0.05, 0.03, 0.05, 0.15));
    EXPECT_EQ(Sampler(study, nullptr).realization(0).watched, 0);
    EXPECT_EQ(Sampler(study, nullptr).realization(0).blocks.size(), 4U);
    study.outcome.follow = Follow::rest;
    const Realization r = Sampler(study, nullptr).realization(0);
    EXPECT_EQ(r.blocks.size(), 5U);
    const int want[][2] = {{0, 1}, {1, 2}, {2, 3}, {0, 2}, {0, 3}, {1, 3}, {4, 1}, {4, 2}, {4, 3}};
    ASSERT_EQ(r.joints.size(), std::size(want));
    for (std::size_t i = 0; i < std::size(want); ++i) {
        EXPECT_EQ(r.joints[i].lower, want[i][0]) << i;
        EXPECT_EQ(r.joints[i].upper, want[i][1]) << i;
    }
}

TEST(StructureRealization, EpistylesShareADampedSeat)
{
    const Realization r = Experiment(study_of(three_columns())).sampler().realization(0);
    // on the outer column the whole top of 1 m, on the middle one a half; the column's top drum is the lighter block
    EXPECT_NEAR(r.joints[6].normal_damping_n_s_m, 0.2 * std::sqrt(3e9 * 1.0 * 6480), 1e-6);
    EXPECT_NEAR(r.joints[7].normal_damping_n_s_m, 0.2 * std::sqrt(3e9 * 0.5 * 6480), 1e-6);
    EXPECT_NEAR(r.joints[7].tangential_damping_n_s_m, 0.2 * std::sqrt(3e9 * 6480), 1e-6);
}

TEST(StructureRealization, WatchedPairsTakeWhatIsDrawnForTheStructure)
{
    Perturbation stiffness = normal(Quantity::normal_stiffness, Per::structure, 0);
    stiffness.distribution = DistributionKind::lognormal;
    stiffness.sigma_ln = 0.5;
    StructureSpec s = two_columns();
    s.columns[1].drums[1].bed.normal_stiffness_n_m2 = 6e9;
    const Study study = study_of(s, {normal(Quantity::friction, Per::joint, 0, 0.1), stiffness});
    const Realization r = Sampler(study, nullptr).realization(3);
    const double drawn = r.inputs.at(5); // after the five beds' friction
    EXPECT_NE(drawn, 3e9);
    for (int i = 0; i < r.beds(); ++i) {
        const Joint& bed = r.joints[static_cast<std::size_t>(i)];
        EXPECT_EQ(bed.friction, r.inputs[static_cast<std::size_t>(i)]);
        // the bed with its own stiffness takes the same quantile of its own distribution
        EXPECT_NEAR(bed.normal_stiffness_n_m2 / drawn, i == 2 ? 2 : 1, 1e-14) << i;
    }
    for (std::size_t i = 5; i < r.joints.size(); ++i) {
        EXPECT_EQ(r.joints[i].friction, 0.7);
        EXPECT_EQ(r.joints[i].normal_stiffness_n_m2, drawn);
    }
}

TEST(StructureRealization, EachBlockVariesAboutItsOwnValues)
{
    StructureSpec s;
    s.depth_m = 1;
    s.columns = {{.drums = {drum(1.4, 0.3, 900), drum(1.2, 1.0, 2000, 0.05), drum(1.0, 0.8, 1500)}}};
    const Experiment experiment(study_of(
        s, {normal(Quantity::drum_width, Per::block, 0, 0.01), normal(Quantity::drum_height, Per::structure, 0, 0.02),
            normal(Quantity::drum_offset, Per::block, 0.003), normal(Quantity::density, Per::block, 0, 0.03)}));
    const Sampler& sampler = experiment.sampler();
    const Realization r = sampler.realization(5);
    ASSERT_EQ(r.inputs.size(), 3U + 1 + 3 + 3);
    const double width[] = {1.4, 1.2, 1.0}, height[] = {0.3, 1.0, 0.8}, mass[] = {900, 2000, 1500};
    const double scale = r.inputs[3] / 0.3; // the first drum's height stands for all
    double top = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Block& b = r.blocks[i];
        EXPECT_EQ(2 * b.half_width_m, r.inputs[i]);
        EXPECT_NE(r.inputs[i], width[i]);
        EXPECT_NEAR(r.inputs[i], width[i], 0.05 * width[i]);
        EXPECT_NEAR(2 * b.half_height_m, scale * height[i], 1e-12);
        EXPECT_EQ(b.x_m, r.inputs[4 + i]);
        EXPECT_NEAR(b.x_m, i == 1 ? 0.05 : 0, 0.015);
        EXPECT_NEAR(b.mass_kg, r.inputs[7 + i] * r.inputs[i] * scale * height[i], 1e-9);
        EXPECT_NEAR(r.inputs[7 + i], mass[i] / (width[i] * height[i]), 0.15 * mass[i] / (width[i] * height[i]));
        EXPECT_NEAR(b.y_m - b.half_height_m, top, 1e-12); // one upon the other, and as high as they come
        top = b.y_m + b.half_height_m;
    }
    EXPECT_NE(top, 2.1);
}

TEST(StructureRealization, ColonnadesStayLevelAndTheirEpistylesApart)
{
    const std::vector<Perturbation> rough = {normal(Quantity::drum_width, Per::block, 0.02),
                                             normal(Quantity::drum_height, Per::block, 0.02),
                                             normal(Quantity::drum_offset, Per::block, 0.02)};
    const Experiment experiment(study_of(three_columns(), rough));
    const Sampler& sampler = experiment.sampler();
    int pushed = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Realization r = sampler.realization(i);
        for (std::size_t c = 0; c < 3; ++c) {
            const Block& lower = r.blocks[2 * c];
            const Block& upper = r.blocks[2 * c + 1];
            EXPECT_EQ(2 * lower.half_height_m, r.inputs[8 + 2 * c]); // as drawn
            EXPECT_NEAR(upper.y_m + upper.half_height_m, 4.4, 1e-12);
            EXPECT_NEAR(upper.y_m - upper.half_height_m, 2 * lower.half_height_m, 1e-12);
            EXPECT_NEAR(upper.mass_kg, 2700 * 4 * upper.half_width_m * upper.half_height_m, 1e-9);
        }
        const Block& left = r.blocks[6];
        const Block& right = r.blocks[7];
        EXPECT_EQ(left.x_m, -1.75 + r.inputs[16 + 6]);
        EXPECT_EQ(2 * left.half_height_m, r.inputs[8 + 6]); // an epistyle is as high as it is drawn
        EXPECT_NEAR(left.y_m - left.half_height_m, 4.4, 1e-12);
        const double wanted = 1.75 + r.inputs[16 + 7];
        const double gap = (right.x_m - right.half_width_m) - (left.x_m + left.half_width_m);
        EXPECT_GE(gap, -1e-12);
        if (right.x_m != wanted) {
            ++pushed;
            EXPECT_GT(right.x_m, wanted);
            EXPECT_NEAR(gap, 0, 1e-12);
        }
    }
    EXPECT_GT(pushed, 60); // half of them, give or take
    EXPECT_LT(pushed, 140);
}

TEST(StructureRealization, RefusesDrawsThatCannotBeBuilt)
{
    const auto draw = [](const StructureSpec& s, const Perturbation& p) {
        const Experiment experiment(study_of(s, {p}));
        const Sampler& sampler = experiment.sampler();
        for (std::uint64_t i = 0; i < 1000; ++i)
            sampler.realization(i);
    };
    const auto expect_words = [&](const StructureSpec& s, const Perturbation& p, std::vector<std::string> words) {
        try {
            draw(s, p);
            ADD_FAILURE() << "accepted: " << words[0];
        } catch (const InputError& error) {
            for (const std::string& word : words)
                EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " in " << error.what();
        }
    };
    expect_words(three_columns(), normal(Quantity::drum_height, Per::block, 0.8),
                 {"perturbation.drum_height: in realization", "less than half of its 2.4 m", "have equal heights"});
    expect_words(two_columns(), normal(Quantity::drum_width, Per::block, 0.02),
                 {"perturbation: in realization", "and drum", "overlap by", "drum_width"});
    expect_words(two_columns(), normal(Quantity::drum_offset, Per::block, 0.05),
                 {"perturbation.drum_offset: in realization", "do not touch"});
}

TEST(StructureRealization, OneDrumPerColumnKeepsItsHeight)
{
    StructureSpec s = two_columns();
    s.columns[1].drums = s.columns[0].drums;
    const Experiment experiment(study_of(s, {normal(Quantity::drum_height, Per::block, 0.002)}));
    const Sampler& sampler = experiment.sampler();
    const Realization r = sampler.realization(1);
    EXPECT_EQ(2 * r.blocks[0].half_height_m, 0.1);
    EXPECT_EQ(2 * r.blocks[1].half_height_m, 0.1);
    EXPECT_NE(2 * r.blocks[2].half_height_m, 0.06);
}

} // namespace
} // namespace stylobate

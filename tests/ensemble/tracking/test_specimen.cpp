/// Measured specimens as structures: every block and joint finds its place, and what cannot be built is named.

#include "ensemble/tracking/specimen.hpp"
#include "io/measured/measured_file.hpp"
#include "tests/io/measured/measured_samples.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

/// The layout has every measured block where it was measured at rest, with its size and mass.
void expect_in_place(const Specimen& specimen)
{
    const SpecimenStructure built = build_specimen(specimen);
    const Layout layout = lay_out(built.structure);
    ASSERT_EQ(built.block.size(), specimen.half_width_m.size());
    ASSERT_EQ(built.bed.size(), specimen.joints.size());
    std::vector<bool> taken(layout.blocks.size());
    for (std::size_t i = 0; i < built.block.size(); ++i) {
        const auto place = static_cast<std::size_t>(built.block[i]);
        ASSERT_LT(place, layout.blocks.size());
        EXPECT_FALSE(taken[place]);
        taken[place] = true;
        const PlacedBlock& block = layout.blocks[place];
        EXPECT_FALSE(block.fixed);
        EXPECT_NEAR(block.x_m() + built.origin_x_m, specimen.rest_x_m[i], 1e-12);
        EXPECT_NEAR(block.y_m + built.origin_y_m, specimen.rest_y_m[i], 1e-12);
        EXPECT_DOUBLE_EQ(block.width_m, 2 * specimen.half_width_m[i]);
        EXPECT_DOUBLE_EQ(block.height_m, 2 * specimen.half_height_m[i]);
        EXPECT_DOUBLE_EQ(block.mass_kg, specimen.mass_kg[i]);
    }
    for (std::size_t j = 0; j < built.bed.size(); ++j) {
        const PlacedBed& bed = layout.beds.at(static_cast<std::size_t>(built.bed[j]));
        const auto [lower, upper] = specimen.joints[j];
        EXPECT_EQ(bed.upper, built.block[static_cast<std::size_t>(upper)]);
        if (lower >= 0) {
            EXPECT_EQ(bed.lower, built.block[static_cast<std::size_t>(lower)]);
        } else {
            EXPECT_TRUE(bed.lower == -1 || layout.blocks[static_cast<std::size_t>(bed.lower)].fixed);
        }
    }
    EXPECT_EQ(layout.beds.size(), specimen.joints.size());
}

/// Two columns of two drums with an epistyle, the blocks and joints in no order.
Specimen sample_colonnade()
{
    Specimen specimen;
    specimen.half_width_m = {0.075, 0.03, 0.03, 0.03, 0.03};
    specimen.half_height_m = {0.03, 0.025, 0.025, 0.025, 0.025};
    specimen.depth_m.assign(5, 0.06);
    specimen.mass_kg = {1.14, 0.375, 0.376, 0.377, 0.378};
    specimen.rest_x_m = {0, 0.045, -0.045, -0.0449, 0.045};
    specimen.rest_y_m = {0.13, 0.075, 0.025, 0.075, 0.025};
    specimen.joints = {{3, 0}, {1, 0}, {4, 1}, {-1, 4}, {2, 3}, {-1, 2}};
    return specimen;
}

TEST(Specimen, AColumnOnAFixedBlock)
{
    expect_in_place(sample_specimen(4));
    const StructureSpec structure = structure_of(sample_specimen(4));
    EXPECT_EQ(structure.kind, StructureKind::column);
    ASSERT_EQ(structure.columns.size(), 1u);
    EXPECT_EQ(structure.columns[0].fixed_blocks, 1);
    EXPECT_EQ(structure.columns[0].drums.size(), 5u);
    EXPECT_DOUBLE_EQ(structure.columns[0].drums[0].height_m, 0.029);
}

TEST(Specimen, AColumnAwayFromTheOrigin)
{
    Specimen specimen = sample_specimen(3);
    for (double& x : specimen.rest_x_m)
        x += 0.4;
    specimen.rest_x_m[2] += 0.001;
    expect_in_place(specimen);
    specimen.base_block_half_width_m.reset();
    specimen.base_block_top_m = 0;
    for (double& y : specimen.rest_y_m)
        y -= 0.029;
    expect_in_place(specimen);
    EXPECT_EQ(structure_of(specimen).columns[0].fixed_blocks, 0);
}

TEST(Specimen, AColonnadeInAnyOrder)
{
    expect_in_place(sample_colonnade());
    const SpecimenStructure built = build_specimen(sample_colonnade());
    EXPECT_EQ(built.block, (std::vector<int>{4, 3, 0, 1, 2}));
    // on one base block that reaches under both columns, and on one for each
    Specimen raised = sample_colonnade();
    for (double& y : raised.rest_y_m)
        y += 0.02;
    raised.base_block_top_m = 0.02;
    raised.base_block_half_width_m = 0.2;
    expect_in_place(raised);
    EXPECT_EQ(structure_of(raised).columns[0].fixed_blocks, 0);
    raised.base_block_half_width_m = 0.03;
    expect_in_place(raised);
    EXPECT_EQ(structure_of(raised).columns[0].fixed_blocks, 1);
}

TEST(Specimen, WhatCannotBeBuiltIsNamed)
{
    const auto refused = [](Specimen specimen, auto&& change, const char* part) {
        change(specimen);
        const std::string text = refusal([&] { build_specimen(specimen); });
        EXPECT_NE(text.find(part), std::string::npos) << text << " / " << part;
    };
    refused(
        sample_specimen(), [](Specimen& s) { s.joints.clear(); }, "no joints");
    refused(
        sample_specimen(), [](Specimen& s) { s.mass_kg.clear(); }, "mass_kg is absent");
    refused(
        sample_specimen(), [](Specimen& s) { s.mass_kg[1] = nan_value; }, "mass_kg of block 1 is not a number");
    refused(
        sample_specimen(), [](Specimen& s) { s.depth_m[2] = 0.05; }, "block 2 0.05 m");
    refused(
        sample_specimen(), [](Specimen& s) { s.joints.pop_back(); }, "block 2 stands on nothing");
    refused(
        sample_specimen(),
        [](Specimen& s) {
            s.joints[2] = {0, 2};
        },
        "blocks 1 and 2 both stand on block 0");
    refused(
        sample_specimen(),
        [](Specimen& s) {
            s.joints[0] = {2, 0};
        },
        "is not joined to the base");
    refused(
        sample_specimen(),
        [](Specimen& s) {
            s.joints[0] = {-1, 9};
        },
        "joint 0 is between -1 and 9");
    refused(
        sample_specimen(), [](Specimen& s) { s.joints.emplace_back(-1, 1); },
        "block 1 stands on the base and on another block");
    refused(
        sample_colonnade(), [](Specimen& s) { s.rest_x_m.clear(); }, "rest_x_m is absent");
    refused(
        sample_colonnade(), [](Specimen& s) { s.half_width_m[0] = 0.01; }, "no seat");
    refused(
        sample_colonnade(),
        [](Specimen& s) {
            s.joints[1] = {4, 0};
        },
        "is not the top of its column");
}

TEST(Specimen, PracticeCampaignsAreBuilt)
{
    const auto files = practice_campaigns();
    if (files.empty())
        GTEST_SKIP() << "no practice campaigns beside this checkout";
    for (const auto& file : files) {
        SCOPED_TRACE(file);
        expect_in_place(read_campaign(file).specimen);
    }
}

} // namespace
} // namespace stylobate

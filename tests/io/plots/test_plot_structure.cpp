/// The drawing of a structure: that it is to scale, what is drawn, and in which formats.

#include "io/plots/plot_structure.hpp"
#include "tests/io/plots/pixels.hpp"

#include <algorithm>

namespace stylobate {
namespace {

using Structure = ExportFolder;

constexpr std::uint32_t drum = 0xead9b5, fixed = 0xa89a7d, epistyle = 0xb9cddb, other_bed = 0xc0271b;

/// Where a colour is, in pixels.
struct Box {
    std::size_t left = ~std::size_t{0}, right = 0, top = ~std::size_t{0}, bottom = 0;
    double width() const { return static_cast<double>(right - left + 1); }
    double height() const { return static_cast<double>(bottom - top + 1); }
};

Box box_of(const Pixels& pixels, std::uint32_t colour)
{
    Box box;
    for (std::size_t k = 0; k < pixels.colour.size(); ++k)
        if (pixels.colour[k] == colour) {
            box.left = std::min(box.left, k % pixels.width);
            box.right = std::max(box.right, k % pixels.width);
            box.top = std::min(box.top, k / pixels.width);
            box.bottom = std::max(box.bottom, k / pixels.width);
        }
    return box;
}

Study column()
{
    Study study;
    study.structure = equal_column(7, 1, 0.048, 0.029, 0.048, 0.1355);
    study.contact.friction = 0.68;
    return study;
}

TEST_F(Structure, AColumnIsDrawnToScale)
{
    plot_structure(column(), "it's a column", (folder / "column.png"));
    const Pixels pixels = decode((folder / "column.png"));
    EXPECT_EQ(pixels.width, 1800U);
    const Box drums = box_of(pixels, drum), foot = box_of(pixels, fixed);
    EXPECT_NEAR(drums.height() / drums.width(), 6 * 29.0 / 48, 0.06) << "lines cover a pixel of an edge";
    EXPECT_NEAR(foot.height() / foot.width(), 29.0 / 48, 0.03);
    EXPECT_GT(foot.top, drums.bottom);
    EXPECT_EQ(pixels.count.count(epistyle), 0U);
    EXPECT_EQ(pixels.count.count(other_bed), 0U);
}

TEST_F(Structure, AColonnadeHasItsEpistyleAndTheBedThatDiffers)
{
    Study study = column();
    study.structure.kind = StructureKind::colonnade;
    ColumnSpec one;
    one.drums = {{.width_m = 1, .height_m = 2, .mass_kg = 5000}, {.width_m = 1, .height_m = 2, .mass_kg = 5000}};
    ColumnSpec two = one;
    two.x_m = 3;
    study.structure.columns = {one, two};
    study.structure.epistyles = {
        {.first_column = 0, .last_column = 1, .x_m = 1.5, .length_m = 4, .height_m = 1, .mass_kg = 10000}};
    plot_structure(study, "alike", (folder / "alike.png"));
    EXPECT_EQ(decode((folder / "alike.png")).count.count(other_bed), 0U);
    plot_structure(study, "alike", (folder / "alike.svg"));
    const std::string svg = read_file((folder / "alike.svg")); // columns count from 1, as the names of blocks do
    EXPECT_NE(svg.find(">column 1<"), std::string::npos);
    EXPECT_EQ(svg.find("column 0"), std::string::npos);
    study.structure.columns[1].drums[1].bed.friction = 0.4;
    plot_structure(study, "not alike", (folder / "other.png"));
    const Pixels pixels = decode((folder / "other.png"));
    const Box beam = box_of(pixels, epistyle), drums = box_of(pixels, drum);
    EXPECT_NEAR(beam.width() / beam.height(), 4, 0.1);
    EXPECT_NEAR(drums.width() / drums.height(), 4.0 / 4, 0.03);
    EXPECT_LT(beam.bottom, drums.top + 3);
    const Box bed = box_of(pixels, other_bed);
    EXPECT_GT(bed.left, (drums.left + drums.right) / 2) << "the second column's";
}

/// Fifty blocks of a centimetre, and one of ten metres: whatever it is, it fits.
TEST_F(Structure, LargeAndSmallOnesFit)
{
    Study many = column(), one = column();
    many.structure = equal_column(50, 0, 0.05, 0.01, 0.05, 0.05);
    for (std::size_t i = 0; i < 50; ++i) // all in the list
        many.structure.columns[0].drums[i].width_m -= 0.0001 * static_cast<double>(i);
    one.structure = equal_column(1, 0, 2, 10, 2, 1e5);
    for (const Study& study : {many, one}) {
        plot_structure(study, "fits", (folder / "fits.png"));
        const Pixels pixels = decode((folder / "fits.png"));
        for (std::size_t y = 0; y < pixels.height; ++y) {
            EXPECT_EQ(pixels.colour[y * pixels.width], 0xffffffU);
            EXPECT_EQ(pixels.colour[(y + 1) * pixels.width - 1], 0xffffffU);
        }
    }
}

TEST_F(Structure, OtherFormats)
{
    plot_structure(column(), "column", (folder / "column.svg"));
    plot_structure(column(), "column", (folder / "column.pdf"));
    EXPECT_TRUE(read_file((folder / "column.svg")).starts_with("<?xml"));
    EXPECT_NE(read_file((folder / "column.svg")).find("drums 2 to 7: 48 × 29 mm, 0.1355 kg"), std::string::npos);
    EXPECT_NE(read_file((folder / "column.svg")).find("203 mm"), std::string::npos);
    EXPECT_TRUE(read_file((folder / "column.pdf")).starts_with("%PDF"));
}

} // namespace
} // namespace stylobate

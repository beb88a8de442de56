/// The picture of the falls: where its curves are, and what is said when there is none.

#include "io/plots/plot_order.hpp"
#include "tests/io/plots/pixels.hpp"

namespace stylobate {
namespace {

using Order = ExportFolder;

/// Pixels of the curves' half of the picture, without the table.
Pixels curves_of(Pixels pixels)
{
    for (std::size_t k = 0; k < pixels.colour.size(); ++k)
        if (static_cast<double>(k % pixels.width) > 0.552 * pixels.width)
            pixels.colour[k] = 0xffffff;
    return pixels;
}

TEST_F(Order, OrderShowsWhoFellWhenAndHowOften)
{
    // 40 realizations: block 2 falls in all of them at 2 s, block 0 in half of them at 8 s, block 1 never.
    FallOrder order;
    order.trials = 40;
    order.end_time_s = 10;
    order.interval = "jeffreys 0.95";
    order.blocks = {{"drum 0", 0, std::vector<double>(20, 8.0), 0.35, 0.65},
                    {"it's \"drum 1\"", 0, {}, 0, 0.06},
                    {"epistyle 0", 40, std::vector<double>(40, 2.0), 0.94, 1}};
    EXPECT_EQ(order_of_falls(order), (std::vector<std::size_t>{2, 0}));
    plot_order(order, "falls: 100 % \"it's\"", "a note", folder / "o.png");
    EXPECT_EQ(entries(), 1U);
    const Pixels pixels = decode(folder / "o.png");
    EXPECT_EQ(pixels.width, 1800U);
    EXPECT_EQ(pixels.height, 1350U);
    const Pixels curves = curves_of(pixels);
    // the axes: 0 to 9.2 s over 0.085 to 0.55 of the width, 0 to 1.01 over 0.1 to 0.845 of the height from below
    const auto x = [](double time) { return 1800 * (0.085 + 0.465 * time / 9.2); };
    const auto y = [](double share) { return 1350 * (1 - 0.1 - 0.745 * share / 1.01); };
    const Extent early = extent(curves, 0x440154);
    EXPECT_NEAR(early.top, y(1), 4);
    EXPECT_NEAR(early.right, x(9.2), 6);
    const Extent late = extent(curves, 0xb0dc2f); // 0.88 of the way along the map: 0.8 from #7ad151 to #bddf26
    EXPECT_NEAR(late.top, y(0.5), 4);
    // the rise of a curve: its pixels in a row at half of its height
    const auto rise = [&](std::uint32_t colour, double level) {
        const auto row = static_cast<std::size_t>(y(level));
        for (std::size_t k = 0; k < curves.width; ++k)
            if (similar(curves.colour[row * curves.width + k], colour, 3))
                return static_cast<double>(k);
        return -1.0;
    };
    EXPECT_NEAR(rise(0x440154, 0.7), x(2), 4);
    EXPECT_NEAR(rise(0xb0dc2f, 0.3), x(8), 4);

    for (FallOrder::Block& block : order.blocks)
        block.fall_time_s.clear();
    EXPECT_NE(message_of([&] { plot_order(order, "", "", folder / "none.png"); }).find("no block fell in 40 valid"),
              std::string::npos);
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Order, OrderOfManyBlocksAndAtOnce)
{
    FallOrder order;
    order.trials = 3000;
    order.interval = "jeffreys 0.95";
    for (std::size_t i = 0; i < 60; ++i) {
        FallOrder::Block block{"drum " + std::to_string(i), 0, {}, 0, 1};
        for (std::size_t k = 0; k < 3000 - 40 * i; ++k)
            block.fall_time_s.push_back(0.001 * static_cast<double>(k));
        order.blocks.push_back(block);
    }
    plot_order(order, "", "", folder / "many.png");
    const Pixels many = decode(folder / "many.png");
    EXPECT_GT(share(many, 0xb0b0b0, 2), 0.002) << "curves that have no line in the table are grey";
    EXPECT_GT(share(many, 0x440154, 2), 0.0001);
    // all at the very start
    order.blocks = {{"drum 0", 1, {0.0}, 0, 1}};
    order.trials = 1;
    plot_order(order, "", "", folder / "one.png");
    EXPECT_GT(decode(folder / "one.png").colours, 20U);
}

TEST_F(Order, OfManyBlocksIsADrawingInTheirPlaces)
{
    // two columns of ten drums of 1 m by 1 m, 3 m apart; block i falls at 1 + i / 10 s, the last one never
    FallOrder order;
    order.trials = 10;
    order.end_time_s = 4;
    order.interval = "jeffreys 0.95";
    for (std::size_t i = 0; i < 20; ++i) {
        const double left = i < 10 ? 0 : 3, bottom = static_cast<double>(i % 10);
        FallOrder::Block block{"drum " + std::to_string(i), 0, {}, 0, 1};
        if (i < 19)
            block.fall_time_s.assign(10, 1 + 0.1 * static_cast<double>(i));
        order.blocks.push_back(block);
        order.places.push_back({left, left + 1, bottom, bottom + 1});
    }
    order.blocks[0].first = 7;
    order.blocks[3].first = 3;
    plot_order(order, "many", "", folder / "drawn.png");
    const Pixels pixels = decode(folder / "drawn.png");
    EXPECT_EQ(pixels.width, 1800U);
    EXPECT_EQ(pixels.height, 1350U);
    // the drawing alone: above the curves, and left of the box of colours
    const auto in_drawing = [&](std::uint32_t colour) {
        Pixels part = pixels;
        for (std::size_t k = 0; k < part.colour.size(); ++k)
            if (k % part.width > 1570 || k / part.width > 676 || k / part.width < 185)
                part.colour[k] = 0xffffff;
        return extent(part, colour);
    };
    const Extent first = in_drawing(0x440154), last = in_drawing(0xb0dc2f), never = in_drawing(0xe8e8e8);
    // one scale for both axes: the first drum is at the bottom of the left column, the last two at the top of the right
    const double metre = (last.left - first.left) / 3;
    EXPECT_GT(metre, 40);
    EXPECT_NEAR(first.right - first.left, metre, 4); // outlines take a pixel and more from each side
    EXPECT_NEAR(first.bottom - first.top, metre, 4);
    EXPECT_NEAR(first.bottom - last.bottom, 8 * metre, 2.5);
    EXPECT_NEAR(last.top - never.top, metre, 2.5);
    // SVG has its words: shares, who was first, the scale
    plot_order(order, "many", "", folder / "drawn.svg");
    const std::string svg = read_file(folder / "drawn.svg");
    EXPECT_NE(svg.find("fell first: drum 0 70.0 %, drum 3 30.0 %"), std::string::npos);
    EXPECT_NE(svg.find("median time of fall"), std::string::npos);
    EXPECT_NE(svg.find("19 of 20 blocks fell"), std::string::npos);
    // few blocks have their table
    order.blocks.resize(5);
    order.places.resize(5);
    plot_order(order, "few", "", folder / "few.svg");
    EXPECT_NE(read_file(folder / "few.svg").find("drum 4"), std::string::npos);
}

} // namespace
} // namespace stylobate

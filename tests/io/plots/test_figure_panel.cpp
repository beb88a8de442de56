/// Figures drawn as pictures: round numbers, texts that keep apart at three sizes, marks, cells.

#include "io/plots/figure_file.hpp"
#include "tests/io/plots/picture_texts.hpp"
#include "tests/io/plots/pixels.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace stylobate {
namespace {

using FigurePictures = ExportFolder;

std::vector<std::string> numbers(double from, double to, bool log)
{
    PlotScale scale;
    scale.from = from;
    scale.to = to;
    scale.log = log;
    std::vector<std::string> all;
    for (const PlotScale::Tic& tic : scale.tics())
        if (!tic.text.empty())
            all.push_back(tic.text);
    return all;
}

/// Three series with long names over an axis of many decades.
Figure some_figure(bool log)
{
    Figure figure;
    figure.title = "A title of a figure that is rather long";
    figure.x_label = "peak ground acceleration of the larger component [m/s²]";
    figure.y_label = "probability of reaching the limit state";
    figure.x_log = log;
    for (int k = 0; k < 3; ++k) {
        FigureSeries line{
            fmt::format("the top moves by more than {}.35 of its width", k), SeriesKind::line, {}, {}, {}, {}};
        for (int i = 0; i <= 40; ++i) {
            line.x.push_back(0.013 * std::pow(1.3, i));
            line.y.push_back(-12345.678 * i * (k + 1));
        }
        line.group = line.name;
        figure.series.push_back(line);
        line.kind = SeriesKind::points;
        figure.series.push_back(line);
    }
    return figure;
}

TEST(PlotScales, NumbersAreRoundAndFew)
{
    EXPECT_EQ(numbers(0, 1, false), (std::vector<std::string>{"0", "0.2", "0.4", "0.6", "0.8", "1"}));
    EXPECT_EQ(numbers(-3, 17, false), (std::vector<std::string>{"0", "5", "10", "15"}));
    EXPECT_EQ(numbers(0.8, 120, true), (std::vector<std::string>{"1", "10", "100"}));
    EXPECT_EQ(numbers(0.5, 10, true), (std::vector<std::string>{"0.5", "1", "2", "5", "10"}));
    EXPECT_EQ(numbers(2, 7, true), (std::vector<std::string>{"2", "3", "4", "5", "6", "7"}));
    EXPECT_EQ(numbers(1e-5, 2e-5, false).front(), "1e-5");
    EXPECT_EQ(numbers(1, 1.001, false).size(), 6U) << "numbers that can be told apart";
    for (const double decades : {1e3, 1e8, 1e20}) {
        const std::vector<std::string> all = numbers(1, decades, true);
        EXPECT_GE(all.size(), 3U) << decades;
        EXPECT_LE(all.size(), 9U) << decades;
    }
}

TEST_F(FigurePictures, TextsKeepApartAtThreeSizes)
{
    for (const PictureSize size : {PictureSize{900, 700}, PictureSize{1800, 1350}, PictureSize{2400, 1000}})
        for (const bool log : {false, true}) {
            const Figure figure = some_figure(log);
            const std::filesystem::path file = folder / "figure.svg";
            write_figure(figure, "A heading", "and what it is of", file, size);
            EXPECT_EQ(text_faults(read_file(file)), "") << size.width << " of one";
            write_figures({figure, figure, figure, figure}, 2, "A heading", "", file, size);
            EXPECT_EQ(text_faults(read_file(file)), "") << size.width << " of four";
            write_figures({figure, figure, figure}, 1, "A heading", "", file, size);
            EXPECT_EQ(text_faults(read_file(file)), "") << size.width << " of three";
        }
    // a test that cannot fail would be none
    EXPECT_NE(text_faults("<svg width=\"100\" height=\"100\" font-size=\"10\"><text x=\"10\" y=\"20\">one text</text>"
                          "<text x=\"20\" y=\"24\">another</text></svg>"),
              "");
}

TEST_F(FigurePictures, FollowsItsData)
{
    Figure figure;
    figure.x_range = {0, 10};
    figure.y_range = {0, 4};
    figure.cells = {{0, 5, 0, 2, "#ff0000"}, {5, 10, 0, 2, "#00ff00"}};
    figure.series.push_back({"", SeriesKind::points, {5}, {3}, {}, {}});
    figure.series.back().colour = "#0000ff";
    write_figure(figure, "", "", folder / "cells.png");
    const Pixels pixels = decode(folder / "cells.png");
    const Extent red = extent(pixels, 0xff0000), green = extent(pixels, 0x00ff00), blue = extent(pixels, 0x0000ff);
    EXPECT_NEAR(red.right, green.left, 2);
    EXPECT_NEAR(red.area, green.area, 0.01 * red.area);
    // the point lies above the border of both, half a cell's height higher than they reach
    EXPECT_NEAR((blue.left + blue.right) / 2, red.right, 2);
    EXPECT_NEAR((blue.top + blue.bottom) / 2, red.top - (red.bottom - red.top) / 2, 3);
}

TEST_F(FigurePictures, WhatIsNotFiniteIsAGap)
{
    Figure figure;
    const double none = std::numeric_limits<double>::quiet_NaN();
    figure.series.push_back({"line", SeriesKind::line, {0, 1, 2, 3, 4}, {1, 2, none, 2, 1}, {}, {}});
    write_figure(figure, "", "", folder / "gap.svg");
    const std::string svg = read_file(folder / "gap.svg");
    const std::size_t at = svg.find("<g data-series=\"0\">");
    ASSERT_NE(at, std::string::npos);
    const std::string data = attribute(svg.substr(svg.find("<path", at)), "d");
    EXPECT_EQ(std::count(data.begin(), data.end(), 'M'), 2) << data;
    figure.series[0].y.assign(5, none);
    write_figure(figure, "", "", folder / "none.svg");
    EXPECT_NE(read_file(folder / "none.svg").find("no data"), std::string::npos);
}

} // namespace
} // namespace stylobate

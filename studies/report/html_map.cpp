#include "studies/report/html_map.hpp"

#include "io/plots/colours.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace stylobate {
namespace {

constexpr double frame_left = 74, frame_top = 10, frame_width = 470, frame_height = 430;
constexpr double scale_left = 560, scale_width = 16;
constexpr double picture_width = 640, picture_height = 496;
constexpr double seam = 0.5; ///< by which cells overlap, so that no light comes between them

double px_x(double unit)
{
    return frame_left + unit * frame_width;
}
double px_y(double unit)
{
    return frame_top + (1 - unit) * frame_height;
}

std::string map_cells(const CellMap& map)
{
    std::string out = "<g shape-rendering=\"crispEdges\">\n";
    const std::size_t ny = map.y.size();
    for (std::size_t i = 0; i < map.x.size(); ++i)
        for (std::size_t j = 0; j < ny; ++j) {
            const double v = map.value[i * ny + j];
            out += fmt::format(
                "<rect data-cell=\"{}\" x=\"{:.5g}\" y=\"{:.5g}\" width=\"{:.5g}\" height=\"{:.5g}\" {}/>\n",
                i * ny + j, px_x(map.x_edges[i]), px_y(map.y_edges[j + 1]),
                (map.x_edges[i + 1] - map.x_edges[i]) * frame_width + seam,
                (map.y_edges[j + 1] - map.y_edges[j]) * frame_height + seam,
                std::isfinite(v) ? "fill=\"" + viridis_colour(v) + "\"" : "class=\"empty-cell\"");
        }
    return out + "</g>\n";
}

/// A dark line under a white one is seen on every colour.
std::string map_lines(const CellMap& map)
{
    std::string out = "<g class=\"contours\">\n", labels;
    for (const SurfaceContour& contour : map.contours) {
        std::string data;
        for (const ContourLine& line : contour.lines)
            for (std::size_t k = 0; k < line.size(); ++k)
                data += fmt::format("{}{:.1f} {:.1f}", k == 0 ? "M" : "L", px_x(line[k].x), px_y(line[k].y));
        if (data.empty())
            continue;
        for (const char* look : {"#202020\" stroke-width=\"3", "#ffffff\" stroke-width=\"1.6"})
            out += fmt::format("<path d=\"{}\" fill=\"none\" pointer-events=\"none\" stroke=\"{}\"/>\n", data, look);
        const double x = px_x(contour.label.x), y = px_y(contour.label.y);
        labels += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"38\" height=\"17\" rx=\"3\" fill=\"#fff\" "
                              "pointer-events=\"none\"/>\n",
                              x - 19, y - 9);
        labels += svg_text(x, y + 4, "middle", fmt::format("{}", contour.level),
                           " class=\"on-colour\" pointer-events=\"none\" font-size=\"12\"");
    }
    return out + labels + "</g>\n";
}

/// At the centres of the cells, as many as have room.
std::string map_axes(const CellMap& map)
{
    std::string out;
    double last = -1e9;
    // of a narrow drawing, whose letters are larger, every other number is left out
    const auto look = [](std::size_t number) { return number % 2 == 1 ? " class=\"every-other\"" : ""; };
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < map.x.size(); ++i) {
        const double x = px_x((map.x_edges[i] + map.x_edges[i + 1]) / 2);
        if (x - last < 42)
            continue;
        last = x;
        out += svg_rule(x, px_y(0), x, px_y(0) + 5, "axis");
        out += svg_text(x, px_y(0) + 20, "middle", fmt::format("{:.3g}", map.x[i]), look(drawn++));
    }
    last = 1e9;
    drawn = 0;
    for (std::size_t j = 0; j < map.y.size(); ++j) {
        const double y = px_y((map.y_edges[j] + map.y_edges[j + 1]) / 2);
        if (last - y < 22)
            continue;
        last = y;
        out += svg_rule(frame_left - 5, y, frame_left, y, "axis");
        out += svg_text(frame_left - 9, y + 4.5, "end", fmt::format("{:.3g}", map.y[j]), look(drawn++));
    }
    out += svg_text(px_x(0.5), px_y(0) + 44, "middle", map.x_label);
    out +=
        svg_text(16, px_y(0.5), "middle", map.y_label, fmt::format(" transform=\"rotate(-90 16 {:.1f})\"", px_y(0.5)));
    return out;
}

std::string colour_scale(const CellMap& map)
{
    std::string out = "<g class=\"scale\">\n";
    constexpr int steps = 48;
    for (int k = 0; k < steps; ++k)
        out += fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"{}\"/>\n", scale_left,
                           px_y((k + 1.0) / steps), scale_width, frame_height / steps + 0.5,
                           viridis_colour((k + 0.5) / steps));
    for (int k = 0; k <= 5; ++k)
        out += svg_text(scale_left + scale_width + 5, px_y(0.2 * k) + 4.5, "start", fmt::format("{:.1f}", 0.2 * k));
    return out +
           svg_text(picture_width - 8, px_y(0.5), "middle", map.value_label,
                    fmt::format(" transform=\"rotate(-90 {} {:.1f})\"", picture_width - 8, px_y(0.5))) +
           "</g>\n";
}

} // namespace

Html map_svg(const CellMap& map)
{
    return Html::ready(fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"cells\" data-frame=\"{7}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" role=\"img\" aria-label=\"{2}\" font-family=\"inherit\" font-size=\"13\">\n"
        "{3}{4}{5}{6}</svg>",
        picture_width, picture_height, html_escaped(map.title), map_cells(map), map_lines(map), map_axes(map),
        colour_scale(map), fmt::format("{} {} {} {}", frame_left, frame_top, frame_width, frame_height)));
}

} // namespace stylobate

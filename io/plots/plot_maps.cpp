#include "io/plots/plot_maps.hpp"

#include "io/plots/colours.hpp"
#include "io/plots/contour.hpp"
#include "io/plots/plot_surface.hpp"
#include "io/store/surface_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::array<double, 3> levels{0.05, 0.5, 0.95};

const MapClass* class_of(const std::vector<MapClass>& classes, double value)
{
    const MapClass* found = nullptr;
    for (const MapClass& c : classes)
        if (value >= c.from)
            found = &c;
    return found;
}

/// The cells of a panel with their axes, and the lines of the picture's function.
Figure panel_figure(const MapPicture& picture, const MapPanel& panel, const CellAxis& f, const CellAxis& a)
{
    Figure figure = cells_figure(picture, [&](std::size_t cell) -> std::string {
        const double value = panel.value[cell];
        if (std::isnan(value))
            return "";
        if (panel.classes.empty())
            return viridis_colour((value - panel.low) / (panel.high - panel.low));
        const MapClass* of = class_of(panel.classes, value);
        return of == nullptr ? "" : of->colour;
    });
    if (picture.line.empty())
        return figure;
    // Lines of the picture's function through the middles of the cells, dark under white: seen on every colour.
    std::vector<double> x, y;
    for (const double value : f.values)
        x.push_back(f.scaled(value));
    for (const double value : a.values)
        y.push_back(a.scaled(value));
    for (const double level : levels)
        for (const ContourLine& line : contour_lines(x, y, picture.line, level)) {
            FigureSeries series;
            for (const ContourPoint& p : line) {
                series.x.push_back(f.unscaled(p.x));
                series.y.push_back(a.unscaled(p.y));
            }
            for (const auto& [line_colour, weight] : {std::pair{"#202020", 1.7}, {"#ffffff", 0.7}}) {
                series.colour = line_colour;
                series.weight = weight;
                figure.series.push_back(series);
            }
        }
    return figure;
}

/// What the colours of the classes mean, in a row.
void draw_classes(DrawingSheet& sheet, const MapPicture& picture, double left, double y, double font)
{
    for (const MapPanel& panel : picture.panels) {
        if (panel.classes.empty())
            continue;
        double wide = 0;
        for (const MapClass& c : panel.classes)
            wide += 80 + DrawingSheet::width(c.name, font);
        const double fits = std::min(1.0, (sheet.size().width - 2 * left) / wide);
        for (const MapClass& c : panel.classes) {
            sheet.rectangle(left, y - 10, left + 36 * fits, y + 10, c.colour);
            sheet.text(c.name, left + 46 * fits, y, font * fits, TextAt::left);
            left += (80 + DrawingSheet::width(c.name, font)) * fits;
        }
        return;
    }
}

/// A scale of colours; the colour of an end stands for all that lies beyond it, and then the end is marked.
void draw_scale(DrawingSheet& sheet, const FigureLook& look, const MapPanel& panel, const PlotFrame& frame)
{
    PlotScale scale;
    scale.from = panel.low;
    scale.to = panel.high;
    const double left = frame.right + 10 * look.unit;
    const auto any = [&](auto beyond) { return std::any_of(panel.value.begin(), panel.value.end(), beyond); };
    const auto end = [&](const char* sign, double value, double y) {
        sheet.text(fmt::format("{} {:g}", sign, value), left, y, look.letters(), TextAt::left);
    };
    if (any([&](double value) { return value < panel.low; }))
        end("≤", panel.low, frame.bottom + 0.9 * look.letters());
    if (any([&](double value) { return value > panel.high; }))
        end("≥", panel.high, frame.top - 0.9 * look.letters());
    draw_colour_scale(sheet, look, {left, frame.top, left + 14 * look.unit, frame.bottom}, scale, "",
                      [&](double value) { return viridis_colour((value - panel.low) / (panel.high - panel.low)); });
}

} // namespace

void plot_maps(const MapPicture& picture, const std::filesystem::path& png)
{
    const CellAxis f = make_cell_axis(picture.rows(), picture.row_quantity().key);
    const CellAxis a = make_cell_axis(picture.pga_m_s2, "pga_m_s2");
    const auto columns = static_cast<std::size_t>(picture.columns);
    const std::size_t rows = (picture.panels.size() + columns - 1) / columns;
    const bool boxes = std::any_of(picture.panels.begin(), picture.panels.end(),
                                   [](const MapPanel& panel) { return panel.classes.empty(); });
    const PictureSize size;
    const FigureLook look{columns > 3 ? 1.2 : 1.7, false};
    const double unit = look.unit, margin = 20;
    DrawingSheet sheet(size, look.letters());
    const double top = sheet.heading(picture.title, picture.subtitle);
    draw_classes(sheet, picture, 60, size.height - 72.0, 22.6);
    if (picture.key)
        sheet.text(*picture.key, 60, size.height - 30.0, DrawingSheet::fitting(*picture.key, size.width - 120.0, 22.6),
                   TextAt::left, "#505050");
    const double wide = (size.width - 2 * margin) / static_cast<double>(columns);
    const double high = (size.height - 100.0 - top) / static_cast<double>(rows);
    for (std::size_t k = 0; k < picture.panels.size(); ++k) {
        const MapPanel& panel = picture.panels[k];
        const Figure figure = panel_figure(picture, panel, f, a);
        FigurePanel drawn(figure, look);
        const double left = margin + wide * static_cast<double>(k % columns);
        const double above = top + high * static_cast<double>(k / columns);
        PlotFrame frame{left + drawn.room_left(), above + 2.6 * look.letters(), left + wide - (boxes ? 66 : 16) * unit,
                        0};
        frame.bottom = above + high - drawn.room_below(frame.right - frame.left) - 4 * unit;
        sheet.text(panel.title, (frame.left + frame.right) / 2, above + look.letters(),
                   DrawingSheet::fitting(panel.title, wide - 30, 1.1 * look.letters()));
        drawn.draw(sheet, frame, k + columns >= picture.panels.size(), k % columns == 0);
        if (panel.classes.empty())
            draw_scale(sheet, look, panel, frame);
    }
    sheet.write(png);
}

} // namespace stylobate

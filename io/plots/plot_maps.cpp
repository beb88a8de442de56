#include "io/plots/plot_maps.hpp"

#include "io/plots/contour.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/store/surface_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::array<double, 3> levels{0.05, 0.5, 0.95};
constexpr const char* grey = "#b8b8b8";

const MapClass* class_of(const std::vector<MapClass>& classes, double value)
{
    const MapClass* found = nullptr;
    for (const MapClass& c : classes)
        if (value >= c.from)
            found = &c;
    return found;
}

/// An edge, and a little more: each cell reaches under its right and upper neighbours, drawn after it, so that no seams
/// shine through.
double beyond(const CellAxis& axis, std::size_t edge)
{
    if (edge + 1 == axis.edges.size())
        return axis.edges[edge];
    const double range = axis.scaled(axis.edges.back()) - axis.scaled(axis.edges.front());
    return axis.unscaled(axis.scaled(axis.edges[edge]) + 0.004 * range);
}

/// The cells of a panel: extent, and the colour as a number or as such.
std::string cells(const MapPicture& picture, const MapPanel& panel, const CellAxis& f, const CellAxis& a)
{
    std::string data;
    const std::size_t np = picture.pga_m_s2.size();
    for (std::size_t cell = 0; cell < panel.value.size(); ++cell) {
        const std::size_t i = cell / np, j = cell % np;
        const double value = panel.value[cell];
        if (std::isnan(value))
            continue;
        const MapClass* of = class_of(panel.classes, value);
        if (!panel.classes.empty() && of == nullptr)
            continue;
        const std::string colour = of ? fmt::format("0x{}", of->colour.substr(1))
                                      : fmt::format("{}", std::clamp(value, panel.low, panel.high));
        data += fmt::format("{} {} {} {} {} {} {}\n", f.values[i], a.values[j], f.edges[i], beyond(f, i + 1),
                            a.edges[j], beyond(a, j + 1), colour);
    }
    return data;
}

/// Lines of the picture's function, through the middles of the cells.
std::string lines(const MapPicture& picture, const CellAxis& f, const CellAxis& a)
{
    std::vector<double> x, y;
    for (const double value : f.values)
        x.push_back(f.scaled(value));
    for (const double value : a.values)
        y.push_back(a.scaled(value));
    std::string data;
    for (const double level : levels)
        for (const ContourLine& line : contour_lines(x, y, picture.line, level)) {
            for (const ContourPoint& p : line)
                data += fmt::format("{} {}\n", f.unscaled(p.x), a.unscaled(p.y));
            data += "\n";
        }
    return data;
}

/// The commands of an axis whose labels stand at the panel to the left.
std::string without_labels(const std::string& commands)
{
    std::string text;
    bool quoted = false;
    for (const char c : commands) {
        if (!quoted || c == '\'')
            text += c;
        quoted = (c == '\'') != quoted;
    }
    return text;
}

/// The colour of an end stands for all that lies beyond it: then the end is marked.
std::string ends(const MapPanel& panel)
{
    const auto any = [&](auto beyond) { return std::any_of(panel.value.begin(), panel.value.end(), beyond); };
    std::string tics = "set cbtics autofreq\n";
    if (any([&](double value) { return value < panel.low; }))
        tics += fmt::format("set cbtics add ('≤ {0:g}' {0})\n", panel.low);
    if (any([&](double value) { return value > panel.high; }))
        tics += fmt::format("set cbtics add ('≥ {0:g}' {0})\n", panel.high);
    return tics;
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

    std::string script = viridis_palette();
    for (std::size_t k = 0; k < picture.panels.size(); ++k)
        script += fmt::format("$cells{} << EOD\n{}EOD\n", k, cells(picture, picture.panels[k], f, a));
    const std::string line = picture.line.empty() ? "" : lines(picture, f, a);
    script += "$lines << EOD\n" + line + "EOD\n";
    script += "set multiplot\n" + gnuplot_heading(picture.title, picture.subtitle);

    // what the colours of the classes mean, in a row at the bottom
    double at = 0.075;
    for (const MapPanel& panel : picture.panels) {
        if (panel.classes.empty())
            continue;
        for (std::size_t c = 0; c < panel.classes.size(); ++c) {
            script += fmt::format("set object {} rectangle from screen {}, screen 0.05 to screen {}, screen 0.066 "
                                  "fillcolor rgb '{}' fillstyle solid 1 noborder\n"
                                  "set label {} at screen {}, screen 0.058 left font ',17'\n",
                                  c + 1, at, at + 0.02, panel.classes[c].colour, gnuplot_text(panel.classes[c].name),
                                  at + 0.026);
            at += 0.045 + 0.0078 * static_cast<double>(panel.classes[c].name.size());
        }
        break;
    }
    if (picture.key)
        script += fmt::format("set label {} at screen 0.075, screen 0.022 left font ',17' textcolor rgb '#505050'\n",
                              gnuplot_text(*picture.key));
    script += "unset key\nset border 31 linewidth 0.8\nset tics out nomirror font ',16'\nset xtics offset "
              "0,0.4\nset cbtics offset -0.9,0\nset style fill solid 1.0 "
              "noborder\n" +
              gnuplot_axis('x', f) + gnuplot_axis('y', a);

    const double left = 0.075, right = 0.985, top = 0.88, bottom = 0.1;
    const double width = (right - left) / static_cast<double>(columns),
                 height = (top - bottom) / static_cast<double>(rows);
    for (std::size_t k = 0; k < picture.panels.size(); ++k) {
        const MapPanel& panel = picture.panels[k];
        const double x = left + width * static_cast<double>(k % columns);
        const std::size_t row = k / columns;
        const double y = top - height * static_cast<double>(row);
        const bool lowest = k + columns >= picture.panels.size();
        script += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset "
                              "bmargin at screen {}\n",
                              x, x + width - (boxes ? 0.095 : 0.02), y - 0.035, y - height + 0.055);
        script += "set title " + gnuplot_text(panel.title) +
                  fmt::format(" font ',{}' offset 0,-0.7\n", columns > 3 ? 16 : 19);
        script += lowest ? fmt::format("set xlabel '{}' font ',17' offset 0,0.9\n", picture.row_quantity().label)
                         : "unset xlabel\n";
        script += k % columns == 0 ? gnuplot_axis('y', a) : without_labels(gnuplot_axis('y', a));
        script += k % columns == 0
                      ? "set ylabel 'peak ground acceleration [m/s²]' font ',17' offset 0.8,0\nset format y\n"
                      : "unset ylabel\nset format y ''\n";
        script += fmt::format("set object 99 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '{}' "
                              "fillstyle solid 1 noborder\n",
                              grey);
        if (panel.classes.empty())
            script += fmt::format("set cbrange [{}:{}]\nset colorbox\n", panel.low, panel.high) + ends(panel);
        std::string plot = "plot ";
        if (cells(picture, panel, f, a).empty())
            plot += "1/0";
        else
            plot += fmt::format("$cells{} using 1:2:3:4:5:6:7 with boxxyerror linecolor {}", k,
                                panel.classes.empty() ? "palette" : "rgb variable");
        if (!line.empty())
            plot += ", $lines with lines linewidth 2.6 linecolor rgb '#202020', $lines with lines linewidth 1.1 "
                    "linecolor rgb '#ffffff'";
        script += plot + "\n";
        if (k == 0) // what stands outside of the maps is there once
            script += "unset label\n" + std::string("unset object\n");
    }
    run_gnuplot(script + "unset multiplot\n", size, png);
}

} // namespace stylobate

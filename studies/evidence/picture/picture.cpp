#include "studies/evidence/picture/picture.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace stylobate::verification {

namespace {

/// Okabe and Ito's colours, told apart by the colour-blind, and a point type each.
struct Style {
    const char* colour;
    int point;
};
constexpr std::array<Style, 6> styles{
    {{"#0072b2", 7}, {"#d55e00", 5}, {"#009e73", 9}, {"#cc79a7", 11}, {"#e69f00", 13}, {"#000000", 4}}};
constexpr std::array<const char*, 4> fills{"#e8e8e8", "#a6cfe8", "#f4c9a0", "#a9dcc9"};

std::string axis(const char* name, const PictureAxis& a)
{
    std::string text =
        fmt::format("set {}label {} font ',18'\nset {}tics font ',15'\n", name, gnuplot_text(a.label), name);
    if (a.log)
        text += fmt::format("set logscale {0}\nset format {0} '%.0e'\n", name);
    if (a.from != 0 || a.to != 0)
        text += fmt::format("set {}range [{}:{}]\n", name, a.from, a.to);
    return text;
}

std::string block(const std::string& name, const Series& s)
{
    std::string text = fmt::format("${} << EOD\n", name);
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        text += fmt::format("{:.9g} {:.9g}", s.x[i], s.y[i]);
        if (!s.low.empty())
            text += fmt::format(" {:.9g} {:.9g}", s.low[i], s.high[i]);
        text += '\n';
    }
    return text + "EOD\n";
}

std::string plotted(const std::string& name, const Series& s, std::size_t k)
{
    const Style& style = styles[(s.colour >= 0 ? static_cast<std::size_t>(s.colour) : k) % styles.size()];
    const char* axes = s.right ? " axes x1y2" : "";
    const std::string title = s.title ? "title " + gnuplot_text(*s.title) : "notitle";
    if (s.line)
        return fmt::format("${} using 1:2{} with lines linecolor rgb '{}' linewidth 1.4 {}", name, axes, style.colour,
                           title);
    if (!s.low.empty())
        return fmt::format("${} using 1:2:3:4{} with yerrorbars linecolor rgb '{}' pointtype {} pointsize 1.6 {}", name,
                           axes, style.colour, style.point, title);
    return fmt::format("${} using 1:2{} with points linecolor rgb '{}' pointtype {} pointsize 1.6 {}", name, axes,
                       style.colour, style.point, title);
}

constexpr const char* frame = "set border linewidth 0.7\nset grid linewidth 0.4 linecolor rgb '#d0d0d0'\n";

} // namespace

std::string curves(const PictureAxis& x, const PictureAxis& y, const std::vector<Series>& series,
                   const std::string& key, const std::optional<PictureAxis>& right)
{
    std::string script = frame + axis("x", x) + axis("y", y) + fmt::format("set key {} font ',15'\n", key);
    if (right)
        script += "set ytics nomirror\n" + axis("y2", *right);
    std::string plot;
    for (std::size_t k = 0; k < series.size(); ++k) {
        const std::string name = fmt::format("s{}", k);
        script += block(name, series[k]);
        plot += (k == 0 ? "plot " : ", ") + plotted(name, series[k], k);
    }
    return script + plot;
}

std::string map(const PictureAxis& x, const PictureAxis& y, const std::vector<double>& at_x,
                const std::vector<double>& at_y, const std::vector<int>& kind, const std::vector<std::string>& kinds,
                const std::vector<Series>& lines)
{
    const double dx = at_x[1] - at_x[0], dy = at_y[1] - at_y[0];
    std::string script = axis("x", x) + axis("y", y);
    script += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", at_x.front() - dx / 2, at_x.back() + dx / 2,
                          at_y.front() - dy / 2, at_y.back() + dy / 2);
    script += "set key outside below font ',15'\nset border linewidth 0.7 front\nset style fill solid noborder\n";
    std::string plot;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        std::string data;
        for (std::size_t j = 0; j < at_y.size(); ++j)
            for (std::size_t i = 0; i < at_x.size(); ++i)
                if (kind[j * at_x.size() + i] == static_cast<int>(k))
                    data += fmt::format("{:.6g} {:.6g}\n", at_x[i], at_y[j]);
        if (data.empty())
            continue;
        script += fmt::format("$k{} << EOD\n{}EOD\n", k, data);
        plot += fmt::format("{}$k{} using 1:2:({}):({}) with boxxyerror fillcolor rgb '{}' title {}",
                            plot.empty() ? "plot " : ", ", k, dx / 2, dy / 2, fills[k % fills.size()],
                            gnuplot_text(kinds[k]));
    }
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const std::string name = fmt::format("l{}", k);
        script += block(name, lines[k]);
        plot += ", " + plotted(name, lines[k], 5);
    }
    return script + plot;
}

} // namespace stylobate::verification

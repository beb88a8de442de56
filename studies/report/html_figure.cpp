#include "studies/report/html_figure.hpp"

#include "io/plots/figure_panel.hpp"
#include "studies/report/json.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {
namespace {

Json axis_json(const PlotScale& axis, const std::string& label, const std::vector<std::string>& ticks)
{
    return Json::object()
        .member("from", axis.from)
        .member("to", axis.to)
        .member("log", axis.log)
        .member("first", axis.first_px)
        .member("last", axis.last_px)
        .member("label", label)
        .member("ticks", Json::list(ticks));
}

/// What the script reads (figure.js). @pre the panel is drawn
std::string figure_json(const Figure& figure, const FigurePanel& panel)
{
    Json all = Json::list();
    for (std::size_t i = 0; i < figure.series.size(); ++i) {
        const FigureSeries& s = figure.series[i];
        const std::vector<std::size_t> kept = panel.kept(s);
        const auto values = [&](const std::vector<double>& v) {
            std::vector<double> drawn;
            for (std::size_t k = 0; k < kept.size() && v.size() == s.x.size(); ++k)
                drawn.push_back(v[kept[k]]);
            return Json::brief(drawn);
        };
        all.item(Json::object()
                     .member("name", s.name)
                     .member("group", FigurePanel::group_of(s))
                     .member("layer", s.layer.value_or(""))
                     .member("kind", s.kind == SeriesKind::spans  ? "spans"
                                     : s.kind == SeriesKind::bars ? "bars"
                                                                  : "values")
                     .member("colour", panel.colour_number(i))
                     .member("shown", s.shown)
                     .member("x", values(s.x))
                     .member("y", values(s.kind == SeriesKind::band ? std::vector<double>{} : s.y))
                     .member("low", values(s.low))
                     .member("high", values(s.high)));
    }
    return Json::object()
        .member("x", axis_json(panel.x(), figure.x_label, figure.x_ticks))
        .member("y", axis_json(panel.y(), figure.y_label, {}))
        .member("series", all)
        .text();
}

} // namespace

std::string svg_text(double x, double y, const char* anchor, const std::string& text, const std::string& more)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       html_escaped(text));
}

Html figure_svg(const Figure& figure, double height)
{
    FigurePanel panel(figure, {1, true});
    const DrawingSheet sheet = panel.sheet(height);
    Html html = Html::ready(
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" role=\"img\" "
                    "aria-label=\"{2}\" font-family=\"inherit\" font-size=\"13\">\n{3}</svg>",
                    sheet.size().width, sheet.size().height, html_escaped(figure.title), sheet.elements()));
    html += data_script("class=\"figure-data\"", figure_json(figure, panel));
    return html;
}

Html bar_svg(double value, std::optional<double> mark, double most)
{
    constexpr double length = 96;
    const auto px = [&](double v) { return std::clamp(v / most, 0.0, 1.0) * length; };
    std::string svg =
        fmt::format("<svg width=\"{0:.0f}\" height=\"12\" viewBox=\"0 0 {0:.0f} 12\" aria-hidden=\"true\">"
                    "<rect y=\"2\" width=\"{1:.1f}\" height=\"8\" style=\"fill:{2}\"/>",
                    length + 2, px(value), mark && value > *mark ? "var(--s0)" : "var(--ground)");
    if (mark)
        svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"0\" y2=\"12\" style=\"stroke:var(--bad)\" "
                           "stroke-width=\"1.6\"/>",
                           px(*mark) + 0.8);
    return Html::ready(svg + "</svg>");
}

} // namespace stylobate

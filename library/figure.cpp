#include "stylobate/figure.hpp"

#include "io/plots/figure.hpp"
#include "io/plots/plot_structure.hpp"
#include "library/inside.hpp"
#include "studies/kinds/surface/surface_kind.hpp"
#include "studies/report/html_figure.hpp"
#include "studies/report/html_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace stylobate::api {

namespace {

void replace_every(std::string& text, std::string_view what, std::string_view by)
{
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
}

/// The colours of paper by their names, "--ink": the first block of the style of a page.
std::vector<std::pair<std::string, std::string>> paper_colours()
{
    std::vector<std::pair<std::string, std::string>> colours;
    const std::string_view style = inner::page_style();
    const std::size_t end = style.find('}', style.find(":root"));
    for (std::size_t at = 0; (at = style.find("--", at)) < end;) {
        const std::size_t colon = style.find(':', at), stop = style.find(';', at);
        const std::size_t value = style.find_first_not_of(' ', colon + 1);
        colours.emplace_back(style.substr(at, colon - at), style.substr(value, stop - value));
        at = stop;
    }
    return colours;
}

/// What the style of a page gives to a drawing becomes a part of the drawing.
std::string on_paper(std::string drawing)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> looks = {
        {{"class=\"axis\"", "stroke=\"var(--axis)\""},
         {"class=\"grid\"", "stroke=\"var(--grid)\""},
         {"class=\"empty-cell\"", "fill=\"var(--line)\""},
         {"class=\"on-colour\"", "fill=\"#000\""},
         {"font-family=\"inherit\"",
          "font-family=\"sans-serif\" fill=\"var(--ink)\" style=\"background:#fff;max-width:100%;height:auto\""}}};
    for (const auto& [from, to] : looks)
        replace_every(drawing, from, to);
    for (const auto& [name, colour] : paper_colours())
        replace_every(drawing, "var(" + name + ")", colour);
    return drawing;
}

/// Without the first line of a document, to stand within another one.
std::string structure_of(const inner::Study& study)
{
    const std::string drawing =
        translated([&] { return inner::structure_sheet(study, study.title.value_or("")).svg(); });
    return drawing.substr(drawing.find("<svg"));
}

inner::SeriesKind inner_kind(SeriesKind kind)
{
    return kind == SeriesKind::line     ? inner::SeriesKind::line
           : kind == SeriesKind::points ? inner::SeriesKind::points
                                        : inner::SeriesKind::bars;
}

inner::FigureSeries inner_series(const FigureSeries& of)
{
    const auto fits = [&](const std::vector<double>& ends) { return ends.empty() || ends.size() == of.x.size(); };
    if (of.y.size() != of.x.size() || !fits(of.lower) || !fits(of.upper) || of.lower.size() != of.upper.size())
        throw InputError(fmt::format("the series \"{}\" of a figure has {} x, {} y, {} lower and {} upper: it needs as "
                                     "many of each; lower and upper may be empty",
                                     of.name, of.x.size(), of.y.size(), of.lower.size(), of.upper.size()));
    inner::FigureSeries series{of.name, inner_kind(of.kind), of.x, of.y, of.lower, of.upper};
    series.group = of.group.empty() ? std::nullopt : std::optional(of.group);
    return series;
}

} // namespace

std::string svg(const Figure& figure)
{
    inner::Figure drawn;
    drawn.title = figure.title;
    drawn.x_label = figure.x_label;
    drawn.y_label = figure.y_label;
    drawn.x_log = figure.x_log;
    drawn.y_log = figure.y_log;
    drawn.x_ticks = figure.x_ticks;
    for (const FigureSeries& series : figure.series)
        drawn.series.push_back(inner_series(series));
    return on_paper(inner::figure_drawing(drawn));
}

std::string svg(const Surface& surface)
{
    inner::SurfaceTable table;
    table.frequency_hz = surface.frequency_hz;
    table.direction_deg = surface.direction_deg;
    table.pga_m_s2 = surface.pga_m_s2;
    table.trials = surface.trials;
    table.collapses = surface.reached;
    table.probability = surface.probability;
    table.lower = surface.lower;
    table.upper = surface.upper;
    table.interval = surface.interval;
    return translated([&] {
        if (!inner::has_all_cells(table))
            throw inner::InputError("a surface with arrays that do not fit its axes");
        return on_paper(inner::map_svg(inner::surface_map(table, surface.limit_state)).markup);
    });
}

std::string svg(const Study& study)
{
    return structure_of(Inside::of(study).study);
}

std::string svg(const Check& check)
{
    return structure_of(Inside::of(check).report.study);
}

} // namespace stylobate::api

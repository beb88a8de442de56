#include "stylobate/figure.hpp"

#include "io/plots/plot_structure.hpp"
#include "io/plots/plot_surface.hpp"
#include "library/inside.hpp"

#include <fmt/format.h>

#include <utility>

namespace stylobate::api {

namespace {

/// As wide as the place where it stands, at most as large as it is.
constexpr char fits[] = "style=\"max-width:100%;height:auto\"";
constexpr inner::FigureLook paper{1, false};

std::string structure_of(const inner::Study& study)
{
    return translated([&] { return inner::structure_sheet(study, study.title.value_or("")).element(); });
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
    return inner::FigurePanel(drawn, paper).sheet(330).element(fits);
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
        const inner::PictureSize size{640, 496};
        inner::DrawingSheet sheet(size, paper.letters());
        inner::draw_surface(sheet, paper, table, surface.limit_state, {12, 10, 1.0 * size.width, size.height - 2.0});
        return sheet.element(fits);
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

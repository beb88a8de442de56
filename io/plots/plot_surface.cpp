#include "io/plots/plot_surface.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/colours.hpp"
#include "io/plots/contour.hpp"
#include "io/plots/figure_file.hpp"
#include "io/store/surface_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace stylobate {

namespace {

constexpr std::array<double, 3> contour_levels{0.05, 0.5, 0.95};
constexpr std::size_t most_slices = 6; ///< that can be told apart

/// The nodes of the contour grid along one axis: the cells' centres, and the frame, to which the outer cells reach.
std::vector<double> contour_nodes(const CellAxis& axis)
{
    std::vector<double> nodes{0.0};
    for (const double value : axis.values)
        nodes.push_back(axis.in_unit(value));
    nodes.push_back(1.0);
    return nodes;
}

/// The contour lines of one level in the unit square.
std::vector<ContourLine> contours(const SurfaceTable& surface, const CellAxis& f, const CellAxis& a, double level)
{
    const std::size_t nf = surface.rows().size();
    const std::size_t np = surface.pga_m_s2.size();
    std::vector<double> z;
    z.reserve((nf + 2) * (np + 2));
    for (std::size_t i = 0; i < nf + 2; ++i)
        for (std::size_t j = 0; j < np + 2; ++j)
            z.push_back(surface.probability[(std::clamp<std::size_t>(i, 1, nf) - 1) * np +
                                            std::clamp<std::size_t>(j, 1, np) - 1]);
    return contour_lines(contour_nodes(f), contour_nodes(a), z, level);
}

double length(const ContourLine& line)
{
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    return sum;
}

/// Distance of a label at `p` to the nearest point of other lines; a label is wider than high.
double clearance(const ContourPoint& p, const std::vector<ContourLine>& lines)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const ContourLine& line : lines)
        for (const ContourPoint& q : line)
            nearest = std::min(nearest, std::hypot(0.6 * (p.x - q.x), p.y - q.y));
    return nearest;
}

/// Where on its longest line a level is named: far from the lines of the other levels and from the frame.
ContourPoint label_place(const std::vector<ContourLine>& own, const std::vector<ContourLine>& others)
{
    const ContourLine& line = *std::max_element(
        own.begin(), own.end(), [](const ContourLine& a, const ContourLine& b) { return length(a) < length(b); });
    ContourPoint best = line[line.size() / 2];
    double best_score = -1;
    for (const ContourPoint& p : line) {
        const double frame = std::min({p.x, 1 - p.x, p.y, 1 - p.y});
        // Clear of other lines first; among places that are clear enough, the one nearest the middle of the frame.
        const double score = std::min(clearance(p, others), 0.12) + 0.1 * std::min(frame, 0.4) - (frame < 0.06 ? 1 : 0);
        if (score > best_score) {
            best_score = score;
            best = p;
        }
    }
    return best;
}

/// The contour lines of one probability, and where its name is best written, in the unit square of the frame (an axis
/// logarithmic where its values are spaced so).
struct SurfaceContour {
    double level = 0;
    std::vector<ContourLine> lines; ///< none: the surface does not reach it
    ContourPoint label;             ///< where there is a line
};

std::vector<SurfaceContour> contours_on(const SurfaceTable& surface, const CellAxis& f, const CellAxis& a)
{
    std::vector<SurfaceContour> all;
    for (const double level : contour_levels)
        all.push_back({level, contours(surface, f, a, level), {}});
    for (SurfaceContour& contour : all) {
        if (contour.lines.empty())
            continue;
        std::vector<ContourLine> others;
        for (const SurfaceContour& other : all)
            if (&other != &contour)
                others.insert(others.end(), other.lines.begin(), other.lines.end());
        contour.label = label_place(contour.lines, others);
    }
    return all;
}

/// The contour line 0.5 of one end of a range.
std::vector<ContourLine> range_contour(const SurfaceTable& surface, const std::vector<double>& probability,
                                       const CellAxis& f, const CellAxis& a)
{
    if (probability.size() != surface.probability.size())
        throw InputError("the band over contact laws has other cells than the surface: one of the two is not of this "
                         "study");
    SurfaceTable other = surface;
    other.probability = probability;
    return contours(other, f, a, 0.5);
}

std::string subtitle(const SurfaceTable& surface)
{
    double widest = 0;
    for (std::size_t cell = 0; cell < surface.lower.size(); ++cell)
        if (surface.trials[cell] > 0)
            widest = std::max(widest, (surface.upper[cell] - surface.lower[cell]) / 2);
    return describe_realizations(surface) +
           fmt::format(" · {}: ± {:.3f} at most", describe_interval(surface.interval), widest);
}

} // namespace

Figure cells_figure(const SurfaceAxes& axes, const std::function<std::string(std::size_t cell)>& colour)
{
    const CellAxis rows = make_cell_axis(axes.rows(), axes.row_quantity().key);
    const CellAxis pga = make_cell_axis(axes.pga_m_s2, "pga_m_s2");
    Figure figure;
    figure.x_label = axes.row_quantity().label;
    figure.y_label = "peak ground acceleration [m/s²]";
    figure.x_log = rows.log;
    figure.y_log = pga.log;
    figure.x_range = {rows.edges.front(), rows.edges.back()};
    figure.y_range = {pga.edges.front(), pga.edges.back()};
    for (std::size_t i = 0; i < rows.values.size(); ++i)
        for (std::size_t j = 0; j < pga.values.size(); ++j)
            figure.cells.push_back(
                {rows.edges[i], rows.edges[i + 1], pga.edges[j], pga.edges[j + 1], colour(i * pga.values.size() + j)});
    return figure;
}

PlotFrame draw_surface(DrawingSheet& sheet, const FigureLook& look, const SurfaceTable& surface,
                       const std::string& limit, const PlotFrame& room, const std::optional<SurfaceRange>& range)
{
    const CellAxis rows = make_cell_axis(surface.rows(), surface.row_quantity().key);
    const CellAxis pga = make_cell_axis(surface.pga_m_s2, "pga_m_s2");
    Figure figure = cells_figure(surface, [&](std::size_t cell) {
        const double p = surface.probability[cell];
        return std::isfinite(p) ? viridis_colour(p) : "";
    });
    if (look.page) // there is less room
        figure.y_label = "PGA [m/s²]";
    const double unit = look.unit;
    FigurePanel panel(figure, look);
    PlotFrame frame{room.left + panel.room_left(), room.top, room.right - (look.page ? 100 : 90) * unit, 0};
    frame.bottom = room.bottom - panel.room_below(frame.right - frame.left);
    panel.draw(sheet, frame);
    const auto on_sheet = [&](const ContourPoint& p) {
        return std::array<double, 2>{frame.left + p.x * (frame.right - frame.left),
                                     frame.bottom - p.y * (frame.bottom - frame.top)};
    };
    const auto draw = [&](const std::vector<ContourLine>& lines, const char* colour, double width,
                          const std::string& dashes = "") {
        for (const ContourLine& line : lines) {
            std::vector<std::array<double, 2>> points;
            for (const ContourPoint& p : line)
                points.push_back(on_sheet(p));
            sheet.path(points, colour, width * unit, dashes);
        }
    };
    sheet.open("class=\"contours\" pointer-events=\"none\"");
    const std::vector<SurfaceContour> all = contours_on(surface, rows, pga);
    for (const SurfaceContour& contour : all) {
        // A dark line under a white one is seen on every colour.
        draw(contour.lines, "#202020", 3);
        draw(contour.lines, "#ffffff", contour.level == 0.5 ? 1.8 : 1.3);
    }
    if (range)
        for (const std::vector<double>* end : {&range->low, &range->high})
            draw(range_contour(surface, *end, rows, pga), "#ff7f0e", 2.3, fmt::format("{} {}", 6 * unit, 4.5 * unit));
    for (const SurfaceContour& contour : all)
        if (!contour.lines.empty()) {
            const auto [x, y] = on_sheet(contour.label);
            sheet.boxed_text(fmt::format("{}", contour.level), x, y, look.letters());
        }
    sheet.close();
    PlotScale scale;
    scale.from = 0;
    scale.to = 1;
    const double strip = frame.right + 20 * unit;
    draw_colour_scale(sheet, look, {strip, frame.top, strip + 18 * unit, frame.bottom}, scale,
                      "probability of " + limit, viridis_colour);
    return frame;
}

void plot_surface(const SurfaceTable& surface, const std::string& limit, const std::string& title,
                  const std::filesystem::path& png, const std::optional<SurfaceRange>& range)
{
    const std::string below_title = subtitle(surface);
    const PictureSize size;
    const FigureLook look = picture_look;
    const double unit = look.unit;
    DrawingSheet sheet(size, look.letters());
    PlotFrame room{12 * unit, sheet.heading(title, below_title) + 10 * unit, static_cast<double>(size.width),
                   size.height - 16 * unit};
    if (range) {
        const std::string words = range->words + "; dashed: 0.5 of the lowest and the highest";
        sheet.text(words, size.width / 2.0, room.top - 6 * unit,
                   DrawingSheet::fitting(words, 0.9 * size.width, 12 * unit), TextAt::center, "#a34e00");
        room.top += 12 * unit;
    }
    draw_surface(sheet, look, surface, limit, room, range);
    if (std::any_of(surface.probability.begin(), surface.probability.end(), [](double p) { return !std::isfinite(p); }))
        sheet.text("grey: no valid realization", size.width - 12 * unit, size.height - 16 * unit, 12 * unit,
                   TextAt::right, "#505050");
    sheet.write(png);
}

std::vector<std::size_t> slice_rows(const SurfaceTable& surface, const std::vector<double>& wanted)
{
    const RowQuantity& of = surface.row_quantity();
    const CellAxis axis = make_cell_axis(surface.rows(), of.key);
    const std::size_t count = axis.values.size();
    if (wanted.size() > most_slices)
        throw InputError(fmt::format("{} {} are too many for one picture of slices.\n  Name 1 to {} of them.",
                                     wanted.size(), of.plural, most_slices));
    std::set<std::size_t> rows;
    if (wanted.empty())
        for (std::size_t k = 1; k <= 3; ++k)
            rows.insert((2 * k - 1) * count / 6);
    for (const double asked : wanted) {
        // a value may be typed with fewer digits than the axis has
        const double first = axis.values.front(), last = axis.values.back();
        if (!(asked >= first - 1e-6 * std::abs(first) && asked <= last + 1e-6 * std::abs(last)))
            throw InputError(fmt::format("{} {}: is beyond the {} of the surface.\n  Name one from {} to {}{}.",
                                         of.option, asked, of.plural, first, last, of.symbol));
        rows.insert(axis.nearest(asked));
    }
    return {rows.begin(), rows.end()};
}

void plot_slice(const SurfaceTable& surface, const std::vector<double>& wanted, const std::string& limit,
                const std::string& title, const std::filesystem::path& png)
{
    const std::string below_title =
        describe_realizations(surface) + " · bars and bands: " + describe_interval(surface.interval);
    const std::vector<std::size_t> rows = slice_rows(surface, wanted);
    const CellAxis pga = make_cell_axis(surface.pga_m_s2, "pga_m_s2");
    const std::size_t np = pga.values.size();
    Figure figure;
    figure.x_label = "peak ground acceleration [m/s²]";
    figure.y_label = "probability of " + limit;
    figure.x_log = pga.log;
    figure.x_range = {pga.edges.front(), pga.edges.back()};
    figure.y_range = {-0.015, 1.015};

    // Curves that coincide must all be seen: each is thinner than those drawn before it, and its points with their bars
    // stand a little beside those of the others.
    double apart = pga.scaled(pga.edges.back()) - pga.scaled(pga.edges.front());
    for (std::size_t j = 1; j < np; ++j)
        apart = std::min(apart, pga.scaled(pga.values[j]) - pga.scaled(pga.values[j - 1]));
    const double step = std::min(0.1 * apart, 0.007 * (pga.scaled(pga.edges.back()) - pga.scaled(pga.edges.front())));
    const double thicker = std::min(1.6, 6.0 / std::max(1.0, static_cast<double>(rows.size() - 1)));
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::string name = fmt::format("{:.3g}{}", surface.rows()[rows[k]], surface.row_quantity().symbol);
        FigureSeries curve, points;
        curve.group = points.group = name;
        points.name = name;
        points.kind = SeriesKind::points;
        curve.weight = 1 + 0.7 * thicker * static_cast<double>(rows.size() - 1 - k);
        const double place = static_cast<double>(k) - static_cast<double>(rows.size() - 1) / 2;
        for (std::size_t j = 0; j < np; ++j) {
            const std::size_t cell = rows[k] * np + j;
            curve.x.push_back(pga.values[j]);
            points.x.push_back(pga.unscaled(pga.scaled(pga.values[j]) + place * step));
            for (FigureSeries* s : {&curve, &points}) { // a cell without a trial is a gap
                s->y.push_back(surface.probability[cell]);
                s->low.push_back(surface.lower[cell]);
                s->high.push_back(surface.upper[cell]);
            }
        }
        figure.series.push_back(std::move(curve));
        figure.series.push_back(std::move(points));
    }
    write_figure(figure, title, below_title, png);
}

} // namespace stylobate

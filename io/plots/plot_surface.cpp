#include "io/plots/plot_surface.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/gnuplot.hpp"
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

/// Lines of the unit square as a data block of gnuplot.
std::string contour_block(const std::string& name, const std::vector<ContourLine>& lines, const CellAxis& f,
                          const CellAxis& a)
{
    std::string data = fmt::format("${} << EOD\n", name);
    for (const ContourLine& line : lines) {
        for (const ContourPoint& p : line)
            data += fmt::format("{} {}\n", f.from_unit(p.x), a.from_unit(p.y));
        data += '\n';
    }
    return data + "EOD\n";
}

struct ContourCommands {
    std::string data;
    std::string labels;
};

ContourCommands contour_commands(const SurfaceTable& surface, const CellAxis& f, const CellAxis& a)
{
    ContourCommands commands;
    const std::vector<SurfaceContour> all = contours_on(surface, f, a);
    for (std::size_t k = 0; k < all.size(); ++k) {
        commands.data += contour_block(fmt::format("contour{}", k), all[k].lines, f, a);
        if (!all[k].lines.empty())
            commands.labels +=
                fmt::format("set label '{}' at {},{} center front boxed font ',21' textcolor rgb '#000000'\n",
                            all[k].level, f.from_unit(all[k].label.x), a.from_unit(all[k].label.y));
    }
    return commands;
}

/// The contour lines 0.5 of the two surfaces of a range, as data blocks $low and $high where there are lines.
std::string range_commands(const SurfaceTable& surface, const SurfaceRange& range, const CellAxis& f, const CellAxis& a)
{
    std::string data;
    SurfaceTable other = surface;
    const auto add = [&](const char* name, const std::vector<double>& probability) {
        if (probability.size() != surface.probability.size())
            throw InputError("the band over contact laws has other cells than the surface: one of the two is not of "
                             "this study");
        other.probability = probability;
        if (const std::vector<ContourLine> lines = contours(other, f, a, 0.5); !lines.empty())
            data += contour_block(name, lines, f, a);
    };
    add("low", range.low);
    add("high", range.high);
    return data;
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

std::vector<SurfaceContour> surface_contours(const SurfaceTable& surface)
{
    const CellAxis rows = make_cell_axis(surface.rows(), surface.row_quantity().key);
    const CellAxis pga = make_cell_axis(surface.pga_m_s2, "pga_m_s2");
    return contours_on(surface, rows, pga);
}

void plot_surface(const SurfaceTable& surface, const std::string& limit, const std::string& title,
                  const std::filesystem::path& png, const std::optional<SurfaceRange>& range)
{
    const std::string below_title = subtitle(surface);
    const CellAxis rows = make_cell_axis(surface.rows(), surface.row_quantity().key);
    const CellAxis pga = make_cell_axis(surface.pga_m_s2, "pga_m_s2");
    const ContourCommands contour = contour_commands(surface, rows, pga);

    // Each cell reaches a pixel under its right and upper neighbours, drawn after it: no seams shine through.
    const double pixel = 1.0 / PictureSize{}.height;
    std::string cells = "$cells << EOD\n";
    std::size_t empty = 0;
    const std::size_t np = pga.values.size();
    for (std::size_t cell = 0; cell < surface.probability.size(); ++cell) {
        const std::size_t i = cell / np;
        const std::size_t j = cell % np;
        if (!std::isfinite(surface.probability[cell])) {
            ++empty;
            continue;
        }
        cells += fmt::format("{} {} {} {} {} {} {}\n", rows.values[i], pga.values[j], rows.edges[i],
                             rows.from_unit(rows.in_unit(rows.edges[i + 1]) + pixel), pga.edges[j],
                             pga.from_unit(pga.in_unit(pga.edges[j + 1]) + pixel), surface.probability[cell]);
    }
    cells += "EOD\n";

    const std::string range_data = range ? range_commands(surface, *range, rows, pga) : "";
    std::string script =
        cells + contour.data + range_data + viridis_palette() + gnuplot_heading(title, below_title) + contour.labels;
    script += "set lmargin at screen 0.095\nset rmargin at screen 0.855\n"
              "set bmargin at screen 0.115\nset tmargin at screen 0.865\n"
              "set style textbox opaque fillcolor rgb '#ffffff' noborder margins 0.8,0.6\n"
              "set border 31 linewidth 0.8\nset tics out nomirror\nunset key\n"
              "set xlabel " +
              gnuplot_text(surface.row_quantity().label) +
              " offset 0,-0.2\nset ylabel 'peak ground acceleration [m/s²]'\n"
              "set cbrange [0:1]\nset cbtics 0.1 format '%.1f'\nset cblabel " +
              gnuplot_text("probability of " + limit) +
              " offset 0.8,0\n"
              "set style fill solid 1.0 noborder\n" +
              gnuplot_axis('x', rows) + gnuplot_axis('y', pga);
    if (range)
        script += fmt::format("set label {} at screen 0.5, screen 0.883 center font ',18' textcolor rgb '#a34e00'\n",
                              gnuplot_text(range->words + "; dashed: 0.5 of the lowest and the highest"));
    if (empty > 0)
        script += fmt::format("set object rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#b8b8b8' "
                              "fillstyle solid 1 noborder\n"
                              "set label 'grey: no valid realization' at screen 0.985, screen 0.03 right font ',18' "
                              "textcolor rgb '#505050'\n");
    std::vector<std::string> layers;
    if (empty < surface.probability.size())
        layers.emplace_back("$cells using 1:2:3:4:5:6:7 with boxxyerror linecolor palette");
    // A dark line under a white one is seen on every colour.
    for (std::size_t k = 0; k < contour_levels.size(); ++k)
        if (contour.data.find(fmt::format("$contour{} << EOD\nEOD", k)) == std::string::npos) {
            layers.push_back(fmt::format("$contour{} with lines linewidth 3.4 linecolor rgb '#202020'", k));
            layers.push_back(fmt::format("$contour{} with lines linewidth {} linecolor rgb '#ffffff'", k,
                                         contour_levels[k] == 0.5 ? 2.0 : 1.4));
        }
    for (const char* end : {"low", "high"})
        if (range_data.find(fmt::format("${} << EOD\n", end)) != std::string::npos)
            layers.push_back(fmt::format("${} with lines linewidth 2.6 dashtype 2 linecolor rgb '#ff7f0e'", end));
    if (layers.empty())
        layers.emplace_back("1/0"); // the frame with nothing in it
    script += "plot ";
    for (std::size_t i = 0; i < layers.size(); ++i)
        script += (i == 0 ? "" : ", ") + layers[i];
    run_gnuplot(script, PictureSize{}, png);
}

namespace {

/// Okabe and Ito's colours, told apart by the colour-blind, and a point type each.
struct CurveStyle {
    const char* colour;
    int point;
};
constexpr std::array<CurveStyle, 6> styles{
    {{"#0072b2", 7}, {"#d55e00", 5}, {"#009e73", 9}, {"#cc79a7", 11}, {"#e69f00", 13}, {"#56b4e9", 15}}};

} // namespace

std::vector<std::size_t> slice_rows(const SurfaceTable& surface, const std::vector<double>& wanted)
{
    const RowQuantity& of = surface.row_quantity();
    const CellAxis axis = make_cell_axis(surface.rows(), of.key);
    const std::size_t count = axis.values.size();
    if (wanted.size() > styles.size())
        throw InputError(fmt::format("{} {} are too many for one picture of slices.\n  Name 1 to {} of them.",
                                     wanted.size(), of.plural, styles.size()));
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

    // Curves that coincide must all be seen: each is thinner than those drawn before it, and its points with their bars
    // stand a little beside those of the others.
    double apart = pga.scaled(pga.edges.back()) - pga.scaled(pga.edges.front());
    for (std::size_t j = 1; j < np; ++j)
        apart = std::min(apart, pga.scaled(pga.values[j]) - pga.scaled(pga.values[j - 1]));
    const double step = std::min(0.1 * apart, 0.007 * (pga.scaled(pga.edges.back()) - pga.scaled(pga.edges.front())));
    const auto beside = [&](double value, std::size_t k) {
        const double place = static_cast<double>(k) - static_cast<double>(rows.size() - 1) / 2;
        return pga.unscaled(pga.scaled(value) + place * step);
    };
    const double thicker = std::min(1.6, 6.0 / std::max(1.0, static_cast<double>(rows.size() - 1)));
    std::string data;
    std::string bands;
    std::string curves;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double wider = static_cast<double>(rows.size() - 1 - k);
        data += fmt::format("$slice{} << EOD\n", k);
        std::size_t points = 0;
        for (std::size_t j = 0; j < np; ++j) {
            const std::size_t cell = rows[k] * np + j;
            if (std::isfinite(surface.probability[cell])) {
                data += fmt::format("{} {} {} {} {}\n", pga.values[j], surface.probability[cell], surface.lower[cell],
                                    surface.upper[cell], beside(pga.values[j], k));
                ++points;
            } else {
                data += '\n'; // a gap in the curve
            }
        }
        data += "EOD\n";
        if (points == 0)
            continue;
        const CurveStyle& style = styles[k];
        bands += fmt::format("{}$slice{} using 1:3:4 with filledcurves fillcolor rgb '{}' fillstyle transparent solid "
                             "0.2 noborder notitle",
                             bands.empty() ? "" : ", ", k, style.colour);
        curves +=
            fmt::format(", $slice{0} using 1:2 with lines linecolor rgb '{1}' linewidth {4:.1f} notitle"
                        ", $slice{0} using 5:2:3:4 with yerrorbars linecolor rgb '{1}' linewidth 0.9 pointtype {2} "
                        "pointsize 1.3 title '{3:.3g}{5}'",
                        k, style.colour, style.point, surface.rows()[rows[k]], 1.4 + thicker * wider,
                        surface.row_quantity().symbol);
    }
    const std::string script =
        data + gnuplot_heading(title, below_title) + gnuplot_axis('x', pga) +
        "set lmargin at screen 0.1\nset rmargin at screen 0.97\nset bmargin at screen 0.115\nset tmargin at screen "
        "0.84\n"
        "set border 3 linewidth 0.8\nset tics out nomirror\nset grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n"
        "set key horizontal center bottom at screen 0.535, screen 0.85 samplen 2\n"
        "set xlabel 'peak ground acceleration [m/s²]' offset 0,-0.2\nset ylabel " +
        gnuplot_text("probability of " + limit) +
        "\n"
        "set yrange [-0.015:1.015]\nset ytics 0,0.1,1 format '%.1f'\n"
        "plot " +
        (bands.empty() ? std::string("1/0 notitle") : bands + curves);
    run_gnuplot(script, PictureSize{}, png);
}

} // namespace stylobate

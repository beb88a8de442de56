#include "studies/evidence/claims/claim_figure.hpp"

#include "io/plots/gnuplot.hpp"
#include "studies/evidence/claims/claim_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace stylobate::claims {

namespace {

/// Okabe and Ito's colours, told apart by the colour-blind, with a point type each; later rounds are dashed.
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr std::array points{7, 5, 9, 11, 13, 15, 4};
/// Confidence of the bars.
constexpr double bar_level = 0.95;

std::size_t axis_index(const ClaimFile& file, const std::string& name)
{
    return static_cast<std::size_t>(
        std::find_if(file.axes.begin(), file.axes.end(), [&](const VariantAxis& axis) { return axis.name == name; }) -
        file.axes.begin());
}

std::vector<std::size_t> inside(const std::vector<double>& values, const Window& window, double unit)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (window.holds(values[i] / unit))
            found.push_back(i);
    return found;
}

/// What tells the variants of a figure apart: the axes of which it shows more than one level, but not `x`.
std::string distinguishing(const ClaimFile& file, const Figure& figure, const std::vector<Sample>& samples,
                           const Levels& levels)
{
    std::string text;
    for (std::size_t i = 0; i < file.axes.size(); ++i) {
        std::set<std::size_t> seen;
        for (const Sample& sample : samples)
            if (sample.why_not.empty() && picked(file.axes, sample.levels, figure.only))
                seen.insert(sample.levels[i]);
        if (seen.size() > 1 && file.axes[i].name != figure.x)
            text += (text.empty() ? "" : ", ") + file.axes[i].label + ' ' + file.axes[i].levels[levels[i]].name;
    }
    return text;
}

bool shown(const Curve::Point& point)
{
    return point.y.known() && std::isfinite(point.y.value);
}

std::string joined(const std::string& a, const std::string& b)
{
    return a.empty() || b.empty() ? a + b : a + ", " + b;
}

/// What a picture shows at its extremes.
struct Extent {
    double left = 1e300, right = 0, lowest = 1e300, highest = 0;
};

/// One curve as data of gnuplot, its points beside those of the others where they would cover each other.
/// @param nudge of the points, in places from the middle   @return the points that can be shown
std::size_t add_data(const Figure& figure, const Curve& curve, bool along_axis, double nudge, std::size_t curves,
                     std::string& data, Extent& extent)
{
    std::size_t drawn = 0;
    for (const Curve::Point& point : curve.points) {
        if (!shown(point) || (figure.log_y && point.y.value <= 0)) {
            data += '\n';
            continue;
        }
        const double scale = unit_text(figure.measures.front()) == "mm" ? 1000 : 1;
        const double upper = std::isfinite(point.y.upper) ? point.y.upper : point.y.value;
        const double lower = figure.log_y && point.y.lower <= 0 ? point.y.value : point.y.lower;
        const double x = along_axis ? point.x + std::min(0.03, 0.3 / static_cast<double>(curves)) * nudge
                                    : point.x * std::pow(1.006, nudge);
        data += fmt::format("{} {} {} {}\n", x, scale * point.y.value, scale * lower, scale * upper);
        extent.highest = std::max(extent.highest, scale * upper);
        extent.lowest = std::min(extent.lowest, scale * lower);
        extent.left = std::min(extent.left, x);
        extent.right = std::max(extent.right, x);
        ++drawn;
    }
    return drawn;
}

/// The command that draws the k-th curve.
std::string plot_of(std::size_t k, const std::string& label)
{
    const std::size_t round = k / colours.size();
    return fmt::format("$curve{0} using 1:2 with lines linecolor rgb '{1}' linewidth 1.6 dashtype {2} notitle, "
                       "$curve{0} using 1:2:3:4 with yerrorbars linecolor rgb '{1}' linewidth 0.9 pointtype {3} "
                       "pointsize 1.2 title {4}",
                       k, colours[k % colours.size()], round + 1, points[(k + 2 * round) % points.size()],
                       gnuplot_text(label.empty() ? " " : label));
}

std::string x_axis_of(const ClaimFile& file, const Figure& figure, bool along_axis, const Extent& extent)
{
    if (!along_axis)
        return fmt::format("set logscale x 2\nset xtics format '%g'\nset xrange [{}:{}]\n", extent.left / 1.15,
                           std::max(extent.right, extent.left) * 1.15) +
               fmt::format("set xlabel '{}'\n",
                           figure.x == "frequency" ? "frequency [Hz]" : "peak ground acceleration [m/s²]");
    const VariantAxis& axis = file.axes[axis_index(file, figure.x)];
    std::string text = fmt::format("set xrange [-0.5:{}]\nset xtics (", static_cast<double>(axis.levels.size()) - 0.5);
    for (std::size_t i = 0; i < axis.levels.size(); ++i)
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_text(axis.levels[i].name), i);
    return text + fmt::format(")\nset xlabel {}\n", gnuplot_text(axis.label));
}

std::string y_axis_of(const Figure& figure, bool decades, const Extent& extent)
{
    if (std::all_of(figure.measures.begin(), figure.measures.end(),
                    [](const Measure& m) { return m.kind == Measure::Kind::probability; }))
        return "set yrange [-0.02:1.02]\nset ytics 0,0.2,1\n";
    if (!figure.log_y)
        return fmt::format("set yrange [0:{}]\n", extent.highest > 0 ? 1.05 * extent.highest : 1);
    return fmt::format("set logscale y {}\nset yrange [{}:{}]\n",
                       decades ? "10\nset ytics format '%g'" : "2\nset ytics format '%g'", extent.lowest / 1.2,
                       std::max(extent.highest, extent.lowest) * 1.2);
}

/// Margins, and the labels of the curves in as many columns as the longest leaves room for.
std::string layout_of(const Figure& figure, const std::vector<Curve>& curves, bool decades)
{
    std::size_t longest = figure.line_label.size();
    for (const Curve& curve : curves)
        longest = std::max(longest, curve.label.size());
    const std::size_t columns = std::clamp<std::size_t>(105 / (longest + 7), 1, 3);
    const std::size_t labels = curves.size() + (figure.line ? 1 : 0);
    const std::size_t lines = (labels + columns - 1) / columns;
    const auto rows = static_cast<double>(lines);
    return fmt::format(
        "set lmargin at screen {3}\nset rmargin at screen 0.97\nset bmargin at screen 0.115\n"
        "set tmargin at screen {0}\nset key horizontal center bottom at screen 0.535, screen {1} maxcols {2} "
        "samplen 2 font ',19'\n",
        0.87 - 0.024 * rows, 0.88 - 0.024 * rows, columns, decades ? 0.13 : 0.1);
}

} // namespace

std::vector<Curve> curves_of(const ClaimFile& file, const Figure& figure, const std::vector<Sample>& samples)
{
    std::vector<Curve> curves;
    const auto add = [&](const std::string& label, double x, const Estimate& y) {
        auto at = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.label == label; });
        if (at == curves.end())
            at = curves.insert(curves.end(), {label, {}});
        at->points.push_back({x, y});
    };
    const bool along_f = figure.x == "frequency", along_p = figure.x == "pga";
    const std::size_t axis = axis_index(file, figure.x);
    for (const Measure& measure : figure.measures)
        for (const Sample& sample : samples) {
            if (!sample.why_not.empty() || !picked(file.axes, sample.levels, figure.only))
                continue;
            const bool of_onset = measure.kind == Measure::Kind::onset;
            const std::string name = joined(distinguishing(file, figure, samples, sample.levels),
                                            figure.measures.size() < 2 ? "" : short_text(measure));
            const auto rows =
                inside(sample.frequency_hz, figure.frequency, figure.frequency.over_f1 ? sample.f1_hz : 1);
            auto columns = inside(sample.pga_m_s2, figure.pga, 1);
            if (of_onset)
                columns = {0};
            for (const std::size_t f : rows)
                for (const std::size_t p : columns) {
                    std::string label = name;
                    if (!along_f && rows.size() > 1)
                        label = joined(label, fmt::format("{:.3g} Hz", sample.frequency_hz[f]));
                    if (!along_p && columns.size() > 1)
                        label = joined(label, fmt::format("{:.3g} m/s²", sample.pga_m_s2[p]));
                    const double x = along_f   ? sample.frequency_hz[f]
                                     : along_p ? sample.pga_m_s2[p]
                                               : static_cast<double>(sample.levels[axis]);
                    add(label, x, estimate(sample, f, p, measure, bar_level));
                }
        }
    return curves;
}

void draw_figure(const ClaimFile& file, const Figure& figure, const std::vector<Curve>& curves,
                 const std::filesystem::path& png)
{
    const bool along_axis = figure.x != "frequency" && figure.x != "pga";
    std::string data, plots;
    Extent extent;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        data += fmt::format("$curve{} << EOD\n", k);
        const double nudge = static_cast<double>(k) - static_cast<double>(curves.size() - 1) / 2;
        const std::size_t drawn = add_data(figure, curves[k], along_axis, nudge, curves.size(), data, extent);
        data += "EOD\n";
        if (drawn > 0)
            plots += (plots.empty() ? "" : ", ") + plot_of(k, curves[k].label);
    }
    if (figure.line) {
        plots += fmt::format("{}{} with lines linecolor rgb '#808080' dashtype 2 linewidth 1 title {}",
                             plots.empty() ? "" : ", ", *figure.line, gnuplot_text(figure.line_label));
        extent.highest = std::max(extent.highest, *figure.line);
    }
    if (extent.right == 0)
        extent = {1, 1, 1, 1}; // nothing to draw: an empty picture with its axes
    const bool decades = figure.log_y && extent.highest > 100 * extent.lowest; // their labels take more room
    const std::string script =
        data + gnuplot_heading(figure.title, file.what) + x_axis_of(file, figure, along_axis, extent) +
        y_axis_of(figure, decades, extent) + layout_of(figure, curves, decades) +
        "set border 3 linewidth 0.8\nset tics out nomirror\n"
        "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n" +
        fmt::format("set ylabel {}\nplot {}\n", gnuplot_text(figure.y_label), plots.empty() ? "1/0 notitle" : plots);
    run_gnuplot(script, PictureSize{}, png);
}

} // namespace stylobate::claims

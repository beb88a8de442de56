#include "io/plots/plot_strip.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/spatial_poses.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/plots/plot_strip_in_space.hpp"
#include "io/plots/strip_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>

namespace stylobate {
namespace {

/// The title of a vertical axis, at the same place beside each plot however long its tics' labels are.
std::string axis_title(const char* what, const Unit& unit, double bottom, double top)
{
    return fmt::format("set label '{} [{}]' at screen 0.017, screen {} center rotate by 90\n", what, unit.name,
                       (bottom + top) / 2);
}

/// Samples up to the first that is not finite.
/// @throws InputError as `plot_strip`
std::size_t finite_samples(const Trajectory& t)
{
    check_trajectory(t, {});
    const std::size_t blocks = t.blocks();
    const std::size_t samples = t.time_s.size();
    std::size_t good = 0;
    const auto finite = [&](std::size_t s) {
        bool all = std::isfinite(t.time_s[s]) && std::isfinite(t["base_x_m"][s]);
        for (std::size_t i = 0; i < blocks; ++i)
            all = all && rectangle_of(t, s, i).is_finite();
        return all;
    };
    while (good < samples && finite(good))
        ++good;
    check_some_sample(t, good);
    for (std::size_t i = 0; i < blocks; ++i)
        if (const Rectangle at = rectangle_of(t, 0, i);
            !(at.half_width > 0 && at.half_height > 0) || !std::isfinite(at.half_width * at.half_height))
            throw InputError(fmt::format("block {} of realization {} is {} m by {} m: the trajectory is damaged.\n"
                                         "  Replay the realization into a new file.",
                                         i, t.index, 2 * at.half_width, 2 * at.half_height));
    return good;
}

/// The blocks that are drawn: all but the ground.
struct Drawn {
    std::vector<std::size_t> blocks; ///< indices
    std::vector<bool> fixed;         ///< for each of them: it moves with the base
    std::size_t top = 0;             ///< the last one that moves: the one whose displacement an outcome has
    std::size_t epistyles = 0;
    std::size_t capitals = 0;
};

Drawn find_blocks(const Trajectory& t, std::size_t samples)
{
    const std::size_t blocks = t.blocks();
    Drawn drawn;
    for (std::size_t i = 0; i < blocks; ++i) {
        const Rectangle start = rectangle_of(t, 0, i);
        if (t.role[i] == BlockRole::ground || start.y + start.half_height <= 1e-6 * start.half_height)
            continue;
        bool moves = false;
        for (std::size_t s = 1; s < samples && !moves; ++s)
            moves = rectangle_of(t, s, i) != start;
        drawn.blocks.push_back(i);
        drawn.fixed.push_back(!moves);
        drawn.epistyles += t.role[i] == BlockRole::epistyle;
        drawn.capitals += t.name[i].starts_with("capital");
        if (moves)
            drawn.top = i;
    }
    if (drawn.blocks.empty())
        throw InputError(fmt::format("the trajectory of realization {} has no block above its base (y = 0).\n"
                                     "  Heights are measured from the top of the base, in metres.",
                                     t.index));
    // Where nothing moves, fixed blocks cannot be distinguished from free ones.
    if (std::all_of(drawn.fixed.begin(), drawn.fixed.end(), [](bool f) { return f; })) {
        drawn.fixed.assign(drawn.fixed.size(), false);
        drawn.top = drawn.blocks.back();
    }
    return drawn;
}

/// How far the blocks are from where they started, in all.
double departure(const Trajectory& t, std::size_t sample, std::size_t from)
{
    double sum = 0;
    for (std::size_t i = 0; i < t.blocks(); ++i) {
        const Rectangle a = rectangle_of(t, sample, i), b = rectangle_of(t, from, i);
        sum += std::hypot(a.x - b.x, a.y - b.y) + std::abs(a.turned_rad - b.turned_rad) * a.half_height;
    }
    return sum;
}

/// Of the picture, in parts of its width.
constexpr double left_edge = 0.1;
constexpr double right_edge = 0.985;
/// Heights in pixels.
constexpr double heading_pixels = 182;
constexpr double one_row_pixels = 526;   ///< of the strip if its snapshots stand in one row
constexpr double most_rows_pixels = 960; ///< of several rows
constexpr double label_pixels = 52;      ///< below a row, for the times
constexpr double panel_pixels = 189;
constexpr double panel_gap_pixels = 54;
constexpr double footing_pixels = 128; ///< below the last panel

/// What one snapshot needs [m].
struct Extent {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    double low = 0;
    double high = 0;
};

/// Where the snapshots are, on one scale; lengths in metres of the structure, (0, 0) at the strip's lower left.
struct StripLayout {
    struct Cell {
        double left = 0;    ///< of the base beneath it
        double right = 0;   ///< of the base
        double shift_x = 0; ///< from the trajectory's coordinates
        double ground = 0;  ///< height of the base's top
    };
    std::vector<Cell> cells;        ///< by snapshot
    std::vector<std::size_t> row;   ///< by snapshot, from the top
    std::vector<double> row_ground; ///< by row
    std::vector<double> row_height; ///< by row, above its ground
    double pixels_per_m = 0;
    double slab = 0; ///< thickness of the base
    double width = 0;
    double pixels = 0; ///< height of the strip
};

/// Puts the snapshots into a number of rows, as large as they fit.
StripLayout layout_in_rows(const std::vector<Extent>& extents, double overhang, double pixels_x, std::size_t rows)
{
    const std::size_t count = extents.size();
    const std::size_t in_row = (count + rows - 1) / rows;
    rows = (count + in_row - 1) / in_row; // none is left empty
    const double least_gap = 0.5 * overhang;
    StripLayout layout;
    std::vector<double> needed(rows);
    std::vector<double> members(rows);
    std::vector<double> low(rows);
    layout.row_height.resize(rows);
    double tallest = 0;
    double widest = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t r = n / in_row;
        layout.row.push_back(r);
        needed[r] += extents[n].right - extents[n].left + 2 * overhang;
        members[r] += 1;
        low[r] = std::min(low[r], extents[n].low);
        layout.row_height[r] = std::max(layout.row_height[r], extents[n].high);
        tallest = std::max(tallest, layout.row_height[r] - low[r]);
        widest = std::max(widest, needed[r] + least_gap * members[r]);
    }
    layout.slab = 0.035 * tallest;
    const double headroom = 0.03 * tallest;
    double height = 0;
    for (std::size_t r = 0; r < rows; ++r)
        height += layout.row_height[r] - low[r] + layout.slab + headroom;
    const double pixels_y = rows == 1 ? one_row_pixels : most_rows_pixels;
    const double labels = label_pixels * static_cast<double>(rows - 1);
    layout.pixels_per_m = std::min(pixels_x / widest, (pixels_y - labels) / height);
    layout.pixels = rows == 1 ? one_row_pixels : std::max(one_row_pixels, height * layout.pixels_per_m + labels);
    layout.width = pixels_x / layout.pixels_per_m;

    // From the bottom row up; what is left of the width goes between the snapshots.
    layout.row_ground.resize(rows);
    double bottom = 0;
    for (std::size_t r = rows; r-- > 0;) {
        layout.row_ground[r] = bottom + layout.slab - low[r];
        bottom = layout.row_ground[r] + layout.row_height[r] + headroom + label_pixels / layout.pixels_per_m;
    }
    double cursor = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t r = layout.row[n];
        const double gap = (layout.width - needed[r]) / members[r];
        if (n == 0 || layout.row[n - 1] != r)
            cursor = gap / 2;
        const double wide = extents[n].right - extents[n].left + 2 * overhang;
        layout.cells.push_back({cursor, cursor + wide, cursor + overhang - extents[n].left, layout.row_ground[r]});
        cursor += wide + gap;
    }
    return layout;
}

StripLayout make_layout(const Trajectory& t, const Drawn& drawn, const std::vector<std::size_t>& chosen,
                        double pixels_x)
{
    std::vector<Extent> extents(chosen.size());
    double widest = 0;
    double tallest = 0;
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        for (const std::size_t block : drawn.blocks) {
            const Rectangle at = rectangle_of(t, chosen[n], block);
            widest = std::max(widest, 2 * at.half_width);
            for (const Rectangle::Corner& c : at.corners()) {
                extents[n].left = std::min(extents[n].left, c.x);
                extents[n].right = std::max(extents[n].right, c.x);
                extents[n].low = std::min(extents[n].low, c.y);
                extents[n].high = std::max(extents[n].high, c.y);
            }
        }
        tallest = std::max(tallest, extents[n].high - extents[n].low);
    }
    const double overhang = std::clamp(0.15 * widest, 0.02 * tallest, 0.1 * tallest);
    // A column's snapshots stand in one row; those of what is wide would be tiny there.
    StripLayout best = layout_in_rows(extents, overhang, pixels_x, 1);
    for (std::size_t rows = 2; rows <= chosen.size(); ++rows) {
        StripLayout other = layout_in_rows(extents, overhang, pixels_x, rows);
        if (other.pixels_per_m > (best.row_height.size() == 1 ? 1.4 : 1.05) * best.pixels_per_m)
            best = std::move(other);
    }
    return best;
}

/// The vertical places of the picture's parts, in parts of its height.
struct Page {
    PictureSize size;
    double at(double pixels_from_top) const { return 1 - pixels_from_top / size.height; }
};

/// Polygons of one look, for gnuplot.
struct Shapes {
    const char* name;
    const char* fill; ///< nullptr: the outline alone
    const char* line;
    std::string data;

    void add(const std::array<Rectangle::Corner, 4>& c, double dx, double dy, double per_metre)
    {
        for (std::size_t i = 0; i <= 4; ++i)
            fmt::format_to(std::back_inserter(data), "{} {}\n", (c[i % 4].x + dx) * per_metre,
                           (c[i % 4].y + dy) * per_metre);
        data += '\n';
    }
};

/// Script of the strip: the snapshots side by side, one scale for both axes.
std::string strip_script(const Trajectory& t, const Drawn& drawn, const std::vector<double>& fall_time_s,
                         const std::vector<std::size_t>& chosen, const StripLayout& layout, const Page& page)
{
    const double tallest = *std::max_element(layout.row_height.begin(), layout.row_height.end());
    const Unit unit = unit_for(tallest);
    Shapes base{"$base", "#6f6f6f", "#6f6f6f", ""};
    Shapes fixed{"$fixed", "#a89a7d", "#4a3b24", ""};
    Shapes drums{"$drums", "#ead9b5", "#4a3b24", ""};
    Shapes epistyles{"$epistyles", "#b9cddb", "#27475c", ""};
    Shapes fallen{"$fallen", nullptr, "#c0271b", ""};

    const double top = heading_pixels;
    const double bottom = heading_pixels + layout.pixels;
    const double span = t.time_s[chosen.back()] - t.time_s[chosen.front()];
    const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(std::max(span, 1e-9)))), 0, 6);
    double narrowest = layout.width;
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        const bool ends_row = n + 1 == chosen.size() || layout.row[n + 1] != layout.row[n];
        const double next = ends_row ? layout.width : layout.cells[n + 1].left;
        narrowest = std::min(narrowest, next - layout.cells[n].left);
    }
    const double label_font = std::min(21.0, 1.4 * narrowest * layout.pixels_per_m / (decimals + 5));
    std::string labels;
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        const StripLayout::Cell& cell = layout.cells[n];
        const double time = t.time_s[chosen[n]];
        for (std::size_t d = 0; d < drawn.blocks.size(); ++d) {
            const std::size_t block = drawn.blocks[d];
            const std::array c = rectangle_of(t, chosen[n], block).corners();
            Shapes& kind = drawn.fixed[d] ? fixed : t.role[block] == BlockRole::epistyle ? epistyles : drums;
            kind.add(c, cell.shift_x, cell.ground, unit.per_metre);
            if (has_fallen(fall_time_s, block, time))
                fallen.add(c, cell.shift_x, cell.ground, unit.per_metre);
        }
        base.add({{{cell.left, -layout.slab}, {cell.right, -layout.slab}, {cell.right, 0}, {cell.left, 0}}}, 0,
                 cell.ground, unit.per_metre);
        const double row_bottom = *std::max_element(layout.row.begin(), layout.row.end()) == layout.row[n]
                                      ? 0
                                      : layout.row_ground[layout.row[n] + 1] + layout.row_height[layout.row[n] + 1] +
                                            0.03 * tallest + label_pixels / layout.pixels_per_m;
        labels += fmt::format("set label '{:.{}f} s' at screen {}, screen {} center font ',{:.1f}'\n", time, decimals,
                              left_edge + (right_edge - left_edge) * (cell.left + cell.right) / 2 / layout.width,
                              page.at(bottom - row_bottom * layout.pixels_per_m + 30), label_font);
    }
    const double step = round_step(tallest / 2.2);
    std::string tics;
    for (std::size_t r = 0; r < layout.row_ground.size(); ++r)
        for (int k = 0; k * step <= layout.row_height[r] * (1 + 1e-9); ++k)
            tics += fmt::format("{}'{:g}' {}", tics.empty() ? "" : ", ", k * step * unit.per_metre,
                                (layout.row_ground[r] + k * step) * unit.per_metre);

    std::string script;
    std::string fills;
    std::string lines;
    for (const Shapes* shapes : {&base, &fixed, &drums, &epistyles, &fallen}) {
        if (shapes->data.empty())
            continue;
        script += fmt::format("{} << EOD\n{}EOD\n", shapes->name, shapes->data);
        if (shapes->fill)
            fills += fmt::format("{}{} with filledcurves closed fillcolor rgb '{}' fillstyle solid 1 noborder",
                                 fills.empty() ? "" : ", ", shapes->name, shapes->fill);
        lines += fmt::format(", {} with lines linecolor rgb '{}' linewidth {}", shapes->name, shapes->line,
                             shapes->fill ? 0.7 : 1.0);
    }
    script += labels;
    script += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\n"
                          "set tmargin at screen {}\nset xrange [0:{}]\nset yrange [0:{}]\n",
                          left_edge, right_edge, page.at(bottom), page.at(top), layout.width * unit.per_metre,
                          layout.pixels / layout.pixels_per_m * unit.per_metre);
    script += fmt::format("set border 2 linewidth 0.8\nset ytics out nomirror ({})\nunset xtics\n", tics);
    script += axis_title("height", unit, page.at(bottom), page.at(top));
    return script + "plot " + fills + lines + '\n';
}

/// A panel over time, below the strip.
struct Panel {
    double top = 0; ///< pixels from the picture's top
    bool has_time_axis = false;
};

/// Its frame and its time axis; the plot itself follows.
std::string panel_frame(const Panel& panel, const Page& page, double first_s, double last_s)
{
    std::string script = fmt::format("unset label\nset lmargin at screen {}\nset rmargin at screen {}\n"
                                     "set bmargin at screen {}\nset tmargin at screen {}\n",
                                     left_edge, right_edge, page.at(panel.top + panel_pixels), page.at(panel.top));
    script += fmt::format("set xrange [{}:{}]\nset border 3 linewidth 0.8\nset xtics out nomirror {}\n"
                          "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n",
                          first_s, last_s > first_s ? last_s : first_s + 1,
                          panel.has_time_axis ? "format '%g'" : "format ''");
    if (panel.has_time_axis)
        script += "set xlabel 'time [s]' offset 0,0.3\n";
    return script;
}

/// A panel of one displacement.
std::string displacement_script(const char* name, const char* label, const char* colour, const Panel& panel,
                                const Page& page, const Trajectory& t, const std::vector<std::size_t>& chosen,
                                const std::vector<double>& displacement_m)
{
    const auto [least_m, most_m] = std::minmax_element(displacement_m.begin(), displacement_m.end());
    const Unit unit = unit_for(std::max(std::abs(*least_m), std::abs(*most_m)));
    const double least = *least_m * unit.per_metre;
    const double most = *most_m * unit.per_metre;
    const double span = most > least ? most - least : std::max(1.0, std::abs(most));
    std::string script = fmt::format("{} << EOD\n", name);
    for (std::size_t s = 0; s < displacement_m.size(); ++s)
        fmt::format_to(std::back_inserter(script), "{} {}\n", t.time_s[s], displacement_m[s] * unit.per_metre);
    script += fmt::format("EOD\n{}marks << EOD\n", name);
    for (const std::size_t s : chosen)
        script += fmt::format("{} {}\n", t.time_s[s], displacement_m[s] * unit.per_metre);
    script += "EOD\n" + panel_frame(panel, page, t.time_s.front(), t.time_s[displacement_m.size() - 1]);
    script += fmt::format("set yrange [{}:{}]\nset ytics out nomirror {}\n", least - 0.06 * span, most + 0.06 * span,
                          round_step(span / 2.4));
    script += axis_title(label, unit, page.at(panel.top + panel_pixels), page.at(panel.top));
    script += fmt::format("plot {0} with lines linecolor rgb '{1}' linewidth 1, {0}marks with points pointtype 7 "
                          "pointsize 1.2 linecolor rgb '{1}'\n",
                          name, colour);
    return script;
}

/// The falls within the drawn time, in their order.
std::vector<std::size_t> falls_in_order(const Drawn& drawn, const std::vector<double>& fall_time_s, double last_s)
{
    std::vector<std::size_t> falls;
    for (const std::size_t block : drawn.blocks)
        if (has_fallen(fall_time_s, block, last_s))
            falls.push_back(block);
    std::stable_sort(falls.begin(), falls.end(),
                     [&](std::size_t a, std::size_t b) { return fall_time_s[a] < fall_time_s[b]; });
    return falls;
}

/// The panel of the falls: how many blocks have fallen, with a point for each.
std::string falls_script(const Panel& panel, const Page& page, const Trajectory& t,
                         const std::vector<std::size_t>& falls, const std::vector<double>& fall_time_s, double last_s)
{
    std::string steps = fmt::format("$count << EOD\n{} 0\n", t.time_s.front());
    std::string points;
    for (std::size_t k = 0; k < falls.size(); ++k) {
        steps += fmt::format("{} {}\n", fall_time_s[falls[k]], k + 1);
        points += fmt::format("{} {}\n", fall_time_s[falls[k]], k + 1);
    }
    const auto count = static_cast<double>(falls.size());
    std::string script = steps + fmt::format("{} {}\nEOD\n$each << EOD\n", last_s, falls.size()) + points + "EOD\n" +
                         panel_frame(panel, page, t.time_s.front(), last_s);
    script += fmt::format("set yrange [0:{}]\nset ytics out nomirror {}\n", 1.1 * count,
                          std::max(1.0, round_step(count / 2.4)));
    script += fmt::format("set label 'fallen' at screen 0.017, screen {} center rotate by 90\n",
                          page.at(panel.top + panel_pixels / 2));
    // Left of the first fall there is room, unless it comes early: then below the curve on the right.
    const double first = fall_time_s[falls.front()];
    const bool late = first - t.time_s.front() > 0.5 * (last_s - t.time_s.front());
    script +=
        fmt::format("set label {} at first {}, graph {} right font ',19' textcolor rgb '#c0271b' front offset -1,0\n",
                    gnuplot_text(falls.size() > 1 && fall_time_s[falls[1]] == first
                                     ? fmt::format("first: several together, {:.2f} s", first)
                                     : fmt::format("first: {}, {:.2f} s", t.name[falls.front()], first)),
                    late ? first : last_s, late ? 0.72 : 0.2);
    script += "plot $count with steps linecolor rgb '#c0271b' linewidth 1, $each with points pointtype 7 pointsize 1.0 "
              "linecolor rgb '#c0271b'\n";
    return script;
}

std::string subtitle(const Trajectory& t, const Drawn& drawn, std::size_t samples, bool falls)
{
    const auto fixed = std::count(drawn.fixed.begin(), drawn.fixed.end(), true);
    std::string text = counted(drawn.blocks.size() - drawn.epistyles - drawn.capitals, "drum");
    if (drawn.capitals > 0)
        text += (drawn.epistyles > 0 ? ", " : " and ") + counted(drawn.capitals, "capital");
    if (drawn.epistyles > 0)
        text += " and " + counted(drawn.epistyles, "epistyle");
    if (fixed > 0)
        text += fmt::format(", {} fixed (darker)", fixed);
    text += " · drawn to scale in the frame of the base";
    text += drawn.blocks.size() > 1 ? " · top: centre of " + t.name[drawn.top] + ", from upright"
                                    : " · top: the drum's centre, from upright";
    if (falls)
        text += " · red outlines: fallen";
    if (samples < t.time_s.size())
        text += fmt::format(" · not finite after {:.4g} s", t.time_s[samples - 1]);
    return text;
}

} // namespace

std::vector<std::size_t> snapshot_samples(const Trajectory& trajectory, std::size_t snapshots)
{
    if (is_spatial(trajectory))
        return snapshot_samples_in_space(trajectory, snapshots);
    return choose_samples(finite_samples(trajectory), snapshots,
                          [&](std::size_t sample, std::size_t from) { return departure(trajectory, sample, from); });
}

void plot_strip(const Trajectory& trajectory, const std::vector<double>& fall_time_s, const std::string& title,
                const std::filesystem::path& png, std::size_t snapshots)
{
    check_trajectory(trajectory, fall_time_s);
    if (is_spatial(trajectory))
        return plot_strip_in_space(trajectory, fall_time_s, title, png, snapshots);
    const std::size_t samples = finite_samples(trajectory);
    const std::size_t blocks = trajectory.blocks();
    const std::vector<std::size_t> chosen = snapshot_samples(trajectory, snapshots);
    const Drawn drawn = find_blocks(trajectory, samples);
    const double last_s = trajectory.time_s[samples - 1];
    const std::vector<std::size_t> falls = falls_in_order(drawn, fall_time_s, last_s);

    Page page;
    const StripLayout layout =
        make_layout(trajectory, drawn, chosen, (right_edge - left_edge) * static_cast<double>(page.size.width));
    const double first_panel = heading_pixels + layout.pixels + label_pixels + 30;
    const double panels = falls.empty() ? 2 : 3;
    page.size.height = static_cast<int>(
        std::lround(first_panel + panels * panel_pixels + (panels - 1) * panel_gap_pixels + footing_pixels));

    std::vector<double> top_m(samples);
    for (std::size_t s = 0; s < samples; ++s)
        top_m[s] = trajectory["x_m"][s * blocks + drawn.top] - trajectory["rest_x_m"][drawn.top];
    std::vector<double> base_m = trajectory["base_x_m"];
    base_m.resize(samples);

    std::string script = "set multiplot\nunset key\n" +
                         gnuplot_heading(title, subtitle(trajectory, drawn, samples, !falls.empty()), page.size) +
                         strip_script(trajectory, drawn, fall_time_s, chosen, layout, page);
    Panel panel{first_panel, false};
    const double stride = panel_pixels + panel_gap_pixels;
    if (!falls.empty()) {
        script += falls_script(panel, page, trajectory, falls, fall_time_s, last_s);
        panel.top += stride;
    }
    script += displacement_script("$top", "top", "#0072b2", panel, page, trajectory, chosen, top_m);
    panel = {panel.top + stride, true};
    script += displacement_script("$ground", "base", "#d55e00", panel, page, trajectory, chosen, base_m);
    script += "unset multiplot\n";
    run_gnuplot(script, page.size, png);
}

} // namespace stylobate

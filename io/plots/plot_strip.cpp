#include "io/plots/plot_strip.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/spatial_poses.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/figure_panel.hpp"
#include "io/plots/plot_strip_in_space.hpp"
#include "io/plots/strip_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace stylobate {
namespace {

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

/// Edges of the plots, and heights of their parts, in pixels.
constexpr double picture_pixels = 1800;
constexpr double left_edge = 180;
constexpr double right_edge = 1773;
constexpr double axis_title = 31; ///< middle of the titles of vertical axes
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

/// How a block is drawn.
struct BlockLook {
    const char* fill;
    const char* line;
};
constexpr BlockLook fixed_look{"#a89a7d", "#4a3b24"}, drum_look{"#ead9b5", "#4a3b24"},
    epistyle_look{"#b9cddb", "#27475c"};
constexpr char fallen_colour[] = "#c0271b";

/// A vertical axis beside the strip or a panel, with round values.
/// @param tics places [px] and what they say
void draw_height_axis(DrawingSheet& sheet, double top, double bottom, const std::string& title,
                      const std::vector<std::pair<double, std::string>>& tics)
{
    sheet.line(left_edge, top, left_edge, bottom, "#303030", 1.6);
    for (const auto& [y, words] : tics) {
        sheet.line(left_edge - 8, y, left_edge, y, "#303030", 1.6);
        sheet.text(words, left_edge - 14, y, 24, TextAt::right);
    }
    sheet.text(title, axis_title, (top + bottom) / 2, DrawingSheet::fitting(title, bottom - top + 40, 26),
               TextAt::center, "#000000", true);
}

/// @param place of a point in the frame of the base [m]: where it is drawn [px]
template <class Place>
void draw_fastening(DrawingSheet& sheet, const Trajectory& t, std::size_t sample, const Fastening& fastening,
                    const Place& place)
{
    std::vector<Rectangle> blocks;
    for (std::size_t b = 0; b < t.blocks(); ++b)
        blocks.push_back(rectangle_of(t, sample, b));
    const auto line =
        line_of(fastening, blocks, rectangle_of(t, 0, *fastening.at.block), t.time_s[sample], t["base_x_m"][sample]);
    if (!line)
        return;
    const auto [x1, y1] = place(line->from);
    const auto [x2, y2] = place(line->to);
    sheet.line(x1, y1, x2, y2, "#1d2730", 4);
}

/// The snapshots side by side, one scale for both axes.
void draw_strip(DrawingSheet& sheet, const Trajectory& t, const Drawn& drawn, const std::vector<double>& fall_time_s,
                const std::vector<std::size_t>& chosen, const StripLayout& layout,
                const std::vector<Fastening>& fastenings)
{
    const double tallest = *std::max_element(layout.row_height.begin(), layout.row_height.end());
    const Unit unit = unit_for(tallest);
    const double bottom = heading_pixels + layout.pixels, scale = layout.pixels_per_m;
    const auto x = [&](double metres) { return left_edge + metres * scale; };
    const auto y = [&](double metres) { return bottom - metres * scale; };
    const double span = t.time_s[chosen.back()] - t.time_s[chosen.front()];
    const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(std::max(span, 1e-9)))), 0, 6);
    double narrowest = layout.width;
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        const bool ends_row = n + 1 == chosen.size() || layout.row[n + 1] != layout.row[n];
        const double next = ends_row ? layout.width : layout.cells[n + 1].left;
        narrowest = std::min(narrowest, next - layout.cells[n].left);
    }
    const std::string widest = fmt::format("{:.{}f} s", t.time_s[chosen.back()], decimals);
    const double label_font = DrawingSheet::fitting(widest, 0.92 * narrowest * scale, 28);
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        const StripLayout::Cell& cell = layout.cells[n];
        const double time = t.time_s[chosen[n]];
        sheet.rectangle(x(cell.left), y(cell.ground), x(cell.right), y(cell.ground - layout.slab), "#6f6f6f");
        const auto draw = [&](std::size_t d, bool outline) {
            const std::size_t block = drawn.blocks[d];
            std::vector<std::array<double, 2>> corners;
            for (const Rectangle::Corner& c : rectangle_of(t, chosen[n], block).corners())
                corners.push_back({x(c.x + cell.shift_x), y(c.y + cell.ground)});
            const BlockLook& look = drawn.fixed[d]                         ? fixed_look
                                    : t.role[block] == BlockRole::epistyle ? epistyle_look
                                                                           : drum_look;
            if (!outline)
                sheet.polygon(corners, look.fill, look.line, 1.4);
            else if (has_fallen(fall_time_s, block, time))
                sheet.polygon(corners, "", fallen_colour, 2);
        };
        for (const bool outline : {false, true}) // red lines above all others
            for (std::size_t d = 0; d < drawn.blocks.size(); ++d)
                draw(d, outline);
        for (const Fastening& one : fastenings)
            draw_fastening(sheet, t, chosen[n], one, [&](const Rectangle::Corner& at) {
                const double along = std::clamp(at.x + cell.shift_x, cell.left, cell.right);
                return std::array{x(along), y(at.y + cell.ground)};
            });
        const bool lowest = *std::max_element(layout.row.begin(), layout.row.end()) == layout.row[n];
        const double row_bottom = lowest ? 0
                                         : layout.row_ground[layout.row[n] + 1] + layout.row_height[layout.row[n] + 1] +
                                               0.03 * tallest + label_pixels / scale;
        sheet.text(fmt::format("{:.{}f} s", time, decimals), x((cell.left + cell.right) / 2), y(row_bottom) + 30,
                   label_font);
    }
    const double step = round_step(tallest / 2.2);
    std::vector<std::pair<double, std::string>> tics;
    for (std::size_t r = 0; r < layout.row_ground.size(); ++r)
        for (int k = 0; k * step <= layout.row_height[r] * (1 + 1e-9); ++k)
            tics.emplace_back(y(layout.row_ground[r] + k * step), fmt::format("{:g}", k * step * unit.per_metre));
    draw_height_axis(sheet, heading_pixels, bottom, fmt::format("height [{}]", unit.name), tics);
}

/// A panel over time, below the strip. @param top of it [px]
void draw_panel(DrawingSheet& sheet, const Figure& figure, const std::string& title, double top, bool has_time_axis)
{
    Figure shown = figure;
    shown.y_label.clear();
    shown.x_label = "time [s]";
    FigurePanel panel(shown, picture_look);
    panel.draw(sheet, {left_edge, top, right_edge, top + panel_pixels}, has_time_axis);
    sheet.text(title, axis_title, top + panel_pixels / 2, DrawingSheet::fitting(title, panel_pixels + 40, 26),
               TextAt::center, "#000000", true);
}

/// A figure over the drawn time.
Figure over_time(double first_s, double last_s)
{
    Figure figure;
    figure.x_range = {first_s, last_s > first_s ? last_s : first_s + 1};
    return figure;
}

/// A panel of one displacement, with marks at the snapshots.
void draw_displacement(DrawingSheet& sheet, const char* what, const char* colour, double top, bool has_time_axis,
                       const Trajectory& t, const std::vector<std::size_t>& chosen,
                       const std::vector<double>& displacement_m)
{
    const auto [least_m, most_m] = std::minmax_element(displacement_m.begin(), displacement_m.end());
    const Unit unit = unit_for(std::max(std::abs(*least_m), std::abs(*most_m)));
    const double least = *least_m * unit.per_metre;
    const double most = *most_m * unit.per_metre;
    const double span = most > least ? most - least : std::max(1.0, std::abs(most));
    Figure figure = over_time(t.time_s.front(), t.time_s[displacement_m.size() - 1]);
    figure.y_range = {least - 0.06 * span, most + 0.06 * span};
    FigureSeries line, points;
    points.kind = SeriesKind::points;
    line.colour = points.colour = colour;
    line.weight = 0.8;
    for (std::size_t s = 0; s < displacement_m.size(); ++s) {
        line.x.push_back(t.time_s[s]);
        line.y.push_back(displacement_m[s] * unit.per_metre);
    }
    for (const std::size_t s : chosen) {
        points.x.push_back(t.time_s[s]);
        points.y.push_back(displacement_m[s] * unit.per_metre);
    }
    // points of this picture are circles, as no series is beside them
    figure.series = {std::move(points), std::move(line)};
    draw_panel(sheet, figure, fmt::format("{} [{}]", what, unit.name), top, has_time_axis);
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
void draw_falls(DrawingSheet& sheet, double top, const Trajectory& t, const std::vector<std::size_t>& falls,
                const std::vector<double>& fall_time_s, double last_s)
{
    const double first_s = t.time_s.front();
    Figure figure = over_time(first_s, last_s);
    figure.y_range = {0, 1.1 * static_cast<double>(falls.size())};
    FigureSeries points{"", SeriesKind::points, {}, {}, {}, {}}, steps{"", SeriesKind::line, {first_s}, {0}, {}, {}};
    points.colour = steps.colour = fallen_colour;
    for (std::size_t k = 0; k < falls.size(); ++k) {
        const double time_s = fall_time_s[falls[k]], count = static_cast<double>(k + 1);
        steps.x.insert(steps.x.end(), {time_s, time_s});
        steps.y.insert(steps.y.end(), {count - 1, count});
        points.x.push_back(time_s);
        points.y.push_back(count);
    }
    steps.x.push_back(last_s);
    steps.y.push_back(static_cast<double>(falls.size()));
    figure.series = {std::move(points), std::move(steps)};
    draw_panel(sheet, figure, "fallen", top, false);
    // Left of the first fall there is room, unless it comes early: then below the curve on the right.
    const double first = fall_time_s[falls.front()];
    const bool late = first - first_s > 0.5 * (last_s - first_s);
    const double at =
        left_edge + ((late ? first : last_s) - first_s) / std::max(last_s - first_s, 1e-12) * (right_edge - left_edge);
    sheet.text(falls.size() > 1 && fall_time_s[falls[1]] == first
                   ? fmt::format("first: several together, {:.2f} s", first)
                   : fmt::format("first: {}, {:.2f} s", t.name[falls.front()], first),
               at - 12, top + panel_pixels * (late ? 0.28 : 0.8), 25, TextAt::right, fallen_colour);
}

std::string subtitle(const Trajectory& t, const Drawn& drawn, std::size_t samples, bool falls, bool held)
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
    if (held)
        text += " · lines: rods, tendons, clamps";
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
                const std::filesystem::path& png, std::size_t snapshots, const std::vector<Fastening>& fastenings)
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

    const StripLayout layout = make_layout(trajectory, drawn, chosen, right_edge - left_edge);
    const double first_panel = heading_pixels + layout.pixels + label_pixels + 30;
    const double panels = falls.empty() ? 2 : 3;
    DrawingSheet sheet({static_cast<int>(picture_pixels),
                        static_cast<int>(std::lround(first_panel + panels * panel_pixels +
                                                     (panels - 1) * panel_gap_pixels + footing_pixels))},
                       picture_look.letters());

    std::vector<double> top_m(samples);
    for (std::size_t s = 0; s < samples; ++s)
        top_m[s] = trajectory["x_m"][s * blocks + drawn.top] - trajectory["rest_x_m"][drawn.top];
    std::vector<double> base_m = trajectory["base_x_m"];
    base_m.resize(samples);

    sheet.heading(title, subtitle(trajectory, drawn, samples, !falls.empty(), !fastenings.empty()));
    draw_strip(sheet, trajectory, drawn, fall_time_s, chosen, layout, fastenings);
    double top = first_panel;
    if (!falls.empty()) {
        draw_falls(sheet, top, trajectory, falls, fall_time_s, last_s);
        top += panel_pixels + panel_gap_pixels;
    }
    draw_displacement(sheet, "top", "#0072b2", top, false, trajectory, chosen, top_m);
    top += panel_pixels + panel_gap_pixels;
    draw_displacement(sheet, "base", "#d55e00", top, true, trajectory, chosen, base_m);
    sheet.write(png);
}

} // namespace stylobate

#include "io/plots/plot_structure_in_space.hpp"

#include "io/plots/solid_sheet.hpp"
#include "io/plots/structure_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {
namespace {

constexpr double sheet_width = 1800, room_left = 310, room_right = 80, room_between = 150, above_drawing = 250;
constexpr double most_high = 720, most_deep = 560; ///< of an elevation, of the plan
constexpr double floor_px = 22, dimension_row = 64;
constexpr char red[] = "#c0271b";

/// From and to.
struct Range {
    double from = std::numeric_limits<double>::infinity(), to = -std::numeric_limits<double>::infinity();
    void add(double a, double b)
    {
        from = std::min(from, a);
        to = std::max(to, b);
    }
    double length() const { return to - from; }
    double middle() const { return (from + to) / 2; }
};

/// What is drawn, and where.
struct SpaceDrawing : DrawnStructure {
    using DrawnStructure::DrawnStructure;
    std::vector<DrawnSolid> solids;
    Range x, z;
    SheetPlace front, side, plan;
    double ground = 0;
};

SpaceDrawing drawing_of(const Study& study)
{
    SpaceDrawing d(study);
    for (const PlacedBlock& b : d.layout.blocks) {
        const PlacedSolid solid = solid_of(b);
        d.solids.push_back({solid, b.fixed                         ? SolidLook::fixed
                                   : b.role == BlockRole::epistyle ? SolidLook::lintel
                                                                   : SolidLook::stone});
        const double half_x = std::max(solid.shape.bottom.x, solid.shape.top.x);
        const double half_z = std::max(solid.shape.bottom.z, solid.shape.top.z);
        d.x.add(b.x_m() - half_x, b.x_m() + half_x);
        d.z.add(b.z_m() - half_z, b.z_m() + half_z);
    }
    d.in_mm = std::max({d.x.length(), d.z.length(), d.top_m}) < 1;
    return d;
}

/// Sets the scale and the places of the views. @returns where the list begins [pixels from above]
double place_views(SpaceDrawing& d)
{
    const double room = sheet_width - room_left - room_right - room_between;
    const double scale =
        std::min({room / (d.x.length() + d.z.length()), most_high / d.top_m, most_deep / d.z.length()});
    const double used = (d.x.length() + d.z.length()) * scale;
    const double left = room_left + (room - used) / 3;
    d.ground = above_drawing + d.top_m * scale;
    d.front = {left - d.x.from * scale, d.ground, scale};
    // from the side z is to the left: the front of the structure comes first
    d.side = {left + d.x.length() * scale + room_between + d.z.to * scale, d.ground, scale};
    const double plan_top = d.ground + floor_px + 2 * dimension_row + 105;
    d.plan = {d.front.x, plan_top - d.z.from * scale, scale};
    return plan_top + d.z.length() * scale + 85;
}

void draw_elevation(const SpaceDrawing& d, DrawingSheet& sheet, const SolidView& view, const SheetPlace& place,
                    double from, double to)
{
    const double over = std::max(24.0, 0.04 * (to - from) * place.per_metre);
    sheet.rectangle(place.x + from * place.per_metre - over, d.ground, place.x + to * place.per_metre + over,
                    d.ground + floor_px, "#6f6f6f");
    draw_solids(sheet, d.solids, view, place);
    for (std::size_t i = 0; i < d.layout.blocks.size(); ++i) {
        if (!d.bed_words(i))
            continue;
        const PlacedSolid solid = solid_of(d.block(i));
        const ViewPoint middle = view.place({solid.middle[0], d.block(i).bottom(), solid.middle[2]});
        const double half = view.azimuth_rad > 0 ? solid.shape.bottom.z : solid.shape.bottom.x;
        const auto [x0, y0] = place.of({middle.x - half, middle.y});
        const auto [x1, y1] = place.of({middle.x + half, middle.y});
        sheet.line(x0, y0, x1, y1, red, 4);
    }
}

/// Values that differ, ascending.
std::vector<double> different(std::vector<double> values)
{
    std::ranges::sort(values);
    const double span = values.back() - values.front();
    const auto equal = [&](double a, double b) { return std::fabs(a - b) <= 1e-9 * std::max(span, 1.0); };
    values.erase(std::unique(values.begin(), values.end(), equal), values.end());
    return values;
}

/// Below an elevation: distances of the axes, of one column the size of its foot, and the whole length.
/// @param foot of the first column   @param x of a length in metres [pixels]
template <class Place>
void draw_lengths(const SpaceDrawing& d, DrawingSheet& sheet, const std::vector<double>& axes, const Range& foot,
                  const Range& all, const Place& x)
{
    double y = d.ground + floor_px + 26;
    for (std::size_t i = 0; i + 1 < axes.size(); ++i)
        sheet.across(x(axes[i]), x(axes[i + 1]), y, d.length(std::fabs(axes[i + 1] - axes[i])));
    const bool has_foot = d.columns.size() == 1 && !same(foot.length(), all.length());
    if (has_foot)
        sheet.across(x(foot.from), x(foot.to), y, d.length(foot.length()));
    if (axes.size() > 1 || has_foot)
        y += dimension_row;
    sheet.across(x(all.from), x(all.to), y, d.length(all.length()));
}

/// The outlines of the columns' feet in the plan, dashed: what lies on them hides them.
void draw_feet(const SpaceDrawing& d, DrawingSheet& sheet)
{
    constexpr double dash = 7; // and as much between two of them [pixels]
    for (const auto& column : d.columns) {
        const PlacedSolid foot = solid_of(d.block(column.front()));
        std::vector<std::array<double, 2>> ring;
        for (const SpacePoint& p : foot.shape.ring(false))
            ring.push_back(d.plan.of(SolidView::above().place({p[0] + foot.middle[0], 0, p[2] + foot.middle[2]})));
        double gone = 0; // along the outline
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
            const double side = std::hypot(b[0] - a[0], b[1] - a[1]), end = gone + side;
            const auto at = [&](double way) {
                const double share = (way - (end - side)) / side;
                return std::array{a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
            };
            while (gone < end) {
                const double mark = std::floor(gone / dash + 1e-9), next = std::min(end, (mark + 1) * dash);
                if (std::fmod(mark, 2) == 0)
                    sheet.path({at(gone), at(next)}, "#4a3b24", 1.2);
                gone = next;
            }
        }
    }
}

void draw_plan_view(const SpaceDrawing& d, DrawingSheet& sheet)
{
    const double over = std::max(24.0, 0.04 * d.x.length() * d.plan.per_metre) / d.plan.per_metre;
    draw_ground(sheet, d.x.from - over, d.x.to + over, d.z.from - over, d.z.to + over, SolidView::above(), d.plan);
    draw_solids(sheet, d.solids, SolidView::above(), d.plan);
    draw_feet(d, sheet);
    sheet.text("plan", d.plan.x + d.x.middle() * d.plan.per_metre, d.plan.y + (d.z.from - over) * d.plan.per_metre - 22,
               16);
    const double right = d.plan.x + (d.x.to + over) * d.plan.per_metre;
    draw_axes(sheet, SolidView::above(), right + 40, d.plan.y + d.z.from * d.plan.per_metre);
    if (d.columns.size() < 2)
        return;
    for (std::size_t c = 0; c < d.columns.size(); ++c) {
        const PlacedBlock& foot = d.block(d.columns[c].front());
        const auto [x, y] = d.plan.of(SolidView::above().place({foot.axis_m, 0, foot.axis_z_m}));
        const double font = std::min(21.0, 1.33 * foot.width_m * d.plan.per_metre / 2);
        if (font >= 9)
            sheet.text(fmt::format("{}", c + 1), x, y, font);
    }
}

std::string size_words(const SpaceDrawing& d, const PlacedBlock& b)
{
    const char* const unit = d.unit();
    std::string height = fmt::format("height {} {}", d.number(b.height_m), unit);
    if (b.echinus_part > 0)
        height += fmt::format(", of which an echinus {}, diameter {} {}", d.number(b.echinus_part * b.height_m),
                              d.number(b.echinus_ratio * b.width_m), unit);
    const bool tapers = !same(b.top_ratio, 1);
    const auto faces = [&](const std::string& bottom, const std::string& top) {
        return tapers ? fmt::format("{} (top {})", bottom, top) : bottom;
    };
    if (b.shape == Shape::round)
        return fmt::format("diameter {} {}, {}", faces(d.number(b.width_m), d.number(b.top_ratio * b.width_m)), unit,
                           height);
    const auto face = [&](double ratio) {
        return fmt::format("{} × {}", d.number(ratio * b.width_m), d.number(ratio * b.depth_m));
    };
    return fmt::format("{} {}, {}", faces(face(1), face(b.top_ratio)), unit, height);
}

/// A line for each run of neighbours that are alike.
std::vector<std::string> lines_of(const SpaceDrawing& d, const std::vector<std::size_t>& blocks)
{
    const auto alike = [&](std::size_t i, std::size_t k) {
        const PlacedBlock &a = d.block(i), &b = d.block(k);
        return size_words(d, a) == size_words(d, b) && same(a.mass_kg, b.mass_kg) && a.fixed == b.fixed &&
               a.capital == b.capital && d.bed_words(i) == d.bed_words(k) && same(1 + a.offset_m, 1 + b.offset_m) &&
               same(1 + a.offset_z_m, 1 + b.offset_z_m);
    };
    std::vector<std::string> lines;
    for (const auto& run : runs_of(blocks, alike)) {
        const PlacedBlock& first = d.block(run.front());
        std::string words = fmt::format("{}: {}, {}", d.name_of(run), size_words(d, first), mass_text(first.mass_kg));
        if (first.role == BlockRole::drum && std::hypot(first.offset_m, first.offset_z_m) > 1e-9 * first.width_m)
            words +=
                fmt::format(", offset {} along x, {} along z", d.length(first.offset_m), d.length(first.offset_z_m));
        if (first.fixed)
            words += ", fixed";
        if (const std::optional<std::string> bed = d.bed_words(run.front()))
            words += "; bed: " + *bed;
        lines.push_back(std::move(words));
    }
    return lines;
}

/// Columns that are alike have their lines once.
std::vector<std::string> block_list(const SpaceDrawing& d)
{
    std::vector<std::pair<std::vector<std::size_t>, std::vector<std::string>>> kinds;
    for (std::size_t c = 0; c < d.columns.size(); ++c) {
        const std::vector<std::string> lines = lines_of(d, d.columns[c]);
        const auto found = std::ranges::find_if(kinds, [&](const auto& kind) { return kind.second == lines; });
        if (found == kinds.end())
            kinds.push_back({{c}, lines});
        else
            found->first.push_back(c);
    }
    std::vector<std::string> list;
    for (const auto& [columns, lines] : kinds) {
        std::string which = columns.size() == 1 ? "column " : "columns ";
        for (std::size_t i = 0; i < columns.size(); ++i)
            which += fmt::format("{}{}", i > 0 ? ", " : "", columns[i] + 1);
        for (const std::string& line : lines)
            list.push_back(d.columns.size() == 1 ? line : fmt::format("{}, {}", which, line));
    }
    for (const std::string& line : lines_of(d, d.epistyles))
        list.push_back(line);
    return list;
}

} // namespace

DrawingSheet structure_sheet_in_space(const Study& study, const std::string& title)
{
    SpaceDrawing d = drawing_of(study);
    const double below = place_views(d);
    std::vector<std::string> list = block_list(d);
    constexpr std::size_t most_lines = 40;
    constexpr double line = 34;
    if (list.size() > most_lines) {
        const std::size_t left_out = list.size() - (most_lines - 1);
        list.resize(most_lines - 1);
        list.push_back(fmt::format("and {} more", left_out));
    }
    DrawingSheet sheet(
        {static_cast<int>(sheet_width), static_cast<int>(below + line * static_cast<double>(list.size()) + 30)});
    draw_elevation(d, sheet, SolidView::front(), d.front, d.x.from, d.x.to);
    draw_elevation(d, sheet, SolidView::side(), d.side, -d.z.to, -d.z.from);
    draw_plan_view(d, sheet);
    draw_heights(d, sheet, d.front.x + d.x.from * d.front.per_metre, d.ground, d.front.per_metre);
    std::vector<double> axes_x, axes_z;
    for (const auto& column : d.columns) {
        axes_x.push_back(d.block(column.front()).axis_m);
        axes_z.push_back(-d.block(column.front()).axis_z_m); // z is to the left
    }
    const PlacedSolid foot = solid_of(d.block(d.columns.front().front()));
    const auto about = [](double middle, double half) { return Range{middle - half, middle + half}; };
    draw_lengths(d, sheet, different(axes_x), about(foot.middle[0], foot.shape.bottom.x), d.x,
                 [&](double x) { return d.front.x + x * d.front.per_metre; });
    draw_lengths(d, sheet, different(axes_z), about(-foot.middle[2], foot.shape.bottom.z), {-d.z.to, -d.z.from},
                 [&](double z) { return d.side.x + z * d.side.per_metre; });
    const double caption = above_drawing - 55;
    const auto middle = [](const SheetPlace& place, double from, double to) {
        return place.x + (from + to) / 2 * place.per_metre;
    };
    sheet.text("from the front", middle(d.front, d.x.from, d.x.to), caption, 21);
    sheet.text("from the side", middle(d.side, -d.z.to, -d.z.from), caption, 21);
    double y = below;
    for (const std::string& words : list) {
        sheet.text(words, 120, y, DrawingSheet::fitting(words, sheet_width - 240, 22.6), TextAt::left);
        y += line;
    }
    sheet.heading(title, fmt::format("{} · friction {:.3g} · {} in all · x to the right, z towards the viewer",
                                     d.count_words(), study.contact.friction, d.whole_mass()));
    return sheet;
}

} // namespace stylobate

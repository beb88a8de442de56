#include "io/plots/plot_structure.hpp"

#include "io/plots/plot_structure_in_space.hpp"
#include "io/plots/structure_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace stylobate {

namespace {

constexpr double picture_width = 1800, left_room = 310, right_room = 60, list_room = 640, heading = 175;
constexpr double slab = 28, row = 75; ///< of the ground; between dimension lines
constexpr char bed_colour[] = "#c0271b";

/// What is drawn, and the scale.
struct Drawing : DrawnStructure {
    using DrawnStructure::DrawnStructure;
    bool alike = true; ///< all columns are
    double left_m = std::numeric_limits<double>::infinity(), right_m = -left_m;
    double per_metre = 0, left = 0, ground = 0; ///< pixels

    double x(double metres) const { return left + (metres - left_m) * per_metre; }
    double y(double metres) const { return ground - metres * per_metre; }
    std::string size(const PlacedBlock& b) const
    {
        return fmt::format("{} × {} {}", number(b.width_m), number(b.height_m), unit());
    }
};

bool alike(const PlacedBlock& a, const PlacedBlock& b)
{
    return same(a.width_m, b.width_m) && same(a.height_m, b.height_m) && same(a.mass_kg, b.mass_kg) &&
           std::fabs(a.offset_m - b.offset_m) <= 1e-9 * a.width_m && a.fixed == b.fixed;
}

bool same_beds(const Drawing& d, std::size_t a, std::size_t b)
{
    return d.bed_words(a) == d.bed_words(b);
}

Drawing make_drawing(const Study& study)
{
    Drawing d(study);
    for (const PlacedBlock& b : d.layout.blocks) {
        d.left_m = std::min(d.left_m, b.left());
        d.right_m = std::max(d.right_m, b.right());
    }
    for (const auto& column : d.columns) {
        d.alike = d.alike && column.size() == d.columns[0].size();
        for (std::size_t k = 0; d.alike && k < column.size(); ++k)
            d.alike = alike(d.block(column[k]), d.block(d.columns[0][k])) && same_beds(d, column[k], d.columns[0][k]);
    }
    d.in_mm = std::max(d.right_m - d.left_m, d.top_m) < 1;
    return d;
}

/// Dimension rows below the ground.
int rows_below(const Drawing& d)
{
    return d.columns.size() > 1 ? 3 : 1;
}

/// The size of the picture, and the scale.
PictureSize scale(Drawing& d)
{
    constexpr double most_height = 900, least_height = 150;
    const double width = picture_width - left_room - (d.alike ? list_room : right_room);
    const double across = width / (d.right_m - d.left_m);
    d.per_metre = std::min(across, most_height / d.top_m);
    d.left = left_room + (width - (d.right_m - d.left_m) * d.per_metre) / 2;
    if (d.alike) // the list stands beside it
        d.left = std::min(d.left, left_room + 160);
    const double above = heading + 110;
    const double high = std::max(least_height, d.top_m * d.per_metre);
    d.ground = above + high;
    return {static_cast<int>(picture_width), static_cast<int>(d.ground + slab + row * rows_below(d) + 50)};
}

void draw_blocks(const Drawing& d, DrawingSheet& sheet)
{
    const double over = std::max(30.0, 0.04 * (d.right_m - d.left_m) * d.per_metre);
    sheet.rectangle(d.x(d.left_m) - over, d.ground, d.x(d.right_m) + over, d.ground + slab, "#6f6f6f");
    for (const PlacedBlock& b : d.layout.blocks) {
        const bool epistyle = b.role == BlockRole::epistyle;
        sheet.rectangle(d.x(b.left()), d.y(b.top()), d.x(b.right()), d.y(b.bottom()),
                        b.fixed    ? "#a89a7d"
                        : epistyle ? "#b9cddb"
                                   : "#ead9b5",
                        epistyle ? "#27475c" : "#4a3b24");
    }
    for (const PlacedBed& bed : d.layout.beds) {
        if (!words_of_bed(bed.bed))
            continue;
        const PlacedBlock& upper = d.block(static_cast<std::size_t>(bed.upper));
        double from = upper.left(), to = upper.right();
        if (bed.lower >= 0) {
            from = std::max(from, d.block(static_cast<std::size_t>(bed.lower)).left());
            to = std::min(to, d.block(static_cast<std::size_t>(bed.lower)).right());
        }
        sheet.line(d.x(from), d.y(upper.bottom()), d.x(to), d.y(upper.bottom()), bed_colour, 4);
    }
}

/// Below the ground: feet and gaps, axes, the whole length.
void draw_plan(const Drawing& d, DrawingSheet& sheet)
{
    double y = d.ground + slab + 26;
    for (std::size_t c = 0; c < d.columns.size(); ++c) {
        const PlacedBlock& foot = d.block(d.columns[c].front());
        sheet.across(d.x(foot.left()), d.x(foot.right()), y, d.length(foot.width_m));
        if (c + 1 == d.columns.size())
            break;
        const PlacedBlock& next = d.block(d.columns[c + 1].front());
        sheet.across(d.x(foot.right()), d.x(next.left()), y, d.length(next.left() - foot.right()));
    }
    if (d.columns.size() < 2)
        return;
    y += row;
    const auto axis = [&](std::size_t c) { return d.block(d.columns[c].front()).axis_m; };
    for (std::size_t c = 0; c + 1 < d.columns.size(); ++c)
        sheet.across(d.x(axis(c)), d.x(axis(c + 1)), y, d.length(axis(c + 1) - axis(c)));
    for (std::size_t c = 0; c < d.columns.size(); ++c)
        sheet.text(fmt::format("{}{}", c == 0 ? "column " : "", c + 1), d.x(axis(c)), d.ground + slab / 2, 18.6,
                   TextAt::center, "#ffffff");
    y += row;
    sheet.across(d.x(d.left_m), d.x(d.right_m), y, d.length(d.right_m - d.left_m));
}

/// Above: lengths of the epistyles, or the width of a top that is not that of the foot.
void draw_tops(const Drawing& d, DrawingSheet& sheet)
{
    const double y = d.y(d.top_m) - 30;
    for (const std::size_t e : d.epistyles)
        sheet.across(d.x(d.block(e).left()), d.x(d.block(e).right()), y, d.length(d.block(e).width_m), true);
    if (!d.epistyles.empty())
        return;
    for (const auto& column : d.columns) {
        const PlacedBlock &foot = d.block(column.front()), &top = d.block(column.back());
        if (!same(foot.width_m, top.width_m))
            sheet.across(d.x(top.left()), d.x(top.right()), d.y(top.top()) - 30, d.length(top.width_m), true);
    }
}

std::string words_of(const Drawing& d, const std::vector<std::size_t>& run)
{
    const PlacedBlock& first = d.block(run.front());
    std::string words = fmt::format("{}: {}, {}", d.name_of(run), d.size(first), mass_text(first.mass_kg));
    if (std::fabs(first.offset_m) > 1e-9 * first.width_m && first.role == BlockRole::drum)
        words += ", offset " + d.length(first.offset_m);
    if (first.fixed)
        words += ", fixed";
    return words;
}

/// Names, sizes and masses beside the last column, with lines that lead to the blocks.
void draw_list(const Drawing& d, DrawingSheet& sheet)
{
    struct Entry {
        std::string words;
        std::optional<std::string> bed;
        double top, bottom, from; ///< of the blocks; where the line begins
        double at;
    };
    std::vector<Entry> entries;
    const auto add = [&](const std::vector<std::size_t>& run, bool of_row) {
        const PlacedBlock &low = d.block(run.front()), &high = d.block(run.back());
        double right = 0;
        for (const std::size_t i : run)
            right = std::max(right, d.block(i).right());
        const double top = d.y(of_row ? low.top() : high.top()), bottom = d.y(low.bottom());
        entries.push_back({words_of(d, run), d.bed_words(run.front()), top, bottom, d.x(right), (top + bottom) / 2});
    };
    const auto is_alike = [&](std::size_t a, std::size_t b) {
        return alike(d.block(a), d.block(b)) && same_beds(d, a, b) && d.name_of({b}) != "capital";
    };
    for (const auto& run : runs_of(d.columns.back(), is_alike))
        add(run, false);
    const auto equal_pieces = [&](std::size_t a, std::size_t b) {
        return same(d.block(a).width_m, d.block(b).width_m) && same(d.block(a).height_m, d.block(b).height_m) &&
               same(d.block(a).mass_kg, d.block(b).mass_kg) && same_beds(d, a, b);
    };
    for (const auto& run : runs_of(d.epistyles, equal_pieces))
        add(run, true);
    std::reverse(entries.begin(), entries.end()); // from the top
    const auto lines = [](const Entry& e) { return e.bed ? 2.0 : 1.0; };
    double all = 0;
    for (const Entry& e : entries)
        all += lines(e);
    const double gap = std::min(30.0, (d.ground - heading - 60) / std::max(all, 1.0));
    // each at its blocks, or as near below the one before and above the ground as there is room
    double next = heading + 40;
    for (Entry& e : entries) {
        e.at = std::max(e.at, next);
        next = e.at + lines(e) * gap;
    }
    double limit = d.ground + slab;
    for (std::size_t k = entries.size(); k-- > 0;) {
        entries[k].at = std::min(entries[k].at, limit - lines(entries[k]) * gap + gap / 2);
        limit = entries[k].at - gap / 2;
    }
    const double brace = d.x(d.right_m) + 24, column = brace + 70, font = std::min(22.6, gap / 1.15);
    for (const Entry& e : entries) {
        const double middle = (e.top + e.bottom) / 2;
        sheet.line(brace, e.top + 2, brace, e.bottom - 2, "#909090", 1.6);
        sheet.line(e.from + 4, middle, brace, middle, "#c8c8c8", 0.8);
        sheet.line(brace, middle, column - 8, e.at, "#909090", 0.8);
        const double fits = DrawingSheet::fitting(e.words, picture_width - column - 10, font);
        sheet.text(e.words, column, e.at, fits, TextAt::left);
        if (e.bed)
            sheet.text("bed: " + *e.bed, column, e.at + gap, fits, TextAt::left, bed_colour);
    }
}

/// Lines of text in a block.
using BlockText = std::vector<std::pair<std::string, const char*>>;

/// Labels that may stand in a block, the most informative first.
std::vector<BlockText> block_texts(const Drawing& d, std::size_t i)
{
    static constexpr char black[] = "#000000"; // the texts point to it
    const PlacedBlock& b = d.block(i);
    const std::pair<std::string, const char*> name{d.name_of({i}), black}, size{d.size(b), black};
    if (d.alike) // the list has the rest
        return {{name}};
    const auto of_bed = d.bed_words(i);
    std::vector<BlockText> texts;
    if (of_bed)
        texts = {{name, size, {*of_bed, bed_colour}}, {size, {*of_bed, bed_colour}}};
    texts.push_back({name, size});
    texts.push_back({size});
    texts.push_back({{d.number(b.width_m) + " ×", black}, {d.number(b.height_m), black}});
    return texts;
}

/// What stands in the blocks: names and sizes as far as there is room.
void draw_in_blocks(const Drawing& d, DrawingSheet& sheet)
{
    constexpr double most = 22.6, least = 10, line = 1.2; // fonts; pixels of a line for each
    for (std::size_t i = 0; i < d.layout.blocks.size(); ++i) {
        const PlacedBlock& b = d.block(i);
        if (d.alike && b.role == BlockRole::drum)
            continue;
        const double width = b.width_m * d.per_metre - 8, height = b.height_m * d.per_metre;
        for (const BlockText& text : block_texts(d, i)) {
            const auto lines = static_cast<double>(text.size());
            double font = std::min(most, height / ((line + 0.2) * lines));
            for (const auto& [words, colour] : text)
                font = std::min(font, DrawingSheet::fitting(words, width, most));
            if (font < least)
                continue;
            double y = d.y(b.y_m) - line * font * (lines - 1) / 2;
            for (const auto& [words, colour] : text) {
                sheet.text(words, d.x(b.x_m()), y, font, TextAt::center, colour);
                y += line * font;
            }
            break;
        }
    }
}

} // namespace

DrawingSheet structure_sheet(const Study& study, const std::string& title)
{
    if (study.structure.spatial())
        return structure_sheet_in_space(study, title);
    Drawing d = make_drawing(study);
    DrawingSheet sheet(scale(d));
    draw_blocks(d, sheet);
    draw_in_blocks(d, sheet);
    draw_heights(d, sheet, d.x(d.left_m), d.ground, d.per_metre);
    draw_plan(d, sheet);
    draw_tops(d, sheet);
    if (d.alike)
        draw_list(d, sheet);
    sheet.heading(title, fmt::format("{} · depth {} · friction {:.3g} · {} in all", d.count_words(),
                                     d.length(study.structure.depth_m), study.contact.friction, d.whole_mass()));
    return sheet;
}

void plot_structure(const Study& study, const std::string& title, const std::filesystem::path& file)
{
    structure_sheet(study, title).write(file);
}

} // namespace stylobate

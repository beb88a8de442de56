#include "io/plots/plot_structure.hpp"

#include "io/plots/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace stylobate {

namespace {

/// Where a text stands beside its point.
enum class TextAt { left, center, right };

/// A drawing in pixels, for gnuplot: rectangles, lines, texts, dimension lines. Places are in pixels from the upper
/// left corner of the picture; what comes later lies above.
class DrawingSheet {
public:
    explicit DrawingSheet(PictureSize size) : size_(size) {}

    void rectangle(double left, double top, double right, double bottom, std::string_view fill,
                   std::string_view line = {});
    void line(double x0, double y0, double x1, double y1, std::string_view colour = "#303030", double width = 1);
    /// @param turned upwards, by a right angle
    void text(std::string_view words, double x, double y, double font, TextAt at = TextAt::center,
              std::string_view colour = "#000000", bool turned = false);
    /// A dimension line below a level or above it: its ends are ticks, its text beside it, turned where it would be
    /// wider than the line. @param above whether the text stands above the line
    void across(double x0, double x1, double y, std::string_view words, bool above = false);
    /// A dimension line on the left: its text on its left.
    /// @param turned along the line
    void along(double x, double y0, double y1, std::string_view words, bool turned = false);

    /// Draws what is on the sheet, below a heading.
    void write(std::string_view title, std::string_view subtitle, const std::filesystem::path& file) const;

    /// The width of a text, about [pixels].
    static double width(std::string_view words, double font);
    /// The largest font up to `most` with which a text fits.
    static double fitting(std::string_view words, double pixels, double most);

private:
    std::string x(double pixels) const;
    std::string y(double pixels) const;
    void tick(double x, double y);

    PictureSize size_;
    int objects_ = 0;
    std::string script_;
};

constexpr double dimension_font = 19, least_font = 9;
constexpr char dimension_colour[] = "#27475c";

std::string DrawingSheet::x(double pixels) const
{
    return fmt::format("screen {:.5f}", pixels / size_.width);
}

std::string DrawingSheet::y(double pixels) const
{
    return fmt::format("screen {:.5f}", 1 - pixels / size_.height);
}

double DrawingSheet::width(std::string_view words, double font)
{
    const auto letters = std::count_if(words.begin(), words.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
    return 0.86 * font * static_cast<double>(letters); // a point is 4/3 of a pixel
}

double DrawingSheet::fitting(std::string_view words, double pixels, double most)
{
    return std::min(most, most * pixels / std::max(width(words, most), 1.0));
}

void DrawingSheet::rectangle(double left, double top, double right, double bottom, std::string_view fill,
                             std::string_view line)
{
    script_ +=
        fmt::format("set object {} rectangle from {}, {} to {}, {} front fillcolor rgb '{}' fillstyle solid 1 {}\n",
                    ++objects_, x(left), y(bottom), x(right), y(top), fill,
                    line.empty() ? "noborder" : fmt::format("border linecolor rgb '{}' linewidth 0.8", line));
}

void DrawingSheet::line(double x0, double y0, double x1, double y1, std::string_view colour, double width)
{
    script_ += fmt::format("set arrow from {}, {} to {}, {} nohead front linecolor rgb '{}' linewidth {}\n", x(x0),
                           y(y0), x(x1), y(y1), colour, width);
}

void DrawingSheet::text(std::string_view words, double at_x, double at_y, double font, TextAt at,
                        std::string_view colour, bool turned)
{
    script_ += fmt::format("set label {} at {}, {} {} {} front font ',{:.1f}' textcolor rgb '{}'\n",
                           gnuplot_text(words), x(at_x), y(at_y),
                           at == TextAt::left    ? "left"
                           : at == TextAt::right ? "right"
                                                 : "center",
                           turned ? "rotate by 90" : "norotate", font, colour);
}

void DrawingSheet::tick(double at_x, double at_y)
{
    constexpr double half = 6;
    line(at_x - half, at_y + half, at_x + half, at_y - half, dimension_colour, 0.8);
}

void DrawingSheet::across(double x0, double x1, double at_y, std::string_view words, bool above)
{
    line(x0, at_y, x1, at_y, dimension_colour, 0.6);
    tick(x0, at_y);
    tick(x1, at_y);
    constexpr double distance = 20;
    const double font = fitting(words, x1 - x0 - 6, dimension_font);
    if (font >= 0.7 * dimension_font)
        return text(words, (x0 + x1) / 2, at_y + (above ? -distance : distance), font, TextAt::center,
                    dimension_colour);
    // upright, away from the line
    constexpr double room = 58; // to the next line
    const double turned = std::max(least_font, std::min((x1 - x0) / 1.5, fitting(words, room, dimension_font)));
    text(words, (x0 + x1) / 2, at_y + (above ? -10 : 10), turned, above ? TextAt::left : TextAt::right,
         dimension_colour, true);
}

void DrawingSheet::along(double at_x, double y0, double y1, std::string_view words, bool turned)
{
    line(at_x, y0, at_x, y1, dimension_colour, 0.6);
    tick(at_x, y0);
    tick(at_x, y1);
    const double middle = (y0 + y1) / 2;
    if (turned)
        text(words, at_x - 20, middle, dimension_font, TextAt::center, dimension_colour, true);
    else
        text(words, at_x - 14, middle, std::clamp((y0 > y1 ? y0 - y1 : y1 - y0) / 1.3, least_font, dimension_font),
             TextAt::right, dimension_colour);
}

void DrawingSheet::write(std::string_view title, std::string_view subtitle, const std::filesystem::path& file) const
{
    // something must be plotted: a point that is nowhere
    run_gnuplot(gnuplot_heading(title, subtitle, size_) + script_ +
                    "unset border\nunset tics\nunset key\nset xrange [0:1]\nset yrange [0:1]\nplot '+' using 1:(1/0) "
                    "notitle\n",
                size_, file);
}

constexpr double picture_width = 1800, left_room = 310, right_room = 60, list_room = 640, heading = 175;
constexpr double slab = 28, row = 75; ///< of the ground; between dimension lines
constexpr char bed_colour[] = "#c0271b";

/// Equal within what a drawing can show.
bool same(double a, double b)
{
    return std::fabs(a - b) <= 1e-9 * std::max(std::fabs(a), std::fabs(b));
}

/// What is drawn, and the scale.
struct Drawing {
    const Study& study;
    Layout layout = lay_out(study.structure);
    std::vector<std::vector<std::size_t>> columns{}; ///< blocks of each, from the bottom
    std::vector<std::size_t> epistyles{};
    bool alike = true; ///< all columns are
    double left_m = 0, right_m = 0, top_m = 0;
    double per_metre = 0, left = 0, ground = 0; ///< pixels
    bool in_mm = false;

    const PlacedBlock& block(std::size_t i) const { return layout.blocks[i]; }
    double x(double metres) const { return left + (metres - left_m) * per_metre; }
    double y(double metres) const { return ground - metres * per_metre; }
    const char* unit() const { return in_mm ? "mm" : "m"; }
    std::string number(double metres) const { return fmt::format("{:.4g}", in_mm ? 1000 * metres : metres); }
    std::string length(double metres) const { return number(metres) + " " + unit(); }
    std::string size(const PlacedBlock& b) const
    {
        return fmt::format("{} × {} {}", number(b.width_m), number(b.height_m), unit());
    }
};

std::string mass(double kg)
{
    return kg < 1000 ? fmt::format("{:.4g} kg", kg) : fmt::format("{:.4g} t", kg / 1000);
}

/// What of a bed is not that of [contact]; nullopt if nothing is.
std::optional<std::string> bed_words(const BedSpec& bed)
{
    std::string words;
    const auto add = [&](const char* name, const std::optional<double>& value, const char* unit) {
        if (value)
            words += fmt::format("{}{} {:.3g}{}", words.empty() ? "" : ", ", name, *value, unit);
    };
    add("friction", bed.friction, "");
    add("K_N", bed.normal_stiffness_n_m2, " N/m2");
    add("K_T", bed.tangential_stiffness_n_m, " N/m");
    add("restitution", bed.restitution, "");
    add("damping", bed.normal_damping_ratio, "");
    add("tangential damping", bed.tangential_damping_ratio, "");
    return words.empty() ? std::nullopt : std::optional(words);
}

/// Of the beds under a block; of an epistyle that of its first seat.
const BedSpec* bed_under(const Drawing& d, std::size_t block)
{
    for (const PlacedBed& bed : d.layout.beds)
        if (bed.upper == static_cast<int>(block))
            return &bed.bed;
    return nullptr;
}

bool alike(const PlacedBlock& a, const PlacedBlock& b)
{
    return same(a.width_m, b.width_m) && same(a.height_m, b.height_m) && same(a.mass_kg, b.mass_kg) &&
           std::fabs(a.offset_m - b.offset_m) <= 1e-9 * a.width_m && a.fixed == b.fixed;
}

bool same_beds(const Drawing& d, std::size_t a, std::size_t b)
{
    const BedSpec *of_a = bed_under(d, a), *of_b = bed_under(d, b);
    return (of_a ? bed_words(*of_a) : std::nullopt) == (of_b ? bed_words(*of_b) : std::nullopt);
}

Drawing make_drawing(const Study& study)
{
    Drawing d{study};
    d.left_m = std::numeric_limits<double>::infinity();
    d.right_m = -d.left_m;
    d.columns.resize(study.structure.columns.size());
    for (std::size_t i = 0; i < d.layout.blocks.size(); ++i) {
        const PlacedBlock& b = d.block(i);
        (b.role == BlockRole::epistyle ? d.epistyles : d.columns[static_cast<std::size_t>(b.column)]).push_back(i);
        d.left_m = std::min(d.left_m, b.left());
        d.right_m = std::max(d.right_m, b.right());
        d.top_m = std::max(d.top_m, b.top());
    }
    for (const auto& column : d.columns) {
        d.alike = d.alike && column.size() == d.columns[0].size();
        for (std::size_t k = 0; d.alike && k < column.size(); ++k)
            d.alike = alike(d.block(column[k]), d.block(d.columns[0][k])) && same_beds(d, column[k], d.columns[0][k]);
    }
    d.in_mm = std::max(d.right_m - d.left_m, d.top_m) < 1;
    return d;
}

/// "drum 3", "capital", "epistyle 1": without its column.
std::string short_name(const PlacedBlock& block)
{
    return block.name.substr(0, block.name.find(" of column"));
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
        if (!bed_words(bed.bed))
            continue;
        const PlacedBlock& upper = d.block(static_cast<std::size_t>(bed.upper));
        double from = upper.left(), to = upper.right();
        if (bed.lower >= 0) {
            from = std::max(from, d.block(static_cast<std::size_t>(bed.lower)).left());
            to = std::min(to, d.block(static_cast<std::size_t>(bed.lower)).right());
        }
        sheet.line(d.x(from), d.y(upper.bottom()), d.x(to), d.y(upper.bottom()), bed_colour, 2);
    }
}

/// Runs of neighbours that are alike.
template <class Alike>
std::vector<std::vector<std::size_t>> runs_of(const std::vector<std::size_t>& blocks, const Alike& is_alike)
{
    std::vector<std::vector<std::size_t>> runs;
    for (const std::size_t i : blocks) {
        if (runs.empty() || !is_alike(runs.back().back(), i))
            runs.emplace_back();
        runs.back().push_back(i);
    }
    return runs;
}

/// The chain of heights on the left, and the whole height.
void draw_heights(const Drawing& d, DrawingSheet& sheet)
{
    std::vector<std::size_t> pile = d.columns.front();
    for (const std::size_t e : d.epistyles)
        if (d.study.structure.epistyles[e - d.epistyles.front()].first_column == 0) {
            pile.push_back(e);
            break;
        }
    const double at = d.x(d.left_m) - 55;
    double top = 0;
    for (const auto& run : runs_of(pile, [&](std::size_t a, std::size_t b) {
             return same(d.block(a).height_m, d.block(b).height_m) && d.block(a).role == d.block(b).role;
         })) {
        const PlacedBlock &low = d.block(run.front()), &high = d.block(run.back());
        top = high.top();
        sheet.along(at, d.y(low.bottom()), d.y(top),
                    run.size() == 1 ? d.length(low.height_m)
                                    : fmt::format("{} × {}", run.size(), d.length(low.height_m)));
        for (const std::size_t i : run)
            sheet.line(at - 4, d.y(d.block(i).top()), at + 4, d.y(d.block(i).top()), "#27475c", 0.6);
    }
    if (pile.size() > 1 || !same(top, d.top_m)) {
        const double outer = at - 190;
        sheet.along(outer, d.y(0), d.y(d.top_m), d.length(d.top_m), true);
        for (const double y : {d.y(0), d.y(d.top_m)})
            sheet.line(outer - 10, y, d.x(d.left_m) - 12, y, "#b0b0b0", 0.4);
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
        sheet.text(fmt::format("{}{}", c == 0 ? "column " : "", c + 1), d.x(axis(c)), d.ground + slab / 2, 14,
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
    const PlacedBlock &first = d.block(run.front()), &last = d.block(run.back());
    std::string name = short_name(first);
    if (run.size() > 1) {
        const std::size_t blank = name.rfind(' ');
        const std::string other = short_name(last);
        name = fmt::format("{}s {} to {}", name.substr(0, blank), name.substr(blank + 1),
                           other.substr(other.rfind(' ') + 1));
    }
    std::string words = fmt::format("{}: {}, {}", name, d.size(first), mass(first.mass_kg));
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
        const BedSpec* bed = bed_under(d, run.front());
        double right = 0;
        for (const std::size_t i : run)
            right = std::max(right, d.block(i).right());
        const double top = d.y(of_row ? low.top() : high.top()), bottom = d.y(low.bottom());
        entries.push_back(
            {words_of(d, run), bed ? bed_words(*bed) : std::nullopt, top, bottom, d.x(right), (top + bottom) / 2});
    };
    const auto is_alike = [&](std::size_t a, std::size_t b) {
        return alike(d.block(a), d.block(b)) && same_beds(d, a, b) && short_name(d.block(b)) != "capital";
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
    const double brace = d.x(d.right_m) + 24, column = brace + 70, font = std::min(17.0, gap / 1.5);
    for (const Entry& e : entries) {
        const double middle = (e.top + e.bottom) / 2;
        sheet.line(brace, e.top + 2, brace, e.bottom - 2, "#909090", 0.8);
        sheet.line(e.from + 4, middle, brace, middle, "#c8c8c8", 0.4);
        sheet.line(brace, middle, column - 8, e.at, "#909090", 0.4);
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
    const std::pair<std::string, const char*> name{short_name(b), black}, size{d.size(b), black};
    if (d.alike) // the list has the rest
        return {{name}};
    const BedSpec* bed = bed_under(d, i);
    const auto of_bed = bed ? bed_words(*bed) : std::nullopt;
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
    constexpr double most = 17, least = 7.5, line = 1.6; // fonts; pixels of a line for each
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

std::string subtitle_of(const Drawing& d)
{
    double sum = 0;
    std::size_t fixed = 0;
    for (const PlacedBlock& b : d.layout.blocks) {
        sum += b.mass_kg;
        fixed += b.fixed;
    }
    const std::size_t blocks = d.layout.blocks.size();
    const StructureSpec& structure = d.study.structure;
    return fmt::format("{} block{}{} · {} · friction {:.3g} · {} in all", blocks, blocks == 1 ? "" : "s",
                       fixed > 0 ? fmt::format(", {} fixed", fixed) : "",
                       structure.spatial() ? "in space" : "depth " + d.length(structure.depth_m),
                       d.study.contact.friction, mass(sum));
}

} // namespace

void plot_structure(const Study& study, const std::string& title, const std::filesystem::path& file)
{
    Drawing d = make_drawing(study);
    DrawingSheet sheet(scale(d));
    draw_blocks(d, sheet);
    draw_in_blocks(d, sheet);
    draw_heights(d, sheet);
    draw_plan(d, sheet);
    draw_tops(d, sheet);
    if (d.alike)
        draw_list(d, sheet);
    sheet.write(title, subtitle_of(d), file);
}

} // namespace stylobate

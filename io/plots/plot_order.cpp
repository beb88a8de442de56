#include "io/plots/plot_order.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/colours.hpp"
#include "io/plots/figure_panel.hpp"
#include "io/store/surface_axis.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace stylobate {
namespace {

/// Of more blocks than this a table and its colours are not read any more: they are drawn in their places.
constexpr std::size_t most_listed = 12;
constexpr std::size_t most_curves = 24;  ///< with a colour and a line of the table each
constexpr std::size_t most_steps = 1000; ///< of one curve: more cannot be distinguished

double fallen_share(const FallOrder& order, std::uint64_t count)
{
    return order.trials > 0 ? static_cast<double>(count) / static_cast<double>(order.trials) : 0.0;
}

/// Colour of an early (0) to a late (1) fall: dark ones fall first. The lightest end of the map is too faint on white.
std::string order_colour(double part)
{
    return viridis_colour(0.88 * part);
}

/// The block's curve: from 0 to the end of the axis, one step for each fall.
FigureSeries order_curve(const FallOrder& order, std::size_t block, double end_s, const std::string& colour,
                         double weight)
{
    const std::vector<double>& falls = order.blocks[block].fall_time_s;
    const std::size_t stride = falls.size() / most_steps + 1;
    FigureSeries curve{"", SeriesKind::line, {0}, {0}, {}, {}};
    curve.colour = colour;
    curve.weight = weight;
    const auto step = [&](double time_s, double share) {
        curve.x.insert(curve.x.end(), {time_s, time_s});
        curve.y.insert(curve.y.end(), {curve.y.back(), share});
    };
    for (std::size_t k = 0; k < falls.size(); k += stride) {
        const std::size_t last = std::min(k + stride, falls.size()) - 1; // of the falls that this step takes together
        step(falls[last], fallen_share(order, last + 1));
    }
    curve.x.push_back(end_s);
    curve.y.push_back(fallen_share(order, falls.size()));
    return curve;
}

/// The frame of the curves, without curves.
Figure curves_figure(double end_s, double most_share)
{
    Figure figure;
    figure.x_label = "time [s]";
    figure.y_label = "share of realizations with the block fallen";
    figure.x_range = {0, end_s};
    figure.y_range = {0, 1.01 * std::min(1.0, 1.1 * most_share)};
    return figure;
}

/// Colour of the k-th of n curves.
std::string colour(std::size_t k, std::size_t n)
{
    return order_colour(n > 1 ? static_cast<double>(k) / static_cast<double>(n - 1) : 0.0);
}

/// Where the columns of the table are [px].
struct Columns {
    double line = 1031;
    double name = 1089;
    double fallen = 1566;
    double median = 1672;
    double first = 1777;
};

void draw_table(DrawingSheet& sheet, const FallOrder& order, const std::vector<std::size_t>& shown, std::size_t others)
{
    const Columns at;
    const double top = 230, high = 992; // of all rows
    const double step = std::min(50.0, high / (static_cast<double>(shown.size()) + (others > 0 ? 2 : 1)));
    double font = std::min(22.6, 0.62 * step);
    for (const std::size_t block : shown)
        font = std::min(font, DrawingSheet::fitting(order.blocks[block].name, 215, font));
    const auto row = [&](const std::string& name, const std::string& fallen, const std::string& median,
                         const std::string& first, double y) {
        sheet.text(name, at.name, y, font, TextAt::left);
        sheet.text(fallen, at.fallen, y, font, TextAt::right);
        sheet.text(median, at.median, y, font, TextAt::right);
        sheet.text(first, at.first, y, font, TextAt::right);
    };
    row("block", "fallen", "median", "first", top);
    double y = top + 1.15 * step;
    for (std::size_t k = 0; k < shown.size(); ++k, y += step) {
        const FallOrder::Block& block = order.blocks[shown[k]];
        sheet.line(at.line, y, at.line + 43, y, colour(k, shown.size()), 4.8);
        row(block.name,
            fmt::format("{:.1f} % ({:.0f} to {:.0f})", 100 * fallen_share(order, block.fall_time_s.size()),
                        100 * block.lower, 100 * block.upper),
            fmt::format("{:.2f} s", sorted_median(block.fall_time_s)),
            fmt::format("{:.1f} %", 100 * fallen_share(order, block.first)), y);
    }
    if (others > 0) {
        sheet.line(at.line, y, at.line + 43, y, "#b0b0b0", 2.4);
        sheet.text(fmt::format("{}, less frequent", counted(others, "other")), at.name, y, font, TextAt::left);
    }
}

/// Where the drawing is, in pixels of the picture from its top left corner.
constexpr double drawing_left = 50, drawing_right = 1560, drawing_top = 190, drawing_bottom = 690;
constexpr double ground_pixels = 14;

/// Median times as colours.
struct TimeScale {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
    double part(double time_s) const { return to > from ? (time_s - from) / (to - from) : 0; }
};

/// Whether white letters are read on a colour "#rrggbb", and not black ones.
bool is_dark(const std::string& colour)
{
    const auto channel = [&](std::size_t digit) { return std::stoi(colour.substr(digit, 2), nullptr, 16); };
    return 299 * channel(1) + 587 * channel(3) + 114 * channel(5) < 140 * 1000;
}

/// The structure to scale, one rectangle for each block.
void draw_structure(DrawingSheet& sheet, const FallOrder& order, const TimeScale& scale)
{
    FallOrder::Place all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0, 0};
    for (const FallOrder::Place& place : order.places) {
        all.left = std::min(all.left, place.left);
        all.right = std::max(all.right, place.right);
        all.top = std::max(all.top, place.top);
    }
    const double per_metre = std::min((drawing_right - drawing_left) / (all.right - all.left),
                                      (drawing_bottom - drawing_top - ground_pixels) / all.top);
    const double middle = (drawing_left + drawing_right) / 2, ground = drawing_bottom - ground_pixels;
    const auto x = [&](double metres) { return middle + (metres - (all.left + all.right) / 2) * per_metre; };
    const auto y = [&](double metres) { return ground - metres * per_metre; };
    sheet.rectangle(drawing_left, ground, drawing_right, drawing_bottom, "#6f6f6f");
    for (std::size_t i = 0; i < order.blocks.size(); ++i) {
        const FallOrder::Place& place = order.places[i];
        const std::vector<double>& falls = order.blocks[i].fall_time_s;
        const std::string fill = falls.empty() ? "#e8e8e8" : order_colour(scale.part(sorted_median(falls)));
        sheet.rectangle(x(place.left), y(place.top), x(place.right), y(place.bottom), fill, "#303030");
        const std::string share = fmt::format("{:.0f}", 100 * fallen_share(order, falls.size()));
        const double font = std::min({25.0, 0.8 * (place.top - place.bottom) * per_metre,
                                      DrawingSheet::fitting("100", 0.9 * (place.right - place.left) * per_metre, 25)});
        if (font >= 10)
            sheet.text(share, x((place.left + place.right) / 2), y((place.bottom + place.top) / 2), font,
                       TextAt::center, falls.empty() || !is_dark(fill) ? "#000000" : "#ffffff");
    }
}

/// "first: epistyle 1 41.2 %, drum 3 of column 2 20.0 %, 5 others 38.8 %"
std::string first_words(const FallOrder& order)
{
    constexpr std::size_t most = 3;
    std::vector<std::pair<std::uint64_t, std::string>> first;
    for (const FallOrder::Block& block : order.blocks)
        if (block.first > 0)
            first.emplace_back(block.first, block.name);
    std::stable_sort(first.begin(), first.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    std::uint64_t others = 0;
    for (std::size_t k = 0; k < first.size(); ++k) {
        if (k >= most)
            others += first[k].first;
        else
            text += fmt::format("{}{} {:.1f} %", k == 0 ? "fell first: " : ", ", first[k].second,
                                100 * fallen_share(order, first[k].first));
    }
    if (others > 0)
        text += fmt::format(", {} {:.1f} %", counted(first.size() - most, "other"), 100 * fallen_share(order, others));
    return text;
}

/// The structure at rest, its blocks in the colour of the median time of their fall and with the share that fell, above
/// the curves in the same colours.
/// @param shown the blocks that fell
/// @pre order.places has one for each block
void plot_order_drawn(const FallOrder& order, const std::vector<std::size_t>& shown, double end_s,
                      const std::string& title, const std::string& note, const std::filesystem::path& file)
{
    const FigureLook look = picture_look;
    const PictureSize size;
    TimeScale scale;
    std::size_t most = 0;
    for (const std::size_t block : shown) {
        const std::vector<double>& falls = order.blocks[block].fall_time_s;
        scale.from = std::min(scale.from, sorted_median(falls));
        scale.to = std::max(scale.to, sorted_median(falls));
        most = std::max(most, falls.size());
    }
    Figure figure = curves_figure(end_s, fallen_share(order, most));
    for (const std::size_t block : shown)
        figure.series.push_back(order_curve(
            order, block, end_s, order_colour(scale.part(sorted_median(order.blocks[block].fall_time_s))), 1.3));
    const std::string subtitle =
        fmt::format("{} realizations · {} of {} blocks fell in some · in the blocks: share that "
                    "fell [%]{}{}",
                    order.trials, shown.size(), order.blocks.size(),
                    shown.size() < order.blocks.size() ? " · grey: never" : "", note.empty() ? "" : " · " + note);
    DrawingSheet sheet(size, look.letters());
    sheet.heading(title, subtitle);
    draw_structure(sheet, order, scale);
    const std::string words = first_words(order);
    sheet.text(words, (drawing_left + drawing_right) / 2, drawing_bottom + 36,
               DrawingSheet::fitting(words, drawing_right - drawing_left, 25));
    FigurePanel panel(figure, look);
    PlotFrame frame{24 + panel.room_left(), drawing_bottom + 80, 0.97 * size.width, 0};
    frame.bottom = size.height - 24 - panel.room_below(frame.right - frame.left);
    panel.draw(sheet, frame);
    PlotScale colours;
    colours.from = scale.from;
    colours.to = scale.to > scale.from ? scale.to : scale.from + 1;
    draw_colour_scale(sheet, look, {1593, drawing_top, 1626, drawing_bottom}, colours, "median time of fall [s]",
                      [&](double time_s) { return order_colour(scale.part(time_s)); });
    sheet.write(file);
}

} // namespace

std::vector<std::size_t> order_of_falls(const FallOrder& order)
{
    std::vector<std::size_t> fell;
    for (std::size_t i = 0; i < order.blocks.size(); ++i)
        if (!order.blocks[i].fall_time_s.empty())
            fell.push_back(i);
    std::stable_sort(fell.begin(), fell.end(), [&](std::size_t a, std::size_t b) {
        return sorted_median(order.blocks[a].fall_time_s) < sorted_median(order.blocks[b].fall_time_s);
    });
    return fell;
}

void plot_order(const FallOrder& order, const std::string& title, const std::string& note,
                const std::filesystem::path& png)
{
    std::vector<std::size_t> shown = order_of_falls(order);
    if (shown.empty())
        throw InputError(fmt::format("no block fell in {} valid realizations: there is no order of falls to draw.\n  "
                                     "Draw the strip of one realization (--picture strip), or increase the shaking.",
                                     order.trials));
    double last = 0;
    for (const std::size_t block : shown)
        last = std::max(last, order.blocks[block].fall_time_s.back());
    const double end_s = last > 0 ? std::max(1.06 * last, std::min(order.end_time_s, 1.15 * last)) : 1;
    if (shown.size() > most_listed && order.places.size() == order.blocks.size())
        return plot_order_drawn(order, shown, end_s, title, note, png);

    std::vector<std::size_t> others;
    if (shown.size() > most_curves) {
        std::vector<std::size_t> by_share = shown;
        std::stable_sort(by_share.begin(), by_share.end(), [&](std::size_t a, std::size_t b) {
            return order.blocks[a].fall_time_s.size() > order.blocks[b].fall_time_s.size();
        });
        others.assign(by_share.begin() + most_curves, by_share.end());
        std::erase_if(
            shown, [&](std::size_t block) { return std::find(others.begin(), others.end(), block) != others.end(); });
    }
    std::size_t most = 0;
    for (const std::size_t block : shown)
        most = std::max(most, order.blocks[block].fall_time_s.size());
    Figure figure = curves_figure(end_s, fallen_share(order, most));
    for (const std::size_t block : others)
        figure.series.push_back(order_curve(order, block, end_s, "#b0b0b0", 0.7));
    for (std::size_t k = 0; k < shown.size(); ++k)
        figure.series.push_back(order_curve(order, shown[k], end_s, colour(k, shown.size()), 1.5));

    const FigureLook look = picture_look;
    const PictureSize size;
    DrawingSheet sheet(size, look.letters());
    const std::string below_title =
        fmt::format("{} realizations · {} of {} blocks fell in some · in brackets: {}", order.trials,
                    shown.size() + others.size(), order.blocks.size(), describe_interval(order.interval));
    FigurePanel panel(figure, look);
    PlotFrame frame{24 + panel.room_left(), sheet.heading(title, below_title), 990, 0};
    if (!note.empty())
        sheet.text(note, size.width / 2.0, frame.top + 10, DrawingSheet::fitting(note, 0.95 * size.width, 25),
                   TextAt::center, "#505050");
    frame.top += 50;
    frame.bottom = size.height - 24 - panel.room_below(frame.right - frame.left);
    panel.draw(sheet, frame);
    draw_table(sheet, order, shown, others.size());
    sheet.write(png);
}

} // namespace stylobate

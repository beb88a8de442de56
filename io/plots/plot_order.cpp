#include "io/plots/plot_order.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/store/surface_axis.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
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

/// The block's curve as data, $blockN: from 0 to the end of the axis, one step for each fall.
std::string order_curve(const FallOrder& order, std::size_t block, double end_s)
{
    const std::vector<double>& falls = order.blocks[block].fall_time_s;
    const std::size_t stride = falls.size() / most_steps + 1;
    std::string data = fmt::format("$block{} << EOD\n0 0\n", block);
    for (std::size_t k = 0; k < falls.size(); k += stride) {
        const std::size_t last = std::min(k + stride, falls.size()) - 1; // of the falls that this step takes together
        fmt::format_to(std::back_inserter(data), "{} {}\n", falls[last], fallen_share(order, last + 1));
    }
    return data + fmt::format("{} {}\nEOD\n", end_s, fallen_share(order, falls.size()));
}

/// The frame of the curves, whose right and upper edges are given.
std::string curves_frame(double right, double top, double end_s, double most_share)
{
    return fmt::format(
        "set lmargin at screen 0.085\nset rmargin at screen {}\nset bmargin at screen 0.1\nset tmargin at screen "
        "{:.5f}\nunset key\nset border 3 linewidth 0.8\nset tics out nomirror\n"
        "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n"
        "set xrange [0:{}]\nset yrange [0:{}]\nset format y '%g'\n"
        "set xlabel 'time [s]' offset 0,-0.1\nset ylabel 'share of realizations with the block fallen' offset 0.6,0\n",
        right, top, end_s, 1.01 * std::min(1.0, 1.1 * most_share));
}

/// Colour of the k-th of n curves.
std::string colour(std::size_t k, std::size_t n)
{
    return order_colour(n > 1 ? static_cast<double>(k) / static_cast<double>(n - 1) : 0.0);
}

/// Where the columns of the table are, in parts of the picture's width.
struct Columns {
    double line = 0.573;
    double name = 0.605;
    double fallen = 0.87;
    double median = 0.929;
    double first = 0.987;
};

std::string cell(const std::string& text, double x, double y, const char* side, double font)
{
    return fmt::format("set label {} at screen {}, screen {} {} font ',{:.1f}'\n", gnuplot_text(text), x, y, side,
                       font);
}

std::string table(const FallOrder& order, const std::vector<std::size_t>& shown, std::size_t others)
{
    const Columns at;
    const double top = 0.83;
    const double rows = static_cast<double>(shown.size()) + (others > 0 ? 2 : 1);
    const double step = std::min(0.037, 0.735 / rows);
    std::size_t longest = 1;
    for (const std::size_t block : shown)
        longest = std::max(longest, order.blocks[block].name.size());
    const double font = std::min({17.0, 17.0 * step / 0.029, 17.0 * 18 / static_cast<double>(longest)});
    std::string script = cell("block", at.name, top, "left", font) + cell("fallen", at.fallen, top, "right", font) +
                         cell("median", at.median, top, "right", font) + cell("first", at.first, top, "right", font);
    double y = top - 1.15 * step;
    for (std::size_t k = 0; k < shown.size(); ++k, y -= step) {
        const FallOrder::Block& block = order.blocks[shown[k]];
        script += fmt::format("set arrow from screen {}, screen {} to screen {}, screen {} nohead linewidth 2.4 "
                              "linecolor rgb '{}'\n",
                              at.line, y, at.line + 0.024, y, colour(k, shown.size()));
        script += cell(block.name, at.name, y, "left", font);
        script += cell(fmt::format("{:.1f} % ({:.0f} to {:.0f})", 100 * fallen_share(order, block.fall_time_s.size()),
                                   100 * block.lower, 100 * block.upper),
                       at.fallen, y, "right", font);
        script += cell(fmt::format("{:.2f} s", sorted_median(block.fall_time_s)), at.median, y, "right", font);
        script += cell(fmt::format("{:.1f} %", 100 * fallen_share(order, block.first)), at.first, y, "right", font);
    }
    if (others > 0) {
        script += fmt::format("set arrow from screen {}, screen {} to screen {}, screen {} nohead linewidth 1.2 "
                              "linecolor rgb '#b0b0b0'\n",
                              at.line, y, at.line + 0.024, y);
        script += cell(fmt::format("{}, less frequent", counted(others, "other")), at.name, y, "left", font);
    }
    return script;
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
std::string drawing_script(const FallOrder& order, const TimeScale& scale, PictureSize size)
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
    const auto x = [&](double metres) {
        return (middle + (metres - (all.left + all.right) / 2) * per_metre) / size.width;
    };
    const auto y = [&](double metres) { return 1 - (ground - metres * per_metre) / size.height; };

    int object = 0;
    std::string script;
    const auto rectangle = [&](double left, double right, double bottom, double top, const std::string& fill,
                               const char* border) {
        script +=
            fmt::format("set object {} rectangle from screen {:.5f}, screen {:.5f} to screen {:.5f}, screen {:.5f} "
                        "fillcolor rgb '{}' fillstyle solid 1 {}\n",
                        ++object, left, bottom, right, top, fill, border);
    };
    rectangle(drawing_left / size.width, drawing_right / size.width, 1 - drawing_bottom / size.height,
              1 - ground / size.height, "#6f6f6f", "noborder");
    for (std::size_t i = 0; i < order.blocks.size(); ++i) {
        const FallOrder::Place& place = order.places[i];
        const std::vector<double>& falls = order.blocks[i].fall_time_s;
        const std::string fill = falls.empty() ? "#e8e8e8" : order_colour(scale.part(sorted_median(falls)));
        rectangle(x(place.left), x(place.right), y(place.bottom), y(place.top), fill,
                  "border linecolor rgb '#303030' linewidth 0.5");
        const double room = std::min((place.top - place.bottom) * per_metre / 1.5,
                                     (place.right - place.left) * per_metre / 2.6); // for a percentage of two digits
        if (const double font = std::min(19.0, room); font >= 8)
            script += fmt::format(
                "set label '{:.0f}' at screen {:.5f}, screen {:.5f} center front font ',{:.1f}' textcolor "
                "rgb '{}'\n",
                100 * fallen_share(order, falls.size()), (x(place.left) + x(place.right)) / 2,
                (y(place.bottom) + y(place.top)) / 2, font, falls.empty() || !is_dark(fill) ? "#000000" : "#ffffff");
    }
    return script;
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
    const PictureSize size;
    TimeScale scale;
    std::size_t most = 0;
    for (const std::size_t block : shown) {
        const std::vector<double>& falls = order.blocks[block].fall_time_s;
        scale.from = std::min(scale.from, sorted_median(falls));
        scale.to = std::max(scale.to, sorted_median(falls));
        most = std::max(most, falls.size());
    }
    std::string data, curves;
    for (const std::size_t block : shown) {
        data += order_curve(order, block, end_s);
        const double time_s = sorted_median(order.blocks[block].fall_time_s);
        curves += fmt::format(", $block{} with steps linecolor rgb '{}' linewidth 1.3", block,
                              order_colour(scale.part(time_s)));
    }
    std::string palette;
    for (int k = 0; k <= 20; ++k)
        palette += fmt::format("{}{} '{}'", k > 0 ? ", " : "", k, order_colour(k / 20.0));

    const std::string subtitle =
        fmt::format("{} realizations · {} of {} blocks fell in some · in the blocks: share that "
                    "fell [%]{}{}",
                    order.trials, shown.size(), order.blocks.size(),
                    shown.size() < order.blocks.size() ? " · grey: never" : "", note.empty() ? "" : " · " + note);
    std::string script = data + gnuplot_heading(title, subtitle, size) + drawing_script(order, scale, size);
    script += "set label " + gnuplot_text(first_words(order)) +
              fmt::format(" at screen {:.5f}, screen {:.5f} center font ',19'\n",
                          (drawing_left + drawing_right) / 2 / size.width, 1 - (drawing_bottom + 40) / size.height);
    script += curves_frame(0.97, 1 - (drawing_bottom + 80) / size.height, end_s, fallen_share(order, most));
    script +=
        "set palette defined (" + palette + ")\n" +
        fmt::format("set cbrange [{}:{}]\nset cblabel 'median time of fall [s]' offset 0.6,0\nset cbtics font "
                    "',18'\nset colorbox user origin screen 0.885, screen {:.5f} size screen 0.018, screen {:.5f}\n",
                    scale.from, scale.to > scale.from ? scale.to : scale.from + 1, 1 - drawing_bottom / size.height,
                    (drawing_bottom - drawing_top) / size.height);
    // the box of colours stands only beside something that uses it
    run_gnuplot(script + "plot '+' using 1:(1/0):1 with points linecolor palette" + curves, size, file);
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
    std::string data;
    std::string curves;
    const auto add = [&](std::size_t block, const std::string& rgb, double width) {
        data += order_curve(order, block, end_s);
        curves += fmt::format("{}$block{} with steps linecolor rgb '{}' linewidth {}", curves.empty() ? "" : ", ",
                              block, rgb, width);
    };
    for (const std::size_t block : others)
        add(block, "#b0b0b0", 0.7);
    for (std::size_t k = 0; k < shown.size(); ++k)
        add(shown[k], colour(k, shown.size()), 1.5);

    std::size_t most = 0;
    for (const std::size_t block : shown)
        most = std::max(most, order.blocks[block].fall_time_s.size());
    const std::string below_title =
        fmt::format("{} realizations · {} of {} blocks fell in some · in brackets: {}", order.trials,
                    shown.size() + others.size(), order.blocks.size(), describe_interval(order.interval));
    std::string script = data + gnuplot_heading(title, below_title) + table(order, shown, others.size());
    if (!note.empty())
        script += fmt::format("set label {} at screen 0.5, screen 0.873 center font ',19' textcolor rgb '#505050'\n",
                              gnuplot_text(note));
    script += curves_frame(0.55, 0.845, end_s, fallen_share(order, most));
    run_gnuplot(script + "plot " + curves, PictureSize{}, png);
}

} // namespace stylobate

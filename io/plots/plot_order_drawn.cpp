#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/plots/plot_order_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace stylobate {
namespace {

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

} // namespace

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
    script += fmt::format(
        "set lmargin at screen 0.085\nset rmargin at screen 0.97\nset bmargin at screen 0.1\nset tmargin "
        "at screen {:.5f}\nunset key\nset border 3 linewidth 0.8\nset tics out nomirror\n"
        "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n"
        "set xrange [0:{}]\nset yrange [0:{}]\nset format y '%g'\n"
        "set xlabel 'time [s]' offset 0,-0.1\nset ylabel 'share of realizations with the block fallen' offset 0.6,0\n",
        1 - (drawing_bottom + 80) / size.height, end_s, 1.01 * std::min(1.0, 1.1 * fallen_share(order, most)));
    script +=
        "set palette defined (" + palette + ")\n" +
        fmt::format("set cbrange [{}:{}]\nset cblabel 'median time of fall [s]' offset 0.6,0\nset cbtics font "
                    "',18'\nset colorbox user origin screen 0.885, screen {:.5f} size screen 0.018, screen {:.5f}\n",
                    scale.from, scale.to > scale.from ? scale.to : scale.from + 1, 1 - drawing_bottom / size.height,
                    (drawing_bottom - drawing_top) / size.height);
    // the box of colours stands only beside something that uses it
    run_gnuplot(script + "plot '+' using 1:(1/0):1 with points linecolor palette" + curves, size, file);
}

} // namespace stylobate

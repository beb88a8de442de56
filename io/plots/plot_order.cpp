#include "io/plots/plot_order.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/plots/plot_order_parts.hpp"
#include "io/plots/plot_surface.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <numeric>

namespace stylobate {
namespace {

constexpr std::size_t most_curves = 24;  ///< with a colour and a line of the table each
constexpr std::size_t most_steps = 1000; ///< of one curve: more cannot be distinguished

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

} // namespace

double fallen_share(const FallOrder& order, std::uint64_t count)
{
    return order.trials > 0 ? static_cast<double>(count) / static_cast<double>(order.trials) : 0.0;
}

std::string order_colour(double part)
{
    const double position = 0.88 * part * static_cast<double>(viridis.size() - 1);
    const auto low = static_cast<std::size_t>(position);
    const double rest = position - static_cast<double>(low);
    const auto channel = [&](std::size_t digit) {
        const auto value = [&](std::size_t i) {
            return static_cast<double>(std::stoi(std::string(viridis[i]).substr(digit, 2), nullptr, 16));
        };
        return static_cast<int>(std::lround((1 - rest) * value(low) + rest * value(low + 1)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", channel(1), channel(3), channel(5));
}

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
    const double top = std::min(1.0, 1.1 * fallen_share(order, most));
    const std::string below_title =
        fmt::format("{} realizations · {} of {} blocks fell in some · in brackets: {}", order.trials,
                    shown.size() + others.size(), order.blocks.size(), describe_interval(order.interval));
    std::string script = data + gnuplot_heading(title, below_title) + table(order, shown, others.size());
    if (!note.empty())
        script += fmt::format("set label {} at screen 0.5, screen 0.873 center font ',19' textcolor rgb '#505050'\n",
                              gnuplot_text(note));
    script += fmt::format(
        "set lmargin at screen 0.085\nset rmargin at screen 0.55\n"
        "set bmargin at screen 0.1\nset tmargin at screen 0.845\nunset key\n"
        "set border 3 linewidth 0.8\nset tics out nomirror\n"
        "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n"
        "set xrange [0:{}]\nset yrange [0:{}]\nset format y '%g'\n"
        "set xlabel 'time [s]' offset 0,-0.1\nset ylabel 'share of realizations with the block fallen' offset 0.6,0\n",
        end_s, 1.01 * top);
    run_gnuplot(script + "plot " + curves, PictureSize{}, png);
}

} // namespace stylobate

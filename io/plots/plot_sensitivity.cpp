#include "io/plots/plot_sensitivity.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/store/surface_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace stylobate {
namespace {

struct Bars {
    const char* index; ///< name in the table
    const char* says;
    const char* colour;
};
constexpr std::array<Bars, 3> of_sobol{{{"first", "alone (first index)", "#0072b2"},
                                        {"total", "with its interactions (total index)", "#e69f00"},
                                        {"value_total", "of single outcomes (total index)", "#999999"}}};
constexpr std::array<Bars, 2> of_morris{{{"mu_star", "mu*", "#999999"}, {"rms", "rms, without noise", "#0072b2"}}};

constexpr std::size_t columns = 2;

std::string spoken(std::string name)
{
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

/// The bars of one outcome as data: place, value, ends of the interval.
std::string data_of(const SensitivityTable& table, std::size_t outcome, const std::vector<Bars>& bars, double width)
{
    std::string data;
    const std::size_t n = table.factors.size();
    for (std::size_t b = 0; b < bars.size(); ++b) {
        data += fmt::format("$bars{}_{} << EOD\n", outcome, b);
        const IntervalArray& of = table.find(bars[b].index)->of;
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t i = outcome * n + k;
            if (!std::isfinite(of.value[i]))
                continue;
            const double place =
                static_cast<double>(k) + width * (static_cast<double>(b) - static_cast<double>(bars.size() - 1) / 2);
            data += fmt::format("{} {} {} {}\n", place, of.value[i], of.lower[i], of.upper[i]);
        }
        data += "EOD\n";
    }
    return data;
}

} // namespace

void plot_sensitivity(const SensitivityTable& table, const std::string& title, const std::filesystem::path& png)
{
    if (table.empty())
        throw InputError("there are no sensitivities to draw");
    const bool sobol = table.method == "sobol";
    std::vector<Bars> bars(of_morris.begin(), of_morris.end());
    if (sobol)
        bars.assign(of_sobol.begin(), of_sobol.end() - (table.inner > 1 ? 0 : 1));
    const double width = 0.8 / static_cast<double>(bars.size());
    const std::size_t n = table.factors.size(), outcomes = table.outcomes.size();
    const std::size_t lines = (outcomes + columns - 1) / columns;

    std::string script;
    for (std::size_t o = 0; o < outcomes; ++o)
        script += data_of(table, o, bars, width);
    script += "set multiplot\n" +
              gnuplot_heading(title, fmt::format("{} rows · bars: {}", table.rows, describe_interval(table.interval))) +
              fmt::format("set border 3 linewidth 0.8\nset tics out nomirror\nset grid ytics linecolor rgb '#dddddd' "
                          "linetype 1 linewidth 0.5\nset boxwidth {}\nset style fill solid 0.9 noborder\nunset key\n"
                          "set xrange [-0.6:{}]\n",
                          width * 0.92, static_cast<double>(n) - 0.4);
    if (sobol)
        script += "set yrange [-0.03:1.03]\nset ytics 0,0.2,1 format '%.1f'\n";
    for (std::size_t b = 0; b < bars.size(); ++b)
        script += fmt::format("set label {} at screen {}, screen 0.872 center font ',17' textcolor rgb '{}'\n",
                              gnuplot_text(std::string("■ ") + bars[b].says),
                              (static_cast<double>(b) + 0.5) / static_cast<double>(bars.size()), bars[b].colour);
    std::string tics;
    for (std::size_t k = 0; k < n; ++k)
        tics += fmt::format("{}{} {}", k > 0 ? ", " : "", gnuplot_text(spoken(table.factors[k])), k);
    for (std::size_t o = 0; o < outcomes; ++o) {
        const double left = 0.075 + 0.485 * static_cast<double>(o % columns);
        const double height = 0.84 / static_cast<double>(lines);
        const double top = 0.84 - height * static_cast<double>(o / columns);
        script += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\n"
                              "set bmargin at screen {}\nset xtics ({}) rotate by 35 right font ',17'\n",
                              left, left + 0.42, top - 0.03, top - height + 0.135, tics);
        script += "set title " +
                  gnuplot_text(spoken(table.outcomes[o]) +
                               (sobol || table.units[o].empty() ? "" : " [" + table.units[o] + "]")) +
                  " font ',22' offset 0,-0.6\n";
        std::string plot;
        for (std::size_t b = 0; b < bars.size(); ++b)
            plot += fmt::format("{}$bars{}_{} using 1:2 with boxes linecolor rgb '{}'", b > 0 ? ", " : "plot ", o, b,
                                bars[b].colour);
        for (std::size_t b = 0; b < bars.size(); ++b)
            plot += fmt::format(", $bars{}_{} using 1:3:(0):($4-$3) with vectors nohead linecolor rgb '#303030' "
                                "linewidth 1.2",
                                o, b);
        script += plot + "\nunset label\n";
    }
    run_gnuplot(script + "unset multiplot\n", PictureSize{}, png);
}

} // namespace stylobate

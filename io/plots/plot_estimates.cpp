#include "io/plots/plot_estimates.hpp"

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

constexpr std::array<const char*, 7> colours{"#404040", "#0072b2", "#d55e00", "#009e73",
                                             "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array<int, 7> symbols{7, 5, 9, 13, 11, 15, 4};

} // namespace

void plot_shares(const SharePicture& picture, const std::filesystem::path& png)
{
    if (picture.series.size() > colours.size())
        throw InputError(
            fmt::format("{} series are too many for one picture, which has {}", picture.series.size(), colours.size()));
    double low = INFINITY, high = 0;
    std::string data, plot;
    for (std::size_t k = 0; k < picture.series.size(); ++k) {
        const ShareSeries& s = picture.series[k];
        // one hundredth of the value between neighbours, so that bars do not hide each other
        const double apart =
            std::pow(1.01, static_cast<double>(k) - static_cast<double>(picture.series.size() - 1) / 2);
        data += fmt::format("$series{} << EOD\n", k);
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            low = std::min(low, s.x[i]);
            high = std::max(high, s.x[i]);
            if (std::isfinite(s.share[i]))
                data += fmt::format("{} {} {} {}\n", s.x[i] * apart, s.share[i], s.lower[i], s.upper[i]);
        }
        data += "EOD\n";
        plot +=
            fmt::format("{}$series{} using 1:2 with lines linecolor rgb '{}' linewidth 1.6 notitle, $series{} using "
                        "1:2:3:4 with yerrorbars linecolor rgb '{}' linewidth 1.2 pointtype {} pointsize 1.4 title "
                        "{}",
                        k > 0 ? ", " : "", k, colours[k], k, colours[k], symbols[k], gnuplot_text(s.name));
    }
    if (!(low <= high))
        throw InputError("there is nothing to draw: no share at any intensity");
    const std::string script =
        data + gnuplot_heading(picture.title, picture.subtitle) +
        fmt::format("set logscale x\nset xrange [{}:{}]\n", low * 0.93, high * 1.07) +
        "set xtics (.01,.02,.05,.1,.2,.3,.5,.7,1,1.5,2,3,5,7,10,15,20,30,50,100)\n"
        "set lmargin at screen 0.1\nset rmargin at screen 0.97\nset bmargin at screen 0.2\nset tmargin at screen "
        "0.88\n"
        "set border 3 linewidth 0.8\nset tics out nomirror\nset grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n"
        "set key vertical maxrows 2 center bottom at screen 0.535, screen 0.01 samplen 2\n"
        "set xlabel " +
        gnuplot_text(picture.x_label) + " offset 0,-0.2\nset ylabel " + gnuplot_text(picture.y_label) +
        "\nset yrange [-0.015:1.015]\nset ytics 0,0.1,1 format '%.1f'\nplot " + plot;
    run_gnuplot(script, PictureSize{}, png);
}

namespace {

/// The whole decade below.
double decade_below(double p)
{
    return std::pow(10.0, std::floor(std::log10(p) - 1e-9));
}

std::string subtitle(const RareTable& table, std::size_t none)
{
    std::string text = "no repeat reached a collapse";
    if (std::isfinite(table.probability))
        text =
            fmt::format("probability of collapse {:.3g}{}", table.probability,
                        std::isfinite(table.lower) ? fmt::format(" ({:.2g} to {:.2g}, 95 %)", table.lower, table.upper)
                                                   : ", without an interval");
    text += fmt::format(" · {} repeats, {} realizations", table.repeats.size(), table.realizations);
    if (none > 0 && none < table.repeats.size())
        text += fmt::format(" · {} of {} repeats without a collapse, counted as 0", none, table.repeats.size());
    return text;
}

constexpr const char* chain_colour = "#56b4e9";
constexpr const char* mean_colour = "#d55e00";

/// The thresholds of all repeats, over the displacement.
std::string chains_panel(const std::vector<RareChain>& chains, double per_metre, double most_m)
{
    std::string script, plot;
    for (std::size_t r = 0; r < chains.size(); ++r) {
        script += fmt::format("$chain{} << EOD\n", r);
        for (std::size_t l = 0; l < chains[r].threshold_m.size(); ++l)
            script += fmt::format("{} {}\n", chains[r].threshold_m[l] * per_metre, chains[r].probability[l]);
        script += "EOD\n";
        if (!chains[r].threshold_m.empty())
            plot +=
                fmt::format("{}$chain{} with linespoints linecolor rgb '{}' linewidth 0.8 pointtype 7 pointsize 0.9",
                            plot.empty() ? "" : ", ", r, chain_colour);
    }
    script += fmt::format("set lmargin at screen 0.125\nset rmargin at screen 0.745\nset border 3 linewidth 0.8\n"
                          "set xrange [0:{}]\nset xlabel 'largest displacement of the centre of the top block [{}]'\n"
                          "set ylabel 'probability of exceedance' offset 0.5,0\nplot {}\nunset label\n",
                          1.05 * most_m * per_metre, per_metre > 1 ? "mm" : "m", plot.empty() ? "1/0" : plot);
    return script;
}

/// What each repeat came to, and their mean with its interval.
std::string collapse_panel(const RareTable& table, double foot)
{
    std::string script = "$each << EOD\n";
    const auto n = static_cast<double>(table.repeats.size());
    for (std::size_t r = 0; r < table.repeats.size(); ++r)
        if (table.repeats[r] > 0)
            script += fmt::format("{} {}\n", -0.5 + 0.4 * (static_cast<double>(r) + 0.5) / n, table.repeats[r]);
    script += "EOD\n$mean << EOD\n";
    const bool known = std::isfinite(table.probability) && table.probability > 0;
    if (known)
        script += std::isfinite(table.lower)
                      ? fmt::format("0.3 {} {} {}\n", table.probability, std::max(table.lower, foot), table.upper)
                      : fmt::format("0.3 {0} {0} {0}\n", table.probability);
    script += "EOD\nset lmargin at screen 0.795\nset rmargin at screen 0.97\nset border 1 linewidth 0.8\n"
              "set xrange [-0.7:0.7]\nunset ylabel\nset format y ''\nset ytics scale 0\n"
              "set xtics ('repeats' -0.3, 'mean' 0.3) scale 0\nset xlabel 'collapse'\n";
    script += fmt::format("plot $each with points pointtype 7 pointsize 1.2 linecolor rgb '{}'", chain_colour);
    if (known)
        script += fmt::format(", $mean with yerrorbars pointtype 5 pointsize 1.6 linewidth 1.6 linecolor rgb '{}'",
                              mean_colour);
    return script + "\n";
}

} // namespace

RareChain rare_chain(const RareTable& table, std::size_t repeat)
{
    RareChain chain;
    double p = 1;
    for (std::size_t l = 0; l < table.levels; ++l) {
        const std::size_t i = repeat * table.levels + l;
        if (l > 0 && std::isfinite(table.threshold_m[i]) && p > 0) {
            chain.threshold_m.push_back(table.threshold_m[i]);
            chain.probability.push_back(p);
        }
        if (!std::isfinite(table.share[i]))
            break;
        p *= table.share[i];
    }
    return chain;
}

void plot_rare(const RareTable& table, const std::string& title, const std::filesystem::path& png)
{
    if (table.empty())
        throw InputError("there is no rare event to draw");
    std::vector<RareChain> chains;
    double least = 0.1, most_m = 0;
    const auto take = [&](double p) {
        if (p > 0) // of NaN too nothing
            least = std::min(least, p);
    };
    for (std::size_t r = 0; r < table.repeats.size(); ++r) {
        chains.push_back(rare_chain(table, r));
        for (const double p : chains.back().probability)
            take(p);
        for (const double x : chains.back().threshold_m)
            most_m = std::max(most_m, x);
        take(table.repeats[r]);
    }
    take(table.lower);
    if (!(most_m > 0))
        most_m = 1;
    const double foot = decade_below(least);
    const auto none = static_cast<std::size_t>(std::count(table.repeats.begin(), table.repeats.end(), 0.0));
    std::string script = "set multiplot\nunset key\n" + gnuplot_heading(title, subtitle(table, none));
    script += fmt::format("set bmargin at screen 0.13\nset tmargin at screen 0.87\nset tics out nomirror\n"
                          "set logscale y\nset yrange [{}:1]\nset format y '%.0e'\n"
                          "set grid ytics linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n",
                          foot);
    script += chains_panel(chains, most_m < 1 ? 1000 : 1, most_m) + collapse_panel(table, foot) + "unset multiplot\n";
    run_gnuplot(script, PictureSize{}, png);
}

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

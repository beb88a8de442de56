#include "io/plots/plot_rare.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
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

} // namespace stylobate

#include "io/plots/plot_shares.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::array<const char*, 7> colours{"#404040", "#0072b2", "#d55e00", "#009e73",
                                             "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array<int, 7> points{7, 5, 9, 13, 11, 15, 4};

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
                        k > 0 ? ", " : "", k, colours[k], k, colours[k], points[k], gnuplot_text(s.name));
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

} // namespace stylobate

#include "io/plots/gnuplot.hpp"
#include "studies/decisions/search/search.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

constexpr const char* line_colour = "#0072b2";
constexpr const char* set_colour = "#009e73";
constexpr const char* point_colour = "#d55e00";

/// The points of a search of one key, with the intervals of their own.
std::string points_block(const SearchResult& r)
{
    std::string data = "$points << EOD\n";
    for (const SearchedPoint& p : r.points)
        data += r.is_frequency()
                    ? fmt::format("{} {} {} {}\n", p.value[0], p.frequency.value, p.frequency.fragility.lower,
                                  p.frequency.fragility.upper)
                    : fmt::format("{} {} {} {}\n", p.value[0], p.share.probability, p.share.lower, p.share.upper);
    return data + "EOD\n";
}

/// Commands of the panel of one key.
std::string panel(const SearchResult& r, std::size_t k, double most)
{
    const SearchSlice& slice = r.slices[k];
    const SearchedKey& key = r.asked.keys[k];
    const double width = 0.86 / static_cast<double>(r.slices.size()), left = 0.11 + width * static_cast<double>(k);
    std::string script = fmt::format("$slice{} << EOD\n", k);
    for (std::size_t i = 0; i < slice.x.size(); ++i)
        script += fmt::format("{} {} {} {}\n", slice.x[i], slice.value[i], slice.lower[i], slice.upper[i]);
    script += fmt::format("EOD\nset lmargin at screen {}\nset rmargin at screen {}\n", left, left + width - 0.03);
    script += key.spacing == Spacing::log ? "set logscale x\n" : "unset logscale x\n";
    script += fmt::format("set xrange [{}:{}]\nset yrange [0:{}]\nset xlabel {}\n", key.from, key.to, most,
                          gnuplot_text(key.key));
    script += k == 0 ? fmt::format("set format y '%g'\nset ylabel {}\n",
                                   gnuplot_text(r.asked.minimise + (r.is_frequency() ? " [1/year]" : ", probability")))
                     : std::string("set format y ''\nunset ylabel\n");
    script += fmt::format("set object 1 rectangle from {},graph 0 to {},graph 1 behind fillcolor rgb '{}' fillstyle "
                          "transparent solid 0.15 noborder\nset arrow 1 from {},graph 0 to {},graph 1 nohead linecolor "
                          "rgb '{}' linewidth 1 dashtype 2\n",
                          r.flat_from[k], r.flat_to[k], set_colour, r.best[k], r.best[k], set_colour);
    script +=
        fmt::format("plot $slice{0} using 1:3:4 with filledcurves fillcolor rgb '{1}' fillstyle transparent solid "
                    "0.2 noborder, $slice{0} using 1:2 with lines linecolor rgb '{1}' linewidth 2",
                    k, line_colour);
    if (r.slices.size() == 1)
        script += fmt::format(", $points using 1:2:3:4 with yerrorbars linecolor rgb '{}' linewidth 0.9 pointtype 7 "
                              "pointsize 0.8",
                              point_colour);
    return script + "\n";
}

} // namespace

void plot_search(const SearchResult& r, const std::filesystem::path& picture)
{
    double most = 0;
    for (const SearchSlice& slice : r.slices)
        most = std::max(most, *std::max_element(slice.upper.begin(), slice.upper.end()));
    const std::string said =
        fmt::format("surface through the best place and its {:g} % interval{}; shaded: not shown to be worse",
                    100 * r.level, r.slices.size() == 1 ? ", points with their own" : "");
    std::string script =
        points_block(r) +
        gnuplot_heading(fmt::format("{}, {} points",
                                    r.is_frequency() ? "Annual frequency of " + r.asked.minimise
                                                     : "Probability of " + r.asked.minimise,
                                    r.points.size()),
                        said) +
        "set border 3 linewidth 0.8\nset tics out nomirror\nset grid linecolor rgb '#dddddd' linetype 1 "
        "linewidth 0.5\nunset key\nset tmargin at screen 0.85\nset bmargin at screen 0.16\nset "
        "multiplot\n";
    for (std::size_t k = 0; k < r.slices.size(); ++k) {
        script += panel(r, k, 1.05 * most);
        script += "unset title\nunset label\n";
    }
    run_gnuplot(script + "unset multiplot\n", PictureSize{}, picture);
}

} // namespace stylobate

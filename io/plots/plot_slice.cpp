#include "io/plots/plot_slice.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/gnuplot.hpp"
#include "io/store/surface_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace stylobate {
namespace {

/// Okabe and Ito's colours, told apart by the colour-blind, and a point type each.
struct CurveStyle {
    const char* colour;
    int point;
};
constexpr std::array<CurveStyle, 6> styles{
    {{"#0072b2", 7}, {"#d55e00", 5}, {"#009e73", 9}, {"#cc79a7", 11}, {"#e69f00", 13}, {"#56b4e9", 15}}};

} // namespace

std::vector<std::size_t> slice_rows(const SurfaceTable& surface, const std::vector<double>& frequencies_hz)
{
    const CellAxis axis = make_cell_axis(surface.frequency_hz, "frequency_hz");
    const std::size_t count = axis.values.size();
    if (frequencies_hz.size() > styles.size())
        throw InputError(fmt::format("{} frequencies are too many for one picture of slices.\n  Name 1 to {} of them.",
                                     frequencies_hz.size(), styles.size()));
    std::set<std::size_t> rows;
    if (frequencies_hz.empty())
        for (std::size_t k = 1; k <= 3; ++k)
            rows.insert((2 * k - 1) * count / 6);
    for (const double asked : frequencies_hz) {
        constexpr double rounding = 1e-6; // of a frequency that is typed with fewer digits than the axis has
        if (!(asked >= axis.values.front() * (1 - rounding) && asked <= axis.values.back() * (1 + rounding)))
            throw InputError(
                fmt::format("--frequency {}: is beyond the frequencies of the surface.\n  Name one from {} "
                            "to {} Hz.",
                            asked, axis.values.front(), axis.values.back()));
        rows.insert(axis.nearest(asked));
    }
    return {rows.begin(), rows.end()};
}

void plot_slice(const SurfaceTable& surface, const std::vector<double>& frequencies_hz, const std::string& limit,
                const std::string& title, const std::filesystem::path& png)
{
    const std::string below_title =
        describe_realizations(surface) + " · bars and bands: " + describe_interval(surface.interval);
    const std::vector<std::size_t> rows = slice_rows(surface, frequencies_hz);
    const CellAxis pga = make_cell_axis(surface.pga_m_s2, "pga_m_s2");
    const std::size_t np = pga.values.size();

    // Curves that coincide must all be seen: each is thinner than those drawn before it, and its points with their bars
    // stand a little beside those of the others.
    double apart = pga.scaled(pga.edges.back()) - pga.scaled(pga.edges.front());
    for (std::size_t j = 1; j < np; ++j)
        apart = std::min(apart, pga.scaled(pga.values[j]) - pga.scaled(pga.values[j - 1]));
    const double step = std::min(0.1 * apart, 0.007 * (pga.scaled(pga.edges.back()) - pga.scaled(pga.edges.front())));
    const auto beside = [&](double value, std::size_t k) {
        const double place = static_cast<double>(k) - static_cast<double>(rows.size() - 1) / 2;
        return pga.unscaled(pga.scaled(value) + place * step);
    };
    const double thicker = std::min(1.6, 6.0 / std::max(1.0, static_cast<double>(rows.size() - 1)));
    std::string data;
    std::string bands;
    std::string curves;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double wider = static_cast<double>(rows.size() - 1 - k);
        data += fmt::format("$slice{} << EOD\n", k);
        std::size_t points = 0;
        for (std::size_t j = 0; j < np; ++j) {
            const std::size_t cell = rows[k] * np + j;
            if (std::isfinite(surface.probability[cell])) {
                data += fmt::format("{} {} {} {} {}\n", pga.values[j], surface.probability[cell], surface.lower[cell],
                                    surface.upper[cell], beside(pga.values[j], k));
                ++points;
            } else {
                data += '\n'; // a gap in the curve
            }
        }
        data += "EOD\n";
        if (points == 0)
            continue;
        const CurveStyle& style = styles[k];
        bands += fmt::format("{}$slice{} using 1:3:4 with filledcurves fillcolor rgb '{}' fillstyle transparent solid "
                             "0.2 noborder notitle",
                             bands.empty() ? "" : ", ", k, style.colour);
        curves +=
            fmt::format(", $slice{0} using 1:2 with lines linecolor rgb '{1}' linewidth {4:.1f} notitle"
                        ", $slice{0} using 5:2:3:4 with yerrorbars linecolor rgb '{1}' linewidth 0.9 pointtype {2} "
                        "pointsize 1.3 title '{3:.3g} Hz'",
                        k, style.colour, style.point, surface.frequency_hz[rows[k]], 1.4 + thicker * wider);
    }
    const std::string script =
        data + gnuplot_heading(title, below_title) + gnuplot_axis('x', pga) +
        "set lmargin at screen 0.1\nset rmargin at screen 0.97\nset bmargin at screen 0.115\nset tmargin at screen "
        "0.84\n"
        "set border 3 linewidth 0.8\nset tics out nomirror\nset grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n"
        "set key horizontal center bottom at screen 0.535, screen 0.85 samplen 2\n"
        "set xlabel 'peak ground acceleration [m/s²]' offset 0,-0.2\nset ylabel " +
        gnuplot_text("probability of " + limit) +
        "\n"
        "set yrange [-0.015:1.015]\nset ytics 0,0.1,1 format '%.1f'\n"
        "plot " +
        (bands.empty() ? std::string("1/0 notitle") : bands + curves);
    run_gnuplot(script, PictureSize{}, png);
}

} // namespace stylobate

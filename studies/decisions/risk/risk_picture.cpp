#include "ensemble/model/input_error.hpp"
#include "io/plots/gnuplot.hpp"
#include "studies/decisions/risk/risk_page.hpp"
#include "studies/decisions/risk/risk_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73"};

/// The values of a series as a block of data: x, y, low, high.
std::string block(const std::string& name, const FigureSeries& series)
{
    std::string data = fmt::format("${} << EOD\n", name);
    for (std::size_t i = 0; i < series.x.size(); ++i)
        data += fmt::format("{} {} {} {}\n", series.x[i], series.y[i], series.low.empty() ? series.y[i] : series.low[i],
                            series.high.empty() ? series.y[i] : series.high[i]);
    return data + "EOD\n";
}

const StateRisk& state_named(const Risk& risk, const std::string& name)
{
    if (name.empty())
        return risk.principal();
    std::vector<std::string> names;
    for (const StateRisk* s : risk.chosen()) {
        if (s->state == name)
            return *s;
        names.push_back(s->state);
    }
    throw InputError(
        fmt::format("--limit {}: no limit state of this estimate; it has {}", name, fmt::join(names, ", ")));
}

/// Commands of one of the three parts, from the top.
std::string part(int number, const std::string& y_label, const std::string& commands)
{
    const double top = 0.87 - 0.262 * number;
    return fmt::format("set tmargin at screen {}\nset bmargin at screen {}\nset ylabel {} offset 0.5,0\n", top,
                       top - 0.225, gnuplot_text(y_label)) +
           commands;
}

} // namespace

void plot_risk(const Risk& risk, const std::string& name, const std::string& title,
               const std::filesystem::path& picture)
{
    const StateRisk& s = state_named(risk, name);
    if (!s.determined)
        throw InputError(fmt::format("{}: the frequency of '{}' is not determined, so its parts are not drawn.\n  {}",
                                     picture.string(), s.state, s.note));
    const std::vector<Figure> figures = risk_figures(risk, s);
    const FigureSeries &hazard = figures[0].series[0], &curve = figures[1].series[0], &points = figures[1].series[1];
    std::string data = block("hazard", hazard) + block("curve", curve) + block("points", points) + "$parts << EOD\n";
    double most = 0;
    for (const FrequencyPart& p : s.estimate.parts)
        if (p.from > 0 && std::isfinite(p.to)) {
            const RiskNumber& f = p.frequency;
            if (!(f.value > 0)) // no run reached the state there
                continue;
            data += fmt::format("{} {} {} {} {} {}\n", std::sqrt(p.from * p.to), f.value, f.total.lower,
                                std::isfinite(f.total.upper) ? f.total.upper : f.value, p.from, p.to);
            most = std::max(most, std::isfinite(f.total.upper) ? f.total.upper : f.value);
        }
    data += "EOD\n";
    if (!(most > 0))
        throw InputError(fmt::format("{}: no run of the study reached '{}' within its intensities, so there is nothing "
                                     "to draw.",
                                     picture.string(), s.state));
    const std::string said =
        fmt::format("{}: {} a year; bands and bars: {:g} % (fragility: {:g} %)", s.state,
                    frequency_text(s.estimate.frequency), 100 * risk.level, 100 * risk.fragility_level);
    std::string script = data + gnuplot_heading(title, said) +
                         fmt::format("set logscale x\nset xrange [{}:{}]\n", s.estimate.parts.front().to * 0.97,
                                     s.estimate.parts.back().from * 1.03) +
                         "set xtics (.01,.02,.05,.1,.2,.3,.5,.7,1,1.5,2,3,5,7,10,15,20,30,50,100)\n"
                         "set lmargin at screen 0.14\nset rmargin at screen 0.97\nset border 3 linewidth 0.8\n"
                         "set tics out nomirror\nset grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n"
                         "set format x ''\nunset key\nset multiplot\n";
    script += part(0, "hazard [1/year]",
                   fmt::format("set logscale y\nset format y '%.0e'\nplot $hazard using 1:3:4 with filledcurves "
                               "fillcolor rgb '{0}' fillstyle transparent solid 0.2 noborder, $hazard using 1:2 with "
                               "lines linecolor rgb '{0}' linewidth 2\n",
                               colours[0]));
    script += "unset logscale y\nunset title\nunset label\n";
    script += part(1, "fragility",
                   fmt::format("set yrange [-0.02:1.02]\nset ytics 0,0.25,1\nset format y '%.2f'\nplot $curve using "
                               "1:3:4 with filledcurves fillcolor rgb '{0}' fillstyle transparent solid 0.2 noborder, "
                               "$curve using 1:2 with lines linecolor rgb '{0}' linewidth 2",
                               colours[1]));
    script += points.x.empty() ? "\n"
                               : fmt::format(", $points using 1:2:3:4 with yerrorbars linecolor rgb '{}' linewidth 0.9 "
                                             "pointtype 7 pointsize 1\n",
                                             colours[1]);
    // boxes from 0: x, y, x from, x to, y from, y to
    script += part(2, "parts [1/year]",
                   fmt::format("set yrange [0:{}]\nset ytics auto\nset format y '%g'\nset format x '%g'\nset xlabel {} "
                               "offset 0,-0.2\nplot $parts using 1:2:5:6:(0):2 with boxxyerror fillcolor rgb '{}' "
                               "fillstyle solid 0.5 noborder, $parts using 1:2:3:4 with yerrorbars linecolor rgb "
                               "'#333333' linewidth 0.9 pointtype 7 pointsize 0.6\n",
                               1.05 * most, gnuplot_text(describe_measure(risk.hazard.measure)), colours[2]));
    script += "unset multiplot\n";
    run_gnuplot(script, PictureSize{}, picture);
}

} // namespace stylobate

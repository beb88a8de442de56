#include "studies/kinds/fragility/fragility_text.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {

namespace {

std::string legend_of(const StateFragility& s)
{
    if (!has_curve(s))
        return s.state.describe + " (no curve)";
    return fmt::format("{} (lack of fit: p = {:.2g}{})", s.state.describe, s.fit.p_value,
                       s.fit.p_value < fit_significance ? ", does not fit" : "");
}

/// A probability with its limits inside 0 to 1; without an interval all three are the value.
void add_point(double x, double value, const Limits& limits, FigureSeries& to)
{
    to.x.push_back(x);
    to.y.push_back(value);
    to.low.push_back(std::isnan(limits.lower) ? value : std::max(limits.lower, 0.0));
    to.high.push_back(std::isnan(limits.upper) ? value : std::min(limits.upper, 1.0));
}

void add_state(const StateFragility& s, Figure& figure)
{
    const std::string name = legend_of(s);
    if (has_curve(s)) {
        FigureSeries curve{name, SeriesKind::line, {}, {}, {}, {}, name, "fitted curve"};
        for (const CurvePoint& at : s.curve.at)
            add_point(at.intensity[0], at.probability.value, at.probability.records, curve);
        figure.series.push_back(std::move(curve));
    }
    if (!s.stripes)
        return;
    FigureSeries shares{name, SeriesKind::points, {}, {}, {}, {}, name, "shares of the stripes"};
    FigureSeries monotone{name, SeriesKind::line, {}, {}, {}, {}, name, "monotone curve"};
    for (const StripeShare& stripe : s.stripes->stripes) {
        add_point(stripe.intensity, stripe.share, stripe.limits, shares);
        monotone.x.push_back(stripe.intensity);
        monotone.y.push_back(stripe.monotone);
    }
    figure.series.push_back(std::move(shares));
    if (!has_curve(s) || s.fit.p_value < fit_significance)
        figure.series.push_back(std::move(monotone));
}

} // namespace

bool has_curve(const StateFragility& s)
{
    return s.curve.maximum == Maximum::inside && s.curve.median.value > 0 && std::isfinite(s.curve.median.value);
}

Figure fragility_figure(const Fragility& f)
{
    Figure figure;
    figure.title = "Fragility curves";
    figure.x_label = describe_measure(f.measure);
    figure.y_label = "probability of reaching the limit state";
    figure.x_log = true;
    constexpr std::size_t most_states = 7; // as many colours as the page has
    std::size_t states = 0;
    for (const StateFragility& s : f.states)
        if ((s.state.kind == DamageState::Kind::peak || s.state.kind == DamageState::Kind::collapse) &&
            states++ < most_states)
            add_state(s, figure);
    return figure;
}

namespace {

struct CurveStyle {
    const char* colour;
    int point;
};
constexpr std::array<CurveStyle, 7> styles{{{"#009e73", 9},
                                            {"#e69f00", 13},
                                            {"#d55e00", 5},
                                            {"#0072b2", 7},
                                            {"#cc79a7", 11},
                                            {"#56b4e9", 15},
                                            {"#666666", 4}}};

std::vector<const StateFragility*> chosen(const Fragility& f, const std::vector<std::string>& names)
{
    std::vector<const StateFragility*> all;
    for (const StateFragility& s : f.states)
        if (names.empty() ? s.state.kind == DamageState::Kind::peak || s.state.kind == DamageState::Kind::collapse
                          : std::find(names.begin(), names.end(), s.state.name) != names.end())
            all.push_back(&s);
    for (const std::string& name : names)
        if (std::none_of(all.begin(), all.end(), [&](const auto* s) { return s->state.name == name; })) {
            std::string known;
            for (const StateFragility& s : f.states)
                known += (known.empty() ? "" : ", ") + s.state.name;
            throw InputError(fmt::format("--limit {}: no limit state of this study; it has {}", name, known));
        }
    if (all.size() > styles.size())
        throw InputError(fmt::format("{} limit states are too many for one picture", all.size()));
    return all;
}

} // namespace

void plot_fragility(const Fragility& f, const std::vector<std::string>& names, const std::string& title,
                    const std::filesystem::path& png)
{
    if (f.states.empty())
        throw InputError("there is nothing to draw: " + (f.says.empty() ? "no valid realization" : f.says.front()));
    std::string data, bands, curves;
    const std::vector<const StateFragility*> states = chosen(f, names);
    const auto point = [](double x, double p, const Limits& limits) {
        return fmt::format("{} {} {} {}\n", x, p, std::isnan(limits.lower) ? p : std::max(limits.lower, 0.0),
                           std::isnan(limits.upper) ? p : std::min(limits.upper, 1.0));
    };
    for (std::size_t k = 0; k < states.size(); ++k) {
        const StateFragility& s = *states[k];
        const CurveStyle& style = styles[k];
        data += fmt::format("$curve{} << EOD\n", k);
        bool drawn = false;
        if (s.curve.maximum == Maximum::inside)
            for (const CurvePoint& at : s.curve.at)
                if (std::isfinite(at.probability.value)) {
                    data += point(at.intensity[0], at.probability.value, at.probability.records);
                    drawn = true;
                }
        data += fmt::format("EOD\n$stripes{} << EOD\n", k);
        if (s.stripes)
            for (const StripeShare& share : s.stripes->stripes)
                data += point(share.intensity, share.share, share.limits);
        data += "EOD\n";
        if (drawn) {
            bands += fmt::format("{}$curve{} using 1:3:4 with filledcurves fillcolor rgb '{}' fillstyle transparent "
                                 "solid 0.2 noborder notitle",
                                 bands.empty() ? "" : ", ", k, style.colour);
            curves += fmt::format(", $curve{} using 1:2 with lines linecolor rgb '{}' linewidth 2 {}", k, style.colour,
                                  s.stripes ? "notitle" : "title " + gnuplot_text(s.state.describe));
        }
        if (s.stripes)
            curves += fmt::format(", $stripes{} using 1:2:3:4 with yerrorbars linecolor rgb '{}' linewidth 0.9 "
                                  "pointtype {} pointsize 1.2 title {}",
                                  k, style.colour, style.point, gnuplot_text(s.state.describe));
    }
    const std::string said =
        fmt::format("{} · {}", design_text(f),
                    f.different < least_records ? "too few motions for intervals"
                                                : "bands and bars: 95 % intervals, clustered by motion");
    const std::string script =
        data + gnuplot_heading(title, said) +
        fmt::format("set logscale x\nset xrange [{}:{}]\n", f.grid.front() * 0.97, f.grid.back() * 1.03) +
        "set xtics (.01,.02,.05,.1,.2,.3,.5,.7,1,1.5,2,3,5,7,10,15,20,30,50,100)\n"
        "set lmargin at screen 0.1\nset rmargin at screen 0.97\nset bmargin at screen 0.25\nset tmargin at screen "
        "0.88\n"
        "set border 3 linewidth 0.8\nset tics out nomirror\nset grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n"
        "set key vertical maxrows 4 center bottom at screen 0.535, screen 0.01 samplen 2\n"
        "set xlabel " +
        gnuplot_text(describe_measure(f.measure)) +
        " offset 0,-0.2\nset ylabel 'probability of reaching the limit state'\n"
        "set yrange [-0.015:1.015]\nset ytics 0,0.1,1 format '%.1f'\nplot " +
        (bands.empty() ? std::string("1/0 notitle") : bands) + curves;
    run_gnuplot(script, PictureSize{}, png);
}

} // namespace stylobate

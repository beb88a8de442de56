#include "ensemble/model/input_error.hpp"
#include "io/plots/gnuplot.hpp"
#include "studies/decisions/risk/risk_change_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace stylobate {

namespace {

constexpr std::array variant_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#666666"};

const StateChange& state_named(const RiskChange& change, const VariantChange& variant, const std::string& name)
{
    if (name.empty())
        return variant.principal();
    std::string known;
    for (const StateChange& s : variant.states) {
        if (s.state == name)
            return s;
        known += (known.empty() ? "" : ", ") + s.state;
    }
    throw InputError(fmt::format("--limit {}: no limit state of {}; it has {}", name, change.comparison_file, known));
}

std::string shares_block(const std::string& name, const std::vector<double>& intensity,
                         const std::vector<double>& share)
{
    std::string data = fmt::format("${} << EOD\n", name);
    for (std::size_t j = 0; j < share.size(); ++j)
        data += fmt::format("{} {}\n", intensity[j], share[j]);
    return data + "EOD\n";
}

} // namespace

void plot_risk_change(const RiskChange& change, const std::string& state, const std::string& title,
                      const std::filesystem::path& picture)
{
    const StateChange& first = state_named(change, change.variants.front(), state);
    std::string data = shares_block("base", change.intensity, first.base_share), changes = "$changes << EOD\n", tics;
    const auto line = [](const std::string& block, std::size_t colour, const std::string& name) {
        return fmt::format("${} using 1:2 with linespoints linecolor rgb '{}' linewidth 2 pointtype 7 pointsize 0.8 "
                           "title {}",
                           block, variant_colours[colour % variant_colours.size()], gnuplot_text(name));
    };
    std::string curves = line("base", 0, change.base_name);
    for (std::size_t v = 0; v < change.variants.size(); ++v) {
        const VariantChange& variant = change.variants[v];
        const StateChange& s = state_named(change, variant, first.state);
        data += shares_block(fmt::format("variant{}", v), change.intensity, s.variant_share);
        curves += ", " + line(fmt::format("variant{}", v), v + 1, variant.name);
        tics += fmt::format("{}{} {}", v > 0 ? ", " : "", gnuplot_text(variant.name), v);
        if (const ChangeNumber& p = s.change.probability.back(); s.determined)
            changes += fmt::format("{} {} {} {}\n", v, 100 * p.value, 100 * p.total.lower, 100 * p.total.upper);
    }
    if (changes.ends_with("EOD\n"))
        throw InputError(fmt::format("{}: no change of '{}' is determined, so none is drawn.\n  {}", picture.string(),
                                     first.state, first.note));
    const std::string said =
        fmt::format("{} · {} motions · below: change of the probability in {:g} years, bars: {:g} %", first.meaning,
                    change.motions, change.years.back(), 100 * change.level);
    const std::string script =
        data + changes + "EOD\n" + gnuplot_heading(title, said) +
        "set lmargin at screen 0.14\nset rmargin at screen 0.97\nset border 3 linewidth 0.8\nset tics out nomirror\n"
        "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\nset multiplot\n"
        "set tmargin at screen 0.87\nset bmargin at screen 0.53\nset logscale x\n" +
        fmt::format("set xrange [{}:{}]\n", change.intensity.front() * 0.97, change.intensity.back() * 1.03) +
        "set xtics (.01,.02,.05,.1,.2,.3,.5,.7,1,1.5,2,3,5,7,10,15,20,30,50,100)\nset yrange [-0.02:1.02]\n"
        "set ytics 0,0.25,1\nset key top left\nset ylabel 'share' offset 0.5,0\nset xlabel " +
        gnuplot_text(describe_measure(change.hazard.measure)) + " offset 0,0.3\nplot " + curves +
        "\nunset title\nunset label\nunset key\nunset logscale x\nset tmargin at screen 0.42\n"
        "set bmargin at screen 0.12\nset autoscale y\nset ytics auto\nunset xlabel\n" +
        fmt::format("set xrange [-0.6:{}]\nset xtics ({})\nset ylabel {} offset 0.5,0\nset xzeroaxis linewidth 1 "
                    "linecolor rgb '#333333' linetype 1\n",
                    static_cast<double>(change.variants.size()) - 0.4, tics, gnuplot_text("change [%-points]")) +
        "plot $changes using 1:2:3:4 with yerrorbars linecolor rgb '#333333' linewidth 1.5 pointtype 7 pointsize 1.2\n"
        "unset multiplot\n";
    run_gnuplot(script, PictureSize{}, picture);
}

} // namespace stylobate

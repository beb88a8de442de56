#include "io/plots/contour.hpp"
#include "io/plots/gnuplot.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/search/search.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

/// The range has no end inside the searched one.
bool is_flat(const SearchResult& r, std::size_t key)
{
    return r.flat_from[key] <= r.asked.keys[key].from && r.flat_to[key] >= r.asked.keys[key].to;
}

constexpr double years = 50;

double over_years(double frequency)
{
    return -std::expm1(-frequency * years);
}

std::string answer_text(const SearchResult& r)
{
    if (!r.is_frequency())
        return fmt::format(
            "smallest probability of {}: {:.4f} ({:.4f} to {:.4f}) at {:g} %, by the response surface of "
            "{} points\n",
            r.asked.minimise, r.value, r.lower, r.upper, 100 * r.level, r.points.size());
    return fmt::format("smallest annual frequency of {}: {:.3g} ({:.3g} to {:.3g}) a year at {:g} %, by the response "
                       "surface of {} points\n  in {:g} years: {:.3g} % ({:.3g} to {:.3g})\n  by the best estimate of "
                       "the hazard {}; the interval is of the motions\n",
                       r.asked.minimise, r.value, r.lower, r.upper, 100 * r.level, r.points.size(), years,
                       100 * over_years(r.value), 100 * over_years(r.lower), 100 * over_years(r.upper),
                       *r.asked.hazard);
}

/// The best point that was run, against the base.
std::string point_text(const SearchResult& r)
{
    const SearchedPoint& point = r.points[r.best_point];
    if (!r.is_frequency())
        return fmt::format("{:.4f} ({:.4f} to {:.4f}), base {:.4f} ({:.4f} to {:.4f}), difference {}",
                           point.share.probability, point.share.lower, point.share.upper, r.base.probability,
                           r.base.lower, r.base.upper, difference_text(r.change));
    const auto number = [](const RiskNumber& f) {
        std::string text = fmt::format("{:.3g} ({:.3g} to {:.3g})", f.value, f.fragility.lower, f.fragility.upper);
        if (f.hazard.lower < f.hazard.upper)
            text += fmt::format(" (with the hazard's uncertainty {:.3g} to {:.3g})", f.total.lower, f.total.upper);
        return text;
    };
    std::string text = fmt::format("{} a year, base {}, difference {:+.3g} ({:+.3g} to {:+.3g})",
                                   number(point.frequency), number(r.base_frequency), r.frequency_change.value,
                                   r.frequency_change.fragility.lower, r.frequency_change.fragility.upper);
    if (r.unseen > 0)
        text += fmt::format(
            "\n    not excluded at intensities where no run reached it, and in no interval: {:.3g} a year", r.unseen);
    if (r.outside)
        text += "\n    " + *r.outside;
    return text;
}

} // namespace

std::string search_text(const SearchResult& r)
{
    std::string text = answer_text(r);
    for (std::size_t k = 0; k < r.best.size(); ++k)
        text += fmt::format("  {} = {:.4g}; not shown to be worse: {:.4g} to {:.4g}{}\n", r.asked.keys[k].key,
                            r.best[k], r.flat_from[k], r.flat_to[k],
                            is_flat(r, k) ? ", the whole range: it does not matter at this budget" : "");
    const SearchedPoint& point = r.points[r.best_point];
    std::string values;
    for (std::size_t k = 0; k < point.value.size(); ++k)
        values += fmt::format("{}{} = {:.6g}", k > 0 ? ", " : "", r.asked.keys[k].key, point.value[k]);
    text += fmt::format("  best point that was run: {} ({})\n    {}\n    It was chosen by these realizations: its "
                        "difference is optimistic. Compare it under another study.seed.\n",
                        values, point.results, point_text(r));
    text += fmt::format("  {} realizations; {}\n", r.realizations,
                        r.at_the_end ? "the budget is spent" : "no improvement is expected of a further point");
    return text + left_out_text(r.dimensions) + "\n";
}

Json search_json(const SearchResult& r)
{
    Json keys = Json::list();
    for (std::size_t k = 0; k < r.best.size(); ++k)
        keys.item(Json::object()
                      .member("key", r.asked.keys[k].key)
                      .member("from", r.asked.keys[k].from)
                      .member("to", r.asked.keys[k].to)
                      .member("best", r.best[k])
                      .member("flat_from", r.flat_from[k])
                      .member("flat_to", r.flat_to[k]));
    const auto share = [](const Share& s) { return json_of(s, {"probability", "lower", "upper", "trials"}); };
    const auto frequency = [](const RiskNumber& f) {
        return json_of(f, {"value",
                           {"lower", "fragility_lower"},
                           {"upper", "fragility_upper"},
                           {"total_lower", "lower"},
                           {"total_upper", "upper"}});
    };
    const auto point_json = [&](const SearchedPoint& point) {
        Json json = Json::object().member("values", json_of(point.value)).member("share", share(point.share));
        if (r.is_frequency())
            json.member("frequency", frequency(point.frequency));
        return json.member("results", point.results);
    };
    Json json = Json::object();
    json.member("minimise", r.asked.minimise)
        .member("level", r.level)
        .member(r.is_frequency() ? "frequency" : "probability", r.value)
        .member("lower", r.lower)
        .member("upper", r.upper)
        .member("keys", keys)
        .member("points", json_list(r.points, point_json))
        .member("best_point", r.best_point)
        .member("base", share(r.base))
        .member("difference", r.change.difference)
        .member("difference_lower", r.change.lower)
        .member("difference_upper", r.change.upper)
        .member("realizations", r.realizations)
        .member("budget_spent", r.at_the_end)
        .member("left_out", left_out_text(r.dimensions));
    if (r.is_frequency())
        json.member("hazard", *r.asked.hazard)
            .member("years", years)
            .member("probability_over_years", over_years(r.value))
            .member("probability_over_years_lower", over_years(r.lower))
            .member("probability_over_years_upper", over_years(r.upper))
            .member("base_frequency", frequency(r.base_frequency))
            .member("frequency_difference", r.frequency_change.value)
            .member("frequency_difference_lower", r.frequency_change.fragility.lower)
            .member("frequency_difference_upper", r.frequency_change.fragility.upper)
            .member("unseen", r.unseen)
            .member("outside", r.outside.value_or(""));
    return json;
}

namespace {

constexpr const char* line_colour = "#0072b2";
constexpr const char* set_colour = "#009e73";
constexpr const char* point_colour = "#d55e00";

std::string objective_name(const SearchResult& r)
{
    return r.asked.minimise + (r.is_frequency() ? " [1/year]" : ", probability");
}

/// Scale, range and label of an axis that is a key.
std::string axis(const SearchedKey& key, const char* name)
{
    return fmt::format("{} logscale {}\nset {}range [{}:{}]\nset {}label {}\n",
                       key.spacing == Spacing::log ? "set" : "unset", name, name, key.from, key.to, name,
                       gnuplot_text(key.key));
}

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
    script += axis(key, "x") + fmt::format("set yrange [0:{}]\n", most);
    script += k == 0 ? fmt::format("set format y '%g'\nset ylabel {}\n", gnuplot_text(objective_name(r)))
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

/// Cells about the candidates of two keys, the border of the set, and the points.
std::string map_blocks(const SearchResult& r)
{
    const std::vector<double>& at = r.map.place;
    const SearchedKey &first = r.asked.keys[0], &second = r.asked.keys[1];
    const double half = 0.55 / static_cast<double>(at.size() - 1); // they overlap, so that no seam shows
    std::string script = "$cells << EOD\n";
    std::vector<double> inside;
    for (std::size_t i = 0; i < at.size(); ++i)
        for (std::size_t j = 0; j < at.size(); ++j) {
            script += fmt::format("{} {} {} {} {} {} {}\n", first.value(at[i]), second.value(at[j]),
                                  first.value(at[i] - half), first.value(at[i] + half), second.value(at[j] - half),
                                  second.value(at[j] + half), r.map.value[i][j]);
            inside.push_back(r.map.flat[i][j]);
        }
    script += "EOD\n$set << EOD\n";
    for (const ContourLine& line : contour_lines(at, at, inside, 0.5)) {
        for (const ContourPoint& p : line)
            script += fmt::format("{} {}\n", first.value(p.x), second.value(p.y));
        script += "\n";
    }
    script += "EOD\n$points << EOD\n";
    for (const SearchedPoint& p : r.points)
        script += fmt::format("{} {}\n", p.value[0], p.value[1]);
    return script + fmt::format("EOD\n$best << EOD\n{} {}\nEOD\n", r.best[0], r.best[1]);
}

std::string map_script(const SearchResult& r)
{
    return map_blocks(r) + viridis_palette() + "set border 15 linewidth 0.8\nset tics out nomirror\n" +
           axis(r.asked.keys[0], "x") + axis(r.asked.keys[1], "y") +
           fmt::format("set cblabel {}\nset format cb '%g'\n", gnuplot_text(objective_name(r))) +
           fmt::format("plot $cells using 1:2:3:4:5:6:7 with boxxyerror fillcolor palette fillstyle solid noborder, "
                       "$set using 1:2 with lines linecolor rgb 'white' linewidth 4, "
                       "$set using 1:2 with lines linecolor rgb 'black' linewidth 1.5, "
                       "$points using 1:2 with points linecolor rgb 'white' pointtype 7 pointsize 1.6, "
                       "$points using 1:2 with points linecolor rgb '{}' pointtype 7 pointsize 1.1, "
                       "$best using 1:2 with points linecolor rgb 'white' linewidth 5 pointtype 1 pointsize 2.6, "
                       "$best using 1:2 with points linecolor rgb 'black' linewidth 2 pointtype 1 pointsize 2.4\n",
                       point_colour);
}

/// Panels of the slices, side by side.
std::string slices_script(const SearchResult& r)
{
    double most = 0;
    for (const SearchSlice& slice : r.slices)
        most = std::max(most, *std::max_element(slice.upper.begin(), slice.upper.end()));
    std::string script =
        points_block(r) +
        "set border 3 linewidth 0.8\nset tics out nomirror\nset grid linecolor rgb '#dddddd' linetype 1 linewidth "
        "0.5\nset bmargin at screen 0.16\nset multiplot\n";
    for (std::size_t k = 0; k < r.slices.size(); ++k)
        script += panel(r, k, 1.05 * most) + "unset title\nunset label\n";
    return script + "unset multiplot\n";
}

const char* description(std::size_t keys)
{
    switch (keys) {
    case 1:
        return "surface and its {:g} % interval, points with their own; shaded: not shown to be worse";
    case 2:
        return "surface, its lowest place (+) and the points; inside the line: not shown to be worse at {:g} %";
    default:
        return "surface through the best place and its {:g} % interval; shaded: not shown to be worse";
    }
}

} // namespace

void plot_search(const SearchResult& r, const std::filesystem::path& picture)
{
    const std::size_t keys = r.asked.keys.size();
    const std::string title = fmt::format("{} of {}, {} points", r.is_frequency() ? "Annual frequency" : "Probability",
                                          r.asked.minimise, r.points.size());
    run_gnuplot(gnuplot_heading(title, fmt::format(fmt::runtime(description(keys)), 100 * r.level)) +
                    "unset key\nset tmargin at screen 0.85\n" + (keys == 2 ? map_script(r) : slices_script(r)),
                PictureSize{}, picture);
}

} // namespace stylobate

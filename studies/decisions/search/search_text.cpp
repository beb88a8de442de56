#include "io/plots/colours.hpp"
#include "io/plots/contour.hpp"
#include "io/plots/figure_file.hpp"
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

constexpr const char* set_colour = "#009e73";

std::string objective_name(const SearchResult& r)
{
    return r.asked.minimise + (r.is_frequency() ? " [1/year]" : ", probability");
}

/// The points of a search of one key, with the intervals of their own.
FigureSeries own_points(const SearchResult& r)
{
    FigureSeries points{"", SeriesKind::points, {}, {}, {}, {}};
    for (const SearchedPoint& p : r.points) {
        points.x.push_back(p.value[0]);
        points.y.push_back(r.is_frequency() ? p.frequency.value : p.share.probability);
        points.low.push_back(r.is_frequency() ? p.frequency.fragility.lower : p.share.lower);
        points.high.push_back(r.is_frequency() ? p.frequency.fragility.upper : p.share.upper);
    }
    return points;
}

/// The surface along each key, through its lowest place.
std::vector<Figure> slice_figures(const SearchResult& r)
{
    double most = 0;
    for (const SearchSlice& slice : r.slices)
        most = std::max(most, *std::max_element(slice.upper.begin(), slice.upper.end()));
    std::vector<Figure> figures;
    for (std::size_t k = 0; k < r.slices.size(); ++k) {
        const SearchSlice& slice = r.slices[k];
        const SearchedKey& key = r.asked.keys[k];
        Figure& figure = figures.emplace_back();
        figure.x_label = key.key;
        figure.y_label = k == 0 ? objective_name(r) : "";
        figure.x_log = key.spacing == Spacing::log;
        figure.x_range = {key.from, key.to};
        figure.y_range = {0, 1.05 * most};
        figure.series = {{"", SeriesKind::line, slice.x, slice.value, slice.lower, slice.upper},
                         {"", SeriesKind::spans, {r.flat_from[k]}, {r.flat_to[k]}, {}, {}},
                         {"", SeriesKind::line, {r.best[k], r.best[k]}, {0, 1.05 * most}, {}, {}}};
        figure.series[1].colour = figure.series[2].colour = set_colour;
        figure.series[2].dashed = true;
        if (r.slices.size() == 1)
            figure.series.insert(figure.series.begin() + 1, own_points(r));
    }
    return figures;
}

/// Cells about the candidates of two keys, the border of the set, the points and the lowest place.
void write_search_map(const SearchResult& r, const std::string& title, const std::string& words,
                      const std::filesystem::path& file)
{
    const std::vector<double>& at = r.map.place;
    const SearchedKey &first = r.asked.keys[0], &second = r.asked.keys[1];
    const double half = 0.5 / static_cast<double>(at.size() - 1);
    Figure figure;
    figure.x_label = first.key;
    figure.y_label = second.key;
    figure.x_log = first.spacing == Spacing::log;
    figure.y_log = second.spacing == Spacing::log;
    figure.x_range = {first.from, first.to};
    figure.y_range = {second.from, second.to};
    PlotScale colours;
    for (const std::vector<double>& row : r.map.value)
        for (const double value : row)
            colours.include(value);
    if (!(colours.from < colours.to))
        colours.pad(0);
    std::vector<double> inside;
    for (std::size_t i = 0; i < at.size(); ++i)
        for (std::size_t j = 0; j < at.size(); ++j) {
            const auto edge = [](const SearchedKey& key, double place) {
                return key.value(std::clamp(place, 0.0, 1.0));
            };
            figure.cells.push_back({edge(first, at[i] - half), edge(first, at[i] + half), edge(second, at[j] - half),
                                    edge(second, at[j] + half),
                                    viridis_colour((r.map.value[i][j] - colours.from) / (colours.to - colours.from))});
            inside.push_back(r.map.flat[i][j]);
        }
    // white below black or colour: seen on every colour
    const auto add = [&](FigureSeries series, const char* colour, double wide, double narrow) {
        series.colour = "#ffffff";
        series.weight = wide;
        figure.series.push_back(series);
        series.colour = colour;
        series.weight = narrow;
        figure.series.push_back(std::move(series));
    };
    for (const ContourLine& line : contour_lines(at, at, inside, 0.5)) {
        FigureSeries border;
        for (const ContourPoint& p : line) {
            border.x.push_back(first.value(p.x));
            border.y.push_back(second.value(p.y));
        }
        add(std::move(border), "#000000", 2.8, 1.1);
    }
    FigureSeries points{"", SeriesKind::points, {}, {}, {}, {}};
    for (const SearchedPoint& p : r.points) {
        points.x.push_back(p.value[0]);
        points.y.push_back(p.value[1]);
    }
    add(std::move(points), "#d55e00", 1.3, 0.9);
    add({"", SeriesKind::points, {r.best[0]}, {r.best[1]}, {}, {}}, "#000000", 2.9, 2.2);

    const PictureSize size;
    DrawingSheet sheet(size, picture_look.letters());
    FigurePanel panel(figure, picture_look);
    PlotFrame frame{24 + panel.room_left(), sheet.heading(title, words) + 20, 0.84 * size.width, 0};
    frame.bottom = size.height - 24 - panel.room_below(frame.right - frame.left);
    panel.draw(sheet, frame);
    draw_colour_scale(
        sheet, picture_look, {frame.right + 44, frame.top, frame.right + 84, frame.bottom}, colours, objective_name(r),
        [&](double value) { return viridis_colour((value - colours.from) / (colours.to - colours.from)); });
    sheet.write(file);
}

const char* description(std::size_t keys)
{
    switch (keys) {
    case 1:
        return "surface and its {:g} % interval, points with their own; shaded: not shown to be worse";
    case 2:
        return "surface, its lowest place (large) and the points; inside the line: not shown to be worse at {:g} %";
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
    const std::string words = fmt::format(fmt::runtime(description(keys)), 100 * r.level);
    if (keys == 2)
        write_search_map(r, title, words, picture);
    else
        write_figures(slice_figures(r), keys, title, words, picture);
}

} // namespace stylobate

#include "studies/kinds/rare/rare_figures.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/figure_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

std::string rare_words(const RareTable& table)
{
    const auto none = static_cast<std::size_t>(std::count(table.repeats.begin(), table.repeats.end(), 0.0));
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

Figure levels_figure(const RareTable& table)
{
    Figure figure;
    figure.title = "Probability to exceed a displacement of the top";
    figure.x_label = "displacement of the top [m]";
    figure.y_label = "probability";
    figure.y_log = true;
    for (std::size_t repeat = 0; repeat < table.repeats.size(); ++repeat) {
        RareChain chain = rare_chain(table, repeat);
        figure.series.push_back({fmt::format("repeat {}", repeat),
                                 SeriesKind::line,
                                 std::move(chain.threshold_m),
                                 std::move(chain.probability),
                                 {},
                                 {},
                                 "repeats"});
    }
    return figure;
}

Figure repeats_figure(const RareTable& table)
{
    Figure figure;
    figure.title = "Probability of collapse, repeat by repeat";
    figure.y_label = "probability of collapse";
    figure.y_log = true;
    FigureSeries repeats{"repeats", SeriesKind::points, {}, {}, {}, {}};
    for (const double p : table.repeats) {
        repeats.x.push_back(static_cast<double>(repeats.x.size()));
        repeats.y.push_back(p);
        figure.x_ticks.push_back(fmt::format("{}", figure.x_ticks.size()));
    }
    FigureSeries mean{"mean",        SeriesKind::points, {static_cast<double>(repeats.x.size())}, {table.probability},
                      {table.lower}, {table.upper}};
    figure.x_ticks.emplace_back("mean");
    figure.series = {std::move(repeats), std::move(mean)};
    return figure;
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

std::vector<Figure> rare_figures(const RareTable& table)
{
    return {levels_figure(table), repeats_figure(table)};
}

void plot_rare(const RareTable& table, const std::string& title, const std::filesystem::path& file)
{
    if (table.empty())
        throw InputError("there is no rare event to draw");
    write_figures(rare_figures(table), 2, title, rare_words(table), file);
}

} // namespace stylobate

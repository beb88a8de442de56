#include "ensemble/model/input_error.hpp"
#include "io/plots/plot_maps.hpp"
#include "studies/kinds/replicas/replicas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace stylobate {

namespace {

const std::vector<MapClass>& classes()
{
    static const std::vector<MapClass> all = {
        {0, "#3d6fb0", fmt::format("certain: fewer than {:g} % of pairs are discordant", 100 * certain_below)},
        {certain_below, "#f2cc5c", "probable"},
        {coin_flip_above, "#c63d2f", fmt::format("coin flip: more than {:g} % are discordant", 100 * coin_flip_above)}};
    return all;
}

/// A place within the class; NaN, which is grey, where there are too few pairs.
double class_place(const DiscordantShare& share)
{
    const std::optional<Sureness> verdict = share.verdict();
    return verdict ? classes()[static_cast<std::size_t>(*verdict)].from : std::numeric_limits<double>::quiet_NaN();
}

MapPicture on_axes(const Replicas& replicas)
{
    MapPicture picture;
    picture.frequency_hz = replicas.frequency_hz;
    picture.pga_m_s2 = replicas.pga_m_s2;
    picture.line = replicas.probability;
    return picture;
}

constexpr const char* key = "lines: probability of collapse 5, 50 and 95 %";

/// A round number at or above the quantile of what is finite and positive.
double top_of(const std::vector<double>& values, double share)
{
    std::vector<double> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
                 [](double v) { return std::isfinite(v) && v > 0; });
    if (finite.empty())
        return 1;
    std::sort(finite.begin(), finite.end());
    const double high = finite[static_cast<std::size_t>(share * static_cast<double>(finite.size() - 1))];
    const double decade = std::pow(10.0, std::floor(std::log10(high)));
    for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0})
        if (step * decade >= high)
            return step * decade;
    return high;
}

} // namespace

void plot_discordance(const Replicas& replicas, const std::string& title, const std::filesystem::path& png)
{
    MapPicture picture = on_axes(replicas);
    picture.title = title;
    picture.subtitle = fmt::format("{} pairs in each cell for each kind of perturbed replica · verdict: collapsed or "
                                   "not · titles: discordant pairs",
                                   replicas.realizations);
    picture.columns = replicas.kinds.size() > 4 ? 4 : static_cast<int>(replicas.kinds.size());
    picture.key = fmt::format("{} · grey: {}", key, too_few_pairs);
    for (const KindDiscordance& kind : replicas.kinds) {
        MapPanel panel;
        panel.title = fmt::format("{}: {:.2g} %", kind.name, 100 * kind.all.all.probability);
        for (const DiscordantShare& share : kind.cells)
            panel.value.push_back(class_place(share));
        panel.classes = classes();
        picture.panels.push_back(std::move(panel));
    }
    plot_maps(picture, png);
}

void plot_growth(const Replicas& replicas, const std::string& title, const std::filesystem::path& png)
{
    if (replicas.growth.empty())
        throw InputError("no tracked pair begins closer than the tolerance: there is nothing to draw.\n"
                         "  Run the study with twins.followed above 0, and a smaller one of twins.moves_m.");
    MapPicture picture = on_axes(replicas);
    picture.title = title;
    picture.subtitle =
        fmt::format("{} pairs tracked in each cell · predictable until the replicas are {:g} % of a drum's width apart",
                    replicas.followed, 100 * replicas.tolerance);
    picture.columns = 2;
    picture.key = fmt::format("{} · grey: no growth to fit a slope to, or fewer than half of the pairs diverge", key);
    const auto add = [&](std::string name, std::vector<double> values, double high) {
        MapPanel panel;
        panel.title = std::move(name);
        panel.high = high;
        for (double& v : values)
            if (std::isinf(v))
                v = std::numeric_limits<double>::quiet_NaN();
        panel.value = std::move(values);
        picture.panels.push_back(std::move(panel));
    };
    const auto values_of = [](const std::vector<Estimated>& cells) {
        std::vector<double> values;
        for (const Estimated& e : cells)
            values.push_back(e.value);
        return values;
    };
    const ReplicaGrowth& smallest = replicas.growth.front();
    const std::vector<double> exponents = values_of(smallest.exponent_per_s);
    add(fmt::format("growth of the separation [1/s], {}", replicas.kinds[smallest.kind].name), exponents,
        top_of(exponents, 0.98));
    const std::size_t shown = std::min<std::size_t>(3, replicas.growth.size());
    std::vector<double> horizons;
    for (std::size_t i = 0; i < shown; ++i)
        for (const Estimated& e : replicas.growth[i].horizon_s)
            horizons.push_back(e.value);
    for (std::size_t i = 0; i < shown; ++i)
        add(fmt::format("horizon [s], {}", replicas.kinds[replicas.growth[i].kind].name),
            values_of(replicas.growth[i].horizon_s), top_of(horizons, 0.9)); // the few longest saturate
    plot_maps(picture, png);
}

} // namespace stylobate

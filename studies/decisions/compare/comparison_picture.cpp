#include "studies/decisions/compare/comparison_picture.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/plot_maps.hpp"
#include "io/plots/plot_shares.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

constexpr double large = 0.2; ///< a difference that has the full colour

/// Numbers of the classes below.
enum Shade { better_much, better, not_named_less, none, not_named_more, worse, worse_much };

/// @param damage whether less of it is better
std::vector<MapClass> classes(bool damage)
{
    const char *less = damage ? "better" : "less", *more = damage ? "worse" : "more";
    return {{better_much, "#2166ac", fmt::format("{}, ≥ {:g}", less, large)},
            {better, "#74add1", less},
            {not_named_less, "#d8e8f1", "less, not named"},
            {none, "#f7f7f7", "no change"},
            {not_named_more, "#fbe3d4", "more, not named"},
            {worse, "#ef8a62", more},
            {worse_much, "#b2182b", fmt::format("{}, ≥ {:g}", more, large)}};
}

double shade_of(const PlaceComparison& place, double rate)
{
    if (place.counts.pairs() == 0)
        return std::numeric_limits<double>::quiet_NaN();
    const double d = place.difference;
    if (d == 0)
        return none;
    if (place.p_adjusted > rate)
        return d < 0 ? not_named_less : not_named_more;
    return d < 0 ? (d <= -large ? better_much : better) : d >= large ? worse_much : worse;
}

void draw_maps(const Comparison& comparison, const std::string& limit, const std::string& title,
               const std::filesystem::path& file)
{
    MapPicture picture;
    picture.title = title;
    picture.subtitle = fmt::format("named: {}", adjustment_text(comparison));
    picture.frequency_hz = comparison.frequency_hz;
    picture.pga_m_s2 = comparison.pga_m_s2;
    const std::size_t n = comparison.variants.size();
    picture.columns = n == 1 ? 1 : n <= 4 ? 2 : 3;
    picture.key = "lines: probability of the base 5, 50 and 95 % · grey: no pair";
    for (const VariantComparison& variant : comparison.variants) {
        const LimitComparison& of = limit_of(variant, limit);
        MapPanel panel;
        panel.title = fmt::format("{}: {}", variant.name, difference_text(of.overall));
        panel.classes = classes(of.damage);
        const bool first = picture.line.empty();
        for (const PlaceComparison& place : of.cells) {
            panel.value.push_back(shade_of(place, comparison.rate));
            if (first)
                picture.line.push_back(place.base.probability);
        }
        picture.panels.push_back(std::move(panel));
    }
    plot_maps(picture, file);
}

void draw_stripes(const Comparison& comparison, const std::string& limit, const std::string& title,
                  const std::filesystem::path& file)
{
    SharePicture picture;
    picture.title = title;
    picture.subtitle = fmt::format("{} motions · bars: {:g} % intervals of each share, clustered by motion",
                                   comparison.motions, 100 * comparison.level);
    picture.x_label = describe_measure(comparison.measure);
    picture.y_label = "probability of reaching the limit state";
    const auto series = [&](const LimitComparison& of, const std::string& name, Share PlaceComparison::*side) {
        ShareSeries s{name, comparison.intensity, {}, {}, {}};
        for (const PlaceComparison& place : of.cells) {
            s.share.push_back((place.*side).probability);
            s.lower.push_back((place.*side).lower);
            s.upper.push_back((place.*side).upper);
        }
        picture.series.push_back(std::move(s));
    };
    series(limit_of(comparison.variants.front(), limit), comparison.base_name, &PlaceComparison::base);
    for (const VariantComparison& variant : comparison.variants)
        series(limit_of(variant, limit), variant.name, &PlaceComparison::variant);
    plot_shares(picture, file);
}

} // namespace

const LimitComparison& limit_of(const VariantComparison& variant, const std::string& limit)
{
    const auto found =
        limit.empty() ? variant.limits.begin() : std::ranges::find(variant.limits, limit, &LimitComparison::name);
    if (found != variant.limits.end())
        return *found;
    std::string names;
    for (const LimitComparison& each : variant.limits)
        names += (names.empty() ? "" : ", ") + each.name;
    throw InputError(fmt::format("--limit {}: no limit state of {}; it has {}", limit, variant.name, names));
}

void comparison_picture(const Comparison& comparison, const std::string& limit, const std::string& title,
                        const std::filesystem::path& file)
{
    const std::string name = limit_of(comparison.variants.front(), limit).name;
    const std::string heading =
        !title.empty() ? title : fmt::format("Change of {}: base {}", name, comparison.base_name);
    if (!comparison.frequency_hz.empty())
        draw_maps(comparison, name, heading, file);
    else if (!comparison.intensity.empty())
        draw_stripes(comparison, name, heading, file);
    else
        throw InputError("a comparison without cells or stripes has no picture; --to csv writes its numbers");
}

} // namespace stylobate

#include "studies/decisions/search/search.hpp"

#include "studies/decisions/compare/comparison_text.hpp"

#include <fmt/format.h>

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
                       100 * over_years(r.value), 100 * over_years(r.lower), 100 * over_years(r.upper), r.asked.hazard);
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
    if (!r.outside.empty())
        text += "\n    " + r.outside;
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
    return text;
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
        .member("budget_spent", r.at_the_end);
    if (r.is_frequency())
        json.member("hazard", r.asked.hazard)
            .member("years", years)
            .member("probability_over_years", over_years(r.value))
            .member("probability_over_years_lower", over_years(r.lower))
            .member("probability_over_years_upper", over_years(r.upper))
            .member("base_frequency", frequency(r.base_frequency))
            .member("frequency_difference", r.frequency_change.value)
            .member("frequency_difference_lower", r.frequency_change.fragility.lower)
            .member("frequency_difference_upper", r.frequency_change.fragility.upper)
            .member("unseen", r.unseen)
            .member("outside", r.outside);
    return json;
}

} // namespace stylobate

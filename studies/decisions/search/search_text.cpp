#include "studies/decisions/search/search.hpp"

#include "studies/decisions/compare/comparison_text.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace {

/// The range has no end inside the searched one.
bool is_flat(const SearchResult& r, std::size_t key)
{
    return r.flat_from[key] <= r.asked.keys[key].from && r.flat_to[key] >= r.asked.keys[key].to;
}

} // namespace

std::string search_text(const SearchResult& r)
{
    std::string text =
        fmt::format("smallest probability of {}: {:.4f} [{:.4f}, {:.4f}] at {:g} %, by the response surface of {} "
                    "points\n",
                    r.asked.minimise, r.probability, r.lower, r.upper, 100 * r.level, r.points.size());
    for (std::size_t k = 0; k < r.best.size(); ++k)
        text += fmt::format("  {} = {:.4g}; not shown to be worse: {:.4g} to {:.4g}{}\n", r.asked.keys[k].key,
                            r.best[k], r.flat_from[k], r.flat_to[k],
                            is_flat(r, k) ? ", the whole range: it does not matter at this budget" : "");
    const SearchedPoint& point = r.points[r.best_point];
    std::string values;
    for (std::size_t k = 0; k < point.value.size(); ++k)
        values += fmt::format("{}{} = {:.6g}", k > 0 ? ", " : "", r.asked.keys[k].key, point.value[k]);
    text +=
        fmt::format("  best point that was run: {} ({})\n    {:.4f} [{:.4f}, {:.4f}], base {:.4f} [{:.4f}, {:.4f}], "
                    "difference {}\n    It was chosen by these realizations: its difference is optimistic. Compare "
                    "it under another study.seed.\n",
                    values, point.results, point.share.probability, point.share.lower, point.share.upper,
                    r.base.probability, r.base.lower, r.base.upper, difference_text(r.change));
    text += fmt::format("  {} realizations; {}\n", r.realizations,
                        r.at_the_end ? "the budget is spent" : "no improvement is expected of a further point");
    return text;
}

Json search_json(const SearchResult& r)
{
    Json keys = Json::list(), points = Json::list();
    for (std::size_t k = 0; k < r.best.size(); ++k)
        keys.item(Json::object()
                      .member("key", r.asked.keys[k].key)
                      .member("from", r.asked.keys[k].from)
                      .member("to", r.asked.keys[k].to)
                      .member("best", r.best[k])
                      .member("flat_from", r.flat_from[k])
                      .member("flat_to", r.flat_to[k]));
    const auto share = [](const Share& s) {
        return Json::object()
            .member("probability", s.probability)
            .member("lower", s.lower)
            .member("upper", s.upper)
            .member("trials", s.trials);
    };
    for (const SearchedPoint& point : r.points) {
        Json values = Json::list();
        for (const double value : point.value)
            values.item_as_is(fmt::format("{}", value));
        points.item(Json::object()
                        .member("values", values)
                        .member("share", share(point.share))
                        .member("results", point.results));
    }
    Json json = Json::object();
    json.member("minimise", r.asked.minimise)
        .member("level", r.level)
        .member("probability", r.probability)
        .member("lower", r.lower)
        .member("upper", r.upper)
        .member("keys", keys)
        .member("points", points)
        .member("best_point", r.best_point)
        .member("base", share(r.base))
        .member("difference", r.change.difference)
        .member("difference_lower", r.change.lower)
        .member("difference_upper", r.change.upper)
        .member("realizations", r.realizations)
        .member("budget_spent", r.at_the_end);
    return json;
}

} // namespace stylobate

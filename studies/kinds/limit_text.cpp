#include "studies/kinds/limit_text.hpp"

#include "io/files/suggest.hpp"
#include "io/store/surface_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

/// @param fair as of `limits_json`
Json share_json(const Share& share, bool fair)
{
    if (!fair)
        return Json::object().member("count", share.count);
    return Json::object()
        .member("count", share.count)
        .member("probability", share.probability)
        .member("lower", share.lower)
        .member("upper", share.upper);
}

std::string share_text(const Share& share)
{
    if (std::isnan(share.lower))
        return fmt::format("{}, {:.3g} %", share.count, 100 * share.probability);
    return fmt::format("{}, {:.3g} % ({:.3g} to {:.3g})", share.count, 100 * share.probability, 100 * share.lower,
                       100 * share.upper);
}

} // namespace

std::vector<std::size_t> first_fallen(const LimitCounts& counts)
{
    std::vector<std::size_t> blocks;
    for (std::size_t i = 0; i < counts.first().size(); ++i)
        if (counts.first()[i] > 0)
            blocks.push_back(i);
    std::stable_sort(blocks.begin(), blocks.end(),
                     [&](std::size_t a, std::size_t b) { return counts.first()[a] > counts.first()[b]; });
    return blocks;
}

Json limits_json(const LimitCounts& counts, const std::vector<std::string>& names, bool to_rest, bool fair)
{
    Json first = Json::list();
    for (const std::size_t block : first_fallen(counts))
        first.item(Json::object()
                       .member("block", block)
                       .member("name", names[block])
                       .member("share", share_json(counts.share_first(block), fair)));
    Json json = Json::object();
    json.member("trials", counts.trials()).member("interval", counts.interval());
    for (std::size_t i = 0; i < limit_state_names().size(); ++i)
        if (const auto limit = static_cast<LimitState>(i); limit != LimitState::total || to_rest)
            json.member(limit_state_names()[i], share_json(counts.share(limit), fair));
    json.member("first_fallen", first)
        .member("first_fallen_together", share_json(counts.share_first_together(), fair))
        .member("median_collapse_time_s", counts.median_collapse_time_s());
    if (to_rest)
        json.member("median_total_collapse_time_s", counts.median_total_collapse_time_s());
    return json;
}

std::optional<std::string> counted_words(const Study& study)
{
    if (study.events() > 1)
        return "of one event";
    return study.design().replica_set ? std::optional("without replicas") : std::nullopt;
}

std::string limits_text(const LimitCounts& counts, const std::vector<std::string>& names, bool to_rest,
                        const std::optional<std::string>& of)
{
    const Share collapsed = counts.share(LimitState::collapse);
    std::string text = "  " + (of ? *of + ": " : "") + "collapsed " + share_text(collapsed);
    if (collapsed.count > 0)
        text += fmt::format(", median time {:.3g} s", counts.median_collapse_time_s());
    if (const Share unseated = counts.share(LimitState::unseated); unseated.count > 0)
        text += "; unseated " + share_text(unseated);
    if (to_rest) {
        const Share total = counts.share(LimitState::total);
        text += "; total collapse " + share_text(total);
        if (total.count > 0)
            text += fmt::format(", median time {:.3g} s", counts.median_total_collapse_time_s());
    }
    text += fmt::format("; {}{}\n",
                        std::isnan(collapsed.lower) ? "" : "in brackets: ", describe_interval(counts.interval()));
    if (const std::optional<std::string> moving = counts.moving_text())
        text += fmt::format("  {}\n", *moving);
    const std::vector<std::size_t> first = first_fallen(counts);
    constexpr std::size_t most = 5;
    std::string list;
    for (std::size_t k = 0; k < std::min(most, first.size()); ++k)
        list += fmt::format("{}{}: {}", k > 0 ? "; " : "", names[first[k]], share_text(counts.share_first(first[k])));
    if (first.size() > most)
        list += fmt::format("; and {}", counted(first.size() - most, "other"));
    if (counts.first_together() > 0)
        list += fmt::format("{}several in the same step: {}", list.empty() ? "" : "; ",
                            share_text(counts.share_first_together()));
    if (!list.empty())
        text += fmt::format("  first to fall (drums counted from the base): {}\n", list);
    return text;
}

} // namespace stylobate

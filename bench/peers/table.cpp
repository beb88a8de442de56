#include "bench/peers/table.hpp"

#include "io/tables/table.hpp"
#include "studies/report/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate::peers {

namespace {

std::string percent(double part)
{
    return std::isfinite(part) ? fmt::format("{:+.2f} %", 100 * part) : "none";
}

std::string dial_text(const Contender& c, const Timed& t)
{
    return c.compliant ? fmt::format("K_N = {:.3g} N/m2, {:.2g} s", t.errors.dial, t.step_s)
                       : fmt::format("{:.3g} s (1/{:.0f})", t.step_s, 1 / t.step_s);
}

std::string line(const Contender& c, const std::string& at, const Timed& t)
{
    return markdown_row("{} | {} | {} | {} | {} | {} | {} | {} of {} | {}", engine_text(c), c.setting, at,
                        dial_text(c, t), percent(t.errors.quarter_period), percent(t.errors.overturning),
                        rate_text(t.shaken.realizations_per_second), t.shaken.collapsed, t.shaken.count,
                        t.resting.moved == 0 ? "yes"
                                             : fmt::format("{} of {} do not", t.resting.moved, t.resting.count));
}

/// The results of one engine, from `first` on to those of the next.
std::vector<Result> of_engine(const std::vector<Result>& results, std::size_t first)
{
    std::vector<Result> of;
    for (std::size_t i = first; i < results.size() && results[i].contender.engine == results[first].contender.engine;
         ++i)
        of.push_back(results[i]);
    return of;
}

Json json_of(const Contender& contender, const Errors& e)
{
    return Json::object()
        .member(dial_key(contender), e.dial)
        .member("quarter_period_error", e.quarter_period)
        .member("overturning_error", e.overturning);
}

Json json_of(const Contender& contender, const Timed& t)
{
    return Json::object()
        .member("errors", json_of(contender, t.errors))
        .member("column_step_s", t.step_s)
        .member("shaken", json_of(t.shaken))
        .member("at_rest", json_of(t.resting));
}

} // namespace

std::string rate_text(double rate)
{
    if (rate == 0) // none lasted for a second
        return "-";
    return rate >= 100 ? fmt::format("{:.0f}", rate) : fmt::format("{:.3g}", rate);
}

std::string target_text(std::size_t target)
{
    return fmt::format("{:g} %", 100 * targets[target]);
}

std::string engine_text(const Contender& contender)
{
    return contender.engine + (contender.own ? "" : " " + contender.version);
}

std::string dial_key(const Contender& contender)
{
    return contender.compliant ? "normal_stiffness_n_m2" : "step_s";
}

Json json_of(const Columns& c)
{
    return Json::object()
        .member("columns", c.count)
        .member("collapsed", c.collapsed)
        .member("collapsed_or_off_their_place", c.moved)
        .member("realizations_per_second", c.realizations_per_second);
}

std::string markdown(const std::vector<Result>& results, const std::string& processor)
{
    std::string text = fmt::format("One core of {}; Stylobate {}.\n\n", processor, code_version()) +
                       markdown_head("engine | setting | at | step | quarter period | overturning | realizations/s | "
                                     "collapsed | stands at rest");
    for (std::size_t i = 0; i < results.size();) {
        const std::vector<Result> of = of_engine(results, i);
        const Contender& first = of.front().contender;
        text += line(first, "customary", of.front().customary);
        for (std::size_t t = 0; t < targets.size(); ++t) {
            bool any = false;
            for (const Result& r : of)
                if (r.reached[t] && (first.own || &r == fastest(of, false, t))) {
                    text += line(r.contender, target_text(t), *r.reached[t]);
                    any = true;
                }
            if (!any)
                text += markdown_row("{} | not reached | {} | | | | | |", first.engine, target_text(t));
        }
        i += of.size();
    }
    text += '\n';
    for (std::size_t t = 0; t < targets.size(); ++t) {
        const Result *own = fastest(results, true, t), *peer = fastest(results, false, t);
        if (own == nullptr || peer == nullptr) {
            text += fmt::format("At {}: no ratio, {} reaches it.\n", target_text(t),
                                own == nullptr ? "Stylobate was not run or never" : "no other engine");
            continue;
        }
        text += fmt::format("At {}: Stylobate ({}) does {:.3g} times the realizations per second of the fastest other "
                            "engine ({}, {}).\n",
                            target_text(t), own->contender.setting,
                            own->reached[t]->shaken.realizations_per_second /
                                peer->reached[t]->shaken.realizations_per_second,
                            peer->contender.engine, peer->contender.setting);
    }
    return text;
}

Json json_head(const std::string& processor)
{
    return Json::object().member("stylobate", code_version()).member("processor", processor);
}

std::string json(const std::vector<Result>& results, const std::string& processor)
{
    Json rows = Json::list();
    for (const Result& r : results) {
        const Contender& c = r.contender;
        Json scanned = Json::list();
        for (const Errors& e : r.scanned)
            scanned.item(json_of(c, e));
        Json row = Json::object();
        row.member("engine", c.engine)
            .member("version", c.version)
            .member("planar", c.planar)
            .member("setting", c.setting)
            .member("customary", json_of(c, r.customary));
        for (std::size_t t = 0; t < targets.size(); ++t)
            if (r.reached[t])
                row.member("within " + target_text(t), json_of(c, *r.reached[t]));
        rows.item(row.member("scanned", scanned));
    }
    return json_head(processor).member("results", rows).text() + '\n';
}

} // namespace stylobate::peers

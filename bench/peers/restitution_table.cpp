#include "bench/peers/restitution.hpp"
#include "bench/peers/scan.hpp"
#include "bench/peers/table.hpp"
#include "io/tables/markdown.hpp"
#include "studies/report/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate::peers {

namespace {

std::string cell(const Impacts& impacts)
{
    return std::isfinite(impacts.worst()) ? fmt::format("{:+.2f} ({:.2f})", 100 * impacts.mean, 100 * impacts.scatter())
                                          : "none";
}

std::string dial_text(const Contender& contender, double dial)
{
    return contender.compliant ? fmt::format("K_N {:.2g}", dial) : fmt::format("1/{:.0f}", 1 / dial);
}

/// Errors over the dials of those that have such dials.
std::string errors_table(const std::vector<ImpactScan>& scans, bool compliant)
{
    std::string text;
    for (const ImpactScan& scan : scans) {
        const Contender& c = scan.contender;
        if (c.compliant != compliant)
            continue;
        if (text.empty()) {
            text = "engine | setting";
            for (const double dial : scan.dials)
                text += " | " + dial_text(c, dial);
            text = markdown_head(text);
        }
        std::string row = engine_text(c) + " | " + c.setting;
        for (const Impacts& each : scan.impacts)
            row += " | " + cell(each);
        text += markdown_row("{}", row);
    }
    return text.empty() ? text : text + '\n';
}

std::string reached_text(const ImpactScan& scan, std::size_t target)
{
    if (!scan.reached[target])
        return "never | ";
    const ImpactScan::Reached& at = *scan.reached[target];
    return fmt::format(
        "{} | {}{}", dial_text(scan.contender, at.dial), rate_text(at.shaken.realizations_per_second),
        at.shaken.collapsed > 0 ? fmt::format(" ({} of {} collapsed)", at.shaken.collapsed, at.shaken.count) : "");
}

} // namespace

std::string impact_markdown(const std::vector<ImpactScan>& scans, const std::string& processor)
{
    std::string text = fmt::format(
        "One core of {}; Stylobate {}. Errors of the restitution in per cent of Housner's {:.4f}: mean (largest less "
        "least) over {} phases of the impact within a step.\n\n",
        processor, code_version(), exact_restitution(), impact_phases);
    text += errors_table(scans, false) + errors_table(scans, true);
    text += markdown_head("engine | setting | within 1 % at every phase | realizations/s | within 0.2 % | "
                          "realizations/s");
    for (const ImpactScan& scan : scans)
        text += markdown_row("{} | {} | {} | {}", engine_text(scan.contender), scan.contender.setting,
                             reached_text(scan, 0), reached_text(scan, 1));
    return text;
}

std::string impact_json(const std::vector<ImpactScan>& scans, const std::string& processor)
{
    Json rows = Json::list();
    for (const ImpactScan& scan : scans) {
        const Contender& c = scan.contender;
        Json scanned = Json::list();
        for (std::size_t i = 0; i < scan.dials.size(); ++i)
            scanned.item(Json::object()
                             .member(dial_key(c), scan.dials[i])
                             .member("mean_error", scan.impacts[i].mean)
                             .member("least_error", scan.impacts[i].least)
                             .member("largest_error", scan.impacts[i].largest));
        Json row = Json::object();
        row.member("engine", c.engine).member("version", c.version).member("setting", c.setting);
        for (std::size_t t = 0; t < targets.size(); ++t)
            if (scan.reached[t])
                row.member("within " + target_text(t), Json::object()
                                                           .member(dial_key(c), scan.reached[t]->dial)
                                                           .member("column_step_s", scan.reached[t]->step_s)
                                                           .member("shaken", json_of(scan.reached[t]->shaken)));
        rows.item(row.member("scanned", scanned));
    }
    return json_head(processor).member("phases", impact_phases).member("results", rows).text() + '\n';
}

} // namespace stylobate::peers

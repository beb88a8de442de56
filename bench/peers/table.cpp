#include "bench/peers/table.hpp"

#include "io/tables/table.hpp"
#include "studies/report/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    return markdown_row("{} | {} | {} | {} | {} | {} | {} | {} of {} | {} of {} | {} of {}", engine_text(c), c.setting,
                        at, dial_text(c, t), percent(t.errors.quarter_period), percent(t.errors.overturning),
                        rate_text(t.shaken.realizations_per_second), t.shaken.collapsed, t.shaken.count, t.shaken.moved,
                        t.shaken.count, t.resting.moved, t.resting.count);
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
                                     "shaken: collapsed | shaken: moved | at rest: moved");
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
                text += markdown_row("{} | not reached | {} | | | | | | |", first.engine, target_text(t));
        }
        i += of.size();
    }
    text += '\n';
    for (std::size_t t = 0; t < targets.size(); ++t) {
        const Result *own = fastest(results, true, t), *peer = fastest(results, false, t);
        if (own == nullptr || peer == nullptr) {
            text +=
                fmt::format("At {}: no ratio, {} reaches it.\n", target_text(t),
                            own == nullptr ? "Stylobate was not run or never" : "no other engine that Debian packages");
            continue;
        }
        text += fmt::format("At {}: Stylobate ({}) does {:.3g} times the realizations per second of the fastest of the "
                            "engines that Debian packages ({}, {}).\n",
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

namespace {

std::string name_of(const CellContender& c)
{
    return c.engine + (c.own ? "" : " " + c.version) + " | " + c.setting;
}

std::string step_text(double step_s)
{
    return fmt::format("1/{:.0f}", 1 / step_s);
}

std::string heading(const std::vector<Cell>& cells)
{
    std::string text;
    for (const Cell& cell : cells)
        text += fmt::format(" | {}, {:g} Hz, {:g} m/s2", cell.name, cell.frequency_hz, cell.pga_m_s2);
    return text;
}

double binomial_error(const Level& level)
{
    const double p = level.probability(), n = static_cast<double>(level.draws.collapsed.size());
    return std::sqrt(std::max(p * (1 - p), 1 / n) / n);
}

const CollapseScan* rigid_among(const std::vector<CollapseScan>& scans)
{
    const auto it =
        std::find_if(scans.begin(), scans.end(), [](const CollapseScan& scan) { return scan.contender.rigid; });
    return it == scans.end() ? nullptr : &*it;
}

/// Probabilities at the finest step, each with its difference from rigid blocks on the draws that both have.
std::string limits_table(const std::vector<CollapseScan>& scans, const std::vector<Cell>& cells)
{
    const CollapseScan* rigid = rigid_among(scans);
    std::string text = markdown_head("engine | setting" + heading(cells));
    for (const CollapseScan& scan : scans) {
        std::string row = name_of(scan.contender);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const Level& finest = scan.cells[k].levels.back();
            row += fmt::format(" | {}: {:.3f} ± {:.3f}", step_text(finest.step_s), finest.probability(),
                               binomial_error(finest));
            if (rigid != nullptr && &scan != rigid) {
                const Difference d =
                    paired_difference(finest.draws.collapsed, rigid->cells[k].levels.back().draws.collapsed);
                row += fmt::format(" ({:+.3f} ± {:.3f})", d.value, d.error);
            }
        }
        text += markdown_row("{}", row);
    }
    return text;
}

std::string converged_text(const std::optional<Converged>& found, const std::vector<CellRun>& cells)
{
    if (!found)
        return "not shown | ";
    return fmt::format("{}: {:.3f}{} | {}", step_text(cells.front().levels[found->level].step_s), found->error.value,
                       found->resolved ? "" : fmt::format(" (to {:.3f})", found->error.bound), rate_text(found->rate));
}

std::string cost_table(const std::vector<CollapseScan>& scans)
{
    std::string head = "engine | setting";
    for (const double target : collapse_targets)
        head += fmt::format(" | within {:g}: step [s], error | realizations/s | rigid blocks are faster by", target);
    std::string text = markdown_head(head);
    const CollapseScan* rigid = rigid_among(scans);
    for (const CollapseScan& scan : scans) {
        std::string row = name_of(scan.contender);
        for (const double target : collapse_targets) {
            const auto found = converged(scan.cells, target);
            row += " | " + converged_text(found, scan.cells) + " | ";
            const auto ours = rigid != nullptr ? converged(rigid->cells, target) : std::nullopt;
            if (found && ours && &scan != rigid)
                row += fmt::format("{:.3g}", ours->rate / found->rate);
        }
        text += markdown_row("{}", row);
    }
    return text;
}

/// Each level's error against the finest one, and its rate.
std::string errors_table(const std::vector<CollapseScan>& scans, const std::vector<Cell>& cells)
{
    std::string text = markdown_head("engine | setting | halvings" + heading(cells));
    for (const CollapseScan& scan : scans) {
        std::size_t levels = 0;
        for (const CellRun& run : scan.cells)
            levels = std::max(levels, run.levels.size());
        for (std::size_t level = 0; level < levels; ++level) {
            std::string row = fmt::format("{} | {}", name_of(scan.contender), level);
            for (const CellRun& run : scan.cells) {
                row += " | ";
                if (level >= run.levels.size())
                    continue;
                const Level& at = run.levels[level];
                row += fmt::format("{}: {:.3f}", step_text(at.step_s), at.probability());
                if (level + 1 < run.levels.size()) {
                    const Difference d = level_error(run, level);
                    row += fmt::format(" ({:+.3f} ± {:.3f})", d.value, d.error);
                }
                row += fmt::format(", {}/s", rate_text(at.rate()));
            }
            text += markdown_row("{}", row);
        }
    }
    return text;
}

std::string draws_text(const std::vector<CollapseScan>& scans)
{
    std::string text;
    for (const CollapseScan& scan : scans) {
        std::string counts;
        for (const CellRun& run : scan.cells)
            counts += fmt::format("{}{}", counts.empty() ? "" : ", ", run.draws());
        text += fmt::format("{}{} ({}) {}", text.empty() ? "" : "; ", scan.contender.engine, scan.contender.setting,
                            counts);
    }
    return text;
}

} // namespace

std::string collapse_markdown(const std::vector<CollapseScan>& scans, const std::vector<Cell>& cells,
                              const std::string& processor)
{
    return fmt::format("Cores of {}, processor time; Stylobate {}. Draws of the cells in their order: {}.\n\n",
                       processor, code_version(), draws_text(scans)) +
           "Collapse probability at each scheme's finest step, ± one standard error; in brackets the difference from "
           "rigid blocks on the same draws.\n\n" +
           limits_table(scans, cells) +
           "\nCost at equal error of the collapse probability against each scheme's own finest step: root mean square "
           "over the cells, less the part of the sampling. In brackets what it may be with two standard errors, where "
           "that is more than the target. The two finest steps are not judged.\n\n" +
           cost_table(scans) +
           "\nAll steps: probability, in brackets the difference from the finest step on the same draws, and "
           "realizations per second.\n\n" +
           errors_table(scans, cells);
}

std::string collapse_json(const std::vector<CollapseScan>& scans, const std::vector<Cell>& cells,
                          const std::string& processor)
{
    Json rows = Json::list();
    for (const CollapseScan& scan : scans) {
        Json of_cells = Json::list();
        for (std::size_t k = 0; k < cells.size(); ++k) {
            Json levels = Json::list();
            for (std::size_t i = 0; i < scan.cells[k].levels.size(); ++i) {
                const Level& level = scan.cells[k].levels[i];
                const Difference error = level_error(scan.cells[k], i);
                std::string collapsed;
                for (const char one : level.draws.collapsed)
                    collapsed += one != 0 ? '1' : '0';
                levels.item(Json::object()
                                .member("step_s", level.step_s)
                                .member("probability", level.probability())
                                .member("error_against_finest", error.value)
                                .member("standard_error", error.error)
                                .member("realizations_per_second", level.rate())
                                .member("simulated_s", level.draws.simulated_s)
                                .member("processor_s", level.draws.processor_s)
                                .member("collapsed", collapsed));
            }
            of_cells.item(Json::object().member("cell", cells[k].name).member("levels", levels));
        }
        Json row = Json::object();
        row.member("engine", scan.contender.engine)
            .member("version", scan.contender.version)
            .member("setting", scan.contender.setting);
        for (const double target : collapse_targets)
            if (const auto found = converged(scan.cells, target))
                row.member(fmt::format("within {:g}", target), Json::object()
                                                                   .member("halvings", found->level)
                                                                   .member("pooled_error", found->error.value)
                                                                   .member("pooled_error_bound", found->error.bound)
                                                                   .member("realizations_per_second", found->rate));
        rows.item(row.member("cells", of_cells));
    }
    return json_head(processor).member("results", rows).text() + '\n';
}

} // namespace stylobate::peers

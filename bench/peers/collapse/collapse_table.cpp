#include "bench/peers/collapse/collapse_table.hpp"

#include "bench/peers/table.hpp"
#include "io/tables/table.hpp"
#include "studies/report/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate::peers {

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

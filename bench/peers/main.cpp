/// Stylobate and general engines of rigid bodies, at equal error: `peers --help`.

#include "bench/peers/restitution.hpp"
#include "bench/peers/space/space_table.hpp"
#include "bench/peers/table.hpp"
#include "studies/workflow/machine_facts.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

using namespace stylobate;
using namespace stylobate::peers;

namespace {

/// What is to be written after long work is looked at before it.
const CLI::Validator in_folder(
    [](std::string& path) {
        const auto folder = std::filesystem::absolute(path).parent_path();
        return std::filesystem::is_directory(folder) ? "" : "there is no folder " + folder.string();
    },
    "FILE");

enum class Test { rocking, restitution, collapse, spatial };

struct Options {
    Test test = Test::rocking;
    std::vector<std::string> names;
    std::string json_path, markdown_path, note;
    double seconds = 1, patience_s = 10;
    CollapseOptions collapse;
    bool all_settings = false, name_processor = false;
    std::vector<std::string> cells;
};

struct Page {
    std::string markdown, json;
};

void write(const std::string& path, const std::string& text)
{
    std::ofstream file(path);
    file << text;
    if (!file.flush())
        throw std::runtime_error("cannot write " + path);
}

Page rocking(const std::vector<Contender>& contenders, const Options& options)
{
    std::vector<Result> results;
    for (const Contender& contender : contenders) {
        fmt::print("{} {}\n", contender.engine, contender.setting);
        results.push_back(scan(contender, options.seconds, options.patience_s));
        for (const Errors& e : results.back().scanned)
            fmt::print("  {} {:<12.5g} quarter period {:+8.3f} %  overturning {:+8.3f} %\n",
                       contender.compliant ? "K_N [N/m2]" : "step [s]", e.dial, 100 * e.quarter_period,
                       100 * e.overturning);
        std::fflush(stdout);
    }
    return {markdown(results, processor()), json(results, processor())};
}

Page restitutions(const std::vector<Contender>& contenders, const Options& options)
{
    std::vector<ImpactScan> scans;
    for (const Contender& contender : contenders) {
        fmt::print("{} {}\n", contender.engine, contender.setting);
        scans.push_back(scan_impacts(contender, options.seconds));
        for (std::size_t i = 0; i < scans.back().dials.size(); ++i)
            fmt::print("  {} {:<12.5g} mean {:+8.3f} %  scatter {:8.3f} %\n",
                       contender.compliant ? "K_N [N/m2]" : "step [s]", scans.back().dials[i],
                       100 * scans.back().impacts[i].mean, 100 * scans.back().impacts[i].scatter());
        std::fflush(stdout);
    }
    return {impact_markdown(scans, processor()), impact_json(scans, processor())};
}

/// Whether an engine is to be run: one that is named, or any where none is.
bool is_wanted(const Options& options, const std::string& engine)
{
    return options.names.empty() ||
           std::find(options.names.begin(), options.names.end(), engine) != options.names.end();
}

Page collapses(const Options& options)
{
    std::vector<CellContender> contenders;
    const auto add = [&](std::vector<CellContender> some) {
        for (CellContender& c : some)
            if (is_wanted(options, c.engine))
                contenders.push_back(std::move(c));
    };
    for (const Engine& engine : engines())
        add(cell_contenders(engine, options.all_settings));
    add(own_cell_contenders());
    std::vector<Cell> cells;
    for (const Cell& cell : rocking_cells())
        if (options.cells.empty() ||
            std::find(options.cells.begin(), options.cells.end(), cell.name) != options.cells.end())
            cells.push_back(cell);
    if (cells.empty())
        throw std::invalid_argument("no cell has such a name.");
    const auto scans = scan_collapses(contenders, cells, options.collapse, [](const std::string& line) {
        fmt::print("{}\n", line);
        std::fflush(stdout);
    });
    return {collapse_markdown(scans, cells, processor()), collapse_json(scans, cells, processor())};
}

Page in_space(const Options& options)
{
    std::vector<SpaceResult> results;
    for (const SpaceContender& contender : space_contenders()) {
        if (!is_wanted(options, contender.engine))
            continue;
        fmt::print("{} {}\n", contender.engine, contender.setting);
        for (SpaceResult& r : run_in_space(contender))
            results.push_back(std::move(r));
        std::fflush(stdout);
    }
    return {space_markdown(results, processor()), space_json(results, processor())};
}

/// Those of the named engines; all, where none is named.
std::vector<Contender> wanted(const Options& options)
{
    std::vector<Contender> all, chosen;
    for (const Engine& engine : engines())
        for (Contender& contender : contenders(engine))
            all.push_back(std::move(contender));
    for (Contender& contender : own_contenders())
        all.push_back(std::move(contender));
    for (const std::string& name : options.names)
        if (std::none_of(all.begin(), all.end(), [&](const Contender& c) { return c.engine == name; }))
            throw std::invalid_argument("'" + name + "' is no engine that was built in.");
    for (Contender& c : all)
        if (is_wanted(options, c.engine))
            chosen.push_back(std::move(c));
    return chosen;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Accuracy and speed of the available engines, on one thread.");
    Options options;
    const std::map<std::string, Test> tests{{"rocking", Test::rocking},
                                            {"restitution", Test::restitution},
                                            {"collapse", Test::collapse},
                                            {"spatial", Test::spatial}};
    app.add_option("--test", options.test, "which test")->transform(CLI::CheckedTransformer(tests));
    app.add_option("--engine", options.names, "engines to run (repeatable; default: all)");
    app.add_option("--json", options.json_path, "file for all measurements (JSON)")->check(in_folder);
    app.add_option("--markdown", options.markdown_path, "file for the table")->check(in_folder);
    app.add_option("--note", options.note, "line about the run, such as what else the machine did, above the table");
    app.add_option("--seconds", options.seconds, "seconds for each timing")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--patience", options.patience_s,
                   "rocking: a step that takes longer than this [s] without reaching the error ends the scan of a "
                   "setting")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_flag("--all-settings", options.all_settings, "collapse: every setting of the engines, not one of each");
    app.add_option("--cell", options.cells, "collapse: cells to run (repeatable; default: all)");
    app.add_option("--budget", options.collapse.budget_s,
                   "collapse: seconds of processor time for an engine in a cell, about")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--draws", options.collapse.draws, "collapse: most draws of a cell")
        ->check(CLI::Range(16, 1000000))
        ->capture_default_str();
    app.add_option("--batch", options.collapse.batch, "collapse: draws that are run at a time, and at the least")
        ->check(CLI::Range(8, 1000000))
        ->capture_default_str();
    app.add_option("--processes", options.collapse.processes, "collapse: cores to use")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--minutes", options.collapse.minutes, "collapse: no work begins after so long")
        ->check(CLI::PositiveNumber);
    app.add_flag("--processor", options.name_processor, "print the processor's name, as the results state it, alone");
    CLI11_PARSE(app, argc, argv);
    if (options.name_processor) {
        fmt::print("{}\n", processor());
        return 0;
    }
    try {
        const std::vector<Contender> chosen = wanted(options);
        Page page = options.test == Test::rocking       ? rocking(chosen, options)
                    : options.test == Test::restitution ? restitutions(chosen, options)
                    : options.test == Test::spatial     ? in_space(options)
                                                        : collapses(options);
        if (!options.note.empty())
            page.markdown = options.note + "\n\n" + page.markdown;
        fmt::print("\n{}", page.markdown);
        if (!options.json_path.empty())
            write(options.json_path, page.json);
        if (!options.markdown_path.empty())
            write(options.markdown_path, page.markdown);
    } catch (const std::invalid_argument& error) {
        fmt::print(stderr, "peers: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "peers: {}\n", error.what());
        return 1;
    }
    return 0;
}

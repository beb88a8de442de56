/// Stylobate and general engines of rigid bodies, at equal error: `peers --help`.

#include "bench/peers/table.hpp"
#include "bench/processor.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
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

void write(const std::string& path, const std::string& text)
{
    std::ofstream file(path);
    file << text;
    if (!file.flush())
        throw std::runtime_error("cannot write " + path);
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Accuracy and speed of the available engines, on one thread.");
    std::vector<std::string> names;
    std::string json_path, markdown_path;
    double seconds = 1, patience_s = 10;
    app.add_option("--engine", names, "engines to run (repeatable; default: all)");
    app.add_option("--json", json_path, "file for all measurements (JSON)")->check(in_folder);
    app.add_option("--markdown", markdown_path, "file for the table")->check(in_folder);
    app.add_option("--seconds", seconds, "seconds for each timing")->check(CLI::PositiveNumber)->capture_default_str();
    app.add_option("--patience", patience_s,
                   "a step that takes longer than this [s] without reaching the error ends the scan of a setting")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    std::vector<Contender> all;
    for (const Engine& engine : engines())
        for (Contender& contender : contenders(engine))
            all.push_back(std::move(contender));
    for (Contender& contender : own_contenders())
        all.push_back(std::move(contender));
    for (const std::string& name : names)
        if (std::none_of(all.begin(), all.end(), [&](const Contender& c) { return c.engine == name; })) {
            fmt::print(stderr, "peers: '{}' is no engine that was built in.\n", name);
            return 2;
        }
    try {
        std::vector<Result> results;
        for (const Contender& contender : all) {
            if (!names.empty() && std::find(names.begin(), names.end(), contender.engine) == names.end())
                continue;
            fmt::print("{} {}\n", contender.engine, contender.setting);
            results.push_back(scan(contender, seconds, patience_s));
            for (const Errors& e : results.back().scanned)
                fmt::print("  {} {:<12.5g} quarter period {:+8.3f} %  overturning {:+8.3f} %\n",
                           contender.own ? "K_N [N/m2]" : "step [s]", e.dial, 100 * e.quarter_period,
                           100 * e.overturning);
            std::fflush(stdout);
        }
        const std::string table = markdown(results, processor());
        fmt::print("\n{}", table);
        if (!json_path.empty())
            write(json_path, json(results, processor()));
        if (!markdown_path.empty())
            write(markdown_path, table);
    } catch (const std::exception& error) {
        fmt::print(stderr, "peers: {}\n", error.what());
        return 1;
    }
    return 0;
}

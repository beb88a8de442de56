/// Error against cost of the engine's own answers, as tables in Markdown: `work_precision --help`.

#include "bench/work_precision/page.hpp"

#include "ensemble/model/input_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <string>

int main(int argc, char** argv)
{
    CLI::App app("Work and precision: errors of three results against block-steps per simulated second.");
    std::string picture;
    std::uint64_t realizations = 1024;
    app.add_option("--picture", picture, "write a picture of the curves to this file (PNG)");
    app.add_option("--realizations", realizations, "number of realizations in each ensemble")
        ->check(CLI::Range(8, 1 << 20))
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        stylobate::work::Report report;
        stylobate::work::monolith_tables(report);
        stylobate::work::collapse_tables(report, realizations);
        if (!picture.empty())
            stylobate::work::draw(report, picture);
        fmt::print("{}", report.text);
    } catch (const stylobate::InputError& e) {
        fmt::print(stderr, "work_precision: {}\n", e.what());
        return 2;
    } catch (const std::exception& e) {
        fmt::print(stderr, "work_precision: {}\n", e.what());
        return 1;
    }
    return 0;
}

/// Error against cost of the engine's own answers: `work_precision --help`.

#include "bench/work_precision/page.hpp"

#include "ensemble/input_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

int main(int argc, char** argv)
{
    CLI::App app("Work and precision: errors of three answers against block-steps per simulated second.");
    std::string page, picture;
    std::uint64_t realizations = 1024;
    app.add_option("--page", page, "write the tables there (Markdown) instead of to the terminal");
    app.add_option("--picture", picture, "draw the curves there (PNG)");
    app.add_option("--realizations", realizations, "of each ensemble")
        ->check(CLI::Range(8, 1 << 20))
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        const stylobate::work::Report report = stylobate::work::measure(realizations);
        if (!picture.empty())
            stylobate::work::draw(report, picture);
        if (page.empty()) {
            fmt::print("{}", report.text);
            return 0;
        }
        std::ofstream file(page);
        file << report.text;
        if (!file.flush())
            throw std::runtime_error("cannot write " + page);
    } catch (const stylobate::InputError& e) {
        fmt::print(stderr, "work_precision: {}\n", e.what());
        return 2;
    } catch (const std::exception& e) {
        fmt::print(stderr, "work_precision: {}\n", e.what());
        return 1;
    }
    return 0;
}

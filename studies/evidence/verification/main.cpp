/// `stylobate_verify [-o PAGE.md] [--images FOLDER] [CASE...]`: runs the verification cases and writes the page.
///
/// Exit status: 0 all passed, 1 at least one failed, 2 bad input.

#include "io/files/atomic_file.hpp"
#include "kernels/isa.hpp"
#include "studies/evidence/picture/page_program.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/version.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace stylobate;
using namespace stylobate::verification;

/// Name of the processor, as far as the system tells.
std::string processor()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "unknown processor";
}

int run(const std::vector<std::string>& names, const std::optional<std::filesystem::path>& out,
        const std::optional<std::filesystem::path>& images)
{
    const Cases cases = chosen(all_cases(), names, "'{}' is not a verification case");
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<RunCase> runs = run_cases(cases);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    bool passed = true;
    for (const RunCase& r : runs) {
        passed = passed && r.passed();
        fmt::print("{:<40} {}\n", r.the_case.name, r.passed() ? "passed" : "FAILED");
        for (const Check& c : r.finding.checks)
            if (!c.passed())
                fmt::print("  {}: expected {:.9g}, measured {:.9g}, tolerance {:.2g}\n", c.what, c.expected, c.measured,
                           c.tolerance);
        if (r.error)
            fmt::print("  {}\n", *r.error);
    }
    if (out) {
        const std::filesystem::path beside = out->parent_path(),
                                    to = images.value_or(beside / "images" / "verification");
        std::filesystem::create_directories(to);
        draw(runs, to);
        const std::string made_by =
            fmt::format("Version {}, {}, {}.", code_version(), processor(), to_string(best_isa()));
        write_whole(*out, page(runs, to.lexically_relative(beside).generic_string() + "/", made_by));
        fmt::print("{}\n", out->string());
    }
    fmt::print("{} cases in {:.0f} s\n", runs.size(), seconds);
    return passed ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Runs the verification cases and, with --output, writes their page.");
    std::optional<std::filesystem::path> out, images;
    std::vector<std::string> names;
    app.add_option("-o,--output", out, "the page to write (Markdown)");
    app.add_option("--images", images, "folder for the pictures [images/verification beside the page]");
    app.add_option("cases", names, "names of the cases to run (default: all)");
    return page_program(app, argc, argv, "stylobate_verify", [&] { return run(names, out, images); });
}

/// `stylobate_verify [-o PAGE.md] [--images FOLDER] [CASE...]`: runs the verification cases and writes the page.
///
/// Exit status: 0 all passed, 1 at least one failed, 2 bad input.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "kernels/isa.hpp"
#include "studies/evidence/verification/page.hpp"
#include "studies/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
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

Cases chosen(const std::vector<std::string>& names)
{
    const Cases all = all_cases();
    if (names.empty())
        return all;
    Cases some;
    for (const std::string& name : names) {
        bool found = false;
        for (const Case& c : all)
            if (c.name == name) {
                some.push_back(c);
                found = true;
            }
        if (!found) {
            std::string known;
            for (const Case& c : all)
                known += (known.empty() ? "" : ", ") + c.name;
            throw InputError(fmt::format("'{}' is not a verification case.\n  Known: {}.", name, known));
        }
    }
    return some;
}

int run(const std::vector<std::string>& names, const std::filesystem::path& out, std::filesystem::path images)
{
    const Cases cases = chosen(names);
    if (images.empty())
        images = out.parent_path() / "images" / "verification";
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
        if (!r.error.empty())
            fmt::print("  {}\n", r.error);
    }
    if (!out.empty()) {
        std::filesystem::create_directories(images);
        draw(runs, images);
        const std::string made_by =
            fmt::format("Version {}, {}, {}.", code_version(), processor(), to_string(best_isa()));
        AtomicFile file(out);
        file.write(page(runs, images.lexically_relative(out.parent_path()).generic_string() + "/", made_by));
        file.commit();
        fmt::print("{}\n", out.string());
    }
    fmt::print("{} cases in {:.0f} s\n", runs.size(), seconds);
    return passed ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Runs the verification cases and, with --output, writes their page.");
    std::filesystem::path out, images;
    std::vector<std::string> names;
    app.add_option("-o,--output", out, "the page to write (Markdown)");
    app.add_option("--images", images, "folder for the pictures [images/verification beside the page]");
    app.add_option("cases", names, "names of the cases to run (default: all)");
    try {
        app.parse(argc, argv);
        return run(names, out, images);
    } catch (const CLI::ParseError& e) {
        const int status = app.exit(e);
        return status == 0 ? 0 : 2;
    } catch (const InputError& e) {
        fmt::print(stderr, "stylobate_verify: {}\n", e.what());
        return 2;
    } catch (const std::exception& e) {
        fmt::print(stderr, "stylobate_verify: {}\n", e.what());
        return 1;
    }
}

/// `stylobate_measured DATA_DIR [--case NAME] [-o DOCS_DIR]`: sets the engine against measured data, and writes a page
/// for each set of data.
///
/// Exit status: 0 done (data that are absent are skipped, with a message), 2 bad input, 1 anything else.

#include "ensemble/input_error.hpp"
#include "studies/command.hpp"
#include "studies/measured/page_case.hpp"
#include "studies/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace {

using namespace stylobate;
using namespace stylobate::measured;
namespace fs = std::filesystem;

struct Options {
    PagePlace place;
    std::vector<std::string> names;
    CommonOptions common;
};

std::vector<PageCase> chosen(const std::vector<std::string>& names)
{
    std::vector<PageCase> cases = all_page_cases();
    for (const std::string& name : names)
        if (std::none_of(cases.begin(), cases.end(), [&](const PageCase& c) { return c.name == name; })) {
            std::string known;
            for (const PageCase& c : cases)
                known += (known.empty() ? "" : ", ") + c.name;
            throw InputError(fmt::format("--case {}: there is no such case.\n  There are: {}.", name, known));
        }
    if (!names.empty())
        std::erase_if(cases,
                      [&](const PageCase& c) { return std::find(names.begin(), names.end(), c.name) == names.end(); });
    return cases;
}

int run(Options o)
{
    o.place.data = fs::absolute(o.place.data);
    o.place.docs = fs::absolute(o.place.docs);
    o.place.studies = o.place.studies.empty() ? o.place.docs : fs::absolute(o.place.studies);
    o.place.run = {o.common.isa(), o.common.thread_count()};
    o.place.quiet = o.common.quiet;
    for (const PageCase& c : chosen(o.names)) {
        if (!fs::is_directory(o.place.data / c.folder)) {
            fmt::print("{}: skipped, there is no folder {}\n", c.name, (o.place.data / c.folder).string());
            continue;
        }
        fs::create_directories(o.place.images());
        fs::create_directories(o.place.studies);
        c.write(o.place);
        fmt::print("{}: {}\n", c.name, (o.place.docs / (c.name + ".md")).string());
        std::fflush(stdout);
    }
    return exit_done;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Sets the engine against measured data and writes a page for each set of data.");
    Options o;
    o.place.docs = "docs/measured";
    app.add_option("DATA_DIR", o.place.data, "folder of the measured data")->required();
    app.add_option("-o,--output", o.place.docs, "folder of the pages")->capture_default_str();
    app.add_option("--studies", o.place.studies, "folder of the study files of the fitted models [that of the pages]");
    app.add_option("--case", o.names, "only these")->delimiter(',');
    app.add_option("--threads", o.common.threads, "threads to use (default: all that the process may use)")
        ->check(CLI::Range(1, 4096));
    app.add_flag("--quiet", o.common.quiet, "no progress: only errors");
    app.set_version_flag("--version", code_version());
    try {
        app.parse(argc, argv);
        return run(o);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_bad_input;
    } catch (const InputError& error) {
        fmt::print(stderr, "stylobate_measured: {}\n", error.what());
        return exit_bad_input;
    } catch (const std::exception& error) {
        fmt::print(stderr, "stylobate_measured: {}\n", error.what());
        return exit_failed;
    }
}

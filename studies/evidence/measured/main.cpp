/// `stylobate_measured DATA_DIR [--case NAME] [-o DOCS_DIR]`: sets the engine against measured data, and writes a page
/// for each set of data.
///
/// `stylobate_measured DATA_DIR --boulder-motion TEST --to FILE` and `stylobate_measured DATA_DIR --double-pulse BD V
/// --to FILE` write one base motion of these data as a table that `stylobate run` follows (`excitation.kind =
/// "table"`).
///
/// Exit status: 0 done (data that are absent are skipped, with a message), 2 bad input, 1 anything else.

#include "io/files/atomic_file.hpp"
#include "studies/evidence/measured/boulders/boulder_model.hpp"
#include "studies/evidence/measured/double_pulse/double_pulse.hpp"
#include "studies/evidence/measured/parts/page_case.hpp"
#include "studies/evidence/picture/page_program.hpp"
#include "studies/version.hpp"
#include "studies/workflow/console.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace {

using namespace stylobate;
using namespace stylobate::measured;
namespace fs = std::filesystem;

struct Options {
    PagePlace place;
    int boulder_test = 0;      ///< whose motion is to be written
    std::vector<double> pulse; ///< distance and velocity of the one that is to be written
    std::optional<fs::path> to;
    std::optional<fs::path> studies; ///< nullopt: the folder of the pages
    std::vector<std::string> names;
    Machine machine;
    bool quiet = false;
};

/// One set of measured data against the engine.
struct PageCase {
    std::string name;                ///< of the page
    std::string folder;              ///< in the data folder; a case whose folder is absent is skipped
    void (*write)(const PagePlace&); ///< computes, draws, writes the page
};
const std::vector<PageCase> page_cases{{"ceh2016", "published", ceh2016},
                                       {"planar_impact", "planar_impact", planar_impact},
                                       {"rock_shake_table", "rock_shake_table", rock_shake_table}};

/// time_s and acceleration_m_s2, at rest before the first line.
void write_motion(const Motion& motion, const fs::path& file)
{
    std::string text = fmt::format("# {}\ntime_s,acceleration_m_s2\n", motion.source);
    for (std::size_t i = 0; i < motion.acceleration_m_s2.size(); ++i)
        text += fmt::format("{:.9g},{:.9g}\n", motion.dt_s * static_cast<double>(i), motion.acceleration_m_s2[i]);
    write_whole(file, text);
}

int write_one_motion(const Options& o)
{
    if (!o.to)
        throw InputError("--to FILE is missing: where the motion is to be written");
    if (!o.pulse.empty()) {
        if (!(o.pulse[0] > 0 && o.pulse[1] > 0))
            throw InputError("--double-pulse BD V: the distance [m] and the velocity [m/s] must be above 0");
        write_motion(base_motion_of({o.pulse[0], o.pulse[1], false}, PulsedBlock{}.pulse_s), *o.to);
        return exit_done;
    }
    const BoulderData data = read_boulders(o.place.data / "rock_shake_table");
    const auto test = std::find_if(data.tests.begin(), data.tests.end(),
                                   [&](const BoulderTest& t) { return t.number == o.boulder_test; });
    if (test == data.tests.end() || test->motion.empty())
        throw InputError(fmt::format(
            "--boulder-motion {}: the table's motion in this test was not measured, or is too weak to move the boulder",
            o.boulder_test));
    write_motion(test->motion, *o.to);
    return exit_done;
}

int run(Options& o)
{
    if (o.boulder_test > 0 || !o.pulse.empty())
        return write_one_motion(o);
    o.place.data = fs::absolute(o.place.data);
    o.place.docs = fs::absolute(o.place.docs);
    o.place.studies = o.studies ? fs::absolute(*o.studies) : o.place.docs;
    o.place.run = {o.machine.isa(), o.machine.thread_count()};
    if (o.place.predict)
        o.place.predict = fs::absolute(*o.place.predict);
    o.place.quiet = o.quiet;
    for (const PageCase& c : chosen(page_cases, o.names, "--case {}: unknown case")) {
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
    CLI::App app("Compares the engine with measured data and writes a page for each data set.");
    Options o;
    o.place.docs = "docs/measured";
    app.add_option("DATA_DIR", o.place.data, "folder of the measured data")->required();
    app.add_option("-o,--output", o.place.docs, "folder of the pages")->capture_default_str();
    app.add_option("--studies", o.studies, "folder of the study files of the fitted models [that of the pages]");
    app.add_option("--case", o.names, "names of the cases to run (default: all)")->delimiter(',');
    app.add_option("--boulder-motion", o.boulder_test, "writes the table's motion in this boulder test, and no page");
    app.add_option("--double-pulse", o.pulse, "writes the base motion over this distance [m] at this velocity [m/s]")
        ->expected(2);
    app.add_option("--to", o.to, "the file for that motion");
    app.add_option(
        "--predict", o.place.predict,
        "a table of planar impacts: writes the predictions of the fitted laws beside the page planar_impact");
    app.add_option("--threads", o.machine.threads, "threads to use (default: all that the process may use)")
        ->check(CLI::Range(1, 4096));
    app.add_flag("--quiet", o.quiet, "no progress: only errors");
    app.set_version_flag("--version", code_version());
    return page_program(app, argc, argv, "stylobate_measured", [&] { return run(o); });
}

/// `stylobate calibrate`: contact parameters from measured response.

#include "io/files/atomic_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/calibration/calibration_data.hpp"
#include "studies/calibration/calibration_file.hpp"
#include "studies/calibration/calibration_text.hpp"
#include "studies/cluster/together.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

namespace stylobate {

namespace {

/// Progress in parameter sets; a wish to stop is the console's to notice.
class CalibrationConsole : public Observer {
public:
    explicit CalibrationConsole(bool quiet) : console_(quiet), quiet_(quiet) {}

    void stage(const std::string& what) { stage_ = what; }

    void progress(const Progress& p) override
    {
        planned_ = p.total;
        if (quiet_ || p.done == 0 || (p.seconds < next_s_ && p.done < p.total))
            return;
        next_s_ = p.seconds + between_lines_s;
        say(calibration_progress(stage_, p) + "\n");
    }
    std::uint64_t planned() const { return planned_; }
    void warn(const std::string& text) override { console_.warn(text); }
    bool stop_requested() override { return console_.stop_requested(); }

private:
    static constexpr double between_lines_s = 10;
    Console console_;
    const bool quiet_;
    double next_s_ = between_lines_s;
    std::uint64_t planned_ = 0;
    std::string stage_;
};

} // namespace

int calibrate_command(const CommonOptions& options, const std::string& measured, const CalibrateOptions& wanted)
{
    const std::filesystem::path given = std::filesystem::path(measured);
    const std::string stem = (given.has_stem() ? given : given.parent_path()).stem().string(); // of a folder too
    const std::string results = wanted.output.empty() ? stem + "_calibration.h5" : wanted.output;
    const std::string calibrated =
        wanted.output.empty() ? stem + "_calibrated.toml"
                              : std::filesystem::path(results).replace_extension().string() + "_calibrated.toml";
    std::optional<CalibrationData> data;
    Study start;
    CalibrationOptions search;
    RunOptions run;
    together(options.ranks, [&] { // before anything is written
        check_kind(measured, "calibrate");
        check_option_kind(wanted.study, FileKind::study, "--study");
        data.emplace(given);
        start = wanted.study.empty() ? data->default_start(options.set) : read_study(wanted.study, options.set);
        demand_double(start, wanted.study.empty() ? "--set" : wanted.study, "a calibration");
        search.keys = fitted_keys(start, wanted.fit, wanted.hold);
        search.forms = fitted_forms(wanted.forms);
        run = options.run_options();
        if (run.leads()) {
            check_output(measured, results, options.force);
            check_output(measured, calibrated, options.force);
        }
    });
    search.outcomes = wanted.outcomes;
    search.held_out = wanted.held_out;
    if (!run.leads()) { // predicts what rank 0 requests
        Console silent(true);
        data->calibrated(start, search, run, silent);
        return exit_done;
    }
    AtomicFile study_file(calibrated), results_file(results);
    search.kept = std::filesystem::path(results).replace_extension().string() + "_sets.bin";
    search.kept_key = data->key();
    CalibrationConsole console(options.quiet);
    search.stage = [&](const std::string& what) { console.stage(what); };
    const Calibration found = data->calibrated(start, search, run, console);
    if (!found.complete) {
        note(options.quiet,
             fmt::format(
                 "Interrupted: {} of at most {} parameter sets are kept in {}. The same command continues from there.",
                 found.kept_sets, console.planned(), search.kept.string()));
        return exit_interrupted;
    }
    const std::string text = calibrated_text(found, measured);
    parse_study(text, calibrated); // what is written is a study
    write_calibration(found, start, code_version(), results_file.temporary());
    study_file.write(text);
    results_file.commit();
    study_file.commit();
    if (options.json)
        fmt::print("{}\n",
                   calibration_json(found).member("results", results).member("calibrated_study", calibrated).text());
    else
        fmt::print("{}{}: {}\n{}: the calibrated study\n", calibration_text(found), results, calibration_cost(found),
                   calibrated);
    return exit_done;
}

} // namespace stylobate

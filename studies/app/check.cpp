/// `stylobate check`.

#include "ensemble/model/input_error.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/check/check_study.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

/// Where the drawing goes; empty: none is asked for.
/// @throws InputError for an unknown format, or one that the file's extension contradicts
fs::path picture_path(const std::string& study, const CheckOptions& wanted)
{
    if (wanted.output.empty())
        return wanted.format.empty() ? fs::path()
                                     : fs::path(fs::path(study).stem().string() + "_structure." + wanted.format);
    if (!wanted.format.empty() && ending_of(wanted.output) != wanted.format)
        throw InputError(
            fmt::format("--to {0} and -o {1}: the file extension is not .{0}", wanted.format, wanted.output));
    check_drawing(wanted.output);
    return wanted.output;
}

} // namespace

int check_command(const CommonOptions& options, const std::string& file, const CheckOptions& wanted)
{
    check_kind(file, "check");
    StudyCheck check(LoadedStudy::from_file(file, options.set), file,
                     {.pilot = wanted.pilot, .trial_seconds = wanted.trial_seconds, .stage = {}},
                     options.run_options());
    const fs::path picture = picture_path(file, wanted);
    if (!picture.empty())
        check_output(file, picture, options.force);
    Console console(options.quiet);
    std::optional<CheckReport> report;
    if (check.draw_realizations(console)) { // nothing is refused any more
        for (const std::string& warning : check.warnings())
            console.warn(warning);
        if (!picture.empty())
            draw_study(check.study(), file, picture);
        report = check.run(console);
    }
    if (!report) {
        fmt::print(stderr, "Interrupted; the study is not checked.\n");
        return exit_interrupted;
    }
    report->picture = picture.string();
    fmt::print("{}", options.json ? check_json(*report).text() + "\n" : check_text(*report));
    return report->missed() ? exit_invalid : exit_done;
}

} // namespace stylobate

/// `stylobate check` and `stylobate verify-file`: a study before its run, and its results afterwards.

#include "ensemble/model/input_error.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/check/check_study.hpp"
#include "studies/verify/verify_file.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

/// The file of the drawing; empty: none.
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
                     {.pilot = wanted.pilot,
                      .trial_seconds = wanted.trial_seconds,
                      .law_seconds = wanted.law_seconds,
                      .costs = [&](const std::string& costs) { note(options.quiet, costs); }},
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
        say("Interrupted; the study is not checked.\n");
        return exit_interrupted;
    }
    report->picture = picture.string();
    fmt::print("{}", options.json ? check_json(*report).text() + "\n" : check_text(*report));
    return report->missed() ? exit_invalid : exit_done;
}

int verify_command(const CommonOptions& options, const std::string& file, const VerifyChoice& wanted)
{
    check_kind(file, "verify-file");
    VerifyOptions verify{.settings = options.set, .run = options.run_options()};
    verify.replay = wanted.replay.value_or(VerifyOptions::usual_replay);
    verify.seed = wanted.seed;
    Console console(options.quiet);
    const FileVerification found = verify_file(file, verify, console);
    if (options.json)
        fmt::print("{}\n", json_of(found).text());
    else
        fmt::print("{}", text_of(found));
    if (!found.well())
        return exit_failed;
    return found.stopped ? exit_interrupted : exit_done;
}

} // namespace stylobate

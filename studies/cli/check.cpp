/// `stylobate check` and `stylobate verify-file`: a study before its run, and its results afterwards.

#include "ensemble/model/input_error.hpp"
#include "studies/cli/command.hpp"
#include "studies/verify/verification.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

/// The file of the drawing; none: the structure is not drawn.
/// @throws InputError for an unknown format, or one that the file's extension contradicts
std::optional<fs::path> drawing_of(const std::string& study, const DrawingOptions& wanted)
{
    if (wanted.output && wanted.format && ending_of(*wanted.output) != *wanted.format)
        throw InputError(
            fmt::format("--to {0} and -o {1}: the file extension is not .{0}", *wanted.format, *wanted.output));
    if (!wanted.output && !wanted.format)
        return std::nullopt;
    if (!wanted.output)
        return fs::path(study).stem().string() + "_structure." + *wanted.format;
    check_drawing(*wanted.output);
    return *wanted.output;
}

} // namespace

int check_command(const CommonOptions& options, const std::string& file, CheckRequest request,
                  const DrawingOptions& drawing)
{
    check_kind(file, "check");
    request.drawing = drawing_of(file, drawing);
    request.force = options.force;
    Console console = options.console("check");
    const auto report = check_study(LoadedStudy::from_file(file, options.set), file, request, options, console);
    if (!report) {
        say("Interrupted; the study is not checked.\n");
        return console.end(exit_interrupted);
    }
    print(
        options, [&] { return check_text(*report); }, [&] { return check_json(*report); });
    return console.end(report->missed() ? exit_invalid : exit_done);
}

int verify_command(const CommonOptions& options, const std::string& file, const VerifyChoice& wanted)
{
    check_kind(file, "verify-file");
    VerifyOptions verify{.settings = options.set, .run = options.run_options()};
    verify.replay = wanted.replay.value_or(VerifyOptions::usual_replay);
    verify.seed = wanted.seed;
    Console console = options.console("verify-file");
    console.begin();
    const FileVerification found = verify_file(file, verify, console);
    print(
        options, [&] { return text_of(found); }, [&] { return json_of(found); });
    return console.end(!found.well() ? exit_failed : found.stopped ? exit_interrupted : exit_done);
}

} // namespace stylobate

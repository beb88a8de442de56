/// `stylobate check`.

#include "ensemble/model/input_error.hpp"
#include "io/drawing/plot_structure.hpp"
#include "io/keys/words.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/check/check_report.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/run_study.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t usual_pilot = 1024, least_pilot = 16, most_pilot = 10'000'000;

/// Why a part of the study cannot be run twice; empty: it can.
std::string no_pilot(const Study& study)
{
    if (study.kind == StudyKind::single || study.kind == StudyKind::fragility ||
        (study.kind == StudyKind::surface && !study.surface->adaptive))
        return {}; // a realization is drawn by its index alone
    return fmt::format("the realizations of study.kind = \"{}\"{} are chosen by what others did. Check the same "
                       "structure and shaking as a surface.",
                       word_for(study_kind_names, study.kind), study.surface ? " with surface.adaptive" : "");
}

/// Where the drawing goes; empty: none is asked for.
/// @throws InputError for an unknown format, or one that the file's extension contradicts
fs::path picture_path(const std::string& study, const CheckOptions& wanted)
{
    if (wanted.output.empty())
        return wanted.format.empty() ? fs::path()
                                     : fs::path(fs::path(study).stem().string() + "_structure." + wanted.format);
    const std::string ending = ending_of(wanted.output);
    if (!wanted.format.empty() && ending != wanted.format)
        throw InputError(
            fmt::format("--to {0} and -o {1}: the file extension is not .{0}", wanted.format, wanted.output));
    if (!is_picture_format(ending))
        throw InputError(
            fmt::format("-o {}: the drawing of the structure is a .png, .svg or .pdf file", wanted.output));
    return wanted.output;
}

std::uint64_t pilot_of(const CheckOptions& wanted, const Study& study, const std::string& file)
{
    const std::uint64_t pilot = wanted.pilot.value_or(usual_pilot);
    if (pilot != 0 && (pilot < least_pilot || pilot > most_pilot))
        throw InputError(
            fmt::format("--pilot {}: a pilot has {} to {} realizations; 0: none", pilot, least_pilot, most_pilot));
    if (const std::string why = no_pilot(study); wanted.pilot && pilot > 0 && !why.empty())
        throw InputError(fmt::format("{}: --pilot runs a part of a study twice: {}", file, why));
    return pilot;
}

} // namespace

int check_command(const CommonOptions& options, const std::string& file, const CheckOptions& wanted)
{
    check_kind(file, "check");
    const LoadedStudy loaded = LoadedStudy::from_file(file, options.set);
    const Study& study = loaded.study();
    CheckReport report{
        .file = file, .study = study, .run = options.run_options(), .warnings = loaded.warnings(file), .notice = {}};
    const std::uint64_t pilot = pilot_of(wanted, study, file);
    report.why_no_pilot = pilot == 0 ? "--pilot 0." : no_pilot(study);
    const ResultHeader header = loaded.result_header();
    const std::unique_ptr<Kind> kind = make_kind(study, header);
    report.notice = kind->prepare(loaded.experiment(), file);
    const std::uint64_t trajectories = trajectories_of_run(loaded, file);
    const fs::path picture = picture_path(file, wanted);
    if (!picture.empty())
        check_output(file, picture, options.force);
    const double before_s = processor_seconds();
    check_realizations(loaded.sampler(), *kind);
    const double drawing_s = processor_seconds() - before_s;

    Console console(options.quiet);
    for (const std::string& warning : report.warnings)
        console.warn(warning);
    if (!picture.empty()) {
        plot_structure(study, study.title.empty() ? fs::path(file).stem().string() : study.title, picture);
        report.picture = picture.string();
    }
    if (wanted.trial_seconds > 0)
        report.trial = try_study(loaded.experiment(), report.run, wanted.trial_seconds, trajectories, console);
    const Trial* trial = report.trial ? &*report.trial : nullptr;
    if (!console.stop_requested()) {
        report.size = size_of_run(loaded, trajectories, trial);
        if (trial && !trial->unfinished)
            report.time = time_of_run(loaded, *trial, report.size, drawing_s);
        report.memory_bytes = memory_of_run(study, report.size, peak_memory_bytes());
        report.weak = weak_spots(loaded, loaded.doubts(), trial);
        if (report.why_no_pilot.empty())
            report.pilot = check_numerics(loaded.experiment(), report.run, pilot, console);
    }
    if (console.stop_requested()) {
        fmt::print(stderr, "Interrupted; the study is not checked.\n");
        return exit_interrupted;
    }
    print_check(report, options.json);
    return report.missed() ? exit_invalid : exit_done;
}

} // namespace stylobate

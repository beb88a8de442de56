/// `stylobate report`: a result, a comparison, a diagnosis, a calibration or a risk estimate as one page.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/calibration/calibration_page.hpp"
#include "studies/decisions/compare/comparison_file.hpp"
#include "studies/decisions/compare/comparison_page.hpp"
#include "studies/decisions/laws/law_runs.hpp"
#include "studies/decisions/risk/risk_change_file.hpp"
#include "studies/decisions/risk/risk_change_text.hpp"
#include "studies/decisions/risk/risk_file.hpp"
#include "studies/decisions/risk/risk_page.hpp"
#include "studies/diagnosis/findings/diagnosis_file.hpp"
#include "studies/diagnosis/findings/diagnosis_page.hpp"
#include "studies/report/json.hpp"
#include "studies/results/result_page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

namespace stylobate {

namespace {

/// A page is HTML: another ending of its name is refused.
void check_ending(const std::string& output)
{
    const std::string ending = std::filesystem::path(output).extension().string();
    if (!ending.empty() && ending != ".html" && ending != ".htm")
        throw InputError(fmt::format(
            "-o {}: a page is written as HTML only.\n  Give a name with .html; a browser can print it to PDF.",
            output));
}

AnimationOptions animation_options(const CommonOptions& options, const ReportOptions& wanted)
{
    for (const auto& [option, value] :
         {std::pair("--animate-mb", wanted.animate_mb), std::pair("--animate-seconds", wanted.animate_seconds)})
        if (value && std::isnan(*value)) // the command line's range lets it pass
            throw InputError(fmt::format("{} nan: a number is needed", option));
    AnimationOptions animations;
    animations.each = wanted.animate.value_or(animations.each);
    animations.budget_mb = wanted.animate_mb.value_or(animations.budget_mb);
    animations.seconds = wanted.animate_seconds.value_or(animations.seconds);
    animations.wanted = (wanted.animate && *wanted.animate > 0) || wanted.animate_mb || wanted.animate_seconds;
    animations.threads = options.thread_count();
    return animations;
}

/// Diagnoses and calibrations have no realizations, and no study whose keys could be set.
void check_no_realizations(const CommonOptions& options, const ReportOptions& wanted, const std::string& file,
                           const char* kind)
{
    check_no_settings(options.set, file);
    if (wanted.animate || wanted.animate_mb || wanted.animate_seconds)
        throw InputError(
            fmt::format("--animate{}: {} is a {} and contains no realizations to choose from; its page has "
                        "the windows in motion that the file has",
                        wanted.animate      ? ""
                        : wanted.animate_mb ? "-mb"
                                            : "-seconds",
                        file, kind));
}

} // namespace

int report_command(const CommonOptions& options, const std::string& file, const ReportOptions& wanted)
{
    check_kind(file, "report");
    const std::string output = wanted.output.empty() ? beside(file, ".html").string() : wanted.output;
    check_output(file, output, options.force);
    check_ending(output);
    Console console(options.quiet); // from here on an interrupt ends the making and leaves no file
    std::string page;
    std::vector<std::string> warnings;
    const FileKind kind = recognise(file).kind;
    if (kind == FileKind::diagnosis) {
        check_no_realizations(options, wanted, file, "diagnosis");
        page = diagnosis_page(read_diagnosis(file), file, wanted.title).text();
    } else if (kind == FileKind::comparison) {
        check_no_realizations(options, wanted, file, "comparison");
        page = comparison_page(read_comparison(file), file, wanted.title, warnings).text();
    } else if (kind == FileKind::calibration) {
        check_no_realizations(options, wanted, file, "calibration");
        page = calibration_page(read_calibration(file), file, wanted.title).text();
    } else if (kind == FileKind::risk) {
        check_no_realizations(options, wanted, file, "risk estimate");
        page = recognise(file).detail == risk_of_comparison
                   ? risk_change_page(read_risk_change(file), file, wanted.title).text()
                   : risk_page(read_risk(file), file, wanted.title).text();
    } else {
        const Results results(file, options.set);
        check_complete(results.reader(), file);
        AtomicFile::check(output); // refuses before realizations are run and pictures drawn
        const KeptAnimations animations =
            keep_animations(results, options.isa(), animation_options(options, wanted), console);
        if (!animations.warning.empty())
            warnings.push_back(animations.warning);
        if (!console.stop_requested())
            page = result_page(results, options.isa(), wanted.title, animations,
                               law_band_beside(file, results.study(), results.header()), warnings)
                       .text();
    }
    if (console.stop_requested()) {
        console.warn("interrupted: no page was written");
        return exit_interrupted;
    }
    AtomicFile target(output);
    target.write(page);
    target.commit();
    for (const std::string& warning : warnings)
        console.warn(warning);
    if (options.json)
        fmt::print("{}\n", Json::object().member("written", output).text());
    else
        fmt::print("{}\n", output);
    return exit_done;
}

} // namespace stylobate
